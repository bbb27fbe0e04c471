/* predict_step.c -- a bed after a change of phibar: end times, times of 90 %, rates.
 *
 * Of the kinematic wave (kinematic_wave.h) and of the wave with pressure (pressure_wave.h), each
 * read as the runs are (bed_track.h, relaxation_theory.h).  A time of a share s is when the centre
 * of mass has gone the share s of its way.
 *
 * Source:     Fiege & Zippelius, Eqs. 1, 7, 9 and 15; docs/theory.md, S7.
 * Leaves out: noise; what is NaN could not be solved.
 * Checked by: tests/unit/test_predict_step.c.
 */
#include "validation/bed_track.h"
#include "validation/kinematic_wave.h"
#include "validation/predictions.h"
#include "validation/relaxation_theory.h"
#include "validation/sphere_laws.h"

#include <math.h>

enum { SAMPLES = 400 };
/* Waves have ended long before: what is sampled, over the end of the linear kinematic one. */
static const double HORIZON = 2.5;

enum wave { KINEMATIC, PRESSURE, INERTIAL };

/* The inputs of STEP, and with pressure those of HEAT. */
static struct bed_change change_of(const double *in, enum wave wave, bool full) {
    struct bed_change c = {.drag_per_s = in[0],
                           .exponent = in[1],
                           .pull_m_per_s2 = in[2] * in[3] * in[4],
                           .load_m = in[5] * 4 * M_PI / 3 * in[8] / (in[6] * in[7]),
                           .radius_m = in[8],
                           .before = in[9],
                           .after = in[10],
                           .full = full,
                           .inertia = wave == INERTIAL};
    if (wave != KINEMATIC) {
        c.heat_m2_per_s2 = in[11] * in[12] / in[13];
        c.layer_m = in[14] * in[8];
        c.restitution = in[15];
    }
    return c;
}

static struct bed_reading reading_of(const struct bed_change *c) {
    double top_R = c->load_m / fmin(c->before, c->after) / c->radius_m;
    return (struct bed_reading){.before = c->before,
                                .after = c->after,
                                .above_R = 10, /* as the recipe bed-step */
                                .smooth_R = 5,
                                .bin_R = 1,
                                .bins = (size_t)ceil(1.2 * top_R + 40)};
}

static bool is_bed(const struct bed_change *c) {
    return c->before > 0 && c->after > 0 && c->before < 0.64 && c->after < 0.64 &&
           c->before != c->after && c->load_m > 0 && c->radius_m > 0 && c->pull_m_per_s2 > 0 &&
           c->drag_per_s > 0 && isfinite(c->load_m / c->radius_m);
}

static enum status follow(const struct bed_change *c, bool pressure, struct bed_track *t) {
    struct bed_reading r = reading_of(c);
    struct fault fault = FAULT_NONE;
    double time[SAMPLES + 1];
    for (size_t k = 0; k <= SAMPLES; k++)
        time[k] = HORIZON * kinematic_wave_end(c) * (double)k / SAMPLES;
    return pressure ? bed_track_pressure(c, &r, time, SAMPLES + 1, t, NULL, &fault)
                    : bed_track_kinematic(c, &r, time, SAMPLES + 1, t, NULL, &fault);
}

static double time_of(const struct bed_change *c, bool pressure, double share) {
    struct bed_track t = {0};
    double time = NAN;
    if (is_bed(c) && !follow(c, pressure, &t))
        time = bed_track_time(&t, t.centre_R[0], t.centre_R[SAMPLES], share);
    bed_track_free(&t);
    return time;
}

static double rate_of(const struct bed_change *c, bool pressure, double window_s) {
    struct fault fault = FAULT_NONE;
    struct relaxation_fit fit;
    return is_bed(c) && !relaxation_theory_fit(c, pressure, window_s, &fit, &fault) ? fit.rate_per_s
                                                                                    : NAN;
}

static double kinematic_end(const double *in) {
    struct bed_change c = change_of(in, KINEMATIC, false);
    return kinematic_wave_end(&c);
}

static double kinematic_90(const double *in) {
    struct bed_change c = change_of(in, KINEMATIC, false);
    return time_of(&c, false, 0.9);
}

static double full_90(const double *in) {
    struct bed_change c = change_of(in, KINEMATIC, true);
    return time_of(&c, false, 0.9);
}

static double kinematic_rate(const double *in) {
    struct bed_change c = change_of(in, KINEMATIC, false);
    return rate_of(&c, false, in[11]);
}

static double pressure_90(const double *in) {
    struct bed_change c = change_of(in, PRESSURE, false);
    return time_of(&c, true, 0.9);
}

static double pressure_rate(const double *in) {
    struct bed_change c = change_of(in, PRESSURE, false);
    return rate_of(&c, true, in[16]);
}

static double inertial_90(const double *in) {
    struct bed_change c = change_of(in, INERTIAL, false);
    return time_of(&c, true, 0.9);
}

