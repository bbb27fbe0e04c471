/* test_contacts.c -- solver/graingas/contacts.h: the collision rule, and that skipping
 * work changes no bit of what plain sweeps over all pairs give. */
#include "solver/graingas/contacts.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_rng.h>
#include <math.h>

static struct grains make(size_t count) {
    struct fault fault = FAULT_NONE;
    struct grains g;
    unit_ok(grains_create(&g, count, &fault), &fault);
    return g;
}

/* Two discs of unequal mass that overlap a little along a slanted normal. */
static struct grains make_pair(void) {
    struct grains g = make(2);
    g.x[0] = 2.1;
    g.y[0] = 1.3;
    g.radius[0] = 0.23;
    g.radius[1] = 0.17;
    g.x[1] = g.x[0] + 0.398 * cos(0.61);
    g.y[1] = g.y[0] + 0.398 * sin(0.61);
    g.vx[0] = 0.37;
    g.vy[0] = -0.21;
    g.vx[1] = -0.53;
    g.vy[1] = -0.44;
    grains_weigh(&g);
    return g;
}

static struct contacts resolve(struct grains *g, const struct contact_rule *rule) {
    struct fault fault = FAULT_NONE;
    struct contacts c;
    unit_ok(contacts_create(&c, g->count, 9, 13, 0.5, &fault), &fault);
    unit_ok(contacts_find(&c, g, rule, &fault), &fault);
    unit_ok(contacts_resolve(&c, g, rule, &fault), &fault);
    return c;
}

static double normal_speed(const struct grains *g) {
    double dx = g->x[1] - g->x[0], dy = g->y[1] - g->y[0], d = hypot(dx, dy);
    return ((g->vx[1] - g->vx[0]) * dx + (g->vy[1] - g->vy[0]) * dy) / d;
}

START_TEST(a_fresh_pair_loses_by_restitution_and_keeps_momentum) {
    struct grains g = make_pair();
    double before = normal_speed(&g);
    double px = g.area[0] * g.vx[0] + g.area[1] * g.vx[1];
    double tangential = (g.vx[1] - g.vx[0]) * -sin(0.61) + (g.vy[1] - g.vy[0]) * cos(0.61);
    struct contacts c = resolve(&g, &(struct contact_rule){0.83, 0, 7});
    ck_assert_double_eq_tol(normal_speed(&g), -0.83 * before, 1e-15);
    ck_assert_double_eq_tol(g.area[0] * g.vx[0] + g.area[1] * g.vx[1], px, 1e-16);
    ck_assert_double_eq_tol((g.vx[1] - g.vx[0]) * -sin(0.61) + (g.vy[1] - g.vy[0]) * cos(0.61),
                            tangential, 1e-15);
    ck_assert_int_eq(c.tally.collisions, 1);
    ck_assert_int_eq(c.tally.elastic, 0);
    contacts_free(&c);
    grains_free(&g);
}
END_TEST

START_TEST(a_grain_hit_now_or_just_before_collides_elastically) {
    for (int ago = 0; ago <= 2; ago++) {
        struct grains g = make_pair();
        double before = normal_speed(&g);
        g.last_hit[1] = 40 - ago;
        struct contacts c = resolve(&g, &(struct contact_rule){0.83, 0, 40});
        ck_assert_double_eq_tol(normal_speed(&g), -(ago <= 1 ? 1 : 0.83) * before, 1e-15);
        contacts_free(&c);
        grains_free(&g);
    }
}
END_TEST

START_TEST(separating_and_resting_pairs_are_left_alone) {
    struct grains g = make_pair();
    struct contacts c = resolve(&g, &(struct contact_rule){0.83, 1e3, 7});
    ck_assert_int_eq(c.tally.collisions, 0);
    contacts_free(&c);
    for (int i = 0; i < 2; i++)
        g.vx[i] = -g.vx[i], g.vy[i] = -g.vy[i];
    c = resolve(&g, &(struct contact_rule){0.83, 0, 8});
    ck_assert_int_eq(c.tally.collisions, 0);
    contacts_free(&c);
    grains_free(&g);
}
END_TEST

