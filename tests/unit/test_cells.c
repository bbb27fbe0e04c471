/* test_cells.c -- solver/suspension/cells.h: the grid itself, and through the engine that a
 * pair is seen from each of the 27 cells, across every kind of side. */
#include "solver/suspension/cells.h"
#include "solver/suspension/engine.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

enum { COUNT = 3000 };

static struct cells made(size_t count, const double low[3], const double high[3],
                         const bool periodic[3], double least) {
    struct fault fault = FAULT_NONE;
    struct cells c;
    unit_ok(cells_create(&c, count, low, high, periodic, least, &fault), &fault);
    return c;
}

/* -- planes and places ---------------------------------------------------------------- */

static const double low[3] = {0.31, 0, -2.3}, high[3] = {9.17, 4.03, 7.9};

START_TEST(cells_cover_the_box_and_are_no_smaller_than_asked) {
    for (int kinds = 0; kinds < 8; kinds++)
        for (double least = 0.37; least < 20; least *= 1.19) {
            const bool periodic[3] = {kinds & 1, kinds & 2, kinds & 4};
            struct cells c = made(COUNT, low, high, periodic, least);
            double fit[3], all = 1; /* as many as fit, if not beyond two a sphere */
            for (int a = 0; a < 3; a++) {
                fit[a] = fmax(floor((high[a] - low[a]) / least), periodic[a] ? 2 : 1);
                all *= fit[a];
            }
            ck_assert_uint_eq(c.total, c.n[0] * c.n[1] * c.n[2]);
            for (int a = 0; a < 3; a++) {
                double most = floor((high[a] - low[a]) / least);
                ck_assert_uint_ge(c.n[a], periodic[a] ? 2 : 1);
                if (all <= 2 * COUNT)
                    ck_assert_double_eq(c.n[a], fit[a]);
                ck_assert_double_eq(c.edge[a][0], low[a]);
                ck_assert_double_eq(c.edge[a][c.n[a]], high[a]);
                ck_assert_double_eq(c.side[a], high[a] - low[a]);
                for (uint32_t k = 0; k < c.n[a] && most >= c.n[a]; k++)
                    ck_assert_double_ge(c.edge[a][k + 1] - c.edge[a][k], least * (1 - 1e-13));
            }
            cells_free(&c);
        }
}
END_TEST

/* A gas of 10 in a wide box: memory goes with spheres, not with volume. */
START_TEST(a_dilute_system_has_no_more_than_a_few_cells_a_sphere) {
    const double from[3] = {0, 0, 0}, to[3] = {713, 917, 1371};
    const bool periodic[3] = {true, false, true};
    for (size_t count = 1; count < 1000000; count *= 10) {
        struct cells c = made(count, from, to, periodic, 1.1);
        ck_assert_uint_le(c.total, 64 + 2 * count);
        ck_assert_uint_ge(c.total, count / 2);
        cells_free(&c);
    }
}
END_TEST

START_TEST(a_place_is_found_between_its_planes_also_on_one_and_outside) {
    const bool periodic[3] = {true, false, true};
    struct cells c = made(COUNT, low, high, periodic, 0.73);
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int a = 0; a < 3; a++) {
        uint32_t n = c.n[a];
        ck_assert_uint_gt(n, 4);
        for (int k = 0; k < 5000; k++) {
            double x = gsl_ran_flat(rng, low[a], high[a]);
            uint32_t at = cells_find(&c, a, x);
            ck_assert_double_le(c.edge[a][at], x);
            ck_assert_double_lt(x, c.edge[a][at + 1]);
        }
        for (uint32_t k = 0; k < n; k++) { /* a plane belongs to the cell above */
            ck_assert_uint_eq(cells_find(&c, a, c.edge[a][k]), k);
            ck_assert_uint_eq(cells_find(&c, a, nextafter(c.edge[a][k + 1], -9)), k);
        }
        ck_assert_uint_eq(cells_find(&c, a, high[a]), n - 1);
        ck_assert_uint_eq(cells_find(&c, a, nextafter(high[a], 99)), n - 1);
        ck_assert_uint_eq(cells_find(&c, a, nextafter(low[a], -99)), 0);
    }
    gsl_rng_free(rng);
    cells_free(&c);
}
END_TEST

