/* observe_drop.c -- pressure drop across the bed against the flux; minimum fluidization.
 *
 *     ratio = (p_floor - p_lid - freeboard)/weight,      x = q - dz/dt
 *
 * with the bed's own upward speed from its centre of mass z (bed_column.h). A bed
 * at rest has ratio = q/q_mf, one that creeps (q - dz/dt)/q_mf, one that is carried 1.
 *
 * With a schedule of fluxes every step gives one point, the mean over its last
 * average_tau. The way up ends with the first step of the largest flux, the way
 * down begins with the last one (a single such step belongs to both). On each way
 *
 *     below: ratio < `below`, |dz/dt| <= `fixed` q: a line through the origin, slope s,
 *            against x
 *     above: q >= `above`/s: the mean m of their ratios;     q_mf = m/s
 *
 * A bed that still falls after the gas was turned down is in part at rest and in part
 * dilute: it belongs to neither. 1/s and m/s agree where m = 1; the break takes the drop as it was
 * measured. The standard error joins those of s and m. At least 3 points on either side. Steps that
 * the run does not complete, or that injection ends in, are left out.
 *
 * Without a schedule there is only `above`, over the window from_tau to to_tau.
 *
 * Source:     docs/theory.md, "Fluidization"; MFM, Eqs. 8 and 11.
 * Leaves out: what a rising bed's acceleration adds to the ratio.
 * Checked by: graingas/minimum-fluidization; tests/unit/test_observe_drop.c.
 */
#include "validation/bed_column.h"
#include "validation/recipes.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

enum { AVERAGE_TAU, FROM_TAU, TO_TAU, BELOW, ABOVE, FIXED, MARGIN_L };
enum {
    Q_MF_UP,
    Q_MF_UP_ERROR,
    Q_MF_DOWN,
    Q_MF_DOWN_ERROR,
    HYSTERESIS,
    OVERSHOOT,
    ABOVE_MEAN,
    ABOVE_SPREAD,
    SOLID_FRACTION,
    SOLID_FRACTION_DOWN,
    FIXED_SPEED,
    POINTS
};
enum { MIN_POINTS = 3 };

/* -- the flux -------------------------------------------------------------------- */

struct schedule {
    size_t steps;              /* 0: constant flux */
    const double *flux;        /* flux[0 .. steps-1] (l/tau) */
    double constant;           /* (l/tau) */
    double on, off, every, dt; /* (tau) */
};

static enum status read_schedule(struct run_view *v, struct schedule *s, struct fault *fault) {
    enum status status = run_view_parameter(v, "flux_on_tau", &s->on, fault);
    if (!status)
        status = run_view_parameter(v, "flux_off_tau", &s->off, fault);
    if (!status)
        status = run_view_parameter(v, "flux_l_per_tau", &s->constant, fault);
    if (!status)
        status = run_view_parameter(v, "dt_tau", &s->dt, fault);
    if (status)
        return status;
    struct fault none = FAULT_NONE;
    status = run_view_parameter_list(v, "flux_schedule_l_per_tau", &s->flux, &s->steps, &none);
    if (status == STATUS_NOT_FOUND) /* an empty list is not written */
        return STATUS_OK;
    if (status)
        *fault = none;
    if (status || !s->steps)
        return status;
    status = run_view_parameter(v, "flux_schedule_every_tau", &s->every, fault);
    if (!status && s->constant != 0)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: flux_l_per_tau %g beside a schedule",
                           run_view_path(v), s->constant);
    if (!status && !(s->every > 0))
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: flux_schedule_every_tau is %g",
                           run_view_path(v), s->every);
    return status;
}

/* The flux of the step that led to the frame at this time. */
static double flux_before(const struct schedule *s, double time) {
    double since = time - s->dt / 2 - s->on;
    if (since < 0 || time - s->dt / 2 > s->off)
        return 0;
    if (!s->steps)
        return s->constant;
    double step = floor(since / s->every);
    return step < (double)s->steps ? s->flux[(size_t)step] : 0;
}

