/* test_kinematic_wave.c -- fronts and fans against finite volumes and closed forms. */
#include "tests/unit/unit.h"
#include "validation/kinematic_wave.h"

#include <math.h>

/* FZ's bed: 1e4 spheres on 16R x 16R. */
static struct bed_change bed(double before, double after, bool full) {
    return (struct bed_change){.before = before,
                               .after = after,
                               .load_m = 1e4 * 4 * M_PI / 3 * 6e-4 / 256,
                               .radius_m = 6e-4,
                               .drag_per_s = 5,
                               .exponent = 4.65,
                               .pull_m_per_s2 = 9.81 * 0.6,
                               .full = full};
}

/* The law of motion, typed again from the paper. */
static double flux(const struct bed_change *c, double phi) {
    double gamma = c->drag_per_s * pow(1 - c->after, -c->exponent), n = c->exponent;
    double b = n * c->pull_m_per_s2;
    if (!c->full)
        return phi * b * (phi - c->after) / ((1 - c->after) * gamma);
    double stream = c->pull_m_per_s2 / gamma;
    return phi * (stream - c->pull_m_per_s2 / c->drag_per_s * pow(1 - phi, n));
}

/* Godunov's scheme, first order: the flux between two cells is the least of f between them
 * where phi rises, the largest where it falls. */
enum { CELLS = 1050 };
static double godunov(const struct bed_change *c, double a, double b) {
    double best = flux(c, a);
    for (int i = 1; i <= 24; i++) {
        double f = flux(c, a + (b - a) * i / 24);
        best = a <= b ? fmin(best, f) : fmax(best, f);
    }
    return best;
}

static void volumes(const struct bed_change *c, double until_s, double cell_m, double *phi,
                    int cells) {
    static double f[CELLS + 1];
    double fastest = 0;
    for (int i = 0; i < cells; i++)
        phi[i] = c->before * fmax(0, fmin(1, c->load_m / c->before / cell_m - i));
    for (double p = 0; p < fmax(c->before, c->after); p += 0.005)
        fastest = fmax(fastest, fabs(flux(c, p + 0.005) - flux(c, p)) / 0.005);
    int steps = (int)ceil(until_s * fastest / (0.8 * cell_m));
    for (int n = 0; n < steps; n++) {
        for (int i = 1; i < cells; i++)
            f[i] = phi[i - 1] == phi[i] ? flux(c, phi[i]) : godunov(c, phi[i - 1], phi[i]);
        f[0] = f[cells] = 0;
        for (int i = 0; i < cells; i++)
            phi[i] -= until_s / steps / cell_m * (f[i + 1] - f[i]);
    }
}

static struct kinematic_wave *wave_at(const struct bed_change *c, double time_s) {
    struct fault fault = FAULT_NONE;
    struct kinematic_wave *w;
    unit_ok(kinematic_wave_create(c, &w, &fault), &fault);
    unit_ok(kinematic_wave_advance(w, time_s, &fault), &fault);
    return w;
}

/* Mean |phi - phi'| over the bed, with so many volumes. */
static double distance(const struct bed_change *c, double time_s, int cells) {
    static double phi[CELLS], own[CELLS];
    double height = c->load_m / fmin(c->before, c->after), cell = 1.25 * height / cells, sum = 0;
    double solid = 0;
    volumes(c, time_s, cell, phi, cells);
    struct kinematic_wave *w = wave_at(c, time_s);
    kinematic_wave_profile(w, cell, own, (size_t)cells);
    for (int i = 0; i < cells; i++) {
        sum += fabs(phi[i] - own[i]) * cell / height;
        solid += own[i] * cell;
    }
    ck_assert_double_eq_tol(solid, c->load_m, 1e-12);
    kinematic_wave_free(w);
    return sum;
}

/* The volumes smear fronts and the corners of fans: they come nearer as they get smaller. */
static void compare(double before, double after, bool full, double time_s) {
    struct bed_change c = bed(before, after, full);
    double rough = distance(&c, time_s, CELLS / 3), fine = distance(&c, time_s, CELLS);
    ck_assert_double_lt(fine, 3e-3); /* 1.6e-3 with 1500 volumes, 2.5e-3 with these */
    ck_assert_double_lt(fine, 0.7 * rough + 1e-4);
}

START_TEST(linear_law_agrees_with_finite_volumes) {
    const double time[] = {0.21, 0.83, 1.61};
    for (int i = 0; i < 3; i++) {
        compare(0.3, 0.55, false, time[i]);
        compare(0.55, 0.3, false, time[i] * 0.31);
        compare(0.35, 0.3, false, time[i] * 0.4);
    }
}
END_TEST

/* f bends over at 2/(n+1) = .354: shocks and fans in one wave. */
START_TEST(full_law_agrees_with_finite_volumes) {
    const double time[] = {0.11, 0.34, 0.61};
    for (int i = 0; i < 3; i++) {
        compare(0.3, 0.55, true, time[i]);
        compare(0.55, 0.3, true, time[i]);
        compare(0.45, 0.33, true, time[i]);
        compare(0.29, 0.41, true, time[i]);
    }
}
END_TEST

/* End times that physics gives: (h0-h1)/(c |phibar - phi0|) where that is the top's way, and
 * h1/(c phibar). */
