/* pressure_wave.c -- see pressure_wave.h. */
#include "validation/pressure_wave.h"

#include "validation/sphere_laws.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>

enum { CELLS_MOST = 20000, STEPS_MOST = 5000000 };
static const double COURANT = 0.3, REST_PER_S = 1e-4;

struct pressure_wave {
    struct bed_change change;
    double phibar, cell_m, time_s;
    size_t cells;
    double *phi;          /* [0 .. cells-1] (1) */
    double *solid;        /* [0 .. cells] below each face (m) */
    double *flux;         /* [0 .. cells] (m/s); none at the ends */
    double *mobile;       /* [0 .. cells] mu at a face over cell_m (s/m); none at the ends */
    double *push, *stiff; /* [0 .. cells-1] phi Z T/m, and its slope (m^2/s^2) */
    double *diagonal, *above, *below, *right, *gain; /* [0 .. cells-1] */
};

enum status pressure_wave_create(const struct bed_change *change, double cell_m,
                                 struct pressure_wave **out, struct fault *fault) {
    *out = NULL;
    double top = change->load_m / fmin(change->before, change->after);
    double cells = ceil((1.2 * top + 40 * change->radius_m) / cell_m);
    if (!(cells >= 8 && cells <= CELLS_MOST))
        return fault_set(fault, STATUS_BAD_INPUT, "a bed of %g m in cells of %g m", top, cell_m);
    struct pressure_wave *w = calloc(1, sizeof *w);
    size_t n = (size_t)cells;
    double *block = calloc(11 * (n + 1), sizeof *block);
    if (!w || !block) {
        free(w);
        free(block);
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu cells", n);
    }
    *w = (struct pressure_wave){
        .change = *change, .phibar = change->before, .cell_m = cell_m, .cells = n, .phi = block};
    double **array[] = {&w->solid,    &w->flux,  &w->mobile, &w->push,  &w->stiff,
                        &w->diagonal, &w->above, &w->below,  &w->right, &w->gain};
    for (size_t i = 0; i < sizeof array / sizeof *array; i++)
        *array[i] = block + (i + 1) * (n + 1);
    double height = change->load_m / change->before;
    for (size_t i = 0; i < n; i++)
        w->phi[i] = change->before * fmax(0, fmin(1, height / cell_m - (double)i));
    *out = w;
    return STATUS_OK;
}

void pressure_wave_free(struct pressure_wave *w) {
    if (w)
        free(w->phi);
    free(w);
}

/* -- a step ------------------------------------------------------------------------ */

static void sum_solid(struct pressure_wave *w) {
    for (size_t i = 0; i < w->cells; i++)
        w->solid[i + 1] = w->solid[i] + w->phi[i] * w->cell_m;
}

static double solid_below(const struct pressure_wave *w, double height_m) {
    double x = fmax(0, fmin(height_m / w->cell_m, (double)w->cells));
    size_t i = (size_t)x;
    return i == w->cells ? w->solid[i] : w->solid[i] + (x - (double)i) * w->phi[i] * w->cell_m;
}

/* Mean over the layer about a face. */
static double layer_mean(const struct pressure_wave *w, size_t face) {
    double z = (double)face * w->cell_m, half = w->change.layer_m / 2;
    if (!(half > w->cell_m))
        return (w->phi[face - 1] + w->phi[face]) / 2;
    double low = fmax(z - half, 0);
    return (solid_below(w, z + half) - solid_below(w, low)) / (z + half - low);
}

/* The value upstream at a face, from the cell's mean and a limited slope. */
static double upstream(const double *phi, size_t cells, size_t face, bool upwards) {
    size_t cell = upwards ? face - 1 : face;
    double rise = 0;
    if (cell > 0 && cell + 1 < cells) {
        double a = phi[cell] - phi[cell - 1], b = phi[cell + 1] - phi[cell];
        if (a * b > 0)
            rise = 2 * a * b / (a + b);
    }
    return phi[cell] + (upwards ? rise : -rise) / 2;
}

static void find_fluxes(struct pressure_wave *w, double dt_s) {
    double heat = w->change.heat_m2_per_s2, collide = (1 + w->change.restitution) / 2;
    for (size_t i = 0; i < w->cells; i++) {
        double phi = w->phi[i];
        w->push[i] = heat * phi * (1 + collide * (spheres_compressibility(phi) - 1));
        w->stiff[i] = heat * (1 + collide * (spheres_stiffness(phi) - 1));
    }
    for (size_t f = 1; f < w->cells; f++) {
        double mean = layer_mean(w, f);
        double speed = bed_change_speed(&w->change, mean, w->phibar);
        w->mobile[f] = bed_change_mobility(&w->change, mean, w->phibar) / w->cell_m;
        double flux = speed * upstream(w->phi, w->cells, f, speed > 0) -
                      w->mobile[f] * (w->push[f] - w->push[f - 1]);
        /* implicit in the friction: what is new has the share gamma dt/(1 + gamma dt) */
        double slow = w->change.inertia ? w->mobile[f] * w->cell_m / dt_s : 0;
        double most = w->cell_m / (2 * dt_s); /* half of a cell in a step */
        flux = (slow * w->flux[f] + flux) / (1 + slow);
        w->flux[f] = flux > 0 ? fmin(flux, most * fmax(w->phi[f - 1], 0))
                              : fmax(flux, -most * fmax(w->phi[f], 0));
        w->mobile[f] /= 1 + slow;
    }
}