/* First and last step of the largest flux; a fault where the fluxes do not rise and then fall. */
static enum status find_turn(struct run_view *v, const struct schedule *s, size_t *first,
                             size_t *last, struct fault *fault) {
    *first = *last = 0;
    for (size_t i = 1; i < s->steps; i++) {
        if (s->flux[i] > s->flux[*first])
            *first = i;
        if (s->flux[i] >= s->flux[*last])
            *last = i;
    }
    for (size_t i = 1; i < s->steps; i++)
        if (i <= *first ? s->flux[i] < s->flux[i - 1] : s->flux[i] > s->flux[i - 1])
            return fault_set(fault, STATUS_BAD_INPUT,
                             "%s: flux_schedule_l_per_tau: value %zu, %g, after %g: the fluxes "
                             "must rise and then fall",
                             run_view_path(v), i + 1, s->flux[i], s->flux[i - 1]);
    return STATUS_OK;
}

/* -- points ------------------------------------------------------------------------ */

struct point {
    double flux, speed;    /* q, and the bed's upwards (l/tau) */
    double ratio;          /* (1) */
    double solid_fraction; /* of the slab (1) */
};

struct task {
    struct run_view *view;
    const double *settings;
    struct observe_box box;
    struct observe_physics physics;
    struct schedule schedule;
    const struct series *fraction, *pressure;
    struct measurement *out;
};

static enum status open_task(struct task *k, struct fault *fault) {
    enum status status = observe_box(k->view, &k->box, fault);
    if (!status)
        status = observe_physics(k->view, &k->physics, fault);
    if (!status)
        status = read_schedule(k->view, &k->schedule, fault);
    if (!status)
        status = observe_field(k->view, "fields/solid_fraction", &k->box, 1, &k->fraction, fault);
    if (!status)
        status = observe_field(k->view, "fields/pressure", &k->box, 1, &k->pressure, fault);
    if (status)
        return status;
    if (!(k->physics.gravity > 0))
        return fault_set(fault, STATUS_BAD_INPUT, "%s: gravity %g: the bed has no weight",
                         run_view_path(k->view), k->physics.gravity);
    if (k->fraction->frames != k->pressure->frames)
        return fault_set(fault, STATUS_BAD_INPUT,
                         "%s: %zu frames of solid fraction, %zu of pressure",
                         run_view_path(k->view), k->fraction->frames, k->pressure->frames);
    return STATUS_OK;
}

/* The ratio of one frame, and its column. */
static enum status measure_frame(const struct task *k, size_t f, struct bed_column *c,
                                 double *ratio, struct fault *fault) {
    double time = k->fraction->time[f];
    *c = bed_column_measure(k->fraction->value + f * k->fraction->size, &k->box,
                            k->settings[MARGIN_L]);
    if (isnan(c->top))
        return fault_set(fault, STATUS_BAD_INPUT, "%s: there is no bed at %g tau",
                         run_view_path(k->view), time);
    double drop = bed_column_drop(k->pressure->value + f * k->pressure->size, &k->box);
    double flux = flux_before(&k->schedule, time);
    *ratio = (drop - bed_column_freeboard(c, &k->box, &k->physics, flux)) /
             bed_column_weight(c, &k->physics);
    return STATUS_OK;
}

/* Mean over the frames in (after, to] and [from, to]; frames: how many there are. */
static enum status average(const struct task *k, double after, double from, double to,
                           struct point *p, size_t *frames, struct fault *fault) {
    double half = k->physics.dt_tau / 2, first_time = 0, first_centre = 0, time = 0, centre = 0;
    *p = (struct point){0};
    *frames = 0;
    for (size_t f = 0; f < k->fraction->frames; f++) {
        struct bed_column c;
        double ratio, now = k->fraction->time[f];
        if (now < after + half || now < from - half || now > to + half)
            continue;
        enum status status = measure_frame(k, f, &c, &ratio, fault);
        if (status)
            return status;
        if (!(*frames)++) {
            first_time = now;
            first_centre = c.centre;
        }
        time = now;
        centre = c.centre;
        p->ratio += ratio;
        p->solid_fraction += c.slab_fraction;
    }
    p->ratio /= (double)*frames;
    p->solid_fraction /= (double)*frames;
    p->speed = (centre - first_centre) / (time - first_time); /* NaN with one frame */
    return STATUS_OK;
}