/* The way out: at that time the sphere is on a plane of its cell, and before in the cell. */
START_TEST(the_way_out_ends_on_the_first_plane) {
    const bool periodic[3] = {true, true, true};
    struct cells c = made(COUNT, low, high, periodic, 0.73);
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    int axis, along[3] = {0};
    for (int k = 0; k < 20000; k++) {
        struct sphere s = {.t = gsl_ran_flat(rng, -3, 3)};
        uint16_t cell[3];
        for (int a = 0; a < 3; a++) {
            s.x[a] = gsl_ran_flat(rng, low[a], high[a]);
            s.w[a] = gsl_rng_uniform_int(rng, 5) == 0 ? 0 : gsl_ran_flat(rng, -0.7, 0.7);
            cell[a] = cells_find(&c, a, s.x[a]);
        }
        double dt = cells_exit(&c, &s, cell, &axis);
        if (s.w[0] == 0 && s.w[1] == 0 && s.w[2] == 0) {
            ck_assert_double_eq(dt, INFINITY);
            continue;
        }
        ck_assert_double_ge(dt, 0);
        along[axis]++;
        for (int a = 0; a < 3; a++) {
            double x = s.x[a] + s.w[a] * dt;
            double plane = c.edge[a][cell[a] + (s.w[a] > 0)];
            ck_assert_double_ge(x, c.edge[a][cell[a]] - 1e-14);
            ck_assert_double_le(x, c.edge[a][cell[a] + 1] + 1e-14);
            if (a == axis)
                ck_assert_double_eq_tol(x, plane, 1e-14);
        }
    }
    for (int a = 0; a < 3; a++)
        ck_assert_int_gt(along[a], 1000);
    gsl_rng_free(rng);
    cells_free(&c);
}
END_TEST

/* -- who is where --------------------------------------------------------------------- */

/* Spheres by name, each with the cell that it should be in, or CELLS_EMPTY when out. */
struct crowd {
    struct cells cells;
    uint32_t cell[COUNT]; /* of label */
    uint32_t in;
    gsl_rng *rng;
};

/* Renumbering shows all that is in: labels 0, 1 ... each once, in the order of cells. */
static void renumber(struct crowd *w) {
    static uint32_t place[COUNT], cell[COUNT];
    memset(place, 0xff, sizeof place);
    memset(cell, 0xff, sizeof cell);
    cells_renumber(&w->cells, place);
    for (uint32_t i = 0; i < COUNT; i++) {
        ck_assert_int_eq(place[i] == UINT32_MAX, w->cell[i] == CELLS_EMPTY);
        if (place[i] == UINT32_MAX)
            continue;
        ck_assert_uint_lt(place[i], w->in);
        ck_assert_uint_eq(cell[place[i]], CELLS_EMPTY); /* given once */
        cell[place[i]] = w->cell[i];
    }
    for (uint32_t i = 1; i < w->in; i++)
        ck_assert_uint_le(cell[i - 1], cell[i]);
    memcpy(w->cell, cell, sizeof cell);
}

/* Put a random sphere that is out in, or take one that is in out, or move it. */
static void change(struct crowd *w, uint32_t most) {
    uint32_t i = (uint32_t)gsl_rng_uniform_int(w->rng, COUNT);
    uint32_t to = (uint32_t)gsl_rng_uniform_int(w->rng, most);
    bool was_in = w->cell[i] != CELLS_EMPTY, out = was_in && gsl_rng_uniform_int(w->rng, 4) == 0;
    if (was_in)
        cells_remove(&w->cells, w->cell[i], i);
    if (!out)
        cells_insert(&w->cells, to, i);
    w->in += (uint32_t)(!out && !was_in);
    w->in -= (uint32_t)out;
    w->cell[i] = out ? CELLS_EMPTY : to;
}

static struct crowd *crowd_new(void) {
    const bool periodic[3] = {true, false, true};
    struct crowd *w = calloc(1, sizeof *w);
    ck_assert_ptr_nonnull(w);
    w->cells = made(COUNT, low, high, periodic, 0.51);
    w->rng = gsl_rng_alloc(gsl_rng_mt19937);
    memset(w->cell, 0xff, sizeof w->cell);
    return w;
}