/* gain[i] is what phi[i] gains in dt_s, the pressure taken at the end of it. */
static enum status solve(struct pressure_wave *w, double dt_s, struct fault *fault) {
    double k = dt_s / w->cell_m;
    size_t n = w->cells;
    for (size_t i = 0; i < n; i++) {
        w->right[i] = k * (w->flux[i] - w->flux[i + 1]);
        w->diagonal[i] = 1 + k * (w->mobile[i] + w->mobile[i + 1]) * w->stiff[i];
        if (i + 1 < n) {
            w->above[i] = -k * w->mobile[i + 1] * w->stiff[i + 1];
            w->below[i] = -k * w->mobile[i + 1] * w->stiff[i];
        }
    }
    gsl_vector_view diagonal = gsl_vector_view_array(w->diagonal, n);
    gsl_vector_view above = gsl_vector_view_array(w->above, n - 1);
    gsl_vector_view below = gsl_vector_view_array(w->below, n - 1);
    gsl_vector_view right = gsl_vector_view_array(w->right, n);
    gsl_vector_view gain = gsl_vector_view_array(w->gain, n);
    if (gsl_linalg_solve_tridiag(&diagonal.vector, &above.vector, &below.vector, &right.vector,
                                 &gain.vector))
        return fault_set(fault, STATUS_NUMERICAL, "no step of a pressure wave at %g s", w->time_s);
    return STATUS_OK;
}

/* Cells a wave may cross in a time: its speed is v + phi dv/dphi. */
static double step_most(const struct pressure_wave *w) {
    double fastest = 0;
    for (size_t i = 0; i < w->cells; i++) {
        double phi = w->phi[i], d = 1e-4;
        double low = bed_change_speed(&w->change, phi, w->phibar);
        double slope = (bed_change_speed(&w->change, phi + d, w->phibar) - low) / d;
        fastest = fmax(fastest, fabs(low) + fabs(phi * slope));
    }
    return COURANT * w->cell_m / fastest;
}

static enum status step(struct pressure_wave *w, double dt_s, double *largest_per_s,
                        struct fault *fault) {
    sum_solid(w);
    find_fluxes(w, dt_s);
    enum status status = solve(w, dt_s, fault);
    *largest_per_s = 0;
    for (size_t f = 1; f < w->cells; f++) /* as the implicit step had it */
        w->flux[f] -= w->mobile[f] * (w->stiff[f] * w->gain[f] - w->stiff[f - 1] * w->gain[f - 1]);
    for (size_t i = 0; !status && i < w->cells; i++) {
        w->phi[i] += w->gain[i];
        *largest_per_s = fmax(*largest_per_s, fabs(w->gain[i]) / dt_s);
        if (!(w->phi[i] > -0.01 && w->phi[i] < 0.74))
            status =
                fault_set(fault, STATUS_NUMERICAL,
                          "a pressure wave has a packing fraction of %g at %g R, %g s", w->phi[i],
                          ((double)i + 0.5) * w->cell_m / w->change.radius_m, w->time_s);
    }
    w->time_s += dt_s;
    return status;
}

/* -- what is asked ------------------------------------------------------------------- */

enum status pressure_wave_settle(struct pressure_wave *w, struct fault *fault) {
    double largest = INFINITY;
    for (int i = 0; i < STEPS_MOST && largest > REST_PER_S; i++) {
        enum status status = step(w, step_most(w), &largest, fault);
        if (status)
            return status;
    }
    if (largest > REST_PER_S)
        return fault_set(fault, STATUS_NUMERICAL, "a bed at phibar %g does not come to rest",
                         w->phibar);
    w->time_s = 0;
    sum_solid(w);
    return STATUS_OK;
}

void pressure_wave_change(struct pressure_wave *w) {
    w->phibar = w->change.after;
}

enum status pressure_wave_advance(struct pressure_wave *w, double time_s, struct fault *fault) {
    if (!(time_s >= w->time_s && time_s < INFINITY))
        return fault_set(fault, STATUS_BAD_INPUT, "a pressure wave at %g s cannot go on to %g s",
                         w->time_s, time_s);
    double largest;
    enum status status = STATUS_OK;
    while (!status && time_s - w->time_s > 1e-12 * time_s) {
        double left = time_s - w->time_s;
        status = step(w, left / ceil(left / step_most(w)), &largest, fault);
    }
    sum_solid(w);
    return status;
}

double pressure_wave_centre(const struct pressure_wave *w) {
    double moment = 0, solid = 0;
    for (size_t i = 0; i < w->cells; i++) {
        moment += w->phi[i] * ((double)i + 0.5) * w->cell_m;
        solid += w->phi[i];
    }
    return moment / solid;
}

double pressure_wave_solid(const struct pressure_wave *w) {
    double solid = 0;
    for (size_t i = 0; i < w->cells; i++)
        solid += w->phi[i] * w->cell_m;
    return solid;
}

void pressure_wave_profile(const struct pressure_wave *w, double bin_m, double *fraction,
                           size_t bins) {
    double below = 0;
    for (size_t i = 0; i < bins; i++) {
        double here = solid_below(w, (double)(i + 1) * bin_m);
        fraction[i] = (here - below) / bin_m;
        below = here;
    }
}
