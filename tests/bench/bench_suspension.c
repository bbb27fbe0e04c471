/* bench_suspension.c -- what an event of the suspension engine costs, beside a floor.
 *
 * Periodic cube, elastic, N = 1e4, 1e5, 1e6 at packing .3 and .45; the start is a dense
 * state of 10^4 spheres grown from a random one, repeated along the axes, with new
 * velocities, and run until it has forgotten that.  Turn by turn: a window of events,
 * then the floor: a bare prediction over 24 neighbours for each of many spheres, from
 * records of one cache line in cell order, no event loop around it.  Then the full
 * model's mix: a kick for each collision.  CPU time of one core; best of the turns.
 *
 *     bench_suspension [LARGEST N [SMALLEST N]] */
#include "common/random.h"
#include "solver/suspension/engine.h"
#include "solver/suspension/predict.h"
#include "tests/bench/bench.h"

#include <gsl/gsl_randist.h>

enum { SMALL = 10000, TURNS = 5, NEIGHBOURS = 24 };

static struct engine *new_engine(size_t count, double side) {
    struct fault fault = FAULT_NONE;
    struct engine *e = NULL;
    struct engine_setup s = {.count = count,
                             .radius_m = 0.5,
                             .mass_kg = 1,
                             .box_m = {side, side, side},
                             .restitution = 1};
    engine_create(&e, &s, &fault);
    stop_on(&fault);
    return e;
}

static void draw_velocities(gsl_rng *r, size_t count, double *v) {
    for (size_t k = 0; k < 3 * count; k++)
        v[k] = gsl_ran_gaussian_ziggurat(r, 1);
}

/* Places of SMALL spheres of diameter 1 in a cube of the given side, by growth. */
static void grow(gsl_rng *r, double side, double *x) {
    struct fault fault = FAULT_NONE;
    struct engine *e = new_engine(SMALL, side);
    double *v = malloc(3 * SMALL * sizeof *v), rate = 0.1;
    for (size_t k = 0; k < 3 * SMALL; k++)
        x[k] = side * gsl_rng_uniform(r);
    engine_set_growth(e, 0, rate, &fault);
    double size = 0;
    draw_velocities(r, SMALL, v);
    engine_set_state(e, x, v, &fault);
    stop_on(&fault);
    while (size < 1) { /* the growth heats: velocities anew now and then */
        double more = size + 0.02 > 1 ? 1 - size : 0.02;
        engine_advance(e, engine_time(e) + more / rate, &fault);
        size = engine_diameter(e);
        engine_snapshot(e, x, NULL, NULL);
        draw_velocities(r, SMALL, v);
        size = size > 1 - 1e-9 ? 1 : size;
        engine_set_growth(e, size, size < 1 ? rate : 0, &fault);
        engine_set_state(e, x, v, &fault);
        stop_on(&fault);
    }
    free(v);
    engine_free(e);
}

/* times[axis] copies of the small state side by side. */
static struct engine *dense_engine(gsl_rng *r, const double *x, double side, size_t times) {
    struct fault fault = FAULT_NONE;
    size_t copies[3] = {times >= 10 ? (times == 10 ? 1 : 4) : 1, times >= 10 ? 2 : 1,
                        times >= 10 ? 5 : 1};
    if (times == 100)
        copies[0] = 4, copies[1] = 5, copies[2] = 5;
    size_t count = SMALL * copies[0] * copies[1] * copies[2];
    struct engine_setup s = {.count = count, .radius_m = 0.5, .mass_kg = 1, .restitution = 1};
    for (int a = 0; a < 3; a++)
        s.box_m[a] = side * (double)copies[a];
    double *p = malloc(3 * count * sizeof *p), *v = malloc(3 * count * sizeof *v);
    for (size_t n = 0, c = 0; c < count / SMALL; c++) {
        const size_t at[3] = {c % copies[0], c / copies[0] % copies[1], c / copies[0] / copies[1]};
        for (size_t k = 0; k < 3 * SMALL; k++, n++)
            p[n] = x[k] + side * (double)at[k % 3];
    }
    draw_velocities(r, count, v);
    struct engine *e = NULL;
    engine_create(&e, &s, &fault);
    stop_on(&fault);
    engine_set_state(e, p, v, &fault);
    stop_on(&fault);
    free(p);
    free(v);
    return e;
}

/* -- floor --------------------------------------------------------------------------- */

struct floor_state {
    struct sphere *sphere;
    size_t count;
    struct candidates near;
};

