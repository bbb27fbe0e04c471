/* observe_fluctuations.c -- the uneven density that forms below the settling front.
 *
 * Of the solid fraction on the lattice sites inside the plateau (wall columns
 * left out), at given times: its variance over the square of its mean, and its
 * correlation length across, the distance at which
 *
 *     C(r) = mean over sites of (rho(x) - m)(rho(x + r) - m) / variance
 *
 * first falls below 1/e, interpolated linearly.  The halo of MFM Eq. 13 alone
 * correlates neighbouring sites; the values at the start show by how much.
 *
 * Source:     MFM, Section III and Fig. 3: "variations of particle density".
 * Leaves out: correlations along gravity, where the plateau has ends.
 * Checked by: graingas/sedimentation; tests/unit/test_observe_settling.c.
 */
#include "validation/observe_profile.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { EARLY_TAU, LATE_TAU, MIN_ROWS, MARGIN_L };
enum {
    VARIANCE_START,
    VARIANCE_EARLY,
    VARIANCE_LATE,
    LENGTH_START,
    LENGTH_EARLY,
    LENGTH_LATE,
    VARIANCE_GROWTH,
    LENGTH_GROWTH,
    OUTPUTS
};

/* Columns [left, right) and rows [low, high) of sites. */
struct window {
    size_t left, right, low, high;
};

struct moments {
    double variance; /* over mean squared (1) */
    double length;   /* (l); NaN when C does not fall that far */
};

static double mean_of(const double *rho, const struct window *w, size_t nx) {
    double sum = 0;
    for (size_t j = w->low; j < w->high; j++)
        for (size_t i = w->left; i < w->right; i++)
            sum += rho[j * nx + i];
    return sum / (double)((w->right - w->left) * (w->high - w->low));
}

/* Mean of (rho(x) - m)(rho(x + r) - m) over all pairs of sites r apart in one row. */
static double covariance(const double *rho, const struct window *w, size_t nx, double mean,
                         size_t r) {
    double sum = 0;
    for (size_t j = w->low; j < w->high; j++)
        for (size_t i = w->left; i + r < w->right; i++)
            sum += (rho[j * nx + i] - mean) * (rho[j * nx + i + r] - mean);
    return sum / (double)((w->right - w->left - r) * (w->high - w->low));
}

/* correlation[0 .. half of the columns - 1] is filled with C. */
static struct moments moments_of(const double *rho, const struct window *w, size_t nx,
                                 double *distance, double *correlation) {
    double mean = mean_of(rho, w, nx), variance = covariance(rho, w, nx, mean, 0);
    struct moments m = {.variance = variance / (mean * mean), .length = NAN};
    for (size_t r = 0; r < (w->right - w->left) / 2; r++) {
        distance[r] = (double)r;
        correlation[r] = covariance(rho, w, nx, mean, r) / variance;
        if (r && isnan(m.length) && correlation[r] < exp(-1)) {
            double fall = correlation[r - 1] - correlation[r];
            m.length = (double)r - 1 + (correlation[r - 1] - exp(-1)) / fall;
        }
    }
    return m;
}

struct task {
    struct run_view *view;
    struct observe_box box;
    struct observe_grains grains;
    const struct series *field;
    struct profile profile;
    double to_volume, min_rows;
    size_t margin;
    double *distance, *correlation; /* [0 .. nx-1] */
};

/* Sites whose cells lie wholly in the plateau's rows. */
static enum status find_window(struct task *k, double time, struct window *out,
                               struct fault *fault) {
    size_t frame;
    *out = (struct window){k->margin, k->box.nx - k->margin, 0, 0};
    if (time <= 0) { /* nothing moves yet: the whole box but its walls */
        out->low = k->margin;
        out->high = k->box.ny - k->margin;
        return STATUS_OK;
    }
    enum status status =
        observe_frame(k->view, "particles/grains/position", k->grains.series, time, &frame, fault);
    if (!status)
        status =
            profile_measure(&k->profile, k->view, &k->box, &k->grains, k->to_volume, frame, fault);
    if (status)
        return status;
    struct plateau p = profile_plateau(&k->profile, &PLATEAU_RULE);
    if ((double)p.rows >= k->min_rows && p.highest > p.lowest) {
        out->low = p.lowest + 1; /* rows are 1 l high: row r lies between sites r and r + 1 */
        out->high = p.highest + 1;
    }
    return STATUS_OK;
}