START_TEST(the_threshold_fades_with_overlap) {
    struct grains g = make_pair(); /* 0.002 of overlap; rest ends at 0.02 */
    double approach = -normal_speed(&g);
    struct contacts c = resolve(&g, &(struct contact_rule){1, approach / 0.9 * 1.01, 7});
    ck_assert_int_eq(c.tally.collisions, 0); /* just below the faded threshold ... */
    contacts_free(&c);
    c = resolve(&g, &(struct contact_rule){1, approach / 0.9 * 0.99, 7});
    ck_assert_int_eq(c.tally.collisions, 1); /* ... and above */
    contacts_free(&c);
    grains_free(&g);
}
END_TEST

START_TEST(each_wall_reflects_and_takes_the_impulse) {
    const double place[4][2] = {{0.19, 6}, {9 - 0.19, 6}, {4, 0.19}, {4, 13 - 0.19}};
    const double normal[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (int wall = 0; wall < WALL_COUNT; wall++) {
        struct grains g = make(1);
        g.x[0] = place[wall][0];
        g.y[0] = place[wall][1];
        g.radius[0] = 0.2;
        g.vx[0] = -0.3 * normal[wall][0] + 0.07 * normal[wall][1];
        g.vy[0] = -0.3 * normal[wall][1] + 0.07 * normal[wall][0];
        grains_weigh(&g);
        struct contacts c = resolve(&g, &(struct contact_rule){0.7, 0, 3});
        ck_assert_double_eq_tol(g.vx[0] * normal[wall][0] + g.vy[0] * normal[wall][1], 0.21, 1e-15);
        ck_assert_double_eq_tol(c.tally.wall_impulse[wall], 0.51 * g.area[0], 1e-15);
        contacts_free(&c);
        grains_free(&g);
    }
}
END_TEST

/* Below the floor's own speed a grain leaves with half of what gravity adds. */
START_TEST(the_floor_carries_a_grain_at_rest) {
    struct grains g = make(1);
    g.x[0] = 4;
    g.y[0] = 0.1999;
    g.radius[0] = 0.2;
    g.vy[0] = -0.0004;
    grains_weigh(&g);
    struct contacts c = resolve(&g, &(struct contact_rule){0.8, 0.0125, 3});
    ck_assert_double_eq_tol(g.vy[0], 0.00625, 1e-15);
    contacts_free(&c);
    grains_free(&g);
}
END_TEST

/* -- against the plain algorithm ---------------------------------------------- */

/* A crowd in a small box, fast enough to need many sweeps. */
static struct grains make_crowd(unsigned long seed) {
    struct grains g = make(600);
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, seed);
    for (size_t i = 0; i < g.count; i++) {
        g.radius[i] = 0.17 + 0.08 * gsl_rng_uniform(rng);
        g.x[i] = 0.1 + 8.8 * gsl_rng_uniform(rng);
        g.y[i] = 0.1 + 12.8 * gsl_rng_uniform(rng);
        g.vx[i] = gsl_rng_uniform(rng) - 0.5;
        g.vy[i] = gsl_rng_uniform(rng) - 0.5;
    }
    grains_weigh(&g);
    gsl_rng_free(rng);
    return g;
}

static bool plain_collide(const struct contact *k, struct grains *g,
                          const struct contact_rule *rule) {
    double speed = -((g->vx[k->i] - g->vx[k->j]) * k->nx + (g->vy[k->i] - g->vy[k->j]) * k->ny);
    if (!(speed > k->rest))
        return false;
    bool elastic =
        g->last_hit[k->i] >= rule->step - 1 || (k->wall < 0 && g->last_hit[k->j] >= rule->step - 1);
    double leaving = fmax((elastic ? 1 : rule->restitution) * speed, k->support);
    double wi = g->inverse_mass[k->i], wj = g->inverse_mass[k->j];
    double impulse = (speed + leaving) * k->reduced_mass;
    g->vx[k->i] += impulse * wi * k->nx;
    g->vy[k->i] += impulse * wi * k->ny;
    g->vx[k->j] -= impulse * wj * k->nx;
    g->vy[k->j] -= impulse * wj * k->ny;
    g->last_hit[k->i] = g->last_hit[k->j] = rule->step;
    return true;
}

