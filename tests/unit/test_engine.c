/* test_engine.c -- solver/suspension/engine.h: single events against closed formulas. */
#include "solver/suspension/engine.h"
#include "tests/unit/unit.h"

#include <math.h>

static const double radius = 0.613e-3, mass = 2.262e-6;

static struct engine *make(size_t count, const double *box_R, enum boundary side,
                           double restitution, const double *x, const double *v) {
    struct fault fault = FAULT_NONE;
    struct engine *e = NULL;
    struct engine_setup s = {.count = count,
                             .radius_m = radius,
                             .mass_kg = mass,
                             .boundary = {side, side, side},
                             .restitution = restitution};
    for (int a = 0; a < 3; a++)
        s.box_m[a] = box_R[a] * radius;
    unit_ok(engine_create(&e, &s, &fault), &fault);
    unit_ok(engine_set_state(e, x, v, &fault), &fault);
    return e;
}

static void run_to(struct engine *e, double time) {
    struct fault fault = FAULT_NONE;
    unit_ok(engine_advance(e, time, &fault), &fault);
    ck_assert_double_eq(engine_time(e), time);
}

static void drag(struct engine *e, double gamma) {
    struct fault fault = FAULT_NONE;
    unit_ok(engine_set_drag(e, gamma, &fault), &fault);
}

static const double box[3] = {17.3, 19.1, 23.7};

/* Two spheres on an oblique course: when they touch, and with what velocities they part. */
static void meet_obliquely(double gamma, double restitution) {
    const double R = radius, x[6] = {5 * R, 6 * R, 7 * R, 9.1 * R, 7.3 * R, 8.2 * R};
    const double v[6] = {0.031, 0.004, -0.002, -0.0123, -0.006, -0.011};
    double r[3], u[3], rr = 0, ru = 0, uu = 0, p[3], w[3], place[3];
    struct engine *e = make(2, box, BOUNDARY_PERIODIC, restitution, x, v);
    drag(e, gamma);
    for (int a = 0; a < 3; a++) {
        r[a] = x[3 + a] - x[a];
        u[a] = v[3 + a] - v[a];
        rr += r[a] * r[a];
        ru += r[a] * u[a];
        uu += u[a] * u[a];
    }
    double s = (-ru - sqrt(ru * ru - uu * (rr - 4 * R * R))) / uu;
    double t = gamma > 0 ? -log(1 - gamma * s) / gamma : s;
    ck_assert_double_gt(t, 0);
    run_to(e, t * (1 - 1e-12));
    ck_assert_int_eq(engine_tally(e)->collisions, 0);
    run_to(e, t * (1 + 1e-12));
    ck_assert_int_eq(engine_tally(e)->collisions, 1);
    double normal = 0, n[3], slow = exp(-gamma * t);
    for (int a = 0; a < 3; a++) {
        n[a] = (r[a] + u[a] * s) / (2 * R);
        normal += n[a] * u[a] * slow;
    }
    engine_place(e, 0, place, w);
    engine_place(e, 1, place, p);
    for (int a = 0; a < 3; a++) {
        double change = 0.5 * (1 + restitution) * normal * n[a];
        ck_assert_double_eq_tol(w[a], v[a] * slow + change, 1e-12 * 0.03);
        ck_assert_double_eq_tol(p[a], v[3 + a] * slow - change, 1e-12 * 0.03);
    }
    double loss = mass / 4 * (1 - restitution * restitution) * normal * normal;
    double virial = mass / 2 * (1 + restitution) * -normal * 2 * R;
    ck_assert_double_eq_tol(engine_tally(e)->dissipated_J, loss, 1e-12 * mass * 1e-3);
    ck_assert_double_eq_tol(engine_tally(e)->virial_J, virial, 1e-11 * virial);
    engine_free(e);
}

START_TEST(two_spheres_meet_as_the_formula_says) {
    meet_obliquely(0, 1);
    meet_obliquely(0, 0.71);
    meet_obliquely(13.7, 1);
    meet_obliquely(13.7, 0.43);
}
END_TEST