/* ns a collision: two predictions over 24 of the next records, at random places. */
static double run_floor(struct floor_state *f, gsl_rng *r, long collisions) {
    struct contact contact = {.now = 0, .diameter = 1};
    double began = cpu_seconds(), sum = 0;
    uint32_t random = (uint32_t)gsl_rng_get(r);
    for (long n = 0; n < collisions; n++) {
        random = random * 1664525u + 1013904223u;
        uint32_t i = (uint32_t)(((uint64_t)random * (f->count - 64)) >> 32);
        for (uint32_t side = 0; side < 2; side++) {
            for (uint32_t k = 0; k < NEIGHBOURS; k++)
                f->near.label[k] = i + 2 + k;
            f->near.count = NEIGHBOURS;
            predict_candidates(&f->sphere[i + side], f->sphere, &contact, false, false, NULL,
                               &f->near);
            for (uint32_t k = 0; k < f->near.hits; k++)
                sum += f->near.tau[k];
        }
        f->sphere[i].x[0] += 1e-30 * sum;
    }
    return 1e9 * (cpu_seconds() - began) / (double)collisions;
}

static struct floor_state make_floor(struct engine *e, size_t count) {
    struct floor_state f = {.count = count,
                            .sphere = spheres_memory((count + 64) * sizeof *f.sphere)};
    for (size_t i = 0; i < count; i++) {
        f.sphere[i] = (struct sphere){.t = 0};
        engine_place(e, i, f.sphere[i].x, f.sphere[i].w);
    }
    return f;
}

/* -- windows --------------------------------------------------------------------------- */

static void advance_by(struct engine *e, double dt) {
    struct fault fault = FAULT_NONE;
    engine_advance(e, engine_time(e) + dt, &fault);
    stop_on(&fault);
}

static void measure(gsl_rng *r, const double *x, double packing, double side, size_t times) {
    struct engine *e = dense_engine(r, x, side, times);
    size_t count = SMALL * times;
    double volume = side * side * side * (double)times;
    struct floor_state f = make_floor(e, count);
    double chi = (1 - packing / 2) / ((1 - packing) * (1 - packing) * (1 - packing));
    double rate = 2 * 1.7724538509 * (double)count * (double)count / volume * chi; /* collisions */
    double window = (times == 100 ? 2e6 : 1e6) / rate, best = 1e30, floor_ns = 1e30;
    struct engine_tally t = {.collisions = 0};
    advance_by(e, 5.0 * (double)count / rate);
    for (int turn = 0; turn < TURNS; turn++) {
        engine_reset_tally(e);
        double began = cpu_seconds();
        advance_by(e, window);
        double ns = 1e9 * (cpu_seconds() - began) / (double)engine_tally(e)->collisions;
        best = ns < best ? ns : best;
        double floor_now = run_floor(&f, r, 300000);
        floor_ns = floor_now < floor_ns ? floor_now : floor_ns;
        t = *engine_tally(e);
    }
    double c = (double)t.collisions;
    printf("N %7zu packing %.2f: %5.0f ns a collision (floor %4.0f); a collision: %.3f passages, "
           "%.3f stale; %lld rebuilds; %.0f B a sphere\n",
           count, packing, best, floor_ns, (double)t.cell_crossings / c, (double)t.stale / c,
           t.rebuilds, (double)engine_bytes(e) / (double)count);
    double most = 0;
    for (int turn = 0; turn < TURNS; turn++) {
        engine_reset_tally(e);
        double began = cpu_seconds();
        for (long k = 0; k < 200000; k++) {
            double dv[3] = {0.01 * gsl_ran_gaussian_ziggurat(r, 1), 0, 0};
            engine_kick(e, gsl_rng_uniform_int(r, count), dv);
            advance_by(e, 1 / rate);
        }
        double events = (double)(engine_tally(e)->collisions + engine_tally(e)->kicks);
        double per_s = events / (cpu_seconds() - began);
        most = per_s > most ? per_s : most;
    }
    t = *engine_tally(e);
    printf("    with kicks: %.3g collisions and kicks a second (%lld and %lld)\n", most,
           t.collisions, t.kicks);
    free(f.sphere);
    engine_free(e);
}

int main(int argc, char **argv) {
    static const double packing[2] = {0.3, 0.45};
    double largest = argc > 1 ? atof(argv[1]) : 1e6, smallest = argc > 2 ? atof(argv[2]) : 1e4;
    setvbuf(stdout, NULL, _IOLBF, 0);
    struct fault fault = FAULT_NONE;
    gsl_rng *r = NULL;
    random_stream(1101, "bench", &r, &fault);
    stop_on(&fault);
    double *x = malloc(3 * SMALL * sizeof *x);
    for (int p = 0; p < 2; p++) {
        double began = cpu_seconds(), side = cbrt(SMALL * M_PI / 6 / packing[p]);
        grow(r, side, x);
        printf("growth to packing %.2f: %.2f s\n", packing[p], cpu_seconds() - began);
        for (size_t times = 1; times <= 100 && (double)(SMALL * times) <= largest; times *= 10)
            if ((double)(SMALL * times) >= smallest)
                measure(r, x, packing[p], side, times);
    }
    free(x);
    gsl_rng_free(r);
    return 0;
}
