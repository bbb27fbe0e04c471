#include "solver/graingas/multigrid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LEVELS = 16, MAX_CYCLES = 100 };

/* One level.  Arrays have a border of zeros: one column between rows (row ends
 * share it) and one row below and above, so that no site needs a branch. */
struct level {
    int nx, ny;
    ptrdiff_t stride, size; /* stride = nx + 1 */
    double *east, *north;   /* faces of a site, 0 where they would leave the box */
    double *mass, *inverse_diagonal;
    double *x, *b;
};

struct multigrid {
    int levels;
    struct level level[MAX_LEVELS];                  /* level[0] is the finest */
    double *residual, *direction, *product, *answer; /* conjugate gradients, bordered */
    double *memory;
};

static ptrdiff_t site(const struct level *l, int i, int j) {
    return (j + 1) * l->stride + i + 1;
}

static ptrdiff_t bordered_size(int nx, int ny) {
    return (ptrdiff_t)(nx + 1) * (ny + 2) + 1;
}

enum status multigrid_create(struct multigrid **out, int nx, int ny, struct fault *fault) {
    *out = NULL;
    struct multigrid *m = calloc(1, sizeof *m);
    if (!m)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for the pressure solver");
    ptrdiff_t total = 4 * bordered_size(nx, ny);
    for (int cx = nx, cy = ny;; cx = (cx + 1) / 2, cy = (cy + 1) / 2) {
        struct level *l = &m->level[m->levels++];
        l->nx = cx;
        l->ny = cy;
        l->stride = cx + 1;
        l->size = bordered_size(cx, cy);
        total += 6 * l->size;
        if (cx == 1 && cy == 1)
            break;
    }
    double *next = m->memory = calloc((size_t)total, sizeof(double));
    if (!next) {
        multigrid_free(m);
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for the pressure on %d x %d sites", nx,
                         ny);
    }
    for (int k = 0; k < m->levels; k++) {
        struct level *l = &m->level[k];
        double **array[] = {&l->east, &l->north, &l->mass, &l->inverse_diagonal, &l->x, &l->b};
        for (size_t a = 0; a < 6; a++, next += l->size)
            *array[a] = next;
    }
    double **fine[] = {&m->residual, &m->direction, &m->product, &m->answer};
    for (size_t a = 0; a < 4; a++, next += m->level[0].size)
        *fine[a] = next;
    *out = m;
    return STATUS_OK;
}

void multigrid_free(struct multigrid *m) {
    if (!m)
        return;
    free(m->memory);
    free(m);
}

static void find_diagonal(struct level *l) {
    for (int j = 0; j < l->ny; j++)
        for (ptrdiff_t k = site(l, 0, j), end = k + l->nx; k < end; k++)
            l->inverse_diagonal[k] = 1 / (l->mass[k] + l->east[k] + l->east[k - 1] + l->north[k] +
                                          l->north[k - l->stride]);
}

/* How many fine sites an aggregate spans along one side. */
static int span(int fine_count, int aggregate) {
    return 2 * aggregate + 1 < fine_count ? 2 : 1;
}

static void coarsen(const struct level *f, struct level *c) {
    for (int j = 0; j < c->ny; j++)
        for (int i = 0; i < c->nx; i++) {
            ptrdiff_t k = site(c, i, j);
            int wide = span(f->nx, i), high = span(f->ny, j);
            double mass = 0, east = 0, north = 0;
            for (int b = 0; b < high; b++) {
                for (int a = 0; a < wide; a++)
                    mass += f->mass[site(f, 2 * i + a, 2 * j + b)];
                east += f->east[site(f, 2 * i + wide - 1, 2 * j + b)];
            }
            for (int a = 0; a < wide; a++)
                north += f->north[site(f, 2 * i + a, 2 * j + high - 1)];
            c->mass[k] = mass;
            c->east[k] = i + 1 < c->nx ? east * 2 / (wide + span(f->nx, i + 1)) : 0;
            c->north[k] = j + 1 < c->ny ? north * 2 / (high + span(f->ny, j + 1)) : 0;
        }
}

