/* command_accept.c -- bedcheck accept: the only way for a result to become a reference.
 *
 * Every ground for refusing is told at once.  A reference is worth what its history is
 * worth: it comes from the present commit (stored references aside), from runs as their
 * cases say, from results that pass what does not depend on references, for a stated
 * reason, and by a person, never by a CI server.
 */
#include "validation/command.h"

#include "common/build.h"
#include "validation/accept.h"
#include "validation/accept_claims.h"
#include "validation/bits.h"
#include "validation/desk.h"
#include "validation/review.h"
#include "validation/source_tree.h"

#include <fnmatch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct work {
    const struct command_options *o;
    const struct console *console;
    struct review *review;
    struct source_tree tree;
    struct desk *desk;
    struct budget *budget;
    size_t count;
    struct accept_case *list; /* list[0 .. count-1]: the chosen cases, none with --claims */
    bool *chosen;             /* chosen[0 .. plan->case_count-1], with --claims all */
    struct assemble_case *cases;
    struct accept_claims claims;
    struct accept_history history;
    char date[16];
    struct fault *fault;
};

static void refuse(struct work *w, const char *why) {
    fault_add(w->fault, STATUS_BAD_INPUT, "%s", why);
}

/* Findings of one step, added to those of others. */
static enum status add_findings(struct work *w, const struct fault *found) {
    if (found->status != STATUS_OK)
        fault_add(w->fault, found->status, "%s", found->text);
    return found->status;
}

/* -- grounds that need no look at the results ---------------------------------------------- */

static bool says_something(const char *reason) {
    for (const char *p = reason; p != NULL && *p != '\0'; p++) {
        if ((unsigned char)*p < ' ' || *p == 127)
            return false;
    }
    return reason != NULL && reason[strspn(reason, " -.")] != '\0';
}

static void check_asked(struct work *w) {
    const struct command_options *o = w->o;
    if (o->in_ci)
        refuse(w, "CI is set: a person accepts references, not a server");
    if (!says_something(o->reason))
        refuse(w, "--reason TEXT: say in one line why the references change");
    if (o->all_changed + o->claims + (o->chosen_count > 0) != 1)
        refuse(w, "which cases? --case CASE (may be repeated), --all-changed or --claims");
}

static void check_record(struct work *w) {
    const struct folder_record *r = &w->review->record;
    if (r->setting_count > 0)
        fault_add(w->fault, STATUS_BAD_INPUT, "%s: MODIFIED: made with --set %s", w->o->out,
                  r->setting[0]);
    if (r->seed_offset != 0)
        fault_add(w->fault, STATUS_BAD_INPUT,
                  "%s: made with --seed-offset %lld: references are of the case's own seeds",
                  w->o->out, r->seed_offset);
    if (w->review->references_folder == NULL)
        refuse(w, "no folder of references: use --references DIR");
}

/* -- which build ----------------------------------------------------------------------------- */

static void check_tree(struct work *w) {
    const struct source_tree *t = &w->tree;
    if (t->first_change != NULL)
        fault_add(w->fault, STATUS_BAD_INPUT, "%s: not committed: %s", t->top, t->first_change);
    struct fault found = FAULT_NONE;
    bool is_head = false, known = false;
    if (!t->is_ours)
        return;
    source_tree_is_head(&w->tree, build_commit(), &is_head, &known, &found);
    if (add_findings(w, &found) == STATUS_OK && (!is_head || strcmp(build_dirty(), "clean") != 0))
        fault_add(w->fault, STATUS_BAD_INPUT,
                  "this bedcheck is of commit %.12s (%s), not of HEAD, %.12s: build it again",
                  build_commit(), build_dirty(), t->head);
}

static void check_build(struct work *w, const char *run, const struct bits_build *b) {
    struct fault found = FAULT_NONE;
    bool is_head = false, known = false;
    source_tree_is_head(&w->tree, b->commit, &is_head, &known, &found);
    if (add_findings(w, &found) != STATUS_OK)
        return;
    if (strcmp(b->commit, "unknown") == 0 || strcmp(b->dirty, "clean") != 0)
        fault_add(w->fault, STATUS_BAD_INPUT, "%s: made by a build of commit %.12s (%s)", run,
                  b->commit, b->dirty);
    else if (!is_head)
        fault_add(w->fault, STATUS_BAD_INPUT,
                  "%s: made by a build of commit %.12s%s, not of HEAD, %.12s", run, b->commit,
                  known ? "" : ", which this checkout does not have", w->tree.head);
}

