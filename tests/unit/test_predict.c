/* test_predict.c -- solver/suspension/predict.h: times of contact against planted ones.
 *
 * A contact is planted: at a time tau the pair stands a diameter apart along a unit vector n
 * and approaches; going back by tau gives where it is now. */
#include "solver/suspension/predict.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

enum { MOST = 200 };

struct scene {
    gsl_rng *rng;
    _Alignas(64) struct sphere all[MOST + 1]; /* the last is the one that asks */
    struct contact contact;
    struct candidates near;
    double expected[MOST], tolerance[MOST]; /* (s); < 0: no contact */
    _Alignas(16) double shift[PREDICT_SHIFTS][4];
};

static struct scene *scene_new(double growth) {
    struct scene *s = spheres_memory(sizeof *s);
    ck_assert_ptr_nonnull(s);
    memset(s, 0, sizeof *s);
    s->rng = gsl_rng_alloc(gsl_rng_mt19937);
    s->contact = (struct contact){.now = 3.917, .diameter = 1.37, .growth = growth};
    for (int k = 0; k < PREDICT_SHIFTS; k++)
        for (int a = 0; a < 3; a++)
            s->shift[k][a] = gsl_ran_flat(s->rng, -20, 20);
    struct sphere *me = &s->all[MOST];
    me->t = s->contact.now;
    for (int a = 0; a < 3; a++) {
        me->x[a] = gsl_ran_flat(s->rng, -3, 3);
        me->w[a] = gsl_ran_flat(s->rng, -1, 1);
    }
    return s;
}

static void scene_free(struct scene *s) {
    gsl_rng_free(s->rng);
    free(s);
}

/* Sphere i stands at r from the one that asks now, and moves by v relative to it; its own
 * record is of an earlier time, and short of shift k. */
static void put(struct scene *s, uint32_t i, const double r[3], const double v[3], int k) {
    struct sphere *p = &s->all[i], *me = &s->all[MOST];
    p->t = s->contact.now - gsl_rng_uniform(s->rng);
    for (int a = 0; a < 3; a++) {
        p->w[a] = me->w[a] + v[a];
        p->x[a] =
            me->x[a] + r[a] - (k >= 0 ? s->shift[k][a] : 0) - p->w[a] * (s->contact.now - p->t);
    }
    s->near.label[s->near.count] = i;
    s->near.shift[s->near.count++] = (uint8_t)(k >= 0 ? k : 0);
}

static int any_shift(struct scene *s, bool shifted) {
    return shifted ? (int)gsl_rng_uniform_int(s->rng, PREDICT_SHIFTS) : -1;
}

/* A contact after tau, at an angle to the normal that is not grazing.  Round-off of r^2 is
 * that of places up to 30, over the change of r^2 in a time, 2 D times the normal speed. */
static void plant(struct scene *s, uint32_t i, double tau, bool shifted) {
    double n[3], v[3], r[3], D = s->contact.diameter + s->contact.growth * tau, normal = 0, rr = 0;
    gsl_ran_dir_3d(s->rng, &n[0], &n[1], &n[2]);
    for (int a = 0; a < 3; a++) {
        v[a] = gsl_ran_flat(s->rng, -1, 1);
        normal += n[a] * v[a];
    }
    double speed = s->contact.growth - 0.05 - gsl_rng_uniform(s->rng); /* that of parting */
    for (int a = 0; a < 3; a++) {
        v[a] += (speed - normal) * n[a];
        r[a] = D * n[a] - v[a] * tau;
        rr += r[a] * r[a];
    }
    put(s, i, r, v, any_shift(s, shifted));
    s->expected[i] = tau;
    s->tolerance[i] = 1e-14 * (30 * sqrt(rr) + rr) / (D * (s->contact.growth - speed));
}

static void predict(struct scene *s, bool shifted) {
    const struct sphere *me = &s->all[MOST];
    const double(*shift)[4] = (const double(*)[4])s->shift;
    bool growing = s->contact.growth > 0;
    if (shifted && growing)
        predict_candidates(me, s->all, &s->contact, true, true, shift, &s->near);
    else if (shifted)
        predict_candidates(me, s->all, &s->contact, true, false, shift, &s->near);
    else if (growing)
        predict_candidates(me, s->all, &s->contact, false, true, shift, &s->near);
    else
        predict_candidates(me, s->all, &s->contact, false, false, shift, &s->near);
}

/* Those with a time touch then, in the order they were asked for; the others do not. */
static void expect(struct scene *s, uint32_t count, bool shifted) {
    uint32_t n = 0;
    predict(s, shifted);
    ck_assert_uint_eq(s->near.count, 0);
    for (uint32_t i = 0; i < count; i++)
        if (s->expected[i] >= 0) {
            ck_assert_uint_lt(n, s->near.hits);
            ck_assert_uint_eq(s->near.hit[n], i);
            ck_assert_double_eq_tol(s->near.tau[n++], s->expected[i], s->tolerance[i]);
        }
    /* An odd last one is looked at twice, and may be given twice. */
    ck_assert_uint_le(s->near.hits, n + count % 2);
    for (; n < s->near.hits; n++)
        ck_assert(s->near.hit[n] == count - 1 && s->expected[count - 1] >= 0);
}

static double some_time(struct scene *s) {
    return pow(10, gsl_ran_flat(s->rng, -6, 1));
}

static void expect_planted(double growth) {
    for (int shifted = 0; shifted < 2; shifted++) {
        struct scene *s = scene_new(growth);
        for (uint32_t count = 0; count <= MOST; count++) {
            for (uint32_t i = 0; i < count; i++)
                plant(s, i, some_time(s), shifted);
            expect(s, count, shifted);
        }
        scene_free(s);
    }
}

