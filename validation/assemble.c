#include "validation/assemble.h"

#include "common/build.h"
#include "common/yaml.h"
#include "validation/claims_judge.h"
#include "validation/execute.h"
#include "validation/figures.h"
#include "validation/papers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FACTS = 64, MAX_RECORD_BYTES = 1 << 20 };

struct builder {
    const struct assemble_input *in;
    struct assembled *out;
    struct arena *arena;
    struct report_fact *fact;
    struct report_case *cases;               /* = out->report.cases */
    const struct report_gallery_item **item; /* item[case][figure]: what it has become */
    struct fault *fault;
};

static enum status no_memory(struct builder *b) {
    return fault_set(b->fault, STATUS_NO_MEMORY, "report: out of memory");
}

/* -- figures -------------------------------------------------------------------- */

/* In place of a figure that its data do not allow. */
static enum status say_missing(struct builder *b, const struct case_figure *f,
                               const struct fault *why, struct figure_output *out) {
    const char **text = arena_take(b->arena, 2, sizeof *text);
    if (text == NULL || (text[1] = arena_copy(b->arena, why->text)) == NULL)
        return no_memory(b);
    text[0] = "Why";
    struct report_table t = {.title = f->title != NULL ? f->title : f->recipe,
                             .caption = "This figure could not be drawn.",
                             .columns = 1,
                             .rows = 1,
                             .heading = &text[0],
                             .cell = &text[1]};
    return figure_add_table(out, &t, b->fault);
}

static void mark(const struct figure_output *out, size_t *at) {
    at[GALLERY_PLOT] = out->figure_count;
    at[GALLERY_PICTURE] = out->picture_count;
    at[GALLERY_SEQUENCE] = out->sequence_count;
    at[GALLERY_ANIMATION] = out->animation_count;
}

/* item[i]: what figure i of the case becomes. */
static enum status build_figures(struct builder *b, const struct assemble_case *c,
                                 struct report_gallery_item *item, struct figure_output *out) {
    const struct case_file *file = c->plan->file;
    struct figure_input in = {.data = c->measured,
                              .file = file,
                              .row_count = c->rows->count,
                              .row = c->rows->row,
                              .row_point = c->rows->point,
                              .row_check = c->rows->check};
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < file->figure_count; i++) {
        const struct case_figure *f = &file->figure[i];
        struct measured_case shown;
        struct fault why = FAULT_NONE;
        if (!f->in_tier[c->plan->tier - file->tier])
            continue;
        in.wanted = f;
        in.observable = f->observable;
        in.observable_count = f->observable_count;
        in.data = &shown;
        mark(out, item[i].begin);
        status = figure_select(c->measured, f, b->arena, &shown, &why);
        if (status == STATUS_OK)
            status = figure_find(f->recipe)->build(&in, out, &why);
        mark(out, item[i].end);
        if (status == STATUS_NO_MEMORY)
            *b->fault = why;
        else if (status != STATUS_OK)
            status = say_missing(b, f, &why, out);
    }
    in.data = c->measured;
    in.wanted = NULL;
    in.observable = NULL;
    in.observable_count = 0;
    return status == STATUS_OK ? figure_default_build(&in, out, b->fault) : status;
}

/* -- cases ---------------------------------------------------------------------- */

/* A path that works in any folder, as a word of a shell; what does not exist stays as it is. */
static const char *path_word(struct builder *b, const char *path) {
    char *real = realpath(path, NULL);
    const char *copy = arena_copy(b->arena, real != NULL ? real : path);
    free(real);
    return copy == NULL ? NULL : execute_shell_word(b->arena, copy);
}

/* One line that runs a case again as this report's was, from any folder. */
static const char *command_of(struct builder *b, const char *name) {
    const struct folder_record *r = b->in->record;
    const char *program = b->in->program == NULL ? "bedcheck" : path_word(b, b->in->program);
    const char *cases = path_word(b, r->cases_folder), *solver = path_word(b, r->solver);
    const char *line = program == NULL || cases == NULL || solver == NULL
                           ? NULL
                           : arena_text(b->arena, "%s run %s --tier %s --cases %s --solver %s",
                                        program, name, r->tier, cases, solver);
    for (size_t i = 0; i < r->setting_count && line != NULL; i++) {
        const char *word = execute_shell_word(b->arena, r->setting[i]);
        line = word == NULL ? NULL : arena_text(b->arena, "%s --set %s", line, word);
    }
    return line;
}

