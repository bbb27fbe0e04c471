/* observe_column.c -- gas driven steadily through an immobile column.
 *
 * A flux q enters at the bottom row and leaves at the top.  When steady,
 * Eq. 8 gives (1/Pe) K dp/dz = -q.  Across a face of the lattice the pressure falls by
 * Pe q/K_face, so the drop over the column is exactly Pe q sum 1/K_face; the
 * continuum's drop is Pe q times the integral of dz/K over the bands.  Under
 * the full Eq. 6 the gas that enters, counted at P0, gives
 * (1/Pe) K (1+p) dp/dz = -q, so that (1+p)^2 is linear with slope -2 Pe q/K.
 *
 * Source:     MFM, Eqs. 6 and 8; docs/theory.md.
 * Leaves out: moving grains.
 * Checked by: graingas/verification-darcy-column, graingas/verification-full-gas;
 *             tests/unit/test_observe_gas.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdlib.h>

enum {
    DROP,
    SERIES_RATIO,
    CONTINUUM_ERROR,
    BEND,
    UNEVENNESS,
    SQUARE_SLOPE,
    SQUARE_BEND,
    UNSTEADINESS,
    ENDS_MEAN
};

struct column {
    struct observe_box box;
    struct observe_physics physics;
    double flux; /* (l/tau) */
    const struct series *pressure, *solid_fraction;
    const double *last; /* pressure of the last frame */
    const double *band; /* solid fractions of equal bands, bottom first */
    size_t bands;
    double *mean;   /* mean[0 .. ny-1]: of the pressure, over each row */
    double *square; /* (1 + mean)^2 */
};

static enum status load(struct run_view *v, struct column *c, struct fault *fault) {
    enum status status = observe_box(v, &c->box, fault);
    if (!status)
        status = observe_physics(v, &c->physics, fault);
    if (!status)
        status = run_view_parameter(v, "flux_l_per_tau", &c->flux, fault);
    if (!status)
        status = observe_field(v, "fields/pressure", &c->box, 1, &c->pressure, fault);
    if (!status)
        status = observe_field(v, "fields/solid_fraction", &c->box, 1, &c->solid_fraction, fault);
    if (!status)
        status = run_view_parameter_list(v, "fixed_bed", &c->band, &c->bands, fault);
    if (status)
        return status;
    if (!c->bands || c->pressure->frames < 2 || c->flux == 0)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: a column needs fixed_bed, flux_l_per_tau and two frames of pressure",
                         run_view_path(v));
    c->last = c->pressure->value + (c->pressure->frames - 1) * c->pressure->size;
    c->mean = calloc(2 * c->box.ny, sizeof *c->mean);
    if (!c->mean)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu rows", c->box.ny);
    c->square = c->mean + c->box.ny;
    return STATUS_OK;
}

/* Row means, weighted with the sites' volumes; returns the largest deviation from them. */
static double average_rows(struct column *c) {
    double worst = 0;
    for (size_t j = 0; j < c->box.ny; j++) {
        const double *row = c->last + j * c->box.nx;
        double sum = 0;
        for (size_t i = 0; i < c->box.nx; i++)
            sum += row[i] * (i == 0 || i == c->box.nx - 1 ? 0.5 : 1);
        c->mean[j] = sum / c->box.width_l;
        c->square[j] = (1 + c->mean[j]) * (1 + c->mean[j]);
        for (size_t i = 0; i < c->box.nx; i++)
            worst = fmax(worst, fabs(row[i] - c->mean[j]));
    }
    return worst;
}

/* Largest distance from the straight line through both ends, over the difference of the ends. */
static double bend(const double *y, size_t count) {
    double worst = 0, difference = y[count - 1] - y[0];
    for (size_t j = 0; j < count; j++)
        worst = fmax(worst, fabs(y[j] - y[0] - difference * (double)j / (double)(count - 1)));
    return worst / fabs(difference);
}

/* Sum of 1/K over the faces of one column of sites (l). */
static double series_resistance(const struct column *c) {
    const double *rho = c->solid_fraction->value;
    double sum = 0;
    for (size_t j = 0; j + 1 < c->box.ny; j++)
        sum +=
            1 / closure_face_conductivity(c->physics.law, c->physics.face, rho[j * c->box.nx],
                                          rho[(j + 1) * c->box.nx], c->physics.solid_fraction_min);
    return sum;
}

/* Integral of dz/K over the bands (l). */
static double continuum_resistance(const struct column *c) {
    double sum = 0;
    for (size_t b = 0; b < c->bands; b++)
        sum += 1 / closure_conductivity(c->physics.law, c->band[b], c->physics.solid_fraction_min);
    return sum * c->box.height_l / (double)c->bands;
}

/* Largest change of the pressure since the frame before, over the drop. */
static double unsteadiness(const struct column *c, double drop) {
    const double *before = c->last - c->pressure->size;
    double worst = 0;
    for (size_t k = 0; k < c->pressure->size; k++)
        worst = fmax(worst, fabs(c->last[k] - before[k]));
    return worst / fabs(drop);
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    (void)settings;
    struct column c = {.mean = NULL};
    enum status status = load(v, &c, fault);
    if (status)
        return status;
    double uneven = average_rows(&c), per_length = c.physics.peclet * c.flux;
    size_t top = c.box.ny - 1;
    double drop = c.mean[0] - c.mean[top];
    out->value[DROP] = drop;
    out->value[SERIES_RATIO] = drop / (per_length * series_resistance(&c));
    out->value[CONTINUUM_ERROR] = fabs(drop / (per_length * continuum_resistance(&c)) - 1);
    out->value[BEND] = bend(c.mean, c.box.ny);
    out->value[UNEVENNESS] = uneven / fabs(drop);
    out->value[SQUARE_SLOPE] = (c.square[top] - c.square[0]) / c.box.height_l;
    out->value[SQUARE_BEND] = bend(c.square, c.box.ny);
    out->value[ENDS_MEAN] = (c.mean[0] + c.mean[top]) / 2;
    out->value[UNSTEADINESS] = unsteadiness(&c, drop);
    double *height = c.square; /* no longer needed */
    for (size_t j = 0; j <= top; j++)
        height[j] = (double)j;
    status = measurement_add_curve(out, "pressure profile", "end", height, c.mean, c.box.ny, fault);
    free(c.mean);
    return status;
}

static const char *const DATASETS[] = {"fields/pressure", "fields/solid_fraction", NULL};
static const char *const CURVES[] = {"pressure profile", NULL};

const struct recipe recipe_column = {
    .name = "column",
    .title = "Steady flow of gas through an immobile column",
    .source = "MFM, Eqs. 6 and 8",
    .datasets = DATASETS,
    .output = {{"drop", "P0", "pressure at the bottom less that on top"},
               {"series_ratio", "1", "drop over Pe q sum 1/K of the faces"},
               {"continuum_error", "1", "|drop over Pe q times the integral of dz/K - 1|"},
               {"bend", "1", "largest distance of p from a straight line, over the drop"},
               {"unevenness", "1", "largest deviation from the row's mean, over the drop"},
               {"square_slope", "1/l", "slope of (1+p)^2 over height"},
               {"square_bend", "1", "as bend, of (1+p)^2"},
               {"unsteadiness", "1", "largest change between the last two frames, over the drop"},
               {"ends_mean", "P0", "mean of the pressures at bottom and top"}},
    .curves = CURVES,
    .measure = measure,
};