START_TEST(ends_are_those_of_the_closed_forms) {
    const double pair[][3] = {{0.3, 0.55, 2.005}, {0.55, 0.3, 0.733}, {0.35, 0.3, 0.733},
                              {0.4, 0.35, 0.705}, {0.45, 0.4, 0.723}, {0.5, 0.45, 0.785},
                              {0.55, 0.5, 0.90}};
    for (int i = 0; i < 7; i++) {
        struct fault fault = FAULT_NONE;
        struct bed_change c = bed(pair[i][0], pair[i][1], false);
        struct kinematic_wave *w;
        double end = 0, slope = bed_change_slope(&c);
        double h0 = c.load_m / c.before, h1 = c.load_m / c.after;
        double by_hand =
            h1 < h0 ? (h0 - h1) / (slope * (c.after - c.before)) : h1 / (slope * c.after);
        unit_ok(kinematic_wave_create(&c, &w, &fault), &fault);
        ck_assert(!kinematic_wave_rests(w));
        unit_ok(kinematic_wave_settle(w, &end, &fault), &fault);
        ck_assert(kinematic_wave_rests(w));
        ck_assert_double_eq_tol(kinematic_wave_end(&c), by_hand, 1e-12);
        ck_assert_double_eq_tol(by_hand, pair[i][2], 0.006);
        ck_assert_double_eq_tol(end, by_hand, 0.004 * by_hand);
        ck_assert_double_eq_tol(kinematic_wave_centre(w), h1 / 2, 1e-9 * h1);
        kinematic_wave_free(w);
    }
}
END_TEST

/* Expansion in closed form: a fan phi = (z/ct + phibar)/2 between c phibar t and the top,
 * which leaves h0 + c (phi0 - phibar) t at h0/(c phi0) for 2 sqrt(h0 c phi0 t) - c phibar t. */
START_TEST(fan_and_top_of_an_expansion_are_those_of_the_closed_form) {
    struct bed_change c = bed(0.55, 0.3, false);
    double slope = bed_change_slope(&c), h0 = c.load_m / c.before, met = h0 / (slope * c.before);
    static double phi[400];
    for (int k = 1; k < 6; k++) {
        double t = met * (0.37 * k), bin = 6e-4, R = 6e-4;
        struct kinematic_wave *w = wave_at(&c, t);
        kinematic_wave_profile(w, bin, phi, 400);
        double top = t < met ? h0 + slope * (c.before - c.after) * t
                             : 2 * sqrt(h0 * slope * c.before * t) - slope * c.after * t;
        for (int i = 0; i < 400; i++) {
            double z = (i + 0.5) * R, low = slope * c.after * t;
            double high = slope * (2 * c.before - c.after) * t;
            if (fabs(z - low) < 2 * R || fabs(z - high) < 2 * R || fabs(z - top) < 2 * R)
                continue;
            double expected = z > top    ? 0
                              : z < low  ? c.after
                              : z < high ? (z / (slope * t) + c.after) / 2
                                         : c.before;
            ck_assert_double_eq_tol(phi[i], expected, 1e-3);
        }
        kinematic_wave_free(w);
    }
}
END_TEST

/* 90 % of the way of the centre of mass: physics has .53 and .52 s (full), 1.37 and .33 s. */
START_TEST(full_law_is_as_fast_in_compaction_as_in_expansion) {
    const struct {
        double before, after;
        bool full;
        double time_s;
    } known[] = {{0.3, 0.55, true, 0.53},
                 {0.55, 0.3, true, 0.52},
                 {0.3, 0.55, false, 1.37},
                 {0.55, 0.3, false, 0.33}};
    for (int i = 0; i < 4; i++) {
        struct bed_change c = bed(known[i].before, known[i].after, known[i].full);
        struct kinematic_wave *early = wave_at(&c, known[i].time_s - 0.006),
                              *late = wave_at(&c, known[i].time_s + 0.006);
        double from = c.load_m / c.before / 2, to = c.load_m / c.after / 2;
        ck_assert_double_lt((kinematic_wave_centre(early) - from) / (to - from), 0.9);
        ck_assert_double_gt((kinematic_wave_centre(late) - from) / (to - from), 0.9);
        kinematic_wave_free(early);
        kinematic_wave_free(late);
    }
}
END_TEST

START_TEST(both_laws_have_the_same_slope_at_phibar) {
    struct bed_change linear = bed(0.3, 0.47, false), full = bed(0.3, 0.47, true);
    double d = 1e-5, slope = bed_change_slope(&linear);
    for (int i = 0; i < 2; i++) {
        const struct bed_change *c = i ? &full : &linear;
        ck_assert_double_eq_tol(bed_change_speed(c, 0.47, 0.47), 0, 1e-15);
        double up = bed_change_speed(c, 0.47 + d, 0.47), down = bed_change_speed(c, 0.47 - d, 0.47);
        ck_assert_double_eq_tol((up - down) / (2 * d), slope, 1e-6 * slope);
        ck_assert_double_eq_tol(0.413 * bed_change_speed(c, 0.413, 0.47), flux(c, 0.413), 1e-15);
    }
    ck_assert_double_eq_tol(bed_change_stream(&full), 9.81 * 0.6 / 5 * pow(0.53, 4.65), 1e-12);
}
END_TEST

START_TEST(no_wave_goes_back_in_time) {
    struct fault fault = FAULT_NONE;
    struct bed_change c = bed(0.3, 0.55, false);
    struct kinematic_wave *w = wave_at(&c, 0.7);
    ck_assert_int_eq(kinematic_wave_advance(w, 0.6, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "cannot go on");
    kinematic_wave_free(w);
    kinematic_wave_free(NULL);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {linear_law_agrees_with_finite_volumes,
                                  full_law_agrees_with_finite_volumes,
                                  ends_are_those_of_the_closed_forms,
                                  fan_and_top_of_an_expansion_are_those_of_the_closed_form,
                                  full_law_is_as_fast_in_compaction_as_in_expansion,
                                  both_laws_have_the_same_slope_at_phibar,
                                  no_wave_goes_back_in_time,
                                  NULL};
    return unit_run("kinematic_wave", tests);
}
