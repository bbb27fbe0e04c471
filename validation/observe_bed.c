/* observe_bed.c -- a bed through which gas is blown: how it rises, thins and mixes.
 *
 * From the fields (bed_column.h): top, centre of mass and bulk fraction in time,
 * their values at at_tau, the speed of the plug (straight line, in a window, through
 * the height above which lie 2 l of solid: the plug's upper part), the largest top since injection
 * began, and what the top still does at the end (slope over the last end_tau, times end_tau).  The
 * slab's fraction is the mean between margin_l and top - margin_l.  From the grains (bed_grains.h):
 * how well the two colours are mixed, which layer at the floor has not moved, which has
 * not risen.
 *
 * The dense layer is read off the profile, averaged over the last end_tau: from the
 * densest row within 3 l of the floor up to where it falls below 1.05 times the
 * slab's mean; 0 if that row itself is below.
 *
 * Source:     MFM, Section IV; docs/theory.md, "Fluidization".
 * Leaves out: bubbles (observe_bubbles.c); a surface that is not level.
 * Checked by: graingas/fluidization; tests/unit/test_observe_bed.c.
 */
#include "validation/bed_column.h"
#include "validation/bed_grains.h"
#include "validation/bed_profile.h"
#include "validation/recipes.h"

#include <math.h>
#include <stdlib.h>

enum { PLUG_FROM_TAU, PLUG_TO_TAU, AT_TAU, END_TAU, MARGIN_L, CELL_L, ROW_L, MOVED_L };
enum {
    TOP,
    CENTRE,
    BULK_FRACTION,
    SLAB_FRACTION,
    PLUG_SPEED,
    PLUG_SPEED_ERROR,
    TOP_PEAK,
    TOP_END_DRIFT,
    MIXING,
    MIXING_START,
    STATIC_LAYER,
    LEFT_LAYER,
    DENSE_LAYER
};

static const double NEAR_FLOOR_L = 3, DENSER = 1.05;
static const double PLUG_SOLID_L = 2; /* above the marker that tells the plug's speed */

/* One run under measurement; the arrays hold one value a frame of the fields. */
struct task {
    struct run_view *view;
    const double *settings;
    struct observe_box box;
    double dt, injected_from; /* (tau) */
    const struct series *fraction;
    double *top, *centre, *bulk, *slab, *marker; /* owned through top */
    struct measurement *out;
};

/* -- the bed as a column -------------------------------------------------------- */

static enum status trace_columns(struct task *k, struct fault *fault) {
    size_t n = k->fraction->frames;
    k->top = calloc(5 * n, sizeof *k->top);
    if (!k->top)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu frames", n);
    k->centre = k->top + n;
    k->bulk = k->centre + n;
    k->slab = k->bulk + n;
    k->marker = k->slab + n;
    for (size_t f = 0; f < n; f++) {
        const double *field = k->fraction->value + f * k->fraction->size;
        struct bed_column c = bed_column_measure(field, &k->box, k->settings[MARGIN_L]);
        k->marker[f] = bed_column_marker(field, &k->box, PLUG_SOLID_L);
        if (isnan(c.top))
            return fault_set(fault, STATUS_BAD_INPUT, "%s: there is no bed at %g tau",
                             run_view_path(k->view), k->fraction->time[f]);
        k->top[f] = c.top;
        k->centre[f] = c.centre;
        k->bulk[f] = c.bulk_fraction;
        k->slab[f] = c.slab_fraction;
    }
    return STATUS_OK;
}

/* Frames of the fields from one time to another, both included. */
struct span {
    size_t first, count;
};

static struct span span_of(const struct task *k, double from, double to) {
    struct span s = {0, 0};
    for (size_t f = 0; f < k->fraction->frames; f++) {
        double time = k->fraction->time[f];
        if (time < from - k->dt / 2 || time > to + k->dt / 2)
            continue;
        if (!s.count++)
            s.first = f;
    }
    return s;
}

static struct span span_of_end(const struct task *k) {
    double end = k->fraction->time[k->fraction->frames - 1];
    return span_of(k, end - k->settings[END_TAU], end);
}

static void conclude_plug(struct task *k) {
    double from = k->settings[PLUG_FROM_TAU], to = k->settings[PLUG_TO_TAU];
    double *value = k->out->value;
    struct span s = span_of(k, from, to);
    value[PLUG_SPEED] = bed_column_slope(k->fraction->time + s.first, k->marker + s.first, s.count,
                                         &value[PLUG_SPEED_ERROR]);
    if (isnan(value[PLUG_SPEED])) /* and so is its error */
        observe_none(
            k->out, PLUG_SPEED,
            "%zu frames from %g to %g tau, 3 needed for a slope; or less than %g l of solid",
            s.count, from, to, PLUG_SOLID_L);
}