static enum status build_case(struct builder *b, const struct assemble_case *c,
                              struct report_case *out) {
    const struct case_file *file = c->plan->file;
    *out = (struct report_case){.name = file->name,
                                .title = file->title,
                                .source = file->source,
                                .question = file->question,
                                .equation = file->equation};
    out->command = command_of(b, file->name);
    out->skip_reason = c->plan->skip_reason != NULL ? c->plan->skip_reason : c->not_run;
    out->skipped = c->rows == NULL;
    if (out->command == NULL)
        return no_memory(b);
    if (c->rows == NULL)
        return STATUS_OK;
    struct figure_output *f = arena_take(b->arena, 1, sizeof *f);
    struct report_gallery_item *item = arena_take(b->arena, file->figure_count, sizeof *item);
    if (f == NULL || item == NULL)
        return no_memory(b);
    f->arena = b->arena;
    b->item[c - b->in->cases] = item;
    enum status status = build_figures(b, c, item, f);
    out->row = c->rows->row;
    out->row_count = c->rows->count;
    out->figure = f->figure;
    out->figure_count = f->figure_count;
    out->picture = f->picture;
    out->picture_count = f->picture_count;
    out->table = f->table;
    out->table_count = f->table_count;
    out->sequence = f->sequence;
    out->sequence_count = f->sequence_count;
    out->animation = f->animation;
    out->animation_count = f->animation_count;
    return status;
}

static enum status build_cases(struct builder *b) {
    struct report *r = &b->out->report;
    struct report_case *cases = arena_take(b->arena, b->in->case_count, sizeof *cases);
    b->item = arena_take(b->arena, b->in->case_count, sizeof *b->item);
    enum status status = cases == NULL || b->item == NULL ? no_memory(b) : STATUS_OK;
    r->cases = b->cases = cases;
    for (; status == STATUS_OK && r->case_count < b->in->case_count; r->case_count++)
        status = build_case(b, &b->in->cases[r->case_count], &cases[r->case_count]);
    return status;
}

static enum status build_ledger(struct builder *b) {
    const struct assemble_input *in = b->in;
    if (in->papers == NULL || in->papers->claims->count == 0)
        return STATUS_OK;
    const struct claims_input c = {.claims = in->papers->claims,
                                   .stored = in->papers->stored,
                                   .tier = in->plan->tier,
                                   .cases = in->cases,
                                   .report = b->cases,
                                   .case_count = in->case_count};
    struct report_ledger *ledger = arena_take(b->arena, 1, sizeof *ledger);
    if (ledger == NULL)
        return no_memory(b);
    b->out->report.ledger = ledger;
    return claims_judge(&c, b->arena, ledger, b->fault);
}

static enum status build_gallery(struct builder *b) {
    const struct assemble_input *in = b->in;
    if (in->papers == NULL || in->papers->gallery->count == 0)
        return STATUS_OK;
    const struct gallery_input g = {.tier = in->plan->tier,
                                    .cases = in->cases,
                                    .report = b->cases,
                                    .item = b->item,
                                    .case_count = in->case_count};
    struct report_gallery *gallery = arena_take(b->arena, 1, sizeof *gallery);
    if (gallery == NULL)
        return no_memory(b);
    b->out->report.gallery = gallery;
    return gallery_hang(in->papers->gallery, &g, b->arena, gallery, b->fault);
}

/* -- facts ---------------------------------------------------------------------- */

/* One fact a name; different values of several runs stand beside each other. */
static void add_fact(struct builder *b, const char *name, const char *value) {
    struct report *r = &b->out->report;
    if (value == NULL)
        return;
    for (size_t i = 0; i < r->fact_count; i++) {
        if (strcmp(b->fact[i].name, name) != 0)
            continue;
        if (strstr(b->fact[i].value, value) == NULL) {
            const char *both = arena_text(b->arena, "%s; %s", b->fact[i].value, value);
            b->fact[i].value = both != NULL ? both : b->fact[i].value;
        }
        return;
    }
    const char *n = arena_copy(b->arena, name), *v = arena_copy(b->arena, value);
    if (r->fact_count < MAX_FACTS && n != NULL && v != NULL)
        b->fact[r->fact_count++] = (struct report_fact){n, v};
}

