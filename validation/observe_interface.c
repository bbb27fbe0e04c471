/* observe_interface.c -- a bed at rest: its interface, its foot, and how long they take to form.
 *
 * bed-interface: the profile of packing fraction, averaged over a window of time, fitted with an
 * error function (interface_fit.h).  The window is cut into blocks of equal time, each fitted by
 * itself: the standard error is the blocks' scatter over the root of their number.  Height and
 * width of the mean profile, not means over blocks, are given.  The foot: the largest value within
 * 4 R of the floor, and the middle of its slab.  Drift: the centre of mass in the later half of the
 * window less that in the earlier.  Bulk: the middle fifth of N V/(Wx Wy phibar).
 *
 * Balanced: hydrostatics (hydrostatic.h) with the vertical temperature that was measured at each
 * packing fraction of the interface, in place of a law for it, and the pressure of inelastic
 * collisions: a test of the balance of forces alone.
 *
 * bed-formation: how far the profile is from the stationary one,
 *
 *     D^2(t) = integral of (phi(z,t) - phi_s(z))^2 dz,   phi_s the mean from settled_s on,
 *
 * of means over blocks of block_s and slabs of slab_R.  D^2 of a stationary profile is not 0 but
 * the noise of a block; the profile is stationary from the first block on that is not above the
 * settled blocks' mean by more than three of their standard deviations.  Beside it: when sigma of a
 * block's mean profile first reaches .9 of the settled one.  Blocks without an interface are left
 * out of that; a run without one has no width and no height, and says why, but all the rest.
 *
 * Source:     Fiege & Zippelius, Section IV A.
 * Leaves out: beds whose phibar changes.
 * Checked by: suspension/interface-width, -formation; tests/unit/test_observe_interface.c.
 */
#include "validation/bed_rest.h"
#include "validation/recipes.h"
#include "validation/sphere_profile.h"

#include <math.h>
#include <stdlib.h>

enum { FROM_S, TO_S, BLOCKS, ABOVE_R, PLATEAU_FREE };
enum {
    SIGMA,
    SIGMA_ERROR,
    HEIGHT,
    HEIGHT_ERROR,
    PLATEAU,
    FIT_RMS,
    SHOULDER_RATIO,
    BULK,
    BOTTOM_PEAK,
    PEAK_HEIGHT,
    BALANCED_SIGMA,
    BALANCED_HEIGHT,
    BALANCE,
    DRIFT,
    TEMPERATURE,
    TEMPERATURE_ZZ,
    COLLISION_RATE,
    COLLISIONS,
    WALLS,
    ABOVE,
    FREE_PLATEAU
};
enum { BLOCK_S, SETTLED_S, FORMATION_ABOVE_R, SLAB_R };
enum { TIME, FORMED_COLLISIONS, SIGMA_TIME, SETTLED_SIGMA, FLOOR, BLOCK_COUNT };
enum { BLOCKS_MAX = 400 };

/* A run of a bed, and its parameters as hydrostatics takes them. */
struct bed {
    struct observe_spheres spheres;
    double input[BED_INPUTS];
    struct sphere_profile fraction;
};

static enum status open_bed(struct run_view *v, struct bed *b, struct fault *fault) {
    static const char *const name[] = {BED_REST_NAMES};
    double gamma;
    enum status status = observe_spheres(v, &b->spheres, fault);
    if (!status)
        status = observe_spheres_drag(v, &gamma, fault); /* refuses a phibar that changes */
    for (size_t i = 0; i < BED_PARAMETERS && !status; i++)
        status = run_view_parameter(v, name[i], &b->input[i], fault);
    const bool *periodic = b->spheres.periodic;
    if (!status && (periodic[2] || periodic[0] != periodic[1]))
        status = fault_set(fault, STATUS_BAD_INPUT,
                           "%s: a bed needs a floor, and sides across x and y of one kind",
                           run_view_path(v));
    if (status)
        return status;
    b->input[BED_WIDTH_X_R] = b->spheres.box_m[0] / b->spheres.radius_m;
    b->input[BED_WIDTH_Y_R] = b->spheres.box_m[1] / b->spheres.radius_m;
    b->input[BED_WALLS] = periodic[0] ? 0 : 1;
    return sphere_profile_open(v, "packing_fraction", &b->spheres, &b->fraction, fault);
}

