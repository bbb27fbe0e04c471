/* test_noise.c -- solver/suspension/noise.h: each rule over a history of random looks and
 * changes, followed here by the balance as it is written in the header. */
#include "solver/suspension/noise.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_randist.h>
#include <math.h>

static struct suspension_parameters parameters(gsl_rng *rng, enum noise_rate rule) {
    return (struct suspension_parameters){.particles = 731,
                                          .radius = gsl_ran_flat(rng, 0.3, 3),
                                          .mass = gsl_ran_flat(rng, 0.3, 3),
                                          .restitution = gsl_ran_flat(rng, 0.3, 1),
                                          .drag = gsl_ran_flat(rng, 0.1, 9),
                                          .temperature = gsl_ran_flat(rng, 0.3, 3),
                                          .noise_rate = rule,
                                          .kick_rate = gsl_ran_flat(rng, 10, 300),
                                          .kick_variance = gsl_ran_flat(rng, 0.1, 3)};
}

/* Collisions of a sphere: 4 sqrt(pi) n d^2 g(d) sqrt(T/m), n = 6 phi/(pi d^3), with g(d) from
 * Carnahan and Starling's pressure, Z = 1 + 4 phi g(d). */
static double enskog(double phi, double square, double d) {
    double z = (1 + phi + phi * phi - phi * phi * phi) / pow(1 - phi, 3);
    return 4 * sqrt(M_PI) * (6 * phi / (M_PI * d * d * d)) * d * d * (z - 1) / (4 * phi) *
           sqrt(square);
}

START_TEST(enskog_s_rate_follows_from_the_pressure) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int k = 0; k < 1000; k++) {
        double phi = gsl_ran_flat(rng, 0.01, 0.6), t = gsl_ran_flat(rng, 0.1, 9);
        double d = gsl_ran_flat(rng, 0.1, 9), expected = enskog(phi, t, d);
        ck_assert_double_eq_tol(noise_enskog(phi, t, d), expected, 1e-12 * expected);
    }
    ck_assert_double_eq(noise_enskog(0, 1.7, 0.3), 0);
    gsl_rng_free(rng);
}
END_TEST

/* The variance that balances (1) at a rate of collisions and a drag. */
static double balance(const struct suspension_parameters *v, double rate, double drag) {
    double eps = v->restitution, t = v->temperature;
    return (rate * (1 - eps * eps) * t / 3 + 2 * drag * t) / (v->mass * v->kick_rate);
}

struct history {
    double rate, drag, error, integral; /* as followed here */
};

static double expected_variance(const struct suspension_parameters *v, const struct history *h) {
    switch (v->noise_rate) {
    case NOISE_NONE:
    case NOISE_GIVEN:
        return v->kick_variance; /* parameters see to it that it is 0 for none */
    case NOISE_FIXED_KICK:
        return balance(v, 0, v->drag);
    case NOISE_FEEDBACK:
        return balance(v, h->rate, h->drag) * fmax(0, 1 + h->error + h->integral);
    default:
        return balance(v, h->rate, h->drag);
    }
}

static void look(struct noise *n, const struct suspension_parameters *v, struct history *h,
                 gsl_rng *rng) {
    double target = v->temperature / v->mass;
    struct noise_reading r = {.elapsed = gsl_ran_flat(rng, 0, 3) / v->kick_rate,
                              .collision_rate = gsl_ran_flat(rng, 0, 400),
                              .packing = gsl_ran_flat(rng, 0.05, 0.55),
                              .temperature = target * gsl_ran_flat(rng, 0.2, 1.9)};
    noise_look(n, &r);
    if (v->noise_rate == NOISE_MEASURED) /* averaged over ten kicks */
        h->rate += (1 - exp(-r.elapsed * v->kick_rate / 10)) * (r.collision_rate - h->rate);
    else
        h->rate = enskog(r.packing, target, 2 * v->radius);
    /* The balance's relaxation of the temperature: its losses over T, m s^2 f/T. */
    h->error = 1 - r.temperature / target;
    h->integral += h->error * balance(v, h->rate, h->drag) * v->kick_rate / target * r.elapsed;
}