void multigrid_set(struct multigrid *m, const double *east, const double *north,
                   const double *mass) {
    struct level *l = &m->level[0];
    for (int j = 0; j < l->ny; j++)
        for (int i = 0; i < l->nx; i++) {
            ptrdiff_t k = site(l, i, j), from = (ptrdiff_t)j * l->nx + i;
            l->east[k] = i + 1 < l->nx ? east[from] : 0;
            l->north[k] = j + 1 < l->ny ? north[from] : 0;
            l->mass[k] = mass[from];
        }
    find_diagonal(l);
    for (int k = 1; k < m->levels; k++) {
        coarsen(&m->level[k - 1], &m->level[k]);
        find_diagonal(&m->level[k]);
    }
}

/* One half sweep of Gauss-Seidel over the sites with (i + j) % 2 == colour. */
static void relax(struct level *l, int colour) {
    const double *restrict e = l->east, *restrict n = l->north, *restrict b = l->b;
    const double *restrict d = l->inverse_diagonal;
    double *restrict x = l->x;
    ptrdiff_t s = l->stride;
    for (int j = 0; j < l->ny; j++)
        for (ptrdiff_t k = site(l, (colour + j) & 1, j), end = site(l, l->nx, j); k < end; k += 2)
            x[k] = (b[k] + (e[k] * x[k + 1] + e[k - 1] * x[k - 1]) +
                    (n[k] * x[k + s] + n[k - s] * x[k - s])) *
                   d[k];
}

/* The first half sweep when x is zero everywhere. */
static void relax_from_zero(struct level *l, int colour) {
    for (int j = 0; j < l->ny; j++)
        for (ptrdiff_t k = site(l, 0, j), end = k + l->nx; k < end; k++)
            l->x[k] = ((k - site(l, 0, j) + j + colour) & 1) ? 0 : l->b[k] * l->inverse_diagonal[k];
}

static inline double residual_at(const struct level *l, ptrdiff_t k) {
    const double *x = l->x;
    return l->b[k] - x[k] / l->inverse_diagonal[k] + l->east[k] * x[k + 1] +
           l->east[k - 1] * x[k - 1] + l->north[k] * x[k + l->stride] +
           l->north[k - l->stride] * x[k - l->stride];
}

/* Sum the fine residual over each aggregate.  After a black half sweep the
 * residual of black sites is zero: only red ones, (i + j) even, count. */
static void restrict_residual(const struct level *f, struct level *c) {
    for (int j = 0; j < c->ny; j++)
        for (int i = 0; i < c->nx; i++) {
            double sum = residual_at(f, site(f, 2 * i, 2 * j));
            if (span(f->nx, i) == 2 && span(f->ny, j) == 2)
                sum += residual_at(f, site(f, 2 * i + 1, 2 * j + 1));
            c->b[site(c, i, j)] = sum;
        }
}

static void add_correction(const struct level *c, struct level *f) {
    for (int j = 0; j < f->ny; j++) {
        const double *from = c->x + site(c, 0, j / 2);
        double *to = f->x + site(f, 0, j);
        for (int i = 0; i < f->nx; i++)
            to[i] += from[i / 2];
    }
}

/* Level 0's x becomes the V-cycle's answer to its b, from zero. */
static void cycle(struct multigrid *m) {
    enum { RED, BLACK };
    for (int k = 0; k + 1 < m->levels; k++) {
        struct level *l = &m->level[k];
        relax_from_zero(l, RED);
        relax(l, BLACK);
        relax(l, RED);
        relax(l, BLACK);
        restrict_residual(l, &m->level[k + 1]);
    }
    struct level *last = &m->level[m->levels - 1];
    last->x[site(last, 0, 0)] =
        last->b[site(last, 0, 0)] * last->inverse_diagonal[site(last, 0, 0)];
    for (int k = m->levels - 2; k >= 0; k--) {
        struct level *l = &m->level[k];
        add_correction(&m->level[k + 1], l);
        relax(l, BLACK);
        relax(l, RED);
        relax(l, BLACK);
        relax(l, RED);
    }
}