/* -- bed-interface ------------------------------------------------------------------ */

struct window {
    size_t first, last;
    struct interface_window fit;
};

/* A profile without an interface has no height and no width, and the reason why; what else a run
 * tells is told. */
static enum status no_interface(enum status status, const struct fault *why, const char *of,
                                const size_t *output, size_t outputs, struct measurement *out,
                                struct fault *fault) {
    if (status == STATUS_NO_MEMORY)
        return fault_set(fault, status, "%s", why->text);
    for (size_t i = 0; i < outputs; i++)
        observe_none(out, output[i], "%s: %s", of, why->text);
    return STATUS_OK;
}

/* Scatter of the blocks' fits over the root of their number. */
static enum status measure_blocks(const struct bed *b, const struct window *w, size_t blocks,
                                  double *profile, struct measurement *out, struct fault *fault) {
    double sum[2] = {0}, squares[2] = {0}, n = (double)blocks;
    size_t frames = w->last - w->first + 1;
    for (size_t k = 0; k < blocks; k++) {
        struct interface_fit fit;
        sphere_profile_mean(&b->fraction, w->first + k * frames / blocks,
                            w->first + (k + 1) * frames / blocks - 1, profile);
        enum status status =
            interface_fit(b->fraction.height_R, profile, b->fraction.bins, &w->fit, &fit, fault);
        if (status)
            return status;
        double value[2] = {fit.sigma_R, fit.height_R};
        for (size_t i = 0; i < 2; i++) {
            sum[i] += value[i] / n;
            squares[i] += value[i] * value[i] / n;
        }
    }
    for (size_t i = 0; i < 2; i++)
        out->value[i ? HEIGHT_ERROR : SIGMA_ERROR] =
            sqrt(fmax(squares[i] - sum[i] * sum[i], 0) / (n - 1));
    return STATUS_OK;
}

static void measure_foot(const struct bed *b, const double *profile, struct measurement *out) {
    for (size_t k = 0; k < b->fraction.bins && b->fraction.height_R[k] < 4; k++)
        if (profile[k] > out->value[BOTTOM_PEAK]) {
            out->value[BOTTOM_PEAK] = profile[k];
            out->value[PEAK_HEIGHT] = b->fraction.height_R[k];
        }
}

/* For figures: slabs of 1 R, or the run's own where these are thicker; the foot in the run's own.
 * fit: NULL where there is no interface. */
static enum status add_measured(const struct bed *b, const double *profile,
                                const struct interface_fit *fit, struct measurement *out,
                                struct fault *fault) {
    size_t pool = (size_t)fmax(1, round(1 / b->fraction.bin_R)), n = b->fraction.bins / pool;
    size_t foot = 0;
    const double *height = b->fraction.height_R;
    double *z = calloc(3 * n, sizeof *z), *mean = z + n, *smooth = mean + n;
    if (!z)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a curve of %zu heights", n);
    for (size_t k = 0; k < n; k++) {
        for (size_t i = k * pool; i < (k + 1) * pool; i++) {
            z[k] += height[i] / (double)pool;
            mean[k] += profile[i] / (double)pool;
        }
        smooth[k] = fit ? interface_fit_at(fit, z[k]) : NAN;
    }
    while (foot < b->fraction.bins && height[foot] < 10)
        foot++;
    enum status status = measurement_add_curve(out, "profile", "measured", z, mean, n, fault);
    if (!status && fit)
        status = measurement_add_curve(out, "fit", "Eq. 14", z, smooth, n, fault);
    if (!status)
        status = measurement_add_curve(out, "foot", "measured", height, profile, foot, fault);
    free(z);
    return status;
}