static void crowd_free(struct crowd *w) {
    cells_free(&w->cells);
    gsl_rng_free(w->rng);
    free(w);
}

/* In 1, 7, 100 cells and all: from all spheres in one cell to one or two in each. */
START_TEST(spheres_put_in_moved_and_taken_out_are_where_they_should_be) {
    struct crowd *w = crowd_new();
    const uint32_t most[] = {1, 7, 100, w->cells.total, 3, w->cells.total};
    for (int n = 0; n < 6; n++)
        for (int round = 0; round < 20; round++) {
            for (int k = 0; k < 2000; k++)
                change(w, most[n]);
            renumber(w);
            ck_assert_uint_gt(w->in, COUNT / 4);
        }
    for (uint32_t i = 0; i < COUNT; i++)
        if (w->cell[i] != CELLS_EMPTY) {
            cells_remove(&w->cells, w->cell[i], i);
            w->cell[i] = CELLS_EMPTY;
        }
    w->in = 0;
    renumber(w);
    crowd_free(w);
}
END_TEST

/* Room for crowded cells is bounded: every sphere in one cell, and five in each of many,
 * which need the most further blocks, must fit again and again. */
START_TEST(the_most_crowded_arrangements_fit_again_and_again) {
    struct crowd *w = crowd_new();
    for (int n = 0; n < 12; n++) {
        uint32_t group = n % 3 == 0 ? COUNT : n % 3 == 1 ? 5 : 7;
        w->in = COUNT;
        for (uint32_t i = 0; i < COUNT; i++) {
            w->cell[i] = (i / group * 13 + (uint32_t)n) % w->cells.total;
            cells_insert(&w->cells, w->cell[i], i);
        }
        renumber(w);
        if (n == 5) {
            cells_clear(&w->cells);
        } else {
            for (uint32_t i = 0; i < COUNT; i++) {
                uint32_t k = (i * 1371u + 17) % COUNT; /* 1371 has no factor with 3000 but 3 */
                k = n % 2 == 0 ? COUNT - 1 - i : k;
                if (w->cell[k] != CELLS_EMPTY)
                    cells_remove(&w->cells, w->cell[k], k);
                w->cell[k] = CELLS_EMPTY;
            }
            for (uint32_t i = 0; i < COUNT; i++)
                if (w->cell[i] != CELLS_EMPTY)
                    cells_remove(&w->cells, w->cell[i], i);
        }
        memset(w->cell, 0xff, sizeof w->cell);
        w->in = 0;
        renumber(w);
    }
    crowd_free(w);
}
END_TEST

/* -- 27 cells ------------------------------------------------------------------------- */

struct pair {
    double box[3], x[6], v[6];
    bool periodic[3];
};

/* When the spheres first touch, over three images to each side, in free flight; R = 1. */
static double first_touch(const struct pair *p) {
    double first = INFINITY;
    for (int image = 0; image < 343; image++) {
        const int turn[3] = {image % 7 - 3, image / 7 % 7 - 3, image / 49 - 3};
        double rr = -4, rv = 0, vv = 0;
        bool there = true;
        for (int a = 0; a < 3; a++) {
            double r = p->x[3 + a] - p->x[a] + turn[a] * p->box[a], v = p->v[3 + a] - p->v[a];
            there = there && (turn[a] == 0 || p->periodic[a]);
            rr += r * r;
            rv += r * v;
            vv += v * v;
        }
        double square = rv * rv - vv * rr;
        if (there && rv < 0 && square > 0)
            first = fmin(first, (-rv - sqrt(square)) / vv);
    }
    return first;
}

/* When either meets a hard side. */
static double first_wall(const struct pair *p) {
    double first = INFINITY;
    for (int k = 0; k < 6; k++)
        if (!p->periodic[k % 3] && p->v[k] != 0)
            first = fmin(first, ((p->v[k] > 0 ? p->box[k % 3] - 1 : 1) - p->x[k]) / p->v[k]);
    return first;
}

/* Sphere 0 anywhere; sphere 1 at most `reach` from touching it, in any direction, folded back
 * into the box.  False if it does not fit. */