static enum status measure_at(struct task *k, struct measurement *out, double time,
                              const char *label, size_t variance, size_t length,
                              struct fault *fault) {
    size_t frame;
    struct window w;
    if (!observe_reaches(k->field, time)) {
        observe_none(out, variance, "no sample as late as %g tau", time);
        observe_none(out, length, "no sample");
        return STATUS_OK;
    }
    enum status status =
        observe_frame(k->view, "fields/solid_fraction", k->field, time, &frame, fault);
    if (!status)
        status = find_window(k, time, &w, fault);
    if (status)
        return status;
    if (w.high <= w.low || w.right <= w.left + 4) {
        observe_none(out, variance, "no plateau of %g rows is left at %g tau", k->min_rows, time);
        observe_none(out, length, "no plateau");
        return STATUS_OK;
    }
    struct moments m = moments_of(k->field->value + frame * k->box.sites, &w, k->box.nx,
                                  k->distance, k->correlation);
    out->value[variance] = m.variance;
    out->value[length] = m.length;
    if (isnan(m.length))
        observe_none(out, length, "the correlation at %g tau does not fall below 1/e", time);
    return measurement_add_curve(out, "correlation", label, k->distance, k->correlation,
                                 (w.right - w.left) / 2, fault);
}

static enum status prepare(struct task *k, const double *settings, struct fault *fault) {
    enum status status = observe_box(k->view, &k->box, fault);
    if (!status)
        status = observe_grains(k->view, true, &k->grains, fault);
    if (!status)
        status = observe_field(k->view, "fields/solid_fraction", &k->box, 1, &k->field, fault);
    if (!status)
        status = run_view_parameter(k->view, "area_to_volume", &k->to_volume, fault);
    if (!status)
        status = profile_create(&k->profile, &k->box, 1, fault);
    if (status)
        return status;
    k->min_rows = settings[MIN_ROWS];
    k->margin = (size_t)settings[MARGIN_L];
    if (2 * k->margin + 4 > k->box.nx || 2 * k->margin + 4 > k->box.ny)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: a margin of %zu l leaves nothing of the box",
                         run_view_path(k->view), k->margin);
    k->distance = calloc(2 * k->box.nx, sizeof *k->distance);
    if (!k->distance)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a correlation");
    k->correlation = k->distance + k->box.nx;
    return STATUS_OK;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct task k = {.view = v};
    char early[64], late[64];
    snprintf(early, sizeof early, "%g tau", settings[EARLY_TAU]);
    snprintf(late, sizeof late, "%g tau", settings[LATE_TAU]);
    enum status status = prepare(&k, settings, fault);
    if (!status)
        status = measure_at(&k, out, 0, "start", VARIANCE_START, LENGTH_START, fault);
    if (!status)
        status =
            measure_at(&k, out, settings[EARLY_TAU], early, VARIANCE_EARLY, LENGTH_EARLY, fault);
    if (!status)
        status = measure_at(&k, out, settings[LATE_TAU], late, VARIANCE_LATE, LENGTH_LATE, fault);
    if (!status) {
        out->value[VARIANCE_GROWTH] = out->value[VARIANCE_EARLY] / out->value[VARIANCE_START];
        out->value[LENGTH_GROWTH] = out->value[LENGTH_EARLY] / out->value[LENGTH_START];
    }
    free(k.distance);
    profile_free(&k.profile);
    return status;
}

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/velocity",
                                       "particles/grains/radius", "fields/solid_fraction", NULL};
static const char *const CURVES[] = {"correlation", NULL};

const struct recipe recipe_fluctuations = {
    .name = "fluctuations",
    .title = "Variance and correlation length of the density below the front",
    .source = "MFM, Section III and Fig. 3",
    .datasets = DATASETS,
    .setting = {{"early_tau", "tau", "first time", 20, 0, 1e6},
                {"late_tau", "tau", "second time", 40, 0, 1e6},
                {"min_rows", "1", "rows that the plateau must have", 8, 3, 1000},
                {"margin_l", "l", "columns left out at each wall", 2, 1, 100}},
    .output = {{"variance_start", "1", "variance over mean squared at time 0"},
               {"variance_early", "1", "the same at early_tau"},
               {"variance_late", "1", "the same at late_tau"},
               {"length_start", "l", "correlation length across at time 0"},
               {"length_early", "l", "the same at early_tau"},
               {"length_late", "l", "the same at late_tau"},
               {"variance_growth", "1", "variance_early over variance_start"},
               {"length_growth", "1", "length_early over length_start"}},
    .curves = CURVES,
    .measure = measure,
};