static enum status add_curves(const struct bed *b, const double *profile,
                              const struct interface_fit *fit, struct measurement *out,
                              struct fault *fault) {
    static const char *const label[] = {"hydrostatic, one temperature",
                                        "hydrostatic, local temperature"};
    static const char *const name[] = {"hydrostatic", "hydrostatic-local"};
    enum status status = add_measured(b, profile, fit, out, fault);
    for (size_t i = 0; i < 2 && !status; i++) {
        struct hydrostatic_profile solved;
        struct fault none = FAULT_NONE; /* a bed may have no stationary state: no curve */
        if (bed_rest_solve(b->input, i == 1, &solved, &none))
            continue;
        status = measurement_add_curve(out, name[i], label[i], solved.height_R, solved.fraction,
                                       solved.count, fault);
        hydrostatic_free(&solved);
    }
    return status;
}

static enum status measure_motion(struct run_view *v, const struct bed *b, const struct window *w,
                                  struct measurement *out, struct fault *fault) {
    const struct series *centre, *collisions;
    enum status status = observe_values(v, "observables/centre_of_mass", 3, &centre, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &collisions, fault);
    if (!status)
        status = observe_spheres_together(v, b->fraction.series, centre, fault);
    if (!status)
        status = observe_spheres_together(v, centre, collisions, fault);
    if (status)
        return status;
    size_t frames = w->last - w->first + 1, half = frames / 2;
    double early = 0, late = 0, count = (double)b->spheres.count;
    for (size_t f = 0; f < half; f++) {
        early += centre->value[3 * (w->first + f) + 2] / (double)half;
        late += centre->value[3 * (w->last - f) + 2] / (double)half;
    }
    out->value[DRIFT] = (late - early) / b->spheres.radius_m;
    double duration = centre->time[w->last] - centre->time[w->first];
    double met = collisions->value[w->last] - collisions->value[w->first];
    out->value[COLLISION_RATE] = 2 * met / (count * duration);
    out->value[COLLISIONS] = 2 * collisions->value[w->last] / count;
    return STATUS_OK;
}

/* Packing fraction, vertical temperature over T, and spheres, in slabs of 1 R from the middle of
 * the bed up to a packing fraction of .004: rows[0 .. n-1], rows[bins ..], rows[2 bins ..]. */
static size_t tabulate(const struct bed *b, const struct window *w,
                       const struct sphere_profile *vertical, double *rows) {
    double target = b->input[BED_THERMAL_J] * b->input[BED_TEMPERATURE_SCALE];
    double z = bed_rest_height_R(b->input) / 2, top = b->fraction.height_R[b->fraction.bins - 1];
    size_t n = 0, bins = b->fraction.bins;
    for (; z < top && n < bins; z++) {
        double phi = sphere_profile_level(&b->fraction, NULL, w->first, w->last, z, z + 1);
        double t = sphere_profile_level(vertical, &b->fraction, w->first, w->last, z, z + 1);
        if (!(t > 0) || phi < 0.004)
            continue;
        rows[n] = rows[2 * bins + n] = phi;
        rows[bins + n++] = t / target;
    }
    return n;
}

static enum status measure_balance(const struct bed *b, const struct window *w,
                                   const struct sphere_profile *vertical, struct measurement *out,
                                   struct fault *fault) {
    struct hydrostatic_profile solved;
    struct interface_fit fit;
    struct fault none = FAULT_NONE;
    size_t bins = b->fraction.bins;
    double *rows = malloc(3 * bins * sizeof *rows);
    if (!rows)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a table of temperatures");
    struct bed_rest_measured m = {rows, rows + bins, rows + 2 * bins,
                                  tabulate(b, w, vertical, rows)};
    enum status status = bed_rest_balance(b->input, &m, &solved, &none);
    free(rows);
    if (!status)
        status = bed_rest_fit(b->input, &solved, &fit, &none);
    if (status) {
        observe_none(out, BALANCED_SIGMA, "%s", none.text);
        observe_none(out, BALANCED_HEIGHT, "%s", none.text);
        hydrostatic_free(&solved);
        return STATUS_OK;
    }
    out->value[BALANCED_SIGMA] = fit.sigma_R;
    out->value[BALANCED_HEIGHT] = fit.height_R;
    status = measurement_add_curve(out, "balanced", "hydrostatic, measured temperature",
                                   solved.height_R, solved.fraction, solved.count, fault);
    hydrostatic_free(&solved);
    return status;
}