/* Through the boundary, in a box of two cells an axis: the nearest image is hit. */
START_TEST(spheres_meet_through_a_periodic_side) {
    const double R = radius, small[3] = {5.3, 4.7, 4.9};
    const double x[6] = {0.9 * R, 2.1 * R, 4.5 * R, 3.6 * R, 2.3 * R, 4.4 * R};
    const double v[6] = {-0.021, 0, 0, 0.002, 0, 0};
    struct engine *e = make(2, small, BOUNDARY_PERIODIC, 1, x, v);
    double dy = 0.2 * R, dz = 0.1 * R, touch = sqrt(4 * R * R - dy * dy - dz * dz);
    double t = ((0.9 + 5.3 - 3.6) * R - touch) / 0.023;
    run_to(e, t * (1 - 1e-12));
    ck_assert_int_eq(engine_tally(e)->collisions, 0);
    run_to(e, t * (1 + 1e-12));
    ck_assert_int_eq(engine_tally(e)->collisions, 1);
    engine_free(e);
}
END_TEST

/* A sphere with drag goes v/gamma and no further; walls fold its way. */
START_TEST(drag_ends_a_way_at_v_over_gamma) {
    const double R = radius, x[3] = {8.7 * R, 9.1 * R, 3.3 * R}, v[3] = {0.91, -0.33, 0.57};
    double place[3], w[3], gamma = 11.3;
    struct engine *e = make(1, box, BOUNDARY_HARD, 0.7, x, v);
    drag(e, gamma);
    for (int n = 1; n <= 60; n++) {
        double t = 0.031 * n;
        run_to(e, t);
        engine_place(e, 0, place, w);
        for (int a = 0; a < 3; a++) { /* unfold: period of twice the free way */
            double free_way = (box[a] - 2) * R, way = v[a] * -expm1(-gamma * t) / gamma;
            double at = fmod(x[a] - R + way + 1000 * 2 * free_way, 2 * free_way);
            double folded = at > free_way ? 2 * free_way - at : at;
            ck_assert_double_eq_tol(place[a], R + folded, 1e-10 * R);
            ck_assert_double_eq_tol(fabs(w[a]), fabs(v[a]) * exp(-gamma * t), 1e-13);
        }
    }
    ck_assert_int_gt(engine_tally(e)->wall_collisions, 10);
    ck_assert_int_gt(engine_tally(e)->rebases, 10);
    engine_free(e);
}
END_TEST

/* Over gamma t = 709 the time of its last event would overflow in the clock. */
START_TEST(a_sphere_may_meet_nothing_for_as_long_as_it_likes) {
    const double x[3] = {0.0031, 0.0047, 0.0059}, v[3] = {0.0071, -0.0023, 0.0013};
    struct engine *e = make(1, box, BOUNDARY_PERIODIC, 0.83, x, v);
    double place[3], speed[3], gamma = 23.7;
    drag(e, gamma);
    run_to(e, 211.3);
    engine_place(e, 0, place, speed);
    for (int a = 0; a < 3; a++) {
        ck_assert_double_eq_tol(place[a], x[a] + v[a] / gamma, 1e-15);
        ck_assert_double_eq_tol(speed[a], 0, 1e-30);
    }
    engine_free(e);
}
END_TEST

START_TEST(a_lone_sphere_comes_round_and_is_counted) {
    const double R = radius, x[3] = {1.7 * R, 9.1 * R, 3.3 * R}, v[3] = {0.91, -0.33, 0.57};
    double place[3];
    int64_t image[3];
    struct engine *e = make(1, box, BOUNDARY_PERIODIC, 0.7, x, v);
    run_to(e, 3.7);
    engine_snapshot(e, place, NULL, image);
    for (int a = 0; a < 3; a++)
        ck_assert_double_eq_tol(place[a] + (double)image[a] * box[a] * R, x[a] + 3.7 * v[a],
                                1e-9 * R);
    ck_assert_int_gt(image[0], 300);
    ck_assert_int_lt(image[1], -100);
    engine_free(e);
}
END_TEST

START_TEST(a_kick_changes_its_sphere_only) {
    const double R = radius, x[6] = {5 * R, 6 * R, 7 * R, 9.1 * R, 7.3 * R, 8.2 * R};
    const double v[6] = {0.031, 0.004, -0.002, -0.0123, -0.006, -0.011};
    const double dv[3] = {-0.05, 0.021, 0.017}, gamma = 7.1, t = 0.013;
    double a[3], u[3], b[3], w[3];
    struct engine *e = make(2, box, BOUNDARY_PERIODIC, 1, x, v);
    drag(e, gamma);
    run_to(e, t);
    engine_kick(e, 0, dv);
    engine_place(e, 0, a, u);
    engine_place(e, 1, b, w);
    for (int k = 0; k < 3; k++) {
        ck_assert_double_eq_tol(u[k], v[k] * exp(-gamma * t) + dv[k], 1e-16);
        ck_assert_double_eq_tol(w[k], v[3 + k] * exp(-gamma * t), 1e-16);
        ck_assert_double_eq_tol(a[k], x[k] - v[k] * expm1(-gamma * t) / gamma, 1e-14 * R * 100);
    }
    run_to(e, 1); /* kicked off its course: they miss */
    ck_assert_int_eq(engine_tally(e)->collisions, 0);
    ck_assert_int_eq(engine_tally(e)->kicks, 1);
    engine_free(e);
}
END_TEST