static double inertial_98(const double *in) {
    struct bed_change c = change_of(in, INERTIAL, false);
    return time_of(&c, true, 0.98);
}

static double inertial_full_90(const double *in) {
    struct bed_change c = change_of(in, INERTIAL, true);
    return time_of(&c, true, 0.9);
}

static double inertial_meeting(const double *in) {
    struct bed_change c = change_of(in, INERTIAL, false);
    struct bed_track t = {0};
    double time = is_bed(&c) && !follow(&c, true, &t) ? bed_track_meeting(&t) : NAN;
    bed_track_free(&t);
    return time;
}

static double inertial_rate(const double *in) {
    struct bed_change c = change_of(in, INERTIAL, false);
    return rate_of(&c, true, in[16]);
}

/* gravity, contrast, scale, drag, phibar, exponent */
static double stream(const double *in) {
    struct bed_change c = {.pull_m_per_s2 = in[0] * in[1] * in[2],
                           .drag_per_s = in[3],
                           .after = in[4],
                           .exponent = in[5]};
    return bed_change_stream(&c);
}

#define STEP                                                                                       \
    "drag_per_s", "exponent", "gravity_m_per_s2", "density_contrast", "drive_scale", "particles",  \
        "width_x_R", "width_y_R", "radius_m", "phibar", "phibar_values"
#define HEAT STEP, "thermal_energy_J", "temperature_scale", "mass_kg", "layer_R", "restitution"

const struct prediction PREDICT_STEP[PREDICT_STEP_COUNT] = {
    {.name = "kinematic-end-time",
     .title = "End of the kinematic wave, linear law",
     .unit = "s",
     .source = "docs/theory.md, S7",
     .input = {STEP, NULL},
     .at = kinematic_end},
    {.name = "kinematic-time-90",
     .title = "90 % of the centre of mass' way, kinematic wave, linear law",
     .unit = "s",
     .source = "Fiege & Zippelius, Eq. 9; docs/theory.md, S7",
     .input = {STEP, NULL},
     .at = kinematic_90},
    {.name = "kinematic-full-time-90",
     .title = "90 % of the centre of mass' way, kinematic wave, full law",
     .unit = "s",
     .source = "Fiege & Zippelius, Eq. 1; docs/theory.md, S7",
     .input = {STEP, NULL},
     .at = full_90},
    {.name = "kinematic-relaxation-rate",
     .title = "Rate fitted to L(t) of the kinematic wave",
     .unit = "1/s",
     .source = "Fiege & Zippelius, Eq. 15; docs/theory.md, S7",
     .input = {STEP, "window_s", NULL},
     .at = kinematic_rate},
    {.name = "pressure-time-90",
     .title = "90 % of the centre of mass' way, wave with pressure, linear law",
     .unit = "s",
     .source = "docs/theory.md, S7",
     .input = {HEAT, NULL},
     .at = pressure_90},
    {.name = "pressure-relaxation-rate",
     .title = "Rate fitted to L(t) of the wave with pressure",
     .unit = "1/s",
     .source = "Fiege & Zippelius, Eq. 15; docs/theory.md, S7",
     .input = {HEAT, "window_s", NULL},
     .at = pressure_rate},
    {.name = "inertial-time-90",
     .title = "90 % of the centre of mass' way, with pressure and inertia, linear law",
     .unit = "s",
     .source = "docs/theory.md, S7",
     .input = {HEAT, NULL},
     .at = inertial_90},
    {.name = "inertial-time-98",
     .title = "98 % of the centre of mass' way, with pressure and inertia, linear law",
     .unit = "s",
     .source = "docs/theory.md, S7",
     .input = {HEAT, NULL},
     .at = inertial_98},
    {.name = "inertial-full-time-90",
     .title = "90 % of the centre of mass' way, with pressure and inertia, full law",
     .unit = "s",
     .source = "docs/theory.md, S7",
     .input = {HEAT, NULL},
     .at = inertial_full_90},
    {.name = "inertial-meeting-time",
     .title = "When bottom front and top meet, with pressure and inertia",
     .unit = "s",
     .source = "docs/theory.md, S7",
     .input = {HEAT, NULL},
     .at = inertial_meeting},
    {.name = "inertial-relaxation-rate",
     .title = "Rate fitted to L(t) of the wave with pressure and inertia",
     .unit = "1/s",
     .source = "Fiege & Zippelius, Eq. 15; docs/theory.md, S7",
     .input = {HEAT, "window_s", NULL},
     .at = inertial_rate},
    {.name = "external-velocity",
     .title = "Speed of the fluid that supports phibar",
     .unit = "m/s",
     .source = "Fiege & Zippelius, Eq. 7",
     .input = {"gravity_m_per_s2", "density_contrast", "drive_scale", "drag_per_s", "phibar",
               "exponent", NULL},
     .at = stream},
};