/* What the solver says of itself and its machine, from the record beside a result. */
static void add_record(struct builder *b, const struct plan_run *run) {
    static const char *const key[] = {"version", "commit", "dirty",   "compiler", "flags",
                                      "gsl",     "hdf5",   "libyaml", "cpu",      "host"};
    struct yaml_document *d = NULL;
    struct fault ignored = FAULT_NONE; /* a solver need not write a record */
    const char *path = folder_result(b->in->folder, b->arena, run);
    path = path == NULL ? NULL : arena_text(b->arena, "%.*s.run.json", (int)strlen(path) - 3, path);
    if (path == NULL || yaml_load(path, MAX_RECORD_BYTES, &d, &ignored) != STATUS_OK)
        return;
    const struct yaml_node *build =
        yaml_root(d)->kind == YAML_MAP ? yaml_get(yaml_root(d), "build") : NULL;
    for (size_t i = 0; build != NULL && build->kind == YAML_MAP && i < sizeof key / sizeof *key;
         i++) {
        const struct yaml_node *n = yaml_get(build, key[i]);
        const char *name = arena_text(b->arena, "solver: %s", key[i]);
        if (n != NULL && n->kind == YAML_SCALAR && name != NULL)
            add_fact(b, name, n->text);
    }
    yaml_free(d);
}

static void add_times(struct builder *b) {
    size_t made = 0, reused = 0, failed = 0;
    double seconds = 0;
    for (size_t i = 0; i < b->in->plan->run_count; i++) {
        const struct outcome *o = &b->in->outcome[i];
        made += o->state == RUN_DONE;
        reused += o->state == RUN_REUSED;
        failed += o->state == RUN_FAILED;
        seconds += isfinite(o->seconds) ? o->seconds : 0;
    }
    add_fact(b, "runs",
             arena_text(b->arena, "%zu made, %zu reused, %zu failed", made, reused, failed));
    add_fact(b, "solver time, all runs", arena_text(b->arena, "%.1f s", seconds));
}

static void build_facts(struct builder *b) {
    const struct folder_record *r = b->in->record;
    add_fact(b, "bedcheck: version", build_version());
    add_fact(b, "bedcheck: commit", build_commit());
    add_fact(b, "bedcheck: dirty", build_dirty());
    if (r->seed_offset != 0)
        add_fact(b, "seed offset", arena_text(b->arena, "%lld", r->seed_offset));
    add_times(b);
    for (size_t i = 0; i < b->in->plan->run_count; i++)
        add_record(b, b->in->plan->run[i]);
}

static const char *join_settings(struct builder *b) {
    const struct folder_record *r = b->in->record;
    const char *text = "";
    for (size_t i = 0; i < r->setting_count && text != NULL; i++)
        text = arena_text(b->arena, "%s%s%s", text, i == 0 ? "" : ", ", r->setting[i]);
    return text;
}

enum status assemble_report(const struct assemble_input *in, struct assembled **out,
                            struct fault *fault) {
    *out = NULL;
    struct assembled *a = calloc(1, sizeof *a);
    if (a == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
    struct builder b = {.in = in, .out = a, .arena = &a->arena, .fault = fault};
    struct report *r = &a->report;
    r->suite = arena_text(&a->arena, "bedcheck %s", build_version());
    r->tier = in->record->tier;
    r->solver = in->record->solver;
    r->solver_key = in->record->solver_key;
    r->started = in->record->started;
    r->modified = in->record->setting_count > 0;
    r->modification = join_settings(&b);
    b.fact = arena_take(&a->arena, MAX_FACTS, sizeof *b.fact);
    r->fact = b.fact;
    if (in->budget != NULL)
        r->budget = (struct report_budget){.allowed = SUITE_FALSE_ALARMS,
                                           .share = in->budget->share,
                                           .statistical = in->budget->statistical};
    for (size_t i = 0; i < in->case_count; i++) {
        const struct rows *rows = in->cases[i].rows;
        r->bits.same += rows == NULL ? 0 : rows->bits.same;
        r->bits.other += rows == NULL ? 0 : rows->bits.other;
        r->bits.unknown += rows == NULL ? 0 : rows->bits.unknown;
    }
    enum status status = r->suite == NULL || r->modification == NULL || b.fact == NULL
                             ? no_memory(&b)
                             : build_cases(&b);
    if (status == STATUS_OK)
        status = build_ledger(&b);
    if (status == STATUS_OK)
        status = build_gallery(&b);
    if (status == STATUS_OK)
        build_facts(&b);
    else {
        assemble_free(a);
        return status;
    }
    *out = a;
    return STATUS_OK;
}

void assemble_free(struct assembled *a) {
    if (a == NULL)
        return;
    arena_free(&a->arena);
    free(a);
}
