/* measure.h -- from finished runs to numbers: the case's recipes on each result file.
 *
 * Each finished run is opened once; every observable of the case is measured,
 * and for every check the run's own measured and expected value is formed
 * (`per` and predictions are evaluated with that run's inputs).  What is
 * averaged, and how, is the judge's business.
 */
#ifndef VALIDATION_MEASURE_H
#define VALIDATION_MEASURE_H

#include "validation/plan.h"

struct measured_sample { /* of one check in one run */
    double measured, expected, expected_uncertainty;
    const char *reason; /* why one of them is NaN, or NULL */
};

struct measured_run {
    const struct plan_run *run;
    const char *run_path, *result_path; /* for run_view_open */
    bool usable;                        /* false: see failure */
    const char *failure;                /* one sentence: crashed, timed out, NaN in data */
    const char *log_end;                /* last lines of its log where it failed, or NULL */
    double seconds;                     /* wall time; NaN when not known */
    struct measurement *observable;     /* observable[0 .. case's observable_count-1] */
    struct measured_sample *sample;     /* sample[0 .. tier's check_count-1] */
};

struct measured_ensemble { /* a fit over all seeds of a point */
    double value[ENSEMBLE_MAX_OUTPUTS], uncertainty[ENSEMBLE_MAX_OUTPUTS];
    const char *reason; /* why they are NaN, or NULL */
};

struct measured_point {
    const struct plan_point *point;
    size_t run_count;
    struct measured_run *run; /* run[0 .. run_count-1], one a seed */
    /* ensemble[0 .. the case's across_count-1]; those that are fits over seeds count. */
    struct measured_ensemble *ensemble;
};

struct measured_case {
    struct arena arena;
    const struct plan_case *plan;
    size_t point_count;
    struct measured_point *point;
};

/* How a run ended, told by whoever ran it. */
struct measure_source {
    /* Fills run_path, result_path, usable, failure, log_end and seconds of r. */
    enum status (*describe)(void *context, const struct plan_run *run, struct arena *arena,
                            struct measured_run *r, struct fault *fault);
    void *context;
};

/* A result that cannot be used (NaN in the data, wrong shape, missing dataset)
 * makes that run unusable, with the reason; it is no fault of this function. */
enum status measure_case(const struct plan_case *plan, const struct measure_source *source,
                         struct measured_case **out, struct fault *fault);
void measured_case_free(struct measured_case *m); /* NULL is allowed */

/* Every fit over seeds of the case at a point whose runs are measured; measure_case does it. */
enum status measured_fit_ensembles(const struct plan_case *plan, struct arena *arena,
                                   struct measured_point *p, struct fault *fault);

/* Mean over the point's usable runs of one output and its standard error (NaN
 * with fewer than two); returns the number of finite values.  For figures. */
size_t measured_mean(const struct measured_point *p, size_t observable, size_t output, double *mean,
                     double *error);

/* A point's parameter as a number, or the one number of its list; NaN when it is none or not
 * set in the case. */
double measured_parameter(const struct measured_point *p, const char *name);
bool measured_parameter_is(const struct measured_point *p, const char *name, const char *value);

#endif
