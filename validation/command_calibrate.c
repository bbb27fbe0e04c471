/* command_calibrate.c -- bedcheck calibrate: many seeds of some cases, and what they say. */
#include "validation/command.h"

#include "validation/budget.h"
#include "validation/calibrate.h"
#include "validation/desk.h"
#include "validation/review.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct work {
    const struct command_options *o;
    FILE *out;
    struct review *review;
    struct desk *desk;
    struct budget *budget; /* of every case of the folder, not of the chosen ones */
    double share;
    struct calibrate_count sum; /* over all rows that could be held out */
    size_t unknown;             /* rows whose rate is not to be had */
    struct fault *fault;
};

/* -- telling -------------------------------------------------------------------------------- */

static void tell_amount(FILE *out, const char *what, double value, double of) {
    fprintf(out, "%s%.3g", what, value);
    if (of != 0)
        fprintf(out, " (%.2g %%)", 100 * value / fabs(of));
}

static void tell_row(struct work *w, const struct scatter *s, size_t n) {
    FILE *out = w->out;
    struct calibrate_row row;
    calibrate_row(s, n, w->share, &row);
    fprintf(out, "  %s [%s] %s\n", s->check->name, s->key.point, s->key.observable);
    if (s->missing != NULL) {
        w->unknown++;
        fprintf(out, "      no ensemble: %s\n", s->missing);
        return;
    }
    double of = s->key.difference ? 0 : s->mean;
    fprintf(out, "      mean %.6g", s->mean);
    tell_amount(out, ", deviation ", s->deviation, of);
    tell_amount(out, "; a regression check sees ", row.detectable, of);
    fputc('\n', out);
    if (s->check->kind == KIND_REGRESSION)
        return;
    double expected = s->key.difference ? 0 : s->expected[0];
    fprintf(out, "      expected %.6g", expected);
    tell_amount(out, ", margin ", row.tolerance, expected);
    fprintf(out, ": alarm rate %.2g%s", row.rate, row.rate <= w->share ? "" : ", over its share");
    if (isfinite(row.margin)) {
        tell_amount(out, "; would do: scatter ", row.scatter, expected);
        tell_amount(out, ", margin ", row.margin, expected);
    }
    fputc('\n', out);
}

static void hold_out(struct work *w, const struct scatter *s, size_t n) {
    struct calibrate_count c;
    calibrate_hold_out(s, n, w->share, &c);
    w->sum.groups += c.groups;
    w->sum.not_pass += c.not_pass;
    w->sum.beyond += c.beyond;
    w->sum.expected += isfinite(c.expected) ? c.expected : 0;
    if (c.groups == 0)
        return;
    fprintf(w->out,
            "      held out: %zu runs of %zu %s, %zu do not pass (%.2g expected), %zu part from "
            "the first %zu seeds (%.2g expected)\n",
            c.groups, n, n == 1 ? "seed" : "seeds", c.not_pass, c.expected, c.beyond, c.calibrating,
            CALIBRATE_LEVEL * (double)c.groups);
}

static enum status tell_case(struct work *w, size_t index) {
    const struct measured_case *m = desk_measured(w->desk, index);
    const struct plan_case *plan = m->plan;
    struct case_file *own = NULL; /* as its text says: how many seeds a run has */
    struct arena a = {0};
    struct scatter *list = NULL;
    size_t count = 0;
    enum status status = case_load(w->review->cases_folder, plan->file->name, &own, w->fault);
    if (status == STATUS_OK)
        status = scatter_measure(m, &a, &list, &count, w->fault);
    if (status == STATUS_OK)
        fprintf(w->out, "%s: %zu rows that chance may decide\n", plan->file->name, count);
    for (size_t i = 0; status == STATUS_OK && i < count; i++) {
        const struct plan_point *p = &plan->point[list[i].point];
        size_t n = case_seed_count(&own->tier[w->review->plan->tier].seeds, p->parameter,
                                   p->parameter_count);
        tell_row(w, &list[i], n);
        hold_out(w, &list[i], n);
    }
    arena_free(&a);
    case_free(own);
    return status;
}

static enum status tell_all(struct work *w) {
    const struct plan *p = w->review->plan;
    fprintf(w->out,
            "tier %s, %zu seeds a point; budget %g false alarms a run of the suite, %zu rows share "
            "it: %.2g each\n",
            case_tier_name(p->tier), w->o->seed_count, SUITE_FALSE_ALARMS, w->budget->statistical,
            w->share);
    for (size_t i = 0; i < p->case_count; i++) {
        if (p->cases[i].skip_reason == NULL && tell_case(w, i) != STATUS_OK)
            return w->fault->status;
    }
    fprintf(w->out,
            "held-out runs of all rows: %zu; %zu do not pass (%.2g expected), %zu part from the "
            "first half (%.3g expected at %g)\n",
            w->sum.groups, w->sum.not_pass, w->sum.expected, w->sum.beyond,
            CALIBRATE_LEVEL * (double)w->sum.groups, CALIBRATE_LEVEL);
    if (w->unknown > 0)
        fprintf(w->out, "%zu rows without an ensemble: their alarm rate is not known\n",
                w->unknown);
    return STATUS_OK;
}

static enum status look(struct work *w) {
    const struct command_options *o = w->o;
    enum verdict worst = VERDICT_PASS;
    struct review **r = &w->review;
    enum status status = review_open(o->out, o->cases_folder, o->references_folder, r, w->fault);
    if (status == STATUS_OK)
        status = desk_create((*r)->plan, (*r)->outcome, &(*r)->execute, NULL, &w->desk, w->fault);
    if (status == STATUS_OK)
        status = desk_judge(w->desk, &worst, w->fault);
    if (status == STATUS_OK)
        status = budget_open((*r)->cases_folder, NULL, (*r)->plan->tier, (*r)->plan, &w->budget,
                             w->fault);
    if (status != STATUS_OK)
        return status;
    w->share = w->budget->share;
    return tell_all(w);
}

int command_calibrate(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct work w = {.o = o, .out = c->out, .fault = &fault};
    if (o->seed_count < 4) {
        fprintf(c->errors, "bedcheck: how many seeds? --seeds K, 4 or more; an ensemble needs %d\n",
                (int)REFERENCE_MIN_SEEDS);
        return 2;
    }
    int code = command_run(o, c);
    if (o->dry_run || code == 2 || code == 130)
        return code;
    if (look(&w) != STATUS_OK) {
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
        code = 2;
    }
    budget_close(w.budget);
    desk_free(w.desk);
    review_close(w.review);
    return code == 2 ? 2 : 0;
}