static enum status measure_temperature(struct run_view *v, const struct bed *b,
                                       const struct window *w, struct measurement *out,
                                       struct fault *fault) {
    static const char *const name[] = {"temperature_xy", "temperature_zz"};
    double low, high, level[2] = {0};
    bed_rest_bulk(b->input, &low, &high);
    for (size_t i = 0; i < 2; i++) {
        struct sphere_profile t;
        enum status status = sphere_profile_open(v, name[i], &b->spheres, &t, fault);
        if (status)
            return status;
        level[i] = sphere_profile_level(&t, &b->fraction, w->first, w->last, low, high);
        if (i == 1)
            status = measure_balance(b, w, &t, out, fault);
        sphere_profile_close(&t);
        if (status)
            return status;
    }
    out->value[TEMPERATURE] = (2 * level[0] + level[1]) / 3;
    out->value[TEMPERATURE_ZZ] = level[1];
    out->value[BULK] = sphere_profile_level(&b->fraction, NULL, w->first, w->last, low, high);
    return STATUS_OK;
}

/* *found: has the window's profile an interface? */
static enum status measure_fit(const struct bed *b, const struct window *w, const double *profile,
                               struct measurement *out, struct interface_fit *fit, bool *found,
                               struct fault *fault) {
    static const size_t output[] = {SIGMA, SHOULDER_RATIO, HEIGHT, PLATEAU, FIT_RMS};
    struct fault why = FAULT_NONE;
    enum status status =
        interface_fit(b->fraction.height_R, profile, b->fraction.bins, &w->fit, fit, &why);
    *found = !status;
    if (status)
        return no_interface(status, &why, "the window's profile", output, 5, out, fault);
    out->value[SIGMA] = fit->sigma_R;
    out->value[HEIGHT] = fit->height_R;
    out->value[PLATEAU] = fit->plateau;
    out->value[FIT_RMS] = fit->rms;
    out->value[SHOULDER_RATIO] = fit->shoulder_rms / fit->rms;
    if (fit->sharp) /* sigma is 0, to a slab; there is no shoulder beside it */
        observe_none(out, SHOULDER_RATIO, "the edge is sharper than slabs of %g R",
                     b->fraction.bin_R);
    return STATUS_OK;
}

static enum status measure_profile(const struct bed *b, const struct window *w, size_t blocks,
                                   struct measurement *out, struct fault *fault) {
    static const size_t errors[] = {SIGMA_ERROR, HEIGHT_ERROR};
    double *profile = malloc(b->fraction.bins * sizeof *profile);
    struct interface_fit fit;
    struct fault why = FAULT_NONE;
    bool found;
    if (!profile)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a profile");
    enum status status = measure_blocks(b, w, blocks, profile, out, &why);
    if (status)
        status = no_interface(status, &why, "a block of time", errors, 2, out, fault);
    sphere_profile_mean(&b->fraction, w->first, w->last, profile);
    if (!status)
        status = measure_fit(b, w, profile, out, &fit, &found, fault);
    if (!status) {
        measure_foot(b, profile, out);
        status = add_curves(b, profile, found ? &fit : NULL, out, fault);
    }
    free(profile);
    return status;
}