static void conclude_tops(struct task *k) {
    double *value = k->out->value, error;
    double end = k->fraction->time[k->fraction->frames - 1];
    struct span peak = span_of(k, k->injected_from, end), last = span_of_end(k);
    value[TOP_PEAK] = NAN;
    for (size_t f = peak.first; f < peak.first + peak.count; f++)
        value[TOP_PEAK] = fmax(value[TOP_PEAK], k->top[f]);
    if (!peak.count)
        observe_none(k->out, TOP_PEAK, "the run ends at %g tau, before injection at %g tau", end,
                     k->injected_from);
    value[TOP_END_DRIFT] =
        k->settings[END_TAU] *
        bed_column_slope(k->fraction->time + last.first, k->top + last.first, last.count, &error);
    if (isnan(value[TOP_END_DRIFT]))
        observe_none(k->out, TOP_END_DRIFT, "%zu frames in the last %g tau; 3 needed for a slope",
                     last.count, k->settings[END_TAU]);
}

/* Values at at_tau, which the run must have sampled. */
static enum status conclude_values(struct task *k, struct fault *fault) {
    double at = k->settings[AT_TAU], *value = k->out->value;
    size_t f;
    if (!observe_reaches(k->fraction, at)) {
        for (size_t i = TOP; i <= SLAB_FRACTION; i++)
            observe_none(k->out, i, "the run was not sampled up to %g tau", at);
        return STATUS_OK;
    }
    enum status status =
        observe_frame(k->view, "fields/solid_fraction", k->fraction, at, &f, fault);
    if (status)
        return status;
    value[TOP] = k->top[f];
    value[CENTRE] = k->centre[f];
    value[BULK_FRACTION] = k->bulk[f];
    value[SLAB_FRACTION] = k->slab[f];
    if (isnan(k->slab[f]))
        observe_none(k->out, SLAB_FRACTION, "a bed of %g l leaves no slab between the margins",
                     k->top[f]);
    return STATUS_OK;
}

/* -- the layer at the floor ------------------------------------------------------ */

/* profile[0 .. rows-1], one row a lattice constant from the floor up. */
static double dense_height(const double *profile, size_t rows, double level) {
    size_t j = 0;
    for (size_t r = 1; r < rows && (double)r <= NEAR_FLOOR_L; r++)
        if (profile[r] > profile[j])
            j = r;
    if (profile[j] < level)
        return 0;
    while (j + 1 < rows && profile[j + 1] >= level)
        j++;
    if (j + 1 == rows)
        return (double)j;
    return (double)j + (profile[j] - level) / (profile[j] - profile[j + 1]);
}

static enum status conclude_dense(struct task *k, struct fault *fault) {
    struct span last = span_of_end(k);
    double slab = 0;
    double *profile = calloc(k->box.ny, sizeof *profile);
    if (!profile)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu rows", k->box.ny);
    for (size_t f = last.first; f < last.first + last.count; f++) {
        slab += k->slab[f] / (double)last.count;
        for (size_t j = 0; j < k->box.ny; j++)
            profile[j] +=
                bed_profile_row(k->fraction->value + f * k->fraction->size, k->box.nx, j) /
                (double)last.count;
    }
    if (isnan(slab))
        observe_none(k->out, DENSE_LAYER, "no slab between the margins to compare with");
    else
        k->out->value[DENSE_LAYER] = dense_height(profile, k->box.ny, DENSER * slab);
    free(profile);
    return STATUS_OK;
}

/* -- the grains ------------------------------------------------------------------ */

/* The last frame of the grains no later than injection begins, or their first. */
static size_t start_frame(const struct task *k, const struct observe_grains *g) {
    size_t start = 0;
    for (size_t f = 1; f < g->frames && g->time[f] <= k->injected_from + k->dt / 2; f++)
        start = f;
    return start;
}

static enum status trace_mixing(struct task *k, const struct observe_grains *g,
                                const double *species, double *mixing, struct fault *fault) {
    enum status status = STATUS_OK;
    for (size_t f = 0; !status && f < g->frames; f++)
        status = bed_grains_mixing(k->view, g, &k->box, species, f, k->settings[CELL_L], &mixing[f],
                                   fault);
    if (!status && !isnan(mixing[0]))
        status = measurement_add_curve(k->out, "mixing", "bed", g->time, mixing, g->frames, fault);
    return status;
}

static enum status conclude_grains(struct task *k, const struct observe_grains *g,
                                   const double *mixing, struct fault *fault) {
    double at = k->settings[AT_TAU], *value = k->out->value;
    size_t start = start_frame(k, g), end;
    value[MIXING_START] = mixing[start];
    if (isnan(mixing[start])) {
        observe_none(k->out, MIXING, "all grains are of one species");
        observe_none(k->out, MIXING_START, "all grains are of one species");
    }
    if (!observe_reaches(g->series, at)) {
        observe_none(k->out, MIXING, "the grains were not sampled up to %g tau", at);
        observe_none(k->out, STATIC_LAYER, "the grains were not sampled up to %g tau", at);
        observe_none(k->out, LEFT_LAYER, "the grains were not sampled up to %g tau", at);
        return STATUS_OK;
    }
    enum status status =
        observe_frame(k->view, "particles/grains/position", g->series, at, &end, fault);
    if (status)
        return status;
    value[MIXING] = mixing[end];
    if (end <= start) {
        observe_none(k->out, STATIC_LAYER, "%g tau is not after injection has begun", at);
        observe_none(k->out, LEFT_LAYER, "%g tau is not after injection has begun", at);
        return STATUS_OK;
    }
    struct bed_grains_layers layers = {NAN, NAN};
    status = bed_grains_layers(k->view, g, &k->box, start, end, k->settings[ROW_L],
                               k->settings[MOVED_L], &layers, fault);
    value[STATIC_LAYER] = layers.still;
    value[LEFT_LAYER] = layers.left;
    return status;
}

