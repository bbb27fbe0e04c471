/* observe_bed_relaxation.c -- how fast a bed leaves its profile after a small change of phibar.
 *
 * L(t) of FZ Eq. 15 with the stationary samples' mean as the first profile and their noise taken
 * off, and the two laws fitted to it from the change to to_s (relaxation_fit.h).  The curve L2
 * holds the window's samples for the ensemble fit `relaxation`, which fits the mean of all seeds.
 *
 * Source:     Fiege & Zippelius, Eq. 15 and Fig. 7.
 * Leaves out: several changes.
 * Checked by: suspension/expansion-rate; tests/unit/test_observe_bed_step.c.
 */
#include "validation/observe_spheres.h"
#include "validation/recipes.h"
#include "validation/relaxation_theory.h"

#include <math.h>
#include <stdlib.h>

enum { TO_S };
enum { RATE, PLATEAU, FLOOR, EXPONENTIAL, ROOT, ROOT_OVER, ROOT_END, WINDOW, STILL };

/* The samples since the change, from `first` on, and those of them in the window. */
struct window {
    size_t count, fitted;
    double *time, *square, *length; /* [0 .. count-1] (s, R, sqrt(R)); one block, by time */
};

static enum status take(const struct series *s, double change_s, double to_s, double bin_R,
                        struct window *w, struct measurement *out, struct fault *fault) {
    size_t still = 0;
    while (still < s->frames && s->time[still] <= change_s * (1 + 1e-9))
        still++;
    if (still < 2 || s->frames < still + 5)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%zu samples before the change of phibar and %zu after: too few", still,
                         s->frames - still);
    double *square = calloc(4 * s->frames, sizeof *square);
    if (!square)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu samples", s->frames);
    enum status status = relaxation_square(s->value, s->frames, s->size, bin_R, still, square,
                                           &out->value[FLOOR], fault);
    *w = (struct window){.count = s->frames - still, .time = square};
    w->square = square + s->frames;
    w->length = w->square + s->frames;
    for (size_t k = 0; k < w->count; k++) {
        w->square[k] = square[still + k];
        w->length[k] = relaxation_length(w->square[k]);
        w->time[k] = s->time[still + k] - change_s; /* square[k] is behind us */
        if (w->time[k] <= to_s * (1 + 1e-9))
            w->fitted = k + 1;
    }
    out->value[STILL] = (double)still;
    return status;
}

static enum status add_theory(const struct bed_change *c, const struct window *w,
                              struct measurement *out, struct fault *fault) {
    static const char *const label[] = {"kinematic wave", "with pressure",
                                        "with pressure and inertia"};
    struct bed_change own = *c;
    double *length = calloc(w->count, sizeof *length);
    enum status status =
        length ? STATUS_OK : fault_set(fault, STATUS_NO_MEMORY, "no memory for a curve");
    for (int i = 0; !status && i < 3; i++) {
        own.inertia = i == 2;
        status = relaxation_theory_length(&own, i > 0, w->time, w->count, length, fault);
        if (!status)
            status = measurement_add_curve(out, "L", label[i], w->time, length, w->count, fault);
    }
    free(length);
    return status;
}

static enum status add_fits(const struct relaxation_fit *fit, const struct window *w,
                            struct measurement *out, struct fault *fault) {
    double *law = calloc(w->fitted, sizeof *law);
    if (!law)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a curve");
    for (size_t k = 0; k < w->fitted; k++)
        law[k] = relaxation_exponential(fit, w->time[k]);
    enum status status =
        measurement_add_curve(out, "fit", "exponential", w->time, law, w->fitted, fault);
    for (size_t k = 0; k < w->fitted; k++)
        law[k] = relaxation_root(fit, w->time[k]);
    if (!status)
        status = measurement_add_curve(out, "fit", "sqrt(t)", w->time, law, w->fitted, fault);
    free(law);
    return status;
}

static enum status fit_window(const struct window *w, struct measurement *out,
                              struct fault *fault) {
    struct relaxation_fit fit;
    struct fault poor = FAULT_NONE;
    enum status status = relaxation_fit(w->time, w->length, w->fitted, &fit, &poor);
    if (status == STATUS_BAD_INPUT) {
        for (size_t i = RATE; i <= ROOT_END; i++)
            if (i != FLOOR)
                observe_none(out, i, "%s", poor.text);
        return STATUS_OK;
    }
    if (status) {
        *fault = poor;
        return status;
    }
    out->value[RATE] = fit.rate_per_s;
    out->value[PLATEAU] = fit.plateau;
    out->value[EXPONENTIAL] = fit.exponential_rms;
    out->value[ROOT] = fit.root_rms;
    out->value[ROOT_OVER] = fit.root_rms / fit.exponential_rms;
    out->value[ROOT_END] = fit.end_s;
    return add_fits(&fit, w, out, fault);
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct observe_spheres b;
    struct bed_change c;
    const struct series *s;
    struct window w = {0};
    double change_s;
    enum status status = observe_spheres(v, &b, fault);
    if (!status)
        status = bed_change_read(v, &c, &change_s, fault);
    if (!status)
        status = run_view_series(v, "profiles/packing_fraction", &s, fault);
    if (status)
        return status;
    double to_s = settings[TO_S] > 0 ? settings[TO_S] : relaxation_theory_window(&c);
    double bin_R = b.box_m[2] / (double)s->size / b.radius_m;
    out->value[WINDOW] = to_s;
    status = take(s, change_s, to_s, bin_R, &w, out, fault);
    if (!status && s->time[s->frames - 1] - change_s < to_s * (1 - 1e-6))
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: ends %g s after the change, window %g s",
                           run_view_path(v), s->time[s->frames - 1] - change_s, to_s);
    if (!status)
        status = measurement_add_curve(out, "L", "measured", w.time, w.length, w.count, fault);
    if (!status)
        status = measurement_add_curve(out, "L2", "L^2", w.time, w.square, w.fitted, fault);
    if (!status)
        status = fit_window(&w, out, fault);
    if (!status)
        status = add_theory(&c, &w, out, fault);
    free(w.time);
    return status;
}

static const char *const DATASETS[] = {"profiles/packing_fraction", NULL};
static const char *const CURVES[] = {"L", "L2", "fit", NULL};

const struct recipe recipe_bed_relaxation = {
    .name = "bed-relaxation",
    .title = "How fast a bed leaves its profile when phibar changes",
    .source = "Fiege & Zippelius, Eq. 15 and Fig. 7",
    .datasets = DATASETS,
    .setting = {{"to_s", "s", "end of the fit, from the change; 0: 2 h1/(c phibar)", 0, 0, 1e9}},
    .output = {{"rate", "1/s", "lambda of A (1 - exp(-lambda t))"},
               {"plateau", "sqrt(R)", "A"},
               {"floor", "R", "L^2 of the stationary state's noise, taken off"},
               {"exponential_rms", "1", "residual over A of the exponential"},
               {"root_rms", "1", "residual over A of B sqrt(min(t, t_e))"},
               {"root_over_exponential", "1", "ratio of the two residuals"},
               {"root_end", "s", "t_e"},
               {"window", "s", "end of the fit, from the change"},
               {"still", "1", "samples before the change"}},
    .curves = CURVES,
    .measure = measure,
};