START_TEST(every_rule_follows_its_law_through_looks_and_changes) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int run = 0; run < 600; run++) {
        enum noise_rate rule = (enum noise_rate)(run % 6);
        struct suspension_parameters v = parameters(rng, rule);
        struct history h = {.drag = gsl_ran_flat(rng, 1, 90)};
        struct noise n;
        double packing = gsl_ran_flat(rng, 0.05, 0.55);
        noise_start(&n, &v, packing, h.drag);
        h.rate = enskog(packing, v.temperature / v.mass, 2 * v.radius);
        for (int k = 0; k < 30; k++) {
            double expected = expected_variance(&v, &h);
            ck_assert_double_ge(n.variance, 0);
            ck_assert_double_eq_tol(n.variance, expected, 1e-11 * (1 + expected));
            if (gsl_rng_uniform_int(rng, 3) == 0)
                noise_change(&n, h.drag = gsl_ran_flat(rng, 1, 90));
            else
                look(&n, &v, &h, rng);
        }
    }
    gsl_rng_free(rng);
}
END_TEST

/* noise_after_change: keep -- looks count before the first change, nothing after it. */
START_TEST(a_variance_that_is_kept_stays_from_the_first_change_on) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    static const enum noise_rate rules[] = {NOISE_ENSKOG, NOISE_MEASURED, NOISE_FEEDBACK};
    for (int run = 0; run < 30; run++) {
        struct suspension_parameters v = parameters(rng, rules[run % 3]);
        struct history h = {.drag = 7.3};
        struct noise n;
        v.keep_noise = true;
        noise_start(&n, &v, 0.31, 7.3);
        double before = n.variance;
        look(&n, &v, &h, rng);
        ck_assert_double_ne(n.variance, before);
        double kept = n.variance;
        for (int k = 0; k < 20; k++) {
            noise_change(&n, 7.3 + k);
            ck_assert_double_eq(n.variance, kept);
            look(&n, &v, &h, rng);
            ck_assert_double_eq(n.variance, kept);
        }
    }
    gsl_rng_free(rng);
}
END_TEST

/* dT/dt = f s^2 - loss (T + off): a loss that the balance does not know is made up for, without
 * ringing.  From rest, 40 relaxation times at 1/50 of one a look: e^-40/2 is left. */
START_TEST(feedback_makes_up_for_losses_that_the_balance_does_not_know) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int run = 0; run < 20; run++) {
        struct suspension_parameters v = parameters(rng, NOISE_FEEDBACK);
        struct noise n;
        double target = v.temperature / v.mass, off = gsl_ran_flat(rng, -0.4, 0.4), most = 0;
        double loss = balance(&v, enskog(0.3, target, 2 * v.radius), 7.3) * v.kick_rate / target;
        double dt = 0.02 / loss, now = 0;
        noise_start(&n, &v, 0.3, 7.3);
        for (int k = 0; k < 2000; k++) {
            now += dt * (v.kick_rate * n.variance - loss * (now + off * target));
            most = fmax(most, now);
            noise_look(&n,
                       &(struct noise_reading){.elapsed = dt, .packing = 0.3, .temperature = now});
        }
        ck_assert_double_eq_tol(now, target, 1e-6 * target);
        ck_assert_double_lt(most, 1.5 * target);
    }
    gsl_rng_free(rng);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {enskog_s_rate_follows_from_the_pressure,
                                  every_rule_follows_its_law_through_looks_and_changes,
                                  a_variance_that_is_kept_stays_from_the_first_change_on,
                                  feedback_makes_up_for_losses_that_the_balance_does_not_know,
                                  NULL};
    return unit_run("noise", tests);
}