/* Every contact, up and down in turn, until a whole sweep finds none. */
static int plain_sweeps(const struct contacts *c, struct grains *g,
                        const struct contact_rule *rule) {
    bool any = true;
    int sweeps = 0;
    for (; any; sweeps++) {
        any = false;
        for (size_t n = 0; n < c->count; n++)
            any |= plain_collide(&c->contact[sweeps % 2 ? c->count - 1 - n : n], g, rule);
    }
    return sweeps;
}

START_TEST(skipping_work_changes_no_bit) {
    for (unsigned long seed = 1; seed <= 5; seed++) {
        const struct contact_rule rule = {0.8, 1.37e-3, 12};
        struct grains g = make_crowd(seed), before = make_crowd(seed);
        struct contacts c = resolve(&g, &rule);
        ck_assert_int_gt(c.tally.last_sweeps, 6);
        struct grains fresh = make_crowd(seed);
        for (size_t i = 0; i < g.count; i++) { /* the crowd was reordered: follow the ids */
            before.vx[i] = fresh.vx[g.id[i]];
            before.vy[i] = fresh.vy[g.id[i]];
            before.area[i] = g.area[i];
            before.inverse_mass[i] = g.inverse_mass[i];
        }
        ck_assert_int_eq(plain_sweeps(&c, &before, &rule), c.tally.last_sweeps);
        for (size_t i = 0; i < g.count; i++) {
            ck_assert_double_eq(g.vx[i], before.vx[i]);
            ck_assert_double_eq(g.vy[i], before.vy[i]);
        }
        contacts_free(&c);
        grains_free(&g);
        grains_free(&before);
        grains_free(&fresh);
    }
}
END_TEST

START_TEST(every_overlapping_pair_is_a_contact) {
    struct grains g = make_crowd(77);
    size_t expected = 0;
    for (size_t i = 0; i < g.count; i++) {
        for (size_t j = 0; j < i; j++)
            expected += hypot(g.x[i] - g.x[j], g.y[i] - g.y[j]) < g.radius[i] + g.radius[j];
        expected += (size_t)((g.x[i] < g.radius[i]) + (9 - g.x[i] < g.radius[i]));
        expected += (size_t)((g.y[i] < g.radius[i]) + (13 - g.y[i] < g.radius[i]));
    }
    struct contacts c = resolve(&g, &(struct contact_rule){0.8, 1e-3, 12});
    ck_assert_uint_eq(c.count, expected);
    contacts_free(&c);
    grains_free(&g);
}
END_TEST

START_TEST(nothing_approaches_afterwards_and_energy_is_accounted_for) {
    struct grains g = make_crowd(78);
    double before = grains_kinetic_energy(&g);
    struct contacts c = resolve(&g, &(struct contact_rule){0.8, 0, 12});
    for (size_t n = 0; n < c.count; n++) {
        const struct contact *k = &c.contact[n];
        double speed = -((g.vx[k->i] - g.vx[k->j]) * k->nx + (g.vy[k->i] - g.vy[k->j]) * k->ny);
        ck_assert_double_le(speed, 0);
    }
    ck_assert_double_eq_tol(before - grains_kinetic_energy(&g), c.tally.dissipated, 1e-12 * before);
    ck_assert_double_gt(c.tally.dissipated, 0.01 * before);
    contacts_free(&c);
    grains_free(&g);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_fresh_pair_loses_by_restitution_and_keeps_momentum,
                                  a_grain_hit_now_or_just_before_collides_elastically,
                                  separating_and_resting_pairs_are_left_alone,
                                  the_threshold_fades_with_overlap,
                                  each_wall_reflects_and_takes_the_impulse,
                                  the_floor_carries_a_grain_at_rest,
                                  skipping_work_changes_no_bit,
                                  every_overlapping_pair_is_a_contact,
                                  nothing_approaches_afterwards_and_energy_is_accounted_for,
                                  NULL};
    return unit_run("contacts", tests);
}