static enum status measure_interface(struct run_view *v, const double *settings,
                                     struct measurement *out, struct fault *fault) {
    struct bed b = {0};
    struct window w = {
        .fit = {.above_R = settings[ABOVE_R], .plateau_free = settings[PLATEAU_FREE] > 0.5}};
    size_t blocks = (size_t)settings[BLOCKS];
    enum status status = open_bed(v, &b, fault);
    if (!status)
        status = observe_spheres_window(v, b.fraction.series, settings[FROM_S], settings[TO_S],
                                        &w.first, &w.last, fault);
    if (!status && w.last - w.first + 1 < 2 * blocks)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: %zu samples for %zu blocks",
                           run_view_path(v), w.last - w.first + 1, blocks);
    b.input[BED_ABOVE_R] = out->value[ABOVE] = settings[ABOVE_R];
    b.input[BED_PLATEAU_FREE] = out->value[FREE_PLATEAU] = settings[PLATEAU_FREE];
    out->value[WALLS] = b.input[BED_WALLS];
    w.fit.phibar = b.input[BED_PHIBAR];
    if (!status)
        status = measure_motion(v, &b, &w, out, fault);
    if (!status)
        status = measure_profile(&b, &w, blocks, out, fault);
    if (!status)
        status = measure_temperature(v, &b, &w, out, fault);
    out->value[BALANCE] = out->value[SIGMA] / out->value[BALANCED_SIGMA];
    sphere_profile_close(&b.fraction);
    return status;
}

/* -- bed-formation ------------------------------------------------------------------- */

struct formation {
    size_t blocks, frames; /* frames a block */
    size_t settled;        /* first settled block */
    double *profile;       /* profile[block*bins + bin] */
    double *stationary;    /* [0 .. bins-1] */
    double *time, *apart;  /* [0 .. blocks-1]: the block's middle (s), D^2 (R) */
};

/* Of means over `slab` bins: the noise of thin slabs, which says nothing of the bed, averages out.
 */
static double distance_square(const struct sphere_profile *p, size_t slab, const double *a,
                              const double *b) {
    double sum = 0;
    for (size_t k = 0; k + slab <= p->bins; k += slab) {
        double apart = 0;
        for (size_t i = k; i < k + slab; i++)
            apart += (a[i] - b[i]) / (double)slab;
        sum += apart * apart * p->bin_R * (double)slab;
    }
    return sum;
}

static enum status divide(struct run_view *v, const struct sphere_profile *p,
                          const double *settings, struct formation *f, struct fault *fault) {
    const struct series *s = p->series;
    double step_s = s->frames > 1 ? s->time[1] - s->time[0] : 0;
    f->frames = step_s > 0 ? (size_t)fmax(1, round(settings[BLOCK_S] / step_s)) : 0;
    f->blocks = f->frames ? s->frames / f->frames : 0;
    while (f->settled < f->blocks &&
           s->time[f->settled * f->frames] < settings[SETTLED_S] * (1 - 1e-6))
        f->settled++;
    if (f->blocks > BLOCKS_MAX || f->blocks < f->settled + 4)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: four blocks of %g s after %g s are needed, %d in all at most",
                         run_view_path(v), settings[BLOCK_S], settings[SETTLED_S], (int)BLOCKS_MAX);
    f->profile = malloc((f->blocks + 1) * p->bins * sizeof *f->profile);
    f->time = malloc(2 * f->blocks * sizeof *f->time);
    if (!f->profile || !f->time)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu profiles", f->blocks);
    f->stationary = f->profile + f->blocks * p->bins;
    f->apart = f->time + f->blocks;
    size_t slab = (size_t)fmax(1, round(settings[SLAB_R] / p->bin_R));
    sphere_profile_mean(p, f->settled * f->frames, s->frames - 1, f->stationary);
    for (size_t i = 0; i < f->blocks; i++) {
        size_t first = i * f->frames, last = first + f->frames - 1;
        sphere_profile_mean(p, first, last, f->profile + i * p->bins);
        f->time[i] = (s->time[first] + s->time[last]) / 2;
        f->apart[i] = distance_square(p, slab, f->profile + i * p->bins, f->stationary);
    }
    return STATUS_OK;
}