static enum status measure_grains(struct task *k, struct fault *fault) {
    struct observe_grains g;
    const double *species;
    size_t count;
    enum status status = observe_grains(k->view, false, &g, fault);
    if (!status)
        status = run_view_array(k->view, "particles/grains/species", &species, &count, fault);
    if (!status && count != g.count)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %zu species for %zu grains",
                           run_view_path(k->view), count, g.count);
    if (status)
        return status;
    double *mixing = calloc(g.frames, sizeof *mixing);
    if (!mixing)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu frames", g.frames);
    status = trace_mixing(k, &g, species, mixing, fault);
    if (!status)
        status = conclude_grains(k, &g, mixing, fault);
    free(mixing);
    return status;
}

/* -- together -------------------------------------------------------------------- */

static enum status add_curves(struct task *k, struct fault *fault) {
    const struct {
        const char *name;
        const double *value;
    } curve[] = {{"top", k->top}, {"centre of mass", k->centre}, {"bulk fraction", k->bulk}};
    enum status status = STATUS_OK;
    for (size_t i = 0; !status && i < sizeof curve / sizeof *curve; i++)
        status = measurement_add_curve(k->out, curve[i].name, "bed", k->fraction->time,
                                       curve[i].value, k->fraction->frames, fault);
    return status;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct task k = {.view = v, .settings = settings, .out = out};
    enum status status = observe_box(v, &k.box, fault);
    if (!status)
        status = run_view_parameter(v, "dt_tau", &k.dt, fault);
    if (!status)
        status = run_view_parameter(v, "flux_on_tau", &k.injected_from, fault);
    if (!status)
        status = observe_field(v, "fields/solid_fraction", &k.box, 1, &k.fraction, fault);
    if (!status)
        status = trace_columns(&k, fault);
    if (!status)
        status = conclude_values(&k, fault);
    if (!status) {
        conclude_plug(&k);
        conclude_tops(&k);
        status = conclude_dense(&k, fault);
    }
    if (!status)
        status = add_curves(&k, fault);
    if (!status)
        status = measure_grains(&k, fault);
    free(k.top);
    return status;
}

static const char *const DATASETS[] = {"fields/solid_fraction", "particles/grains/position",
                                       "particles/grains/radius", "particles/grains/species", NULL};
static const char *const CURVES[] = {"top", "centre of mass", "bulk fraction", "mixing", NULL};

const struct recipe recipe_bed_motion = {
    .name = "bed-motion",
    .title = "A bed under a flux of gas",
    .source = "MFM, Section IV; docs/theory.md",
    .datasets = DATASETS,
    .setting = {{"plug_from_tau", "tau", "the window of the plug's rise begins", 2, 0, 1e6},
                {"plug_to_tau", "tau", "and ends", 8, 0, 1e6},
                {"at_tau", "tau", "time of the stated values", 40, 0, 1e6},
                {"end_tau", "tau", "length of the window at the run's end", 10, 1e-3, 1e6},
                {"margin_l", "l", "left out of the slab at the floor and under the top", 5, 0,
                 1000},
                {"cell_l", "l", "side of the cells in which mixing is counted", 1, 0.1, 100},
                {"row_l", "l", "height of the rows for the static layer", 0.5, 0.1, 10},
                {"moved_l", "l", "a row that moved less, on average, is static", 0.25, 1e-6, 100}},
    .output = {{"top", "l", "height of the top at at_tau"},
               {"centre_of_mass", "l", "height, weighted with mass, at at_tau"},
               {"bulk_fraction", "1", "solid height over the top's height at at_tau"},
               {"slab_fraction", "1", "mean solid fraction of the slab at at_tau"},
               {"plug_speed", "l/tau",
                "of the height above which lie 2 l of solid, in the plug's window"},
               {"plug_speed_error", "l/tau", "its standard error from the scatter"},
               {"top_peak", "l", "largest height of the top since injection began"},
               {"top_end_drift", "l", "change of the top over the last end_tau, by its slope"},
               {"mixing", "1", "Lacey's index at at_tau: 0 segregated, 1 random"},
               {"mixing_start", "1", "the same when injection began"},
               {"static_layer", "l", "height up to which rows have hardly moved by at_tau"},
               {"left_layer", "l", "height up to which rows have hardly risen by at_tau"},
               {"dense_layer", "l", "height up to which the floor's layer is 1.05 times as dense"}},
    .curves = CURVES,
    .measure = measure,
};
