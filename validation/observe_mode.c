/* observe_mode.c -- how fast a cosine mode of the pressure dies away.
 *
 * In a closed box of uniform solid fraction and grains at rest Eq. 8 is a heat
 * equation.  The amplitude a of cos(pi mx x/W) cos(pi my y/H) is the projection
 * with the sites' volumes, under which the lattice's own modes are orthogonal;
 * its rate is -ln(a_last/a_first)/(t_last - t_first).  Two errors are told
 * apart: of space, against the continuum's rate D k^2, after taking backward
 * Euler's (1 + s dt)^-1 a step into s; and of time, against the lattice's rate.
 *
 * Source:     MFM, Eq. 8; docs/theory.md.
 * Leaves out: moving grains, uneven solid fraction.
 * Checked by: graingas/verification-mode-decay; tests/unit/test_observe_gas.c.
 */
#include "validation/observe.h"
#include "validation/recipes.h"

#include <math.h>

enum { RATE, STEP_RATE, SPACE_ERROR, TIME_ERROR, LATTICE_ERROR, IMPURITY };

struct mode {
    struct observe_box box;
    double mx, my;
};

static double shape(const struct mode *m, size_t i, size_t j) {
    return cos(M_PI * m->mx * (double)i / m->box.width_l) *
           cos(M_PI * m->my * (double)j / m->box.height_l);
}

static double amplitude(const struct mode *m, const double *p) {
    double sum = 0, norm = 0;
    for (size_t j = 0; j < m->box.ny; j++)
        for (size_t i = 0; i < m->box.nx; i++) {
            double s = shape(m, i, j);
            double volume = closure_site_volume(i, j, m->box.nx, m->box.ny);
            sum += volume * s * p[j * m->box.nx + i];
            norm += volume * s * s;
        }
    return sum / norm;
}

/* Largest deviation from a times the mode, over a. */
static double impurity(const struct mode *m, const double *p, double a) {
    double worst = 0;
    for (size_t j = 0; j < m->box.ny; j++)
        for (size_t i = 0; i < m->box.nx; i++)
            worst = fmax(worst, fabs(p[j * m->box.nx + i] - a * shape(m, i, j)));
    return worst / fabs(a);
}

/* The solid fraction, which must be the same everywhere. */
static enum status uniform_fraction(struct run_view *v, const struct observe_box *box, double *out,
                                    struct fault *fault) {
    const struct series *s;
    enum status status = observe_field(v, "fields/solid_fraction", box, 1, &s, fault);
    if (status)
        return status;
    *out = s->value[0];
    for (size_t k = 0; k < s->frames * s->size; k++)
        if (fabs(s->value[k] - *out) > 1e-12)
            return fault_set(fault, STATUS_BAD_INPUT,
                             "%s: fields/solid_fraction is not uniform (%.9g and %.9g)",
                             run_view_path(v), *out, s->value[k]);
    return STATUS_OK;
}

static void compare(const struct mode *m, const struct observe_physics *physics, double rho,
                    double ratio, double time, double steps, struct measurement *out) {
    double d = closure_diffusivity(physics->law, rho, physics->solid_fraction_min, physics->peclet);
    double continuum = d * closure_mode_square(m->mx, m->my, m->box.width_l, m->box.height_l);
    double lattice = d * closure_mode_square_lattice(m->mx, m->my, m->box.width_l, m->box.height_l);
    double rate = -log(ratio) / time;
    double step_rate = (pow(ratio, -1 / steps) - 1) * steps / time;
    out->value[RATE] = rate;
    out->value[STEP_RATE] = step_rate;
    out->value[SPACE_ERROR] = fabs(step_rate / continuum - 1);
    out->value[TIME_ERROR] = fabs(rate / lattice - 1);
    out->value[LATTICE_ERROR] = fabs(step_rate / lattice - 1);
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    (void)settings;
    struct mode m;
    struct observe_physics physics;
    const struct series *p;
    double rho;
    enum status status = observe_box(v, &m.box, fault);
    if (!status)
        status = observe_physics(v, &physics, fault);
    if (!status)
        status = run_view_parameter(v, "pressure_mode_x", &m.mx, fault);
    if (!status)
        status = run_view_parameter(v, "pressure_mode_y", &m.my, fault);
    if (!status)
        status = observe_field(v, "fields/pressure", &m.box, 1, &p, fault);
    if (!status)
        status = uniform_fraction(v, &m.box, &rho, fault);
    if (status)
        return status;
    if (p->frames < 2)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: fields/pressure needs two frames",
                         run_view_path(v));
    size_t last = p->frames - 1;
    const double *end = p->value + last * p->size;
    double first_a = amplitude(&m, p->value), last_a = amplitude(&m, end);
    if (!(first_a * last_a > 0)) {
        for (size_t i = RATE; i <= IMPURITY; i++)
            observe_none(out, i, "the mode's amplitude goes from %g to %g", first_a, last_a);
        return STATUS_OK;
    }
    compare(&m, &physics, rho, last_a / first_a, p->time[last] - p->time[0],
            p->step[last] - p->step[0], out);
    out->value[IMPURITY] = impurity(&m, end, last_a);
    return STATUS_OK;
}

static const char *const DATASETS[] = {"fields/pressure", "fields/solid_fraction", NULL};

const struct recipe recipe_mode_decay = {
    .name = "mode-decay",
    .title = "Decay rate of a cosine mode of the pressure",
    .source = "MFM, Eq. 8",
    .datasets = DATASETS,
    .output = {{"rate", "1/tau", "-d ln a/dt between the first and the last frame"},
               {"step_rate", "1/tau", "s where a falls by 1/(1 + s dt) a step"},
               {"space_error", "1", "|step_rate over the continuum's rate - 1|"},
               {"time_error", "1", "|rate over the lattice's rate - 1|"},
               {"lattice_error", "1", "|step_rate over the lattice's rate - 1|"},
               {"impurity", "1", "largest part of the pressure that is not the mode, over a"}},
    .measure = measure,
};