/* point[0 .. *count-1]: the steps that were completed. */
static enum status trace_steps(const struct task *k, struct point *point, size_t *count,
                               struct fault *fault) {
    const struct schedule *s = &k->schedule;
    for (*count = 0; *count < s->steps; (*count)++) {
        double begin = s->on + (double)*count * s->every, end = begin + s->every;
        size_t frames;
        if (!observe_reaches(k->fraction, end - s->dt) || end > s->off + s->dt)
            return STATUS_OK;
        enum status status =
            average(k, begin, end - k->settings[AVERAGE_TAU], end, &point[*count], &frames, fault);
        if (!status && frames < 2)
            status = fault_set(fault, STATUS_BAD_INPUT,
                               "%s: fields: %zu frames in the last %g of the step that ends at %g "
                               "tau; 2 needed",
                               run_view_path(k->view), frames, k->settings[AVERAGE_TAU], end);
        if (status)
            return status;
        point[*count].flux = s->flux[*count];
    }
    return STATUS_OK;
}

/* -- the break ----------------------------------------------------------------------- */

struct branch {
    size_t below_count, above_count;
    double slope, slope_variance; /* of the ratio against q - u, below (tau/l) */
    double level, level_variance; /* of the mean ratio above */
    double q_mf, q_mf_error;      /* (l/tau); NaN where there is none */
    double solid_fraction;        /* mean of the points below */
    double fixed_speed;           /* largest |u| of those (l/tau) */
};

/* A bed at rest, or nearly so, that the gas does not carry. */
static bool is_below(const struct point *p, const double *settings) {
    return p->ratio < settings[BELOW] && fabs(p->speed) <= settings[FIXED] * fabs(p->flux);
}

/* room[0 .. 2*count-1]: scratch. */
static void fit_below(const struct point *p, size_t count, const double *settings, double *room,
                      struct branch *b) {
    double *x = room, *y = room + count, squares;
    for (size_t i = 0; i < count; i++)
        if (is_below(&p[i], settings)) {
            x[b->below_count] = p[i].flux - p[i].speed;
            y[b->below_count++] = p[i].ratio;
            b->solid_fraction += p[i].solid_fraction;
            b->fixed_speed = fmax(b->fixed_speed, fabs(p[i].speed));
        }
    b->solid_fraction /= (double)b->below_count;
    if (b->below_count >= MIN_POINTS)
        gsl_fit_mul(x, 1, y, 1, b->below_count, &b->slope, &b->slope_variance, &squares);
}

/* ratio[0 .. ]: those of the points above are appended from above_count on. */
static void average_above(const struct point *p, size_t count, double from_flux, double *ratio,
                          struct branch *b) {
    for (size_t i = 0; i < count; i++)
        if (p[i].flux >= from_flux)
            ratio[b->above_count++] = p[i].ratio;
    if (b->above_count < MIN_POINTS)
        return;
    b->level = gsl_stats_mean(ratio, 1, b->above_count);
    b->level_variance =
        gsl_stats_variance_m(ratio, 1, b->above_count, b->level) / (double)b->above_count;
}

/* The break of one way; the ratios above are written to ratio[]. */
static struct branch find_break(const struct point *p, size_t count, const double *settings,
                                double *room, double *ratio) {
    struct branch b = {.q_mf = NAN, .q_mf_error = NAN};
    fit_below(p, count, settings, room, &b);
    if (b.below_count < MIN_POINTS || !(b.slope > 0))
        return b;
    average_above(p, count, settings[ABOVE] / b.slope, ratio, &b);
    if (b.above_count < MIN_POINTS)
        return b;
    b.q_mf = b.level / b.slope;
    b.q_mf_error = b.q_mf * sqrt(b.slope_variance / (b.slope * b.slope) +
                                 b.level_variance / (b.level * b.level));
    return b;
}