/* Every record of a run that did not fail; equal builds are looked at once. */
static enum status check_runs(struct work *w) {
    struct bits_build last = {"", "", ""}, b;
    const struct review *r = w->review;
    for (size_t i = 0; i < r->plan->run_count; i++) {
        const struct plan_run *run = r->plan->run[i];
        if (r->outcome[i].state == RUN_FAILED)
            continue; /* has a row of its own, which fails */
        const char *record = folder_run_record(r->folder, &w->review->arena, run);
        struct fault found = FAULT_NONE;
        if (record == NULL)
            return fault_set(w->fault, STATUS_NO_MEMORY, "accept: out of memory");
        bits_read_build(record, &b, &found);
        if (add_findings(w, &found) != STATUS_OK)
            return w->fault->status;
        if (strcmp(b.commit, last.commit) == 0 && strcmp(b.dirty, last.dirty) == 0)
            continue;
        check_build(w, run->name, &b);
        last = b;
    }
    w->history.commit = arena_copy(&w->review->arena, last.commit);
    return w->history.commit == NULL
               ? fault_set(w->fault, STATUS_NO_MEMORY, "accept: out of memory")
               : w->fault->status;
}

/* -- which cases ------------------------------------------------------------------------------ */

static bool is_chosen(const struct work *w, const char *name) {
    for (size_t i = 0; i < w->o->chosen_count; i++) {
        if (fnmatch(w->o->chosen[i], name, 0) == 0)
            return true;
    }
    return w->o->all_changed || w->o->claims;
}

static void check_choice(struct work *w) {
    const struct plan *p = w->review->plan;
    for (size_t i = 0; i < w->o->chosen_count; i++) {
        bool hit = false;
        for (size_t c = 0; c < p->case_count; c++)
            hit |= p->cases[c].skip_reason == NULL &&
                   fnmatch(w->o->chosen[i], p->cases[c].file->name, 0) == 0;
        if (!hit)
            fault_add(w->fault, STATUS_NOT_FOUND, "--case %s: %s has no results of such a case",
                      w->o->chosen[i], w->o->out);
    }
}

/* What does not depend on references must pass. */
static void check_rows(struct work *w, size_t index) {
    const struct rows *rows = desk_rows(w->desk, index);
    for (size_t i = 0; i < rows->count; i++) {
        const struct report_row *row = &rows->row[i];
        bool own = rows->check[i] != NULL && rows->check[i]->kind == KIND_REGRESSION;
        if (row->verdict == VERDICT_FAIL && !own)
            fault_add(w->fault, STATUS_BAD_INPUT, "%s: %s [%s] fails: %s", row->case_name,
                      row->check, row->point, row->reason);
    }
}

static enum status judge(struct work *w) {
    enum verdict worst = VERDICT_PASS;
    struct review *r = w->review;
    struct fault found = FAULT_NONE;
    enum status status = budget_open_unrefused(r->cases_folder, r->references_folder, r->plan->tier,
                                               r->plan, &w->budget, &found);
    if (status == STATUS_OK)
        status = desk_create(r->plan, r->outcome, &r->execute, NULL, &w->desk, &found);
    if (status == STATUS_OK)
        desk_set_budget(w->desk, w->budget);
    if (status == STATUS_OK)
        status = desk_judge(w->desk, &worst, &found);
    return add_findings(w, &found) == STATUS_OK ? w->fault->status : status;
}

/* A regression check must see what it says with the new numbers and its case's own seeds: one
 * diverging run among them makes it blind. */
static void check_power(struct work *w, const struct accept_case *c) {
    const struct plan *all = w->budget->plan;
    struct references fresh = {.count = c->count, .item = c->item};
    struct fault found = FAULT_NONE;
    for (size_t i = 0; i < all->case_count; i++) {
        if (strcmp(all->cases[i].file->name, c->plan->file->name) == 0)
            budget_refuse(&all->cases[i], &fresh, w->budget->share, &found);
    }
    add_findings(w, &found);
}

static enum status gather_case(struct work *w, size_t index) {
    const struct plan_case *c = &w->review->plan->cases[index];
    struct case_file *own = NULL; /* as its text says, whatever --seeds said */
    struct fault found = FAULT_NONE;
    case_load(w->review->cases_folder, c->file->name, &own, &found);
    if (add_findings(w, &found) != STATUS_OK)
        return w->fault->status;
    struct accept_source source = {.measured = desk_measured(w->desk, index),
                                   .own = &own->tier[w->review->plan->tier].seeds,
                                   .results = w->review->folder,
                                   .references_folder = w->review->references_folder,
                                   .history = w->history};
    struct accept_case *fresh = &w->list[w->count++];
    accept_gather(&source, fresh, &found);
    if (add_findings(w, &found) == STATUS_OK)
        check_power(w, fresh);
    case_free(own);
    return w->fault->status;
}

