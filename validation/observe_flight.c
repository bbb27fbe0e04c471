/* observe_flight.c -- grains on their own: through-flow, and free fall.
 *
 * acceleration: grains are held in place until the gas is steady and then let go.
 * For a single grain at rest in a flux q, from one step to the next, Fr dv/dt =
 * -gravity + q/(K rho_min), for where no site reaches rho_min the gradient is
 * q Pe/K(rho_min) everywhere.  A moving grain would drag itself, by an amount that
 * depends on its place in the cell; but one grain in the middle of every cell
 * makes density and velocity the same on all sites, and then the homogeneous law
 * is exact too: Fr dv/dt = -gravity + v/v_own.
 *
 * free-fall: without gas, x = x0 + v0 t - gravity t^2/(2 Fr), before any contact.
 *
 * Source:     MFM, Eq. 11 and Section II C; docs/theory.md.
 * Leaves out: contacts.
 * Checked by: graingas/verification-through-flow, graingas/verification-free-fall;
 *             tests/unit/test_observe_grains.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>

enum { ACCELERATION, SIDEWAYS, SPREAD, SPEED };
enum { POSITION_ERROR, VELOCITY_ERROR };

static enum status load_last_step(struct run_view *v, struct observe_grains *g, double *dt,
                                  struct fault *fault) {
    enum status status = observe_grains(v, true, g, fault);
    if (!status)
        status = run_view_parameter(v, "dt_tau", dt, fault);
    if (status)
        return status;
    size_t last = g->frames - 1;
    if (g->frames < 2 || !g->count || g->series->step[last] != g->series->step[last - 1] + 1)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: acceleration needs grains and two samples one step apart",
                         run_view_path(v));
    for (size_t i = 0; i < g->count; i++)
        for (size_t a = 0; a < 2; a++) {
            double before = observe_vector(g->position, g, 0, i)[a];
            double held = observe_vector(g->position, g, last - 1, i)[a];
            if (before != held)
                return fault_set(fault, STATUS_BAD_INPUT,
                                 "%s: grain %zu moves before it is let go at %g tau",
                                 run_view_path(v), i, g->time[last - 1]);
        }
    return STATUS_OK;
}

static enum status measure_acceleration(struct run_view *v, const double *settings,
                                        struct measurement *out, struct fault *fault) {
    (void)settings;
    struct observe_grains g;
    double dt;
    enum status status = load_last_step(v, &g, &dt, fault);
    if (status)
        return status;
    double sum = 0, speed = 0, sideways = 0, low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < g.count; i++) {
        const double *before = observe_vector(g.velocity, &g, g.frames - 2, i);
        const double *after = observe_vector(g.velocity, &g, g.frames - 1, i);
        double a = (after[1] - before[1]) / dt;
        speed -= before[1];
        sum += a;
        low = fmin(low, a);
        high = fmax(high, a);
        sideways = fmax(sideways, fabs((after[0] - before[0]) / dt));
    }
    out->value[ACCELERATION] = sum / (double)g.count;
    out->value[SIDEWAYS] = sideways;
    out->value[SPREAD] = high - low;
    out->value[SPEED] = speed / (double)g.count;
    return STATUS_OK;
}

static enum status measure_free_fall(struct run_view *v, const double *settings,
                                     struct measurement *out, struct fault *fault) {
    (void)settings;
    struct observe_grains g;
    double gravity, froude;
    enum status status = observe_grains(v, true, &g, fault);
    if (!status)
        status = run_view_parameter(v, "gravity", &gravity, fault);
    if (!status)
        status = run_view_parameter(v, "froude", &froude, fault);
    if (status)
        return status;
    if (g.frames < 2 || !g.count)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: free fall needs grains and two samples",
                         run_view_path(v));
    for (size_t f = 1; f < g.frames; f++) {
        double t = g.time[f] - g.time[0], fall[2] = {0, gravity / froude};
        for (size_t i = 0; i < g.count; i++) {
            const double *x0 = observe_vector(g.position, &g, 0, i);
            const double *u0 = observe_vector(g.velocity, &g, 0, i);
            const double *x = observe_vector(g.position, &g, f, i);
            const double *u = observe_vector(g.velocity, &g, f, i);
            for (size_t a = 0; a < 2; a++) {
                double x_error = fabs(x[a] - (x0[a] + u0[a] * t - fall[a] * t * t / 2));
                double u_error = fabs(u[a] - (u0[a] - fall[a] * t));
                out->value[POSITION_ERROR] = fmax(out->value[POSITION_ERROR], x_error);
                out->value[VELOCITY_ERROR] = fmax(out->value[VELOCITY_ERROR], u_error);
            }
        }
    }
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/velocity",
                                       "particles/grains/radius", NULL};

const struct recipe recipe_acceleration = {
    .name = "acceleration",
    .title = "Acceleration of grains at rest that are let go",
    .source = "MFM, Eq. 11",
    .datasets = DATASETS,
    .output = {{"acceleration", "U0/tau", "upwards, over the last step, mean over grains"},
               {"sideways", "U0/tau", "largest across"},
               {"spread", "U0/tau", "largest less smallest upwards"},
               {"speed", "U0", "downwards, when let go, mean over grains"}},
    .measure = measure_acceleration,
};

const struct recipe recipe_free_fall = {
    .name = "free-fall",
    .title = "Deviation from the parabola",
    .source = "MFM, Section II B, step 1",
    .datasets = DATASETS,
    .output = {{"position_error", "l", "largest deviation of a coordinate"},
               {"velocity_error", "U0", "largest deviation of a velocity component"}},
    .measure = measure_free_fall,
};