/* The first block that is as near to the stationary profile as settled blocks are. */
static size_t first_near(const struct formation *f, double *floor) {
    double mean = 0, square = 0, n = (double)(f->blocks - f->settled);
    for (size_t i = f->settled; i < f->blocks; i++) {
        mean += f->apart[i] / n;
        square += f->apart[i] * f->apart[i] / n;
    }
    double limit = mean + 3 * sqrt(fmax(square - mean * mean, 0) * n / (n - 1));
    *floor = mean;
    size_t i = 0;
    while (i < f->settled && f->apart[i] > limit)
        i++;
    return i;
}

/* Widths of the blocks that have an interface: time[0 .. *count-1] (s), sigma (R). */
static enum status block_widths(const struct sphere_profile *p, const struct formation *f,
                                const struct interface_window *w, double *time, double *sigma,
                                size_t *count, struct fault *fault) {
    *count = 0;
    for (size_t i = 0; i < f->blocks; i++) {
        struct interface_fit fit;
        struct fault why = FAULT_NONE;
        enum status status =
            interface_fit(p->height_R, f->profile + i * p->bins, p->bins, w, &fit, &why);
        if (status == STATUS_NO_MEMORY)
            return fault_set(fault, status, "%s", why.text);
        if (status)
            continue;
        time[*count] = f->time[i];
        sigma[(*count)++] = fit.sigma_R;
    }
    return STATUS_OK;
}

/* When sigma first reaches .9 of the settled one, straight between blocks.  A block whose edge is
 * sharper than its slabs has a width of 0. */
static enum status sigma_time(const struct sphere_profile *p, const struct formation *f,
                              const struct interface_window *w, struct measurement *out,
                              struct fault *fault) {
    double time[BLOCKS_MAX], sigma[BLOCKS_MAX];
    static const size_t output[] = {SETTLED_SIGMA, SIGMA_TIME};
    struct interface_fit fit;
    struct fault why = FAULT_NONE;
    size_t n = 0, i = 0;
    enum status status = interface_fit(p->height_R, f->stationary, p->bins, w, &fit, &why);
    if (status)
        return no_interface(status, &why, "the settled profile", output, 2, out, fault);
    double wanted = 0.9 * (out->value[SETTLED_SIGMA] = fit.sigma_R);
    status = block_widths(p, f, w, time, sigma, &n, fault);
    while (i < n && sigma[i] < wanted)
        i++;
    if (i == n || fit.sharp)
        observe_none(out, SIGMA_TIME, "sigma does not reach .9 of what it settles at");
    else
        out->value[SIGMA_TIME] = i == 0 ? time[0]
                                        : time[i - 1] + (time[i] - time[i - 1]) *
                                                            (wanted - sigma[i - 1]) /
                                                            (sigma[i] - sigma[i - 1]);
    return status ? status : measurement_add_curve(out, "sigma", "sigma", time, sigma, n, fault);
}

static enum status measure_formation(struct run_view *v, const double *settings,
                                     struct measurement *out, struct fault *fault) {
    struct bed b = {0};
    struct formation f = {0};
    const struct series *collisions;
    enum status status = open_bed(v, &b, fault);
    if (!status)
        status = observe_values(v, "observables/collisions", 1, &collisions, fault);
    if (!status)
        status = observe_spheres_together(v, b.fraction.series, collisions, fault);
    if (!status)
        status = divide(v, &b.fraction, settings, &f, fault);
    struct interface_window w = {.above_R = settings[FORMATION_ABOVE_R],
                                 .phibar = b.input[BED_PHIBAR]};
    if (!status)
        status = sigma_time(&b.fraction, &f, &w, out, fault);
    if (!status) {
        size_t near = first_near(&f, &out->value[FLOOR]);
        size_t frame = near * f.frames + f.frames / 2;
        out->value[BLOCK_COUNT] = (double)f.blocks;
        out->value[TIME] = f.time[near];
        out->value[FORMED_COLLISIONS] = 2 * collisions->value[frame] / (double)b.spheres.count;
        if (near == f.settled) {
            observe_none(out, TIME, "not stationary before the time told as settled");
            observe_none(out, FORMED_COLLISIONS, "not stationary before the time told as settled");
        }
    }
    if (!status)
        status = measurement_add_curve(out, "apart", "D^2", f.time, f.apart, f.blocks, fault);
    free(f.profile);
    free(f.time);
    sphere_profile_close(&b.fraction);
    return status;
}

