/* plan.h -- cases x points x seeds of a tier, expanded into flat runs.
 *
 * Each point of each case and each seed is one run of the solver, described by
 * a run file (common/runfile.h) that names the origin of every parameter.  A
 * run's name is made of its case and of the digest of its meaning (parameters,
 * samples, datasets, start), so points that a solver cannot tell apart share a
 * run, and so do cases that start from the same run of another case.
 */
#ifndef VALIDATION_PLAN_H
#define VALIDATION_PLAN_H

#include "validation/case.h"

struct plan_run {
    const char *id;       /* "graingas.sedimentation.1a2b3c4d" */
    const char *name;     /* id and seed: "graingas.sedimentation.1a2b3c4d-s1101" */
    const char *run_file; /* in DIR/runs: ID.yaml, or NAME.yaml where it has a start */
    const char *case_name, *point;
    const char *text;    /* of the run file */
    const char *meaning; /* the same without comments: what is digested */
    long long seed;
    size_t index;           /* in plan->run */
    struct plan_run *start; /* complete before this one begins, or NULL */
    double expect_s, limit_s;
    double bytes; /* expected size of the result, an estimate */
};

struct plan_point {
    const char *name; /* "height_l=64,darcy=published", or "single" */
    size_t parameter_count, run_count;
    const struct case_parameter *parameter;
    struct plan_run *const *run; /* one a seed */
};

struct plan_case {
    const struct case_file *file;
    const struct case_tier *tier;
    const char *skip_reason; /* not NULL: shown and counted, not run */
    size_t point_count;
    const struct plan_point *point;
};

struct plan {
    struct arena arena;
    enum tier tier;
    size_t case_count, run_count;
    struct plan_case *cases;
    struct plan_run **run; /* each run once, after the one that it starts from */
};

/* A case to be run; `file` is borrowed and must outlive the plan. */
struct plan_order {
    const struct case_file *file;
    const char *skip_reason; /* or NULL */
};

/* `all[0 .. all_count-1]`: every case of the folder, for those started from. */
enum status plan_make(const struct plan_order *order, size_t count,
                      const struct case_file *const *all, size_t all_count, enum tier tier,
                      long long seed_offset, struct plan **out, struct fault *fault);
void plan_free(struct plan *p); /* NULL is allowed */

#endif