START_TEST(planted_contacts_are_found_when_they_are) {
    expect_planted(0);
}
END_TEST

START_TEST(planted_contacts_of_growing_spheres_are_found_when_they_are) {
    expect_planted(0.0371);
    expect_planted(0.93);
}
END_TEST

/* By 1e-9 of the diameter: the root's square differs by 2e-9 v^2 D^2, its round-off is that
 * of places, 1e-14. */
START_TEST(a_pair_that_grazes_is_told_from_one_that_passes) {
    struct scene *s = scene_new(0);
    for (int round = 0; round < 200; round++) {
        for (uint32_t i = 0; i < MOST; i++) {
            double n[3], v[3], r[3], way = 0, speed = 0, ahead = gsl_ran_flat(s->rng, 0.01, 3);
            bool touches = gsl_rng_uniform_int(s->rng, 2) == 0;
            double off = s->contact.diameter * (touches ? 1 - 1e-9 : 1 + 1e-9);
            gsl_ran_dir_3d(s->rng, &n[0], &n[1], &n[2]);
            gsl_ran_dir_3d(s->rng, &v[0], &v[1], &v[2]);
            for (int a = 0; a < 3; a++)
                way += n[a] * v[a];
            for (int a = 0; a < 3; a++) {
                v[a] -= way * n[a]; /* across the normal */
                speed += v[a] * v[a];
            }
            for (int a = 0; a < 3; a++)
                r[a] = off * n[a] - v[a] * ahead;
            put(s, i, r, v, -1);
            /* Half a chord of sqrt(2e-9) D before the nearest place, known to 1e-5 of it. */
            double chord = s->contact.diameter * sqrt(2e-9 / speed);
            s->expected[i] = touches ? ahead - chord : -1;
            s->tolerance[i] = 1e-3 * chord;
        }
        expect(s, MOST, false);
    }
    scene_free(s);
}
END_TEST

/* Receding, at rest, or beside: nothing, and nothing now for one that overlaps and recedes. */
START_TEST(what_recedes_or_stands_does_not_touch) {
    struct scene *s = scene_new(0);
    for (uint32_t count = 1; count <= MOST; count++) {
        for (uint32_t i = 0; i < count; i++) {
            double n[3], v[3], r[3], parting = gsl_ran_flat(s->rng, 0.01, 2);
            double apart = s->contact.diameter * (i % 3 == 0   ? 1 - 1e-12
                                                  : i % 3 == 1 ? 1 + 1e-12
                                                               : gsl_ran_flat(s->rng, 1, 5));
            gsl_ran_dir_3d(s->rng, &n[0], &n[1], &n[2]);
            for (int a = 0; a < 3; a++) {
                v[a] = i % 7 == 0 ? 0 : parting * n[a];
                r[a] = apart * n[a];
            }
            put(s, i, r, v, -1);
            /* At rest to the bit. */
            for (int a = 0; a < 3 && i % 7 == 0; a++)
                s->all[i].w[a] = s->all[MOST].w[a];
            s->expected[i] = -1;
        }
        expect(s, count, false);
    }
    scene_free(s);
}
END_TEST

/* Deeper than round-off of places, 1e-14, and approaching: now, exactly; also while growing. */
START_TEST(a_pair_that_overlaps_by_round_off_and_approaches_touches_now) {
    for (int growing = 0; growing < 2; growing++) {
        struct scene *s = scene_new(growing ? 0.0371 : 0);
        for (uint32_t count = 1; count <= MOST; count++) {
            for (uint32_t i = 0; i < count; i++) {
                double n[3], v[3], r[3], depth = pow(10, gsl_ran_flat(s->rng, -13, -10));
                double speed = -gsl_ran_flat(s->rng, 1e-3, 2);
                gsl_ran_dir_3d(s->rng, &n[0], &n[1], &n[2]);
                for (int a = 0; a < 3; a++) {
                    v[a] = speed * n[a];
                    r[a] = s->contact.diameter * (1 - depth) * n[a];
                }
                put(s, i, r, v, -1);
                s->expected[i] = 0;
                s->tolerance[i] = 0x1p-1022; /* the check is for less than this */
            }
            expect(s, count, false);
        }
        scene_free(s);
    }
}
END_TEST

/* Surfaces that grow faster than anything moves meet also those that recede; slower ones
 * never catch up with a sphere that flees along the line. */
START_TEST(growing_surfaces_catch_up_with_the_slower_only) {
    struct scene *s = scene_new(0.61);
    for (int round = 0; round < 50; round++) {
        for (uint32_t i = 0; i < MOST; i++) {
            double n[3], v[3], r[3], gap = gsl_ran_flat(s->rng, 1e-4, 4);
            double flight = gsl_ran_flat(s->rng, 0, 0.56) + (i % 2 == 0 ? 0 : 0.66);
            gsl_ran_dir_3d(s->rng, &n[0], &n[1], &n[2]);
            for (int a = 0; a < 3; a++) {
                v[a] = flight * n[a];
                r[a] = (s->contact.diameter + gap) * n[a];
            }
            put(s, i, r, v, -1);
            s->expected[i] = i % 2 == 0 ? gap / (0.61 - flight) : -1;
            s->tolerance[i] = 1e-12 * (1 + s->expected[i]) / (0.61 - flight);
        }
        expect(s, MOST, false);
    }
    scene_free(s);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {planted_contacts_are_found_when_they_are,
                                  planted_contacts_of_growing_spheres_are_found_when_they_are,
                                  a_pair_that_grazes_is_told_from_one_that_passes,
                                  what_recedes_or_stands_does_not_touch,
                                  a_pair_that_overlaps_by_round_off_and_approaches_touches_now,
                                  growing_surfaces_catch_up_with_the_slower_only,
                                  NULL};
    return unit_run("predict", tests);
}