/* Verdicts of the claims that rest on chosen cases alone; what is wrong with those cases. */
static enum status gather_claims(struct work *w) {
    const struct review *r = w->review;
    struct fault found = FAULT_NONE;
    for (size_t i = 0; i < r->plan->case_count; i++)
        w->cases[i] = (struct assemble_case){.plan = &r->plan->cases[i],
                                             .measured = desk_measured(w->desk, i),
                                             .rows = desk_rows(w->desk, i)};
    const struct accept_claims_source source = {.cases_folder = r->cases_folder,
                                                .references_folder = r->references_folder,
                                                .tier = r->plan->tier,
                                                .cases = w->cases,
                                                .chosen = w->chosen,
                                                .case_count = r->plan->case_count,
                                                .commit = w->history.commit,
                                                .date = w->history.date,
                                                .reason = w->history.reason};
    accept_claims_gather(&source, &w->claims, &found);
    if (add_findings(w, &found) != STATUS_OK)
        return w->fault->status;
    for (size_t i = 0; w->o->claims && i < r->plan->case_count; i++) {
        if (accept_claims_rest_on(&w->claims, &source, i))
            check_rows(w, i);
    }
    return w->fault->status;
}

static enum status gather(struct work *w) {
    const struct plan *p = w->review->plan;
    w->list = calloc(p->case_count + 1, sizeof *w->list);
    w->chosen = calloc(p->case_count + 1, sizeof *w->chosen);
    w->cases = calloc(p->case_count + 1, sizeof *w->cases);
    if (w->list == NULL || w->chosen == NULL || w->cases == NULL)
        return fault_set(w->fault, STATUS_NO_MEMORY, "accept: out of memory");
    for (size_t i = 0; i < p->case_count; i++) {
        w->chosen[i] = p->cases[i].skip_reason == NULL && is_chosen(w, p->cases[i].file->name);
        if (!w->chosen[i] || w->o->claims)
            continue;
        check_rows(w, i);
        gather_case(w, i);
    }
    return gather_claims(w);
}

/* -- telling --------------------------------------------------------------------------------- */

static void tell_value(FILE *out, const struct reference *r) {
    if (r == NULL)
        fputs("none", out);
    else if (r->origin == ORIGIN_ENSEMBLE)
        fprintf(out, "%.6g (%zu seeds, deviation %.2g)", r->value, r->seeds, r->deviation);
    else
        fprintf(out, "%.9g", r->value);
}

static void tell_change(FILE *out, const struct accept_change *c) {
    const struct reference *r = c->new != NULL ? c->new : c->old;
    double difference = accept_difference(c);
    fprintf(out, "  %s [%s] %s: ", case_tier_name(r->tier), r->point, r->observable);
    tell_value(out, c->old);
    fputs(" -> ", out);
    tell_value(out, c->new);
    if (isfinite(difference))
        fprintf(out, ", %+.1f u", difference);
    if (c->old != NULL && c->new != NULL &&strcmp(c->old->meaning, c->new->meaning) != 0)
        fputs(", the case text is another", out);
    fputc('\n', out);
}

static void tell_bits(FILE *out, const struct accept_case *c) {
    size_t fresh = 0, changed = 0, gone = 0, all = 0;
    for (size_t i = 0; i < c->change_count; i++) {
        const struct accept_change *change = &c->change[i];
        const struct reference *r = change->new != NULL ? change->new : change->old;
        if (r->origin != ORIGIN_BITS)
            continue;
        fresh += change->old == NULL;
        gone += change->new == NULL;
        changed += change->old != NULL && change->new != NULL;
    }
    for (size_t i = 0; i < c->count; i++)
        all += c->item[i].origin == ORIGIN_BITS;
    if (all + gone > 0)
        fprintf(out, "  bits of runs: %zu new, %zu changed, %zu as they were, %zu removed\n", fresh,
                changed, all - fresh - changed, gone);
}

