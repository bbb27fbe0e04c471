/* case_stage.h -- a case from its text, its plan, and measured runs to be filled in by hand. */
#ifndef CASE_STAGE_H
#define CASE_STAGE_H

#include "tests/unit/unit.h"
#include "validation/figures.h"

#include <sys/stat.h>

/* folder/NAME.yaml with this text, loaded: a case "fake/..."; NULL and the fault, or the case. */
static inline struct case_file *stage_case(const char *folder, const char *name, const char *text,
                                           struct fault *fault) {
    char file[64];
    struct case_file *c = NULL;
    snprintf(file, sizeof file, "%s.yaml", name);
    mkdir(unit_path(folder, "fake"), 0755); /* may be there */
    unit_write(unit_path(folder, file), text);
    *fault = FAULT_NONE;
    case_load(folder, name, &c, fault);
    return c;
}

/* `good` with one text replaced by another, in a folder of its own that is gone again. */
static inline struct case_file *stage_spoiled(const char *name, const char *good, const char *from,
                                              const char *to, struct fault *fault) {
    char text[8192];
    const char *folder = unit_folder(), *at = strstr(good, from);
    ck_assert_msg(at != NULL, "no '%s' in the case", from);
    int length =
        snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, to, at + strlen(from));
    ck_assert_int_lt(length, (int)sizeof text);
    struct case_file *c = stage_case(folder, name, text, fault);
    unit_remove(folder);
    return c;
}

/* The plan of a tier of a case that starts from no other. */
static inline struct plan *stage_plan(const struct case_file *c, enum tier tier) {
    struct fault fault = FAULT_NONE;
    struct plan *plan;
    struct plan_order order = {.file = c};
    const struct case_file *all[] = {c};
    unit_ok(plan_make(&order, 1, all, 1, tier, 0, &plan, &fault), &fault);
    return plan;
}

/* All runs of the plan's first case, usable, without observables or samples.  It is freed by
 * measured_case_free. */
static inline struct measured_case *stage_runs(const struct plan *plan) {
    struct measured_case *m = calloc(1, sizeof *m);
    ck_assert_ptr_nonnull(m);
    m->plan = &plan->cases[0];
    m->point_count = m->plan->point_count;
    m->point = arena_take(&m->arena, m->point_count, sizeof *m->point);
    for (size_t p = 0; p < m->point_count; p++) {
        struct measured_point *point = &m->point[p];
        point->point = &m->plan->point[p];
        point->run_count = point->point->run_count;
        point->run = arena_take(&m->arena, point->run_count, sizeof *point->run);
        for (size_t i = 0; i < point->run_count; i++)
            point->run[i] = (struct measured_run){.run = point->point->run[i], .usable = true};
    }
    return m;
}

/* Build a figure of the runs; `file` says what its observables are. */
static inline enum status stage_figure(const struct measured_case *m,
                                       const struct case_figure *wanted,
                                       const struct case_file *file, struct figure_output *out,
                                       struct fault *fault) {
    struct measured_case shown;
    *fault = FAULT_NONE;
    unit_ok(figure_select(m, wanted, out->arena, &shown, fault), fault);
    struct figure_input in = {.data = &shown,
                              .file = file,
                              .wanted = wanted,
                              .observable = wanted->observable,
                              .observable_count = wanted->observable_count};
    return figure_find(wanted->recipe)->build(&in, out, fault);
}

#endif
