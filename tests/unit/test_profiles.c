/* test_profiles.c -- solver/suspension/profiles.h: slabs against a count slab by slab, planted
 * temperatures, and slabs that are empty or hold one sphere. */
#include "solver/suspension/profiles.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>

enum { COUNT = 4000 };

struct bed {
    struct suspension_parameters p;
    struct profiles f;
    double position[3 * COUNT], velocity[3 * COUNT];
    gsl_rng *rng;
};

static struct bed *bed_new(size_t particles, double profile_bin) {
    struct fault fault = FAULT_NONE;
    struct bed *b = calloc(1, sizeof *b);
    ck_assert_ptr_nonnull(b);
    b->p = (struct suspension_parameters){.particles = particles,
                                          .radius = 0.0317,
                                          .mass = 1.73,
                                          .box = {2.1, 3.3, 7.9},
                                          .profile_bin = profile_bin};
    unit_ok(profiles_create(&b->f, &b->p, &fault), &fault);
    b->rng = gsl_rng_alloc(gsl_rng_mt19937);
    return b;
}

static void bed_free(struct bed *b) {
    profiles_free(&b->f);
    gsl_rng_free(b->rng);
    free(b);
}

/* Heights denser below; velocities about a wind that grows with height. */
static void scatter(struct bed *b) {
    for (size_t i = 0; i < b->p.particles; i++) {
        double u = gsl_rng_uniform(b->rng), *x = b->position + 3 * i, *v = b->velocity + 3 * i;
        x[0] = gsl_ran_flat(b->rng, 0, 2.1);
        x[1] = gsl_ran_flat(b->rng, 0, 3.3);
        x[2] = 7.9 * u * u;
        for (int a = 0; a < 3; a++)
            v[a] = 3 * x[2] * (a - 0.7) + gsl_ran_gaussian(b->rng, 0.3 + 0.2 * a);
    }
    profiles_make(&b->f, &b->p, b->position, b->velocity);
}

/* Variances by all pairs: sum over i < j of (v_i - v_j)^2 is n times the sum about the mean. */
static void expect_slab(const struct bed *b, size_t k, double freedoms[3]) {
    const double w = 7.9 / (double)b->f.bins;
    double n = 0, pairs[3] = {0};
    for (size_t i = 0; i < b->p.particles; i++) {
        if (floor(b->position[3 * i + 2] / w) != (double)k)
            continue;
        n++;
        for (size_t j = 0; j < i; j++)
            for (size_t a = 0; a < 3 && floor(b->position[3 * j + 2] / w) == (double)k; a++)
                pairs[a] += pow(b->velocity[3 * i + a] - b->velocity[3 * j + a], 2);
    }
    double volume = 4 * M_PI / 3 * pow(0.0317, 3), one = fmax(1, n * (n - 1));
    double xy = 1.73 * (pairs[0] + pairs[1]) / 2 / one, zz = 1.73 * pairs[2] / one;
    ck_assert_double_eq_tol(b->f.packing[k], n * volume / (2.1 * 3.3 * w), 1e-13);
    ck_assert_double_eq_tol(b->f.xy[k], xy, 1e-11 * (1 + xy));
    ck_assert_double_eq_tol(b->f.zz[k], zz, 1e-11 * (1 + zz));
    freedoms[0] += fmax(0, n - 1);
    freedoms[1] += xy * fmax(0, n - 1);
    freedoms[2] += zz * fmax(0, n - 1);
}

/* From slabs of hundreds to slabs with one or none. */
START_TEST(every_slab_is_that_of_a_count_of_its_own) {
    const double bin[] = {7.9, 0.83, 0.113};
    for (int n = 0; n < 3; n++) {
        struct bed *b = bed_new(300, bin[n]);
        double whole[3] = {0};
        ck_assert_double_eq((double)b->f.bins, round(7.9 / bin[n]));
        for (int twice = 0; twice < 2; twice++) { /* nothing is left of the first */
            whole[0] = whole[1] = whole[2] = 0;
            scatter(b);
            for (size_t k = 0; k < b->f.bins; k++)
                expect_slab(b, k, whole);
        }
        ck_assert_double_eq_tol(b->f.whole_xy, whole[1] / whole[0], 1e-11 * b->f.whole_xy);
        ck_assert_double_eq_tol(b->f.whole_zz, whole[2] / whole[0], 1e-11 * b->f.whole_zz);
        bed_free(b);
    }
}
END_TEST