static void conclude_branch(const struct branch *b, const char *way, size_t q_mf,
                            size_t solid_fraction, struct measurement *out) {
    out->value[q_mf] = b->q_mf;
    out->value[q_mf + 1] = b->q_mf_error;
    out->value[solid_fraction] = b->solid_fraction;
    if (isnan(b->q_mf))
        observe_none(out, q_mf, "%s: %zu points below the break, %zu clearly above; %d needed", way,
                     b->below_count, b->above_count, (int)MIN_POINTS);
    if (!b->below_count)
        observe_none(out, solid_fraction, "%s: no point at which the bed is fixed", way);
    else if (isnan(b->solid_fraction))
        observe_none(out, solid_fraction, "the bed leaves no slab between the margins");
}

/* ratio[0 .. up->above_count + down->above_count - 1] are those above. */
static void conclude(const struct branch *up, const struct branch *down, const double *ratio,
                     struct measurement *out) {
    size_t above = up->above_count + down->above_count;
    conclude_branch(up, "up", Q_MF_UP, SOLID_FRACTION, out);
    conclude_branch(down, "down", Q_MF_DOWN, SOLID_FRACTION_DOWN, out);
    out->value[HYSTERESIS] = (up->q_mf - down->q_mf) / up->q_mf;
    out->value[FIXED_SPEED] = fmax(up->fixed_speed, down->fixed_speed);
    if (!up->below_count && !down->below_count)
        out->value[FIXED_SPEED] = NAN; /* the reason is told by the fractions */
    if (above < MIN_POINTS) {
        observe_none(out, ABOVE_MEAN, "%zu points clearly above the break; %d needed", above,
                     (int)MIN_POINTS);
        out->value[ABOVE_SPREAD] = NAN;
        return;
    }
    out->value[ABOVE_MEAN] = gsl_stats_mean(ratio, 1, above);
    out->value[ABOVE_SPREAD] = gsl_stats_sd(ratio, 1, above);
}

/* -- curves ----------------------------------------------------------------------------- */

/* x[0 .. count-1], y: room for the larger of all points and all frames. */
static enum status add_way(const struct point *p, size_t count, const char *way,
                           const struct branch *b, double *x, double *y, struct measurement *out,
                           struct fault *fault) {
    double last = 0;
    for (size_t i = 0; i < count; i++) {
        x[i] = p[i].flux - p[i].speed;
        y[i] = p[i].ratio;
        last = fmax(last, p[i].flux);
    }
    enum status status = measurement_add_curve(out, way, way, x, y, count, fault);
    const double line_x[] = {0, b->q_mf, last}, line_y[] = {0, b->level, b->level};
    if (!status && !isnan(b->q_mf))
        status = measurement_add_curve(out, "fit", way, line_x, line_y, 3, fault);
    return status;
}

static enum status add_time(const struct task *k, double *time, double *ratio,
                            struct fault *fault) {
    size_t count = 0;
    for (size_t f = 0; f < k->fraction->frames; f++) {
        struct bed_column c;
        if (k->fraction->time[f] <= k->schedule.on + k->schedule.dt / 2)
            continue; /* a start file's pressure, or none yet */
        time[count] = k->fraction->time[f];
        enum status status = measure_frame(k, f, &c, &ratio[count++], fault);
        if (status)
            return status;
    }
    return measurement_add_curve(k->out, "time", "bed", time, ratio, count, fault);
}

/* -- together ------------------------------------------------------------------------------ */

/* room[0 .. 2*steps + 2*max(steps, frames) - 1] */
static enum status measure_schedule(const struct task *k, struct point *point, double *ratio,
                                    double *room, size_t most, struct fault *fault) {
    struct measurement *out = k->out;
    size_t count, first, last;
    enum status status = find_turn(k->view, &k->schedule, &first, &last, fault);
    if (!status)
        status = trace_steps(k, point, &count, fault);
    if (status)
        return status;
    size_t up_count = count < first + 1 ? count : first + 1, start = count < last ? count : last;
    struct branch up = find_break(point, up_count, k->settings, room, ratio);
    struct branch down =
        find_break(point + start, count - start, k->settings, room, ratio + up.above_count);
    conclude(&up, &down, ratio, out);
    out->value[POINTS] = (double)count;
    out->value[OVERSHOOT] = NAN;
    for (size_t i = 0; i < up_count; i++)
        out->value[OVERSHOOT] = fmax(out->value[OVERSHOOT], point[i].ratio);
    status = add_way(point, up_count, "up", &up, room, room + most, out, fault);
    if (!status)
        status =
            add_way(point + start, count - start, "down", &down, room, room + most, out, fault);
    return status;
}