static bool place_pair(struct pair *p, gsl_rng *rng, double reach) {
    double n[3], distance = 2 + 1e-9 + reach * gsl_rng_uniform(rng);
    gsl_ran_dir_3d(rng, &n[0], &n[1], &n[2]);
    for (int a = 0; a < 3; a++) {
        double edge = p->periodic[a] ? 0 : 1;
        p->x[a] = gsl_ran_flat(rng, edge, p->box[a] - edge);
        double x = p->x[a] + distance * n[a];
        if (p->periodic[a])
            x -= p->box[a] * floor(x / p->box[a]);
        if (!(x >= edge && x <= p->box[a] - edge) || x == p->box[a])
            return false;
        p->x[3 + a] = x;
        p->v[a] = gsl_ran_flat(rng, -1, 1);
        p->v[3 + a] = gsl_ran_flat(rng, -1, 1) - n[a]; /* rather towards it */
    }
    for (int image = 0; image < 27; image++) { /* touches no other image either */
        double rr = 0;
        for (int a = 0, k = image; a < 3; a++, k /= 3) {
            double r = p->x[3 + a] - p->x[a] + (p->periodic[a] ? (k % 3 - 1) * p->box[a] : 0);
            rr += r * r;
        }
        if (rr < 4 + 1e-9)
            return false;
    }
    return true;
}

static long long collisions_at(struct engine *e, double time) {
    struct fault fault = FAULT_NONE;
    unit_ok(engine_advance(e, time, &fault), &fault);
    return engine_tally(e)->collisions;
}

/* The engine's collision is at the time of the closed formula, and none before a wall's; up
 * to 2, within which speeds of 3 an axis pass no more than the images looked at. */
static bool expect_touch(struct engine *e, const struct pair *p) {
    struct fault fault = FAULT_NONE;
    double touch = first_touch(p), wall = fmin(first_wall(p), 2), end = fmin(touch, wall);
    unit_ok(engine_set_state(e, p->x, p->v, &fault), &fault);
    ck_assert_int_eq(collisions_at(e, end - 1e-9), 0);
    if (fabs(touch - wall) < 1e-6 || touch > wall)
        return false;
    ck_assert_int_eq(collisions_at(e, end + 1e-9), 1);
    return true;
}

/* Boxes of two, three and more cells an axis, all kinds of sides.  A graze nearer than
 * 1e-9 of a contact to the formula's round-off is not expected in 5e4 pairs. */
START_TEST(a_pair_is_seen_from_every_neighbouring_cell) {
    static const double box[][3] = {
        {4.1, 4.3, 5.9}, {4.7, 6.3, 6.9}, {6.1, 8.3, 4.2}, {8.7, 9.1, 11.3}, {14.9, 6.2, 10.7}};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int n = 0; n < 40; n++) {
        struct fault fault = FAULT_NONE;
        struct engine *e = NULL;
        struct pair p;
        struct engine_setup s = {.count = 2, .radius_m = 1, .mass_kg = 1, .restitution = 1};
        for (int a = 0; a < 3; a++) {
            p.periodic[a] = !(n % 8 >> a & 1);
            p.box[a] = s.box_m[a] = box[n / 8][a];
            s.boundary[a] = p.periodic[a] ? BOUNDARY_PERIODIC : BOUNDARY_HARD;
        }
        unit_ok(engine_create(&e, &s, &fault), &fault);
        int met = 0;
        for (int k = 0; k < 1500; k++)
            if (place_pair(&p, rng, k % 2 == 0 ? 0.3 : 2.5))
                met += expect_touch(e, &p);
        ck_assert_int_gt(met, 50);
        engine_free(e);
    }
    gsl_rng_free(rng);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {cells_cover_the_box_and_are_no_smaller_than_asked,
                                  a_dilute_system_has_no_more_than_a_few_cells_a_sphere,
                                  a_place_is_found_between_its_planes_also_on_one_and_outside,
                                  the_way_out_ends_on_the_first_plane,
                                  spheres_put_in_moved_and_taken_out_are_where_they_should_be,
                                  the_most_crowded_arrangements_fit_again_and_again,
                                  a_pair_is_seen_from_every_neighbouring_cell,
                                  NULL};
    return unit_run("cells", tests);
}