/* phi(z) integrates to the spheres' volume, also with centres on the lid and below the floor by
 * round-off. */
START_TEST(no_sphere_is_lost_or_counted_twice) {
    struct bed *b = bed_new(COUNT, 0.31);
    double sum = 0;
    scatter(b);
    b->position[2] = 7.9;
    b->position[5] = nextafter(7.9, 9);
    b->position[8] = -1e-17;
    b->position[11] = 0;
    profiles_make(&b->f, &b->p, b->position, b->velocity);
    for (size_t k = 0; k < b->f.bins; k++)
        sum += b->f.packing[k] * 2.1 * 3.3 * 7.9 / (double)b->f.bins;
    ck_assert_double_eq_tol(sum / suspension_parameters_volume(&b->p), COUNT, 1e-9);
    bed_free(b);
}
END_TEST

/* Each slab moves at its own, large, random velocity: a sample's variance about its own mean,
 * over n - 1, has no bias.  6 slabs, 4000 spheres, 10 draws: xy has 80000 freedoms and scatters by
 * sqrt(2/80000), zz by sqrt(2/40000) = .7 %; bounds of four. */
START_TEST(planted_temperatures_are_found_whatever_the_slabs_do) {
    struct bed *b = bed_new(COUNT, 7.9 / 6);
    double xy = 0, zz = 0, thin = 0;
    for (int draw = 0; draw < 10; draw++) {
        double wind[6][3];
        for (int k = 0; k < 18; k++)
            wind[k / 3][k % 3] = gsl_ran_flat(b->rng, -50, 50);
        for (size_t k = 0; k < 3 * COUNT; k++) {
            size_t slab = k / 3 % 6;
            b->position[k] = 7.9 / 6 * ((double)slab + gsl_rng_uniform(b->rng));
            b->velocity[k] = wind[slab][k % 3] + gsl_ran_gaussian(b->rng, k % 3 == 2 ? 0.37 : 0.91);
        }
        profiles_make(&b->f, &b->p, b->position, b->velocity);
        xy += b->f.whole_xy / 10;
        zz += b->f.whole_zz / 10;
    }
    ck_assert_double_eq_tol(xy, 1.73 * 0.91 * 0.91, 0.02 * xy);
    ck_assert_double_eq_tol(zz, 1.73 * 0.37 * 0.37, 0.028 * zz);
    /* Slabs of two or three: n in place of n - 1 would be off by a half.  3000 draws of 6
     * slabs: sqrt(2/24000) = .9 %. */
    b->p.particles = 14;
    for (int draw = 0; draw < 3000; draw++) {
        for (size_t k = 0; k < 3 * 14; k++) {
            b->position[k] = 7.9 / 6 * ((double)(k / 3 % 6) + 0.5);
            b->velocity[k] = gsl_ran_gaussian(b->rng, 1);
        }
        profiles_make(&b->f, &b->p, b->position, b->velocity);
        thin += b->f.whole_zz / 3000;
    }
    ck_assert_double_eq_tol(thin, 1.73, 0.04 * thin);
    bed_free(b);
}
END_TEST

START_TEST(slabs_without_two_spheres_have_no_temperature) {
    struct bed *b = bed_new(2, 0.79);
    b->position[2] = 1;
    b->position[5] = 7;
    b->velocity[2] = 31;
    b->velocity[3] = -17;
    profiles_make(&b->f, &b->p, b->position, b->velocity);
    for (size_t k = 0; k < b->f.bins; k++) {
        ck_assert_double_eq(b->f.xy[k], 0);
        ck_assert_double_eq(b->f.zz[k], 0);
        ck_assert_int_eq(b->f.packing[k] > 0, k == 1 || k == 8);
    }
    ck_assert_double_eq(b->f.whole_xy, 0);
    ck_assert_double_eq(b->f.whole_zz, 0);
    bed_free(b);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {every_slab_is_that_of_a_count_of_its_own,
                                  no_sphere_is_lost_or_counted_twice,
                                  planted_temperatures_are_found_whatever_the_slabs_do,
                                  slabs_without_two_spheres_have_no_temperature, NULL};
    return unit_run("profiles", tests);
}
