/* test_sleep.c -- solver/graingas/sleep.h: what falls asleep, what wakes it, and that a
 * sleeper is ground to the others. */
#include "tests/unit/graingas_fixture.h"

#include <math.h>

/* Four discs from wall to wall on the floor and one in the dent between the first two. */
static const char pile[] = "grains: 5\nwidth_l: 2\nheight_l: 7\ngas: none\ndt_tau: 0.013\n"
                           "start: list\n"
                           "grain_x: [0.25, 0.75, 1.2475, 1.745, 0.5]\n"
                           "grain_y: [0.25, 0.25, 0.2475, 0.25, 0.66]\n"
                           "grain_diameter: [0.5, 0.5, 0.495, 0.5, 0.45]\n"
                           "grain_velocity_x: [0, 0, 0, 0, 0]\ngrain_velocity_y: [0, 0, 0, 0, 0]\n";

static size_t index_of(const struct graingas *s, int32_t id) {
    size_t i = 0;
    while (s->grains.id[i] != id)
        i++;
    return i;
}

START_TEST(a_quiet_pile_falls_asleep_and_stays_where_it_is) {
    struct graingas *s = fixture_state(pile, 1);
    fixture_steps(s, 70); /* .91 tau */
    ck_assert_uint_eq(s->sleep.sleeping, 0);
    fixture_steps(s, 400);
    ck_assert_uint_eq(s->sleep.sleeping, 5);
    double y = s->grains.y[index_of(s, 4)];
    ck_assert_double_gt(y, 0.6);
    fixture_steps(s, 100);
    ck_assert_double_eq(s->grains.y[index_of(s, 4)], y);
    ck_assert_double_eq(grains_kinetic_energy(&s->grains), 0);
    graingas_model.free(s);
}
END_TEST

START_TEST(sleepers_still_tell_their_overlap) {
    struct graingas *s = fixture_state(pile, 1);
    fixture_steps(s, 600);
    const struct grains *g = &s->grains;
    double deepest = 0;
    for (size_t i = 0; i < g->count; i++) {
        deepest = fmax(deepest, g->radius[i] - g->y[i]);
        for (size_t j = 0; j < i; j++)
            deepest = fmax(deepest, g->radius[i] + g->radius[j] -
                                        hypot(g->x[i] - g->x[j], g->y[i] - g->y[j]));
    }
    ck_assert_double_gt(deepest, 1e-6);
    ck_assert_double_eq_tol(s->contacts.tally.largest_overlap, deepest, 1e-15);
    graingas_model.free(s);
}
END_TEST

START_TEST(nothing_sleeps_without_gravity_or_when_turned_off) {
    static const char *const off[] = {"gravity: 0\n", "sleep_displacement_l: 0\n"};
    for (int k = 0; k < 2; k++) {
        char text[1000];
        snprintf(text, sizeof text, "%s%s", pile, off[k]);
        struct graingas *s = fixture_state(text, 1);
        fixture_steps(s, 500);
        ck_assert_uint_eq(s->sleep.sleeping, 0);
        graingas_model.free(s);
    }
}
END_TEST

START_TEST(a_falling_grain_never_sleeps) {
    struct graingas *s = fixture_state("grains: 1\nwidth_l: 3\nheight_l: 90\ngas: none\n"
                                       "start: list\ngrain_x: [1.3]\ngrain_y: [88.7]\n"
                                       "grain_diameter: [0.41]\ngrain_velocity_x: [0]\n"
                                       "grain_velocity_y: [0]\n",
                                       1);
    for (int n = 0; n < 900; n++) {
        fixture_steps(s, 1);
        ck_assert_uint_eq(s->sleep.sleeping, 0);
    }
    graingas_model.free(s);
}
END_TEST

/* Grain 4 is lifted off its place and let go. */
static void lift(struct graingas *s, double by) {
    size_t i = index_of(s, 4);
    s->sleep.anchor[8] = s->grains.x[i];
    s->sleep.anchor[9] = s->grains.y[i];
    s->grains.y[i] += by;
    s->grains.inverse_mass[i] = 1 / s->grains.area[i];
    s->sleep.quiet[4] = 0;
    s->sleep.asleep[4] = false;
    s->sleep.sleeping--;
}

START_TEST(a_hard_hit_wakes_and_a_soft_one_does_not) {
    for (int k = 0; k < 2; k++) {
        struct graingas *s = fixture_state(pile, 1);
        fixture_steps(s, 600);
        lift(s, k ? 2.1 : 0.003); /* arrives at 2 and at .08 U0 */
        bool woken = false;
        for (int n = 0; n < 260; n++) {
            fixture_steps(s, 1);
            woken |= !s->sleep.asleep[0] || !s->sleep.asleep[1];
        }
        ck_assert_int_eq(woken, k);
        fixture_steps(s, 900);
        ck_assert_uint_eq(s->sleep.sleeping, 5);
        graingas_model.free(s);
    }
}
END_TEST

START_TEST(a_neighbour_that_leaves_its_place_wakes) {
    struct graingas *s = fixture_state(pile, 1);
    fixture_steps(s, 600);
    lift(s, 0.006); /* not far enough */
    fixture_steps(s, 4);
    ck_assert(s->sleep.asleep[0] && s->sleep.asleep[1]);
    s->grains.y[index_of(s, 4)] += 0.018;
    fixture_steps(s, 4); /* one of them looks */
    ck_assert(!s->sleep.asleep[0] && !s->sleep.asleep[1]);
    ck_assert(s->sleep.asleep[3]);
    graingas_model.free(s);
}
END_TEST