/* Three in a row with little restitution, between: the gaps close in ever shorter times. */
START_TEST(a_collapse_is_guarded_or_told) {
    const double R = radius,
                 x[9] = {4 * R, 9 * R, 9 * R, 6.37 * R, 9 * R, 9 * R, 9 * R, 9 * R, 9 * R};
    const double v[9] = {0.05, 0, 0, 0, 0, 0, -0.05, 0, 0};
    struct engine_setup s = {.count = 3,
                             .radius_m = radius,
                             .mass_kg = mass,
                             .box_m = {17 * R, 18 * R, 19 * R},
                             .restitution = 0.07,
                             .contact_time_s = 1e-6,
                             .cutoff_speed_m_s = 1e-6};
    for (int g = GUARD_NONE; g <= GUARD_CUTOFF_SPEED; g++) {
        struct fault fault = FAULT_NONE;
        struct engine *e = NULL;
        s.guard = (enum guard)g;
        unit_ok(engine_create(&e, &s, &fault), &fault);
        unit_ok(engine_set_state(e, x, v, &fault), &fault);
        enum status status = engine_advance(e, 0.1, &fault);
        if (g == GUARD_NONE) {
            ck_assert_int_eq(status, STATUS_NUMERICAL);
            unit_says(&fault, "no headway");
        } else {
            unit_ok(status, &fault);
            ck_assert_int_gt(engine_tally(e)->elastic, 0);
            ck_assert_int_lt(engine_tally(e)->collisions, 1000);
        }
        engine_free(e);
    }
}
END_TEST

static void refused(struct engine_setup s, const char *words) {
    struct fault fault = FAULT_NONE;
    struct engine *e = NULL;
    ck_assert_int_eq(engine_create(&e, &s, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(e);
    unit_says(&fault, words);
}

START_TEST(what_cannot_be_is_refused) {
    struct engine_setup good = {
        .count = 2, .radius_m = 1, .mass_kg = 1, .box_m = {9, 9, 9}, .restitution = 0.7};
    struct engine_setup s = good;
    s.box_m[1] = 4;
    refused(s, "side y");
    s = good;
    s.restitution = NAN;
    refused(s, "restitution");
    s = good;
    s.radius_m = -1;
    refused(s, "radius_m");
    const double R = radius, x[6] = {5 * R, 6 * R, 7 * R, 6.9 * R, 6 * R, 7 * R}, v[6] = {0};
    struct fault fault = FAULT_NONE;
    struct engine *e = NULL;
    good.radius_m = R;
    for (int a = 0; a < 3; a++)
        good.box_m[a] = 12 * R;
    unit_ok(engine_create(&e, &good, &fault), &fault);
    ck_assert_int_eq(engine_set_state(e, x, v, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "spheres 0 and 1 overlap by 0.05");
    engine_free(e);
}
END_TEST

START_TEST(no_sphere_at_all_is_a_system) {
    struct engine *e = make(0, box, BOUNDARY_HARD, 1, NULL, NULL);
    run_to(e, 5);
    ck_assert_double_eq(engine_deepest_overlap(e), 0);
    engine_free(e);
}
END_TEST

int main(void) {
    const TTest *tests[] = {two_spheres_meet_as_the_formula_says,
                            spheres_meet_through_a_periodic_side,
                            drag_ends_a_way_at_v_over_gamma,
                            a_sphere_may_meet_nothing_for_as_long_as_it_likes,
                            a_lone_sphere_comes_round_and_is_counted,
                            a_kick_changes_its_sphere_only,
                            a_collapse_is_guarded_or_told,
                            what_cannot_be_is_refused,
                            no_sphere_at_all_is_a_system,
                            NULL};
    return unit_run("engine", tests);
}