/* product = A v on the finest level; v has a zero border. Returns v . A v. */
static double multiply(const struct level *l, const double *restrict v, double *restrict product) {
    ptrdiff_t s = l->stride;
    double sum = 0;
    for (int j = 0; j < l->ny; j++)
        for (ptrdiff_t k = site(l, 0, j), end = k + l->nx; k < end; k++) {
            double p = l->mass[k] * v[k] + l->east[k] * (v[k] - v[k + 1]) +
                       l->east[k - 1] * (v[k] - v[k - 1]) + l->north[k] * (v[k] - v[k + s]) +
                       l->north[k - s] * (v[k] - v[k - s]);
            product[k] = p;
            sum += v[k] * p;
        }
    return sum;
}

static double dot(const double *a, const double *b, ptrdiff_t count) {
    double sum[4] = {0};
    ptrdiff_t k = 0;
    for (; k + 4 <= count; k += 4)
        for (int c = 0; c < 4; c++)
            sum[c] += a[k + c] * b[k + c];
    for (; k < count; k++)
        sum[0] += a[k] * b[k];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Between the caller's packed rows and the bordered ones. */
static void pack(const struct level *l, const double *bordered, double *packed) {
    for (int j = 0; j < l->ny; j++)
        memcpy(packed + (size_t)j * (size_t)l->nx, bordered + site(l, 0, j),
               (size_t)l->nx * sizeof(double));
}

static void unpack(const struct level *l, const double *packed, double *bordered) {
    for (int j = 0; j < l->ny; j++)
        memcpy(bordered + site(l, 0, j), packed + (size_t)j * (size_t)l->nx,
               (size_t)l->nx * sizeof(double));
}

/* z = V-cycle of the residual; returns residual . z. */
static double precondition(struct multigrid *m) {
    struct level *l = &m->level[0];
    memcpy(l->b, m->residual, (size_t)l->size * sizeof(double));
    cycle(m);
    return dot(m->residual, l->x, l->size);
}

static void advance(struct multigrid *m, double step) {
    for (ptrdiff_t k = 0; k < m->level[0].size; k++) {
        m->answer[k] += step * m->direction[k];
        m->residual[k] -= step * m->product[k];
    }
}

enum status multigrid_solve(struct multigrid *m, const double *b, double tolerance, double *x,
                            struct multigrid_outcome *outcome, struct fault *fault) {
    struct level *l = &m->level[0];
    unpack(l, x, m->answer);
    unpack(l, b, m->residual);
    double b_norm = sqrt(dot(m->residual, m->residual, l->size));
    multiply(l, m->answer, m->product);
    for (ptrdiff_t k = 0; k < l->size; k++)
        m->residual[k] -= m->product[k];
    double norm = sqrt(dot(m->residual, m->residual, l->size));
    double rho = 0;
    int n = 0;
    for (; norm > tolerance * b_norm && n < MAX_CYCLES; n++) {
        double next = precondition(m), ratio = n ? next / rho : 0;
        rho = next;
        for (ptrdiff_t k = 0; k < l->size; k++)
            m->direction[k] = l->x[k] + ratio * m->direction[k];
        advance(m, rho / multiply(l, m->direction, m->product));
        norm = sqrt(dot(m->residual, m->residual, l->size));
    }
    pack(l, m->answer, x);
    *outcome = (struct multigrid_outcome){n, b_norm > 0 ? norm / b_norm : norm};
    if (norm <= tolerance * b_norm)
        return STATUS_OK;
    return fault_set(fault, STATUS_NUMERICAL,
                     "the pressure did not converge: residual %.3g after %d cycles, %.3g asked",
                     outcome->residual, n, tolerance);
}