/* Under lift of 97 % of the weight sleepers wake, under 80 % they do not. */
START_TEST(lift_that_takes_the_weight_off_wakes) {
    for (int k = 0; k < 2; k++) {
        struct graingas *s = fixture_state(pile, 1);
        struct sleep_rule rule = {.displacement = 0.01, .after = 1, .fall = 1, .elapsed = 0.013};
        fixture_steps(s, 600);
        for (int n = 0; n < 90; n++) {
            double ax[5] = {0}, ay[5];
            for (int i = 0; i < 5; i++)
                ay[i] = k ? 0.97 : 0.80;
            sleep_hold(&s->sleep, &s->grains, &rule, ax, ay);
            for (int i = 0; i < 5 && !k; i++)
                ck_assert_double_eq(ay[i], 1); /* held: the net force is zero */
        }
        ck_assert_uint_eq(s->sleep.sleeping, k ? 0 : 5);
        graingas_model.free(s);
    }
}
END_TEST

START_TEST(hits_from_below_that_carry_a_sleeper_wake_it) {
    struct graingas *s = fixture_state(pile, 1);
    struct sleep_rule rule = {.displacement = 0.01, .after = 1, .fall = 1, .elapsed = 0.013};
    fixture_steps(s, 600);
    size_t i = index_of(s, 4);
    for (int n = 0; n < 90; n++) {
        double ax[5] = {0}, ay[5] = {0};
        s->sleep.hits[4] = 0.98 * s->grains.area[i] * rule.elapsed;
        sleep_hold(&s->sleep, &s->grains, &rule, ax, ay);
    }
    ck_assert(!s->sleep.asleep[4]);
    ck_assert(s->sleep.asleep[0]);
    graingas_model.free(s);
}
END_TEST

/* A grain caged by sleepers that overlap it on all sides would bounce for ever. */
START_TEST(a_cage_of_sleepers_opens) {
    struct fault fault = FAULT_NONE;
    struct grains g;
    struct contacts c;
    unit_ok(grains_create(&g, 4, &fault), &fault);
    for (int k = 0; k < 4; k++) {
        double angle = 0.3 + 2 * M_PI / 3 * k;
        g.radius[k] = 0.21 + 0.007 * k;
        g.x[k] = k < 3 ? 2.5 + 0.41 * cos(angle) : 2.5;
        g.y[k] = k < 3 ? 2.6 + 0.41 * sin(angle) : 2.6;
    }
    g.vx[3] = 0.31;
    g.vy[3] = -0.17;
    grains_weigh(&g);
    for (int k = 0; k < 3; k++)
        g.inverse_mass[k] = 0;
    unit_ok(contacts_create(&c, 4, 5, 6, 0.5, &fault), &fault);
    struct contact_rule rule = {.restitution = 1, .threshold = 0, .step = 5};
    unit_ok(contacts_find(&c, &g, &rule, &fault), &fault);
    ck_assert_uint_eq(c.count, 3);
    unit_ok(contacts_resolve(&c, &g, &rule, &fault), &fault);
    size_t freed = 0;
    for (int k = 0; k < 3; k++)
        freed += g.inverse_mass[k] > 0;
    ck_assert_uint_gt(freed, 0);
    contacts_free(&c);
    grains_free(&g);
}
END_TEST

START_TEST(a_checkpoint_keeps_sleep) {
    struct fault fault = FAULT_NONE;
    struct graingas *s = fixture_state(pile, 1), *t = fixture_state(pile, 1);
    const char *folder = unit_folder();
    const char *path = unit_path(folder, "state.h5");
    fixture_steps(s, 120); /* some sleep, some do not yet */
    unit_ok(graingas_model.save(s, path, &fault), &fault);
    unit_ok(graingas_model.load(t, path, &fault), &fault);
    ck_assert_uint_eq(s->sleep.sleeping, t->sleep.sleeping);
    fixture_steps(s, 300);
    fixture_steps(t, 300);
    for (size_t i = 0; i < 5; i++) {
        ck_assert_double_eq(s->grains.y[i], t->grains.y[i]);
        ck_assert_double_eq(s->grains.vx[i], t->grains.vx[i]);
        ck_assert_double_eq(s->grains.inverse_mass[i], t->grains.inverse_mass[i]);
    }
    unit_remove(folder);
    graingas_model.free(s);
    graingas_model.free(t);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_quiet_pile_falls_asleep_and_stays_where_it_is,
                                  sleepers_still_tell_their_overlap,
                                  nothing_sleeps_without_gravity_or_when_turned_off,
                                  a_falling_grain_never_sleeps,
                                  a_hard_hit_wakes_and_a_soft_one_does_not,
                                  a_neighbour_that_leaves_its_place_wakes,
                                  lift_that_takes_the_weight_off_wakes,
                                  hits_from_below_that_carry_a_sleeper_wake_it,
                                  a_cage_of_sleepers_opens,
                                  a_checkpoint_keeps_sleep,
                                  NULL};
    return unit_run("sleep", tests);
}