static const char *const INTERFACE_DATASETS[] = {
    "profiles/packing_fraction", "profiles/temperature_xy",    "profiles/temperature_zz",
    "observables/collisions",    "observables/centre_of_mass", NULL};
static const char *const INTERFACE_CURVES[] = {
    "profile", "fit", "foot", "hydrostatic", "hydrostatic-local", "balanced", NULL};
static const char *const FORMATION_DATASETS[] = {"profiles/packing_fraction",
                                                 "observables/collisions", NULL};
static const char *const FORMATION_CURVES[] = {"sigma", "apart", NULL};

const struct recipe recipe_bed_interface = {
    .name = "bed-interface",
    .title = "Interface and foot of a bed at rest",
    .source = "Fiege & Zippelius, Eq. 14",
    .datasets = INTERFACE_DATASETS,
    .setting = {{"from_s", "s", "samples before are left out", 0, 0, 1e9},
                {"to_s", "s", "samples after are left out; 0: none", 0, 0, 1e9},
                {"blocks", "1", "blocks of time, for errors", 5, 2, 100},
                {"above_R", "R", "heights below are not fitted", 10, 0, 1e6},
                {"plateau", "1", "0: fixed at phibar, 1: fitted", 0, 0, 1}},
    .output = {{"sigma", "R", "width of the interface"},
               {"sigma_error", "R", "standard, from blocks of time"},
               {"height", "R", "height of the interface"},
               {"height_error", "R", "standard, from blocks of time"},
               {"plateau", "1", "of the fit"},
               {"fit_rms", "1", "root mean square of the residuals"},
               {"shoulder_ratio", "1", "of those from h - 4 sigma to h - sigma, over fit_rms"},
               {"bulk", "1", "packing fraction of the middle fifth"},
               {"bottom_peak", "1", "largest packing fraction within 4 R of the floor"},
               {"peak_height", "R", "middle of the slab that has it"},
               {"balanced_sigma", "R", "of the profile that balances the measured temperatures"},
               {"balanced_height", "R", "of the profile that balances the measured temperatures"},
               {"balance", "1", "sigma over balanced_sigma"},
               {"drift", "R", "of the centre of mass, later half less earlier half"},
               {"temperature", "J", "of the middle fifth, about the slabs' mean velocities"},
               {"temperature_zz", "J", "its vertical part"},
               {"collision_rate", "1/s", "2 N_coll/(N t) in the window"},
               {"collisions_per_particle", "1", "2 N_coll/N from time 0 to the window's end"},
               {"walls", "1", "1: hard sides, 0: periodic; for predictions"},
               {"above", "R", "the setting; for predictions"},
               {"plateau_free", "1", "the setting; for predictions"}},
    .curves = INTERFACE_CURVES,
    .measure = measure_interface,
};

const struct recipe recipe_bed_formation = {
    .name = "bed-formation",
    .title = "From a sharp edge to a stationary profile",
    .source = "Fiege & Zippelius, Fig. 1",
    .datasets = FORMATION_DATASETS,
    .setting = {{"block_s", "s", "length of a block", 0.04, 0, 1e9},
                {"settled_s", "s", "stationary from here on", 1, 0, 1e9},
                {"above_R", "R", "heights below are not fitted", 10, 0, 1e6},
                {"slab_R", "R", "slabs that profiles are compared in", 4, 0, 1e6}},
    .output = {{"time", "s", "first block as near to the stationary profile as settled ones"},
               {"collisions_per_particle", "1", "2 N_coll/N by then"},
               {"sigma_time", "s", "when sigma first reaches .9 of the settled one"},
               {"settled_sigma", "R", "of the mean settled profile"},
               {"floor", "R", "D^2 of settled blocks"},
               {"blocks", "1", "blocks in all"}},
    .curves = FORMATION_CURVES,
    .measure = measure_formation,
};
