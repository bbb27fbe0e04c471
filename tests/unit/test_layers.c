/* test_layers.c -- solver/suspension/layers.h: exact counts, the histogram and its error. */
#include "solver/suspension/layers.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_rng.h>
#include <math.h>

enum { COUNT = 700 };

struct sample {
    double position[3 * COUNT];
};

/* Heights uniform in [0.3, height - 0.3]. */
static void fill(struct sample *s, double height) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int i = 0; i < 3 * COUNT; i++)
        s->position[i] = 0.3 + (height - 0.6) * gsl_rng_uniform(rng);
    gsl_rng_free(rng);
}

static struct layers made(const struct sample *s, bool periodic, double height, double thickness,
                          double bin) {
    struct fault fault = FAULT_NONE;
    struct layers l;
    struct layers_setup setup = {.thickness_m = thickness,
                                 .height_m = height,
                                 .rise_m = 0.0137,
                                 .bin_m = bin,
                                 .periodic = periodic,
                                 .count = COUNT};
    unit_ok(layers_create(&l, &setup, &fault), &fault);
    layers_refresh(&l, s->position);
    return l;
}

/* Counted here by images and by the layer's two ends. */
static double counted(const struct sample *s, bool periodic, double height, double thickness,
                      double z) {
    double low = z - thickness / 2, high = z + thickness / 2, n = 0;
    for (int i = 0; i < COUNT; i++)
        for (int image = periodic ? -1 : 0; image <= (periodic ? 1 : 0); image++) {
            double at = s->position[3 * i + 2] + image * height;
            n += at >= low && at <= high;
        }
    double inside = periodic ? thickness : fmin(high, height) - fmax(low, 0);
    return n * 0.0137 / inside;
}

START_TEST(the_exact_count_is_that_of_brute_force_by_images) {
    struct sample s;
    const double height = 23.7, thickness = 7.3;
    fill(&s, height);
    for (int periodic = 0; periodic < 2; periodic++) {
        struct layers l = made(&s, periodic, height, thickness, 0.25);
        for (double z = 0.01; z < height; z += 0.377)
            ck_assert_double_eq_tol(layers_exact(&l, s.position, z),
                                    counted(&s, periodic, height, thickness, z), 1e-12);
        layers_free(&l);
    }
}
END_TEST

START_TEST(a_layer_as_thick_as_a_periodic_box_holds_every_sphere_once) {
    struct sample s;
    fill(&s, 9.1);
    struct layers l = made(&s, true, 9.1, 9.1, 0.25);
    ck_assert_double_eq_tol(layers_exact(&l, s.position, 2.3), COUNT * 0.0137 / 9.1, 1e-12);
    ck_assert_double_eq_tol(layers_fraction(&l, 2.3), COUNT * 0.0137 / 9.1, 1e-12);
    layers_free(&l);
}
END_TEST

/* Each end of a layer cuts a bin whose n centres are taken as spread evenly: at most n
 * of either bin are misjudged.  Here by the error of the largest bin, twice. */
START_TEST(the_histogram_is_off_by_no_more_than_the_two_bins_it_cuts) {
    struct sample s;
    const double height = 23.7, thickness = 7.3;
    fill(&s, height);
    for (int periodic = 0; periodic < 2; periodic++) {
        struct layers l = made(&s, periodic, height, thickness, 0.25);
        double most = 0, worst = 0;
        for (size_t k = 0; k < l.bins; k++)
            most = fmax(most, l.below[k + 1] - l.below[k]);
        for (double z = 0.01; z < height; z += 0.0377) {
            double inside =
                periodic ? thickness : fmin(z + thickness / 2, height) - fmax(z - thickness / 2, 0);
            double off = fabs(layers_fraction(&l, z) - layers_exact(&l, s.position, z));
            ck_assert_double_le(off, 2 * most * 0.0137 / inside);
            worst = fmax(worst, off);
        }
        ck_assert_double_gt(worst, 0.0137 / thickness); /* it is no exact count */
        layers_free(&l);
    }
}
END_TEST

START_TEST(the_reported_error_is_that_of_each_sphere_counted_alone) {
    struct sample s;
    struct fault fault = FAULT_NONE;
    const double height = 23.7;
    fill(&s, height);
    for (int periodic = 0; periodic < 2; periodic++) {
        struct layers l = made(&s, periodic, height, 7.3, 0.9);
        double rms, largest, sum = 0, worst = 0;
        unit_ok(layers_error(&l, s.position, &rms, &largest, &fault), &fault);
        for (int i = 0; i < COUNT; i++) {
            double z = s.position[3 * i + 2];
            double off = fabs(layers_fraction(&l, z) - layers_exact(&l, s.position, z));
            sum += off * off;
            worst = fmax(worst, off);
        }
        ck_assert_double_eq_tol(rms, sqrt(sum / COUNT), 1e-12);
        ck_assert_double_eq_tol(largest, worst, 1e-12);
        layers_free(&l);
    }
}
END_TEST

START_TEST(narrower_bins_are_nearer_the_exact_count) {
    struct sample s;
    struct fault fault = FAULT_NONE;
    fill(&s, 23.7);
    double before = INFINITY;
    const double bin[] = {2, 0.5, 0.125, 0.002};
    for (int n = 0; n < 4; n++) {
        struct layers l = made(&s, false, 23.7, 7.3, bin[n]);
        double rms, largest;
        unit_ok(layers_error(&l, s.position, &rms, &largest, &fault), &fault);
        ck_assert_double_lt(rms, before);
        before = rms;
        layers_free(&l);
    }
}
END_TEST

/* Evenly spread centres: every layer holds the same fraction, at walls too. */
START_TEST(an_even_slab_has_the_same_fraction_everywhere_and_as_its_mean) {
    struct sample s;
    const double height = 7.0;
    for (int i = 0; i < COUNT; i++)
        s.position[3 * i + 2] = (i + 0.5) * height / COUNT;
    struct layers l = made(&s, false, height, 2.0, 0.25);
    double even = COUNT * 0.0137 / height;
    for (double z = 0; z <= height; z += 0.13)
        ck_assert_double_eq_tol(layers_fraction(&l, z), even, 1e-12 * even);
    ck_assert_double_eq_tol(layers_mean(&l), even, 1e-12 * even);
    layers_free(&l);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {the_exact_count_is_that_of_brute_force_by_images,
                                  a_layer_as_thick_as_a_periodic_box_holds_every_sphere_once,
                                  the_histogram_is_off_by_no_more_than_the_two_bins_it_cuts,
                                  the_reported_error_is_that_of_each_sphere_counted_alone,
                                  narrower_bins_are_nearer_the_exact_count,
                                  an_even_slab_has_the_same_fraction_everywhere_and_as_its_mean,
                                  NULL};
    return unit_run("layers", tests);
}