static enum status measure_constant(const struct task *k, struct fault *fault) {
    const struct schedule *s = &k->schedule;
    double from = k->settings[FROM_TAU], to = k->settings[TO_TAU];
    struct point p;
    size_t frames;
    for (size_t i = Q_MF_UP; i <= FIXED_SPEED; i++)
        if (i != ABOVE_MEAN)
            observe_none(k->out, i, "the flux is constant: no schedule, no break");
    if (s->constant == 0 || from < s->on || to > s->off || !observe_reaches(k->fraction, to)) {
        k->out->reason[0] = 0; /* this one matters more */
        observe_none(k->out, ABOVE_MEAN, "%g to %g tau is not a time of injection in this run",
                     from, to);
        return STATUS_OK;
    }
    enum status status = average(k, s->on, from, to, &p, &frames, fault);
    if (status)
        return status;
    k->out->value[ABOVE_MEAN] = p.ratio;
    k->out->value[POINTS] = (double)frames;
    if (!frames) {
        k->out->reason[0] = 0;
        observe_none(k->out, ABOVE_MEAN, "no frame from %g to %g tau", from, to);
    }
    return STATUS_OK;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct task k = {.view = v, .settings = settings, .out = out};
    enum status status = open_task(&k, fault);
    if (status)
        return status;
    size_t steps = k.schedule.steps;
    size_t most = steps > k.fraction->frames ? steps : k.fraction->frames;
    struct point *point = calloc(steps + 1, sizeof *point);
    double *room = calloc(2 * most + 2 * (steps + 1), sizeof *room);
    if (!point || !room)
        status = fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu points", most);
    else if (steps)
        status = measure_schedule(&k, point, room + 2 * most, room, most, fault);
    else
        status = measure_constant(&k, fault);
    if (!status)
        status = add_time(&k, room, room + most, fault);
    free(point);
    free(room);
    return status;
}

static const char *const DATASETS[] = {"fields/solid_fraction", "fields/pressure", NULL};
static const char *const CURVES[] = {"up", "down", "fit", "time", NULL};

const struct recipe recipe_pressure_drop = {
    .name = "pressure-drop",
    .title = "Pressure drop across the bed, and where it breaks",
    .source = "MFM, Eqs. 8 and 11; docs/theory.md",
    .datasets = DATASETS,
    .setting = {{"average_tau", "tau", "end of each step that is averaged", 2, 1e-3, 1e6},
                {"from_tau", "tau", "constant flux: the window begins", 10, 0, 1e6},
                {"to_tau", "tau", "and ends", 40, 0, 1e6},
                {"below", "1", "points of a smaller ratio are below the break", 0.9, 0.01, 1},
                {"above", "1", "points from this share of the break on are above", 1.1, 1, 100},
                {"fixed", "1",
                 "points at which the bed moves faster than this share of the flux are not below",
                 0.1, 0, 1},
                {"margin_l", "l", "left out of the slab at the floor and under the top", 5, 0,
                 1000}},
    .output = {{"q_mf_up", "l/tau", "the break as the flux rises"},
               {"q_mf_up_error", "l/tau", "its standard error"},
               {"q_mf_down", "l/tau", "the break as the flux falls"},
               {"q_mf_down_error", "l/tau", "its standard error"},
               {"hysteresis", "1", "(up - down)/up"},
               {"overshoot", "1", "largest ratio of a step on the way up"},
               {"above", "1", "mean ratio above the break"},
               {"above_spread", "1", "standard deviation of the ratios above the break"},
               {"solid_fraction", "1", "of the slab, mean over the points below on the way up"},
               {"solid_fraction_down", "1", "the same on the way down"},
               {"fixed_speed", "l/tau", "largest speed of the bed at a point below"},
               {"points", "1", "steps used; frames, with a constant flux"}},
    .curves = CURVES,
    .measure = measure,
};