static void tell_case(FILE *out, const struct accept_case *c) {
    fprintf(out, "%s: %s\n", c->plan->file->name,
            c->change_count == 0 ? "nothing changed" : "old -> new");
    for (size_t i = 0; i < c->change_count; i++) {
        const struct accept_change *change = &c->change[i];
        if ((change->new != NULL ? change->new : change->old)->origin != ORIGIN_BITS)
            tell_change(out, change);
    }
    tell_bits(out, c);
    for (size_t i = 0; i < c->omission_count; i++)
        fprintf(out, "  no ensemble: %s\n", c->omission[i]);
}

static size_t tell(const struct work *w) {
    size_t changed = 0;
    for (size_t i = 0; i < w->count; i++) {
        changed += w->list[i].change_count > 0;
        if (!w->o->all_changed || w->list[i].change_count > 0)
            tell_case(w->console->out, &w->list[i]);
    }
    return changed;
}

static void tell_verdict(FILE *out, const struct work *w, const struct accept_verdict *v) {
    fprintf(out, "  %s %s: %s -> %s: %s\n", case_tier_name(w->review->plan->tier), v->id,
            v->old == NULL ? "none" : v->old, v->new == NULL ? "none" : v->new, v->why);
}

static void tell_claims(const struct work *w) {
    FILE *out = w->console->out;
    const struct accept_claims *c = &w->claims;
    if (c->change_count > 0)
        fputs("claims of the papers: old -> new\n", out);
    for (size_t i = 0; i < c->change_count; i++)
        tell_verdict(out, w, &c->change[i]);
    for (size_t i = 0; i < c->open_count; i++) {
        const struct accept_verdict *v = &c->open[i];
        fprintf(out, "  %s %s: undecided, %s: %s\n", case_tier_name(w->review->plan->tier), v->id,
                v->old == NULL ? "nothing is stored" : "what is stored stays", v->why);
    }
}

/* -- the command ------------------------------------------------------------------------------ */

static enum status look(struct work *w) {
    const struct command_options *o = w->o;
    struct fault found = FAULT_NONE;
    check_asked(w);
    review_open(o->out, o->cases_folder, o->references_folder, &w->review, &found);
    if (add_findings(w, &found) != STATUS_OK)
        return w->fault->status;
    check_record(w);
    check_choice(w);
    source_tree_look(w->review->cases_folder, w->review->references_folder, o->path_list,
                     o->environment, &w->tree, &found);
    if (add_findings(w, &found) != STATUS_OK)
        return w->fault->status;
    check_tree(w);
    return check_runs(w);
}

static enum status work_out(struct work *w) {
    time_t now = time(NULL);
    struct tm day;
    if (gmtime_r(&now, &day) == NULL || strftime(w->date, sizeof w->date, "%Y-%m-%d", &day) == 0)
        return fault_set(w->fault, STATUS_IO, "the clock gives no day");
    w->history.date = w->date;
    w->history.reason = w->o->reason;
    w->history.solver_key = w->review->record.solver_key;
    enum status status = judge(w);
    return status == STATUS_OK ? gather(w) : status;
}

static enum status finish(struct work *w) {
    size_t changed = tell(w), verdicts = w->claims.change_count;
    enum status status = STATUS_OK;
    tell_claims(w);
    if (!w->o->dry_run)
        status =
            accept_write(w->review->references_folder, w->list, w->count, &w->claims, w->fault);
    if (status != STATUS_OK)
        return status;
    FILE *out = w->console->out;
    fprintf(out, "%s: ", w->review->references_folder);
    if (!w->o->claims)
        fprintf(out, "%zu of %zu cases", changed, w->count);
    if (w->o->claims || verdicts > 0)
        fprintf(out, "%s%zu claim%s", w->o->claims ? "" : ", ", verdicts, verdicts == 1 ? "" : "s");
    fprintf(out, " %s\n", w->o->dry_run ? "would change (--dry-run)" : "changed");
    return STATUS_OK;
}

int command_accept(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct work w = {.o = o, .console = c, .fault = &fault};
    if (look(&w) != STATUS_OK || work_out(&w) != STATUS_OK || finish(&w) != STATUS_OK)
        fprintf(c->errors, "bedcheck: nothing is accepted:\n%s\n", fault.text);
    for (size_t i = 0; i < w.count; i++)
        accept_free(&w.list[i]);
    free(w.list);
    accept_claims_free(&w.claims);
    free(w.cases);
    free(w.chosen);
    desk_free(w.desk);
    budget_close(w.budget);
    source_tree_free(&w.tree);
    review_close(w.review);
    return fault.status == STATUS_OK ? 0 : 2;
}
