/* judged_stage.h -- a folder with one case and its references, and measured runs made by hand. */
#ifndef JUDGED_STAGE_H
#define JUDGED_STAGE_H

#include "tests/unit/case_stage.h"
#include "validation/rows.h"

#include <math.h>

/* Points height_l = 3.7, 5.3; two seeds of each, 11 and 12. */
#define STAGE_HEAD                                                                                 \
    "name: fake/case\ntitle: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"                \
    "sweep: {height_l: [3.7, 5.3]}\nsamples: [1]\nseeds: {first: 11, count: 2}\n"                  \
    "observables: {bed: {recipe: contacts}}\n"

struct stage {
    const char *folder;
    struct budget *budget;
    struct folder *results;
    struct execute_options o;
    struct measured_case *m;
    struct rows *rows;
};

/* Cases and references of their own folders below one. */
static inline void stage_begin(struct stage *s, const char *case_text) {
    *s = (struct stage){.folder = unit_folder()};
    static const char *const inside[] = {"cases", "cases/fake", "references", "references/fake"};
    for (size_t i = 0; i < 4; i++)
        ck_assert_int_eq(mkdir(unit_path(s->folder, inside[i]), 0755), 0);
    unit_write(unit_path(s->folder, "cases/fake/case.yaml"), case_text);
}

static inline enum status stage_open(struct stage *s, enum tier tier, struct fault *fault) {
    budget_close(s->budget);
    s->budget = NULL;
    *fault = FAULT_NONE;
    return budget_open(unit_path(s->folder, "cases"), unit_path(s->folder, "references"), tier,
                       NULL, &s->budget, fault);
}

/* What check and point are kept under, in the tier that is open. */
static inline struct reference stage_line(struct stage *s, size_t check, size_t point,
                                          enum reference_origin origin, double value,
                                          double deviation) {
    static struct arena a; /* texts must outlive the table */
    struct fault fault = FAULT_NONE;
    struct reference_key key;
    unit_ok(reference_key_make(&s->budget->plan->cases[0], check, point, &a, &key, &fault), &fault);
    bool ours = origin == ORIGIN_ENSEMBLE || origin == ORIGIN_SEED;
    return (struct reference){
        .tier = key.tier,
        .origin = origin,
        .point = arena_copy(&a, key.point), /* the plan may go */
        .observable = arena_copy(&a, key.observable),
        .value = value,
        .deviation = deviation,
        .seeds = origin == ORIGIN_ENSEMBLE ? 32 : ours,
        .meaning = ours ? key.meaning : "-",
        .commit = ours ? "0123456789abcdef0123456789abcdef01234567" : "-",
        .solver_key =
            ours ? "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff" : "-",
        .date = "2026-11-22",
        .reason = "first set"};
}

static inline void stage_write(struct stage *s, const struct reference *line, size_t count) {
    struct fault fault = FAULT_NONE;
    char *text;
    const char *path = unit_path(s->folder, "references/fake/case.tsv");
    unit_ok(reference_text(path, line, count, &text, &fault), &fault);
    unit_write(path, text);
    free(text);
}

/* Runs of the open tier; samples are filled in by the test. */
static inline void stage_measure(struct stage *s) {
    struct fault fault = FAULT_NONE;
    unit_ok(folder_open(unit_path(s->folder, "out"), true, &s->results, &fault), &fault);
    s->o = (struct execute_options){.folder = s->results, .solver = "./solver"};
    struct measured_case *m = s->m = stage_runs(s->budget->plan);
    for (size_t p = 0; p < m->point_count; p++) {
        for (size_t i = 0; i < m->point[p].run_count; i++) {
            struct measured_run *r = &m->point[p].run[i];
            r->observable = arena_take(&m->arena, 1, sizeof *r->observable);
            r->sample = arena_take(&m->arena, m->plan->tier->check_count, sizeof *r->sample);
            ck_assert(r->observable != NULL && r->sample != NULL);
        }
    }
}

/* The measured runs are those of the budget's plan, which opening makes anew. */
static inline void stage_attach(struct stage *s) {
    s->m->plan = &s->budget->plan->cases[0];
    for (size_t p = 0; p < s->m->point_count; p++) {
        s->m->point[p].point = &s->m->plan->point[p];
        for (size_t i = 0; i < s->m->point[p].run_count; i++)
            s->m->point[p].run[i].run = s->m->plan->point[p].run[i];
    }
}

/* The row of a check at a point, judged anew. */
static inline const struct report_row *stage_judge(struct stage *s, const char *check,
                                                   const char *point) {
    struct fault fault = FAULT_NONE;
    rows_free(s->rows);
    stage_attach(s);
    unit_ok(rows_judge(s->m, &s->o, s->budget, &s->rows, &fault), &fault);
    for (size_t i = 0; i < s->rows->count; i++) {
        if (strcmp(s->rows->row[i].check, check) == 0 && strcmp(s->rows->row[i].point, point) == 0)
            return &s->rows->row[i];
    }
    ck_abort_msg("no row %s at %s", check, point);
    return NULL;
}

static inline void stage_end(struct stage *s) {
    rows_free(s->rows);
    measured_case_free(s->m);
    budget_close(s->budget);
    folder_close(s->results);
    unit_remove(s->folder);
}

#endif
