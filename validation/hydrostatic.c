/* hydrostatic.c -- see hydrostatic.h.
 *
 * Cells 1 .. n of height delta over the depth left free on the floor, faces 0 .. n; N[j] the column
 * above face j, N[0] all of it, N[n] = 0, phi of cell j = (N[j-1] - N[j])/delta.  At the faces
 * 1 .. n-1
 *
 *     a (P(p2) - P(p1))/(L(p1, p2) delta) = F,   P(p) = p Z t,   L = (p2 - p1)/ln(p2/p1)
 *
 * p1 below, p2 above the face: L is the mean under which P = p gives ln(p2/p1), so the
 * exponential of the dilute end is exact.
 */
#include "validation/hydrostatic.h"

#include "validation/sphere_laws.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS_MAX = 200, CELLS_MAX = 40000 };

/* -- bulk and cross-section ------------------------------------------------------ */

double hydrostatic_depth_R(double bulk) {
    double p = bulk;
    return 1 - 3 * p * (1 + 2 * p) / (1 + p * (4 + p * (4 + p * (-4 + p))));
}

double hydrostatic_fraction_of(const struct hydrostatic_bed *bed, double bulk) {
    double phi = bulk, depth = hydrostatic_depth_R(bulk);
    for (size_t a = 0; a < 2; a++)
        if (bed->walls[a])
            phi *= 1 - 2 * depth / bed->width_R[a];
    return phi;
}

/* phi rises with p, nearly in proportion: secant steps. */
double hydrostatic_bulk_of(const struct hydrostatic_bed *bed, double fraction) {
    double p = fraction;
    for (int i = 0; i < 60; i++) {
        double next = p * fraction / hydrostatic_fraction_of(bed, p);
        if (fabs(next - p) <= 1e-14 * p)
            return next;
        p = next;
    }
    return p;
}

static double measured(const struct hydrostatic_bed *bed, double fraction) {
    double x = fmin(fraction, bed->measured_to), sum = 0;
    for (size_t i = HYDROSTATIC_TERMS; i-- > 0;)
        sum = sum * x + bed->c[i];
    return exp(sum);
}

/* s^2 (1 + H r s) = 1 + H, s = sqrt(t), r = p chi(p) over that of the bulk at phibar, `home`. */
static double balanced(const struct hydrostatic_bed *bed, double home, double bulk) {
    double r = bulk * spheres_contact(bulk) / (home * spheres_contact(home));
    double h = bed->heat_ratio, s = 1;
    for (int i = 0; i < 60; i++) {
        double step = (s * s * (1 + h * r * s) - 1 - h) / (2 * s + 3 * h * r * s * s);
        s -= step;
        if (fabs(step) < 1e-14)
            break;
    }
    return s * s;
}

static double temperature(const struct hydrostatic_bed *bed, double home, double bulk) {
    if (bed->measured_to > 0)
        return measured(bed, hydrostatic_fraction_of(bed, bulk));
    return bed->local_temperature ? balanced(bed, home, bulk) : 1;
}

double hydrostatic_temperature(const struct hydrostatic_bed *bed, double bulk) {
    return temperature(bed, hydrostatic_bulk_of(bed, bed->phibar), bulk);
}

static double pressure(const struct hydrostatic_bed *bed, double home, double p) {
    double push = bed->restitution > 0 ? (1 + bed->restitution) / 2 : 1;
    double z = 1 + push * (spheres_compressibility(p) - 1);
    return p * z * temperature(bed, home, p);
}

/* -- equations -------------------------------------------------------------------- */

/* A cell: p, P(p), and their slopes. */
struct cell {
    double bulk, pressure; /* p, p Z t (1) */
    double bulk_slope;     /* dp/dphi (1) */
    double pressure_slope; /* dP/dp (1) */
};

struct problem {
    const struct hydrostatic_bed *bed;
    size_t n, reach;     /* cells; faces in Delta/2 */
    double delta, floor; /* (R) */
    double home;         /* p of the bulk at phibar (1) */
    double *column;      /* column[0 .. n]: N (R) */
    double *band;        /* band[(j-1) width + k]: row j, column j - reach + k */
    double *rest;        /* rest[0 .. n-2]: residual, then step, of faces 1 .. n-1 */
    struct cell *cell;   /* cell[1 .. n] */
    size_t width;        /* of a row of the band, with room for pivots */
};

static double fraction_in(const struct problem *q, size_t cell) {
    return (q->column[cell - 1] - q->column[cell]) / q->delta;
}

static void look(const struct problem *q, size_t c) {
    const double h = 1e-5;
    double phi = fraction_in(q, c), p = hydrostatic_bulk_of(q->bed, phi);
    double wider = hydrostatic_fraction_of(q->bed, p * (1 + h));
    double narrower = hydrostatic_fraction_of(q->bed, p * (1 - h));
    double more = pressure(q->bed, q->home, p * (1 + h));
    double less = pressure(q->bed, q->home, p * (1 - h));
    q->cell[c] = (struct cell){.bulk = p,
                               .pressure = pressure(q->bed, q->home, p),
                               .bulk_slope = 2 * h * p / (wider - narrower),
                               .pressure_slope = (more - less) / (2 * h * p)};
}

/* (P2 - P1)/L(p1, p2), and its slopes with phi below and above. */
static double climb(const struct cell *below, const struct cell *above, double *slope_below,
                    double *slope_above) {
    double p1 = below->bulk, p2 = above->bulk, way = log(p2 / p1);
    bool flat = fabs(way) < 1e-5;
    double mean = flat ? (p1 + p2) / 2 : (p2 - p1) / way;
    double out = (above->pressure - below->pressure) / mean;
    double mean_below = flat ? 0.5 : (mean / p1 - 1) / way;
    double mean_above = flat ? 0.5 : (1 - mean / p2) / way;
    *slope_below = (-below->pressure_slope - out * mean_below) / mean * below->bulk_slope;
    *slope_above = (above->pressure_slope - out * mean_above) / mean * above->bulk_slope;
    return out;
}

static double *entry(const struct problem *q, size_t row, size_t face) {
    return &q->band[(row - 1) * q->width + (face + q->reach - row)];
}

static void add(const struct problem *q, size_t row, size_t face, double value) {
    if (face >= 1 && face < q->n)
        *entry(q, row, face) += value;
}

static void write_row(const struct problem *q, size_t j) {
    const struct hydrostatic_bed *bed = q->bed;
    double scale = bed->a_R / q->delta, z = q->floor + (double)j * q->delta;
    double half = bed->layer_R / 2, thickness = z + half - fmax(z - half, 0);
    size_t low = j > q->reach ? j - q->reach : 0;
    size_t high = j + q->reach < q->n ? j + q->reach : q->n;
    double lift = (q->column[low] - q->column[high]) / thickness - bed->phibar;
    double below, above, rise = climb(&q->cell[j], &q->cell[j + 1], &below, &above);
    q->rest[j - 1] = scale * rise - lift;
    add(q, j, j - 1, scale * below / q->delta);
    add(q, j, j, scale * (above - below) / q->delta);
    add(q, j, j + 1, -scale * above / q->delta);
    add(q, j, low, -1 / thickness);
    add(q, j, high, 1 / thickness);
}

/* Gauss with rows exchanged for the largest pivot; the step is left in rest. */
static bool eliminate(const struct problem *q) {
    size_t m = q->n - 1, reach = q->reach, wide = reach; /* 2 reach once rows were exchanged */
    for (size_t j = 1; j <= m; j++) {
        size_t last = j + reach < m ? j + reach : m, best = j;
        for (size_t i = j + 1; i <= last; i++)
            if (fabs(*entry(q, i, j)) > fabs(*entry(q, best, j)))
                best = i;
        if (!(fabs(*entry(q, best, j)) > 0))
            return false;
        wide = best != j ? 2 * reach : wide;
        size_t end = j + wide < m ? j + wide : m;
        for (size_t k = j; k <= end && best != j; k++) {
            double keep = *entry(q, j, k);
            *entry(q, j, k) = *entry(q, best, k);
            *entry(q, best, k) = keep;
        }
        double keep = q->rest[j - 1];
        q->rest[j - 1] = q->rest[best - 1];
        q->rest[best - 1] = keep;
        for (size_t i = j + 1; i <= last; i++) {
            double share = *entry(q, i, j) / *entry(q, j, j);
            if (share == 0)
                continue;
            for (size_t k = j; k <= end; k++)
                *entry(q, i, k) -= share * *entry(q, j, k);
            q->rest[i - 1] -= share * q->rest[j - 1];
        }
    }
    for (size_t j = m; j >= 1; j--) {
        size_t end = j + wide < m ? j + wide : m;
        for (size_t k = j + 1; k <= end; k++)
            q->rest[j - 1] -= *entry(q, j, k) * q->rest[k - 1];
        q->rest[j - 1] /= *entry(q, j, j);
    }
    return true;
}

static double step_of(const struct problem *q, size_t face) {
    return face >= 1 && face < q->n ? -q->rest[face - 1] : 0;
}

/* No cell may lose more than half of what it holds in a step.  Returns the largest relative change
 * of a cell. */
static double apply(const struct problem *q) {
    double share = 1, largest = 0;
    for (size_t c = 1; c <= q->n; c++) {
        double change = (step_of(q, c - 1) - step_of(q, c)) / (q->column[c - 1] - q->column[c]);
        largest = fmax(largest, fabs(change));
        if (change < 0)
            share = fmin(share, 0.5 / -change);
    }
    for (size_t j = 1; j < q->n; j++)
        q->column[j] += share * step_of(q, j);
    return largest;
}

static enum status iterate(const struct problem *q, struct fault *fault) {
    for (int round = 0; round < ROUNDS_MAX; round++) {
        memset(q->band, 0, (q->n - 1) * q->width * sizeof *q->band);
        for (size_t c = 1; c <= q->n; c++)
            look(q, c);
        for (size_t j = 1; j < q->n; j++)
            write_row(q, j);
        if (!eliminate(q))
            return fault_set(fault, STATUS_NUMERICAL, "a bed at rest: no step at round %d", round);
        double change = apply(q);
        if (!isfinite(change))
            break;
        if (change < 1e-8)
            return STATUS_OK;
    }
    return fault_set(fault, STATUS_NUMERICAL, "a bed at rest at phibar %g does not converge",
                     q->bed->phibar);
}

/* -- set-up ------------------------------------------------------------------------ */

static enum status check(const struct hydrostatic_bed *b, struct fault *fault) {
    bool wide = true;
    for (size_t a = 0; a < 2; a++)
        wide = wide && (!b->walls[a] || b->width_R[a] > 4);
    if (b->phibar > 0 && b->phibar < 0.6 && b->a_R > 0 && b->layer_R > 0 && wide &&
        b->column_R / b->phibar > b->layer_R && b->column_R < 1e6 && b->a_R < 1e4 &&
        !(b->spacing_R < 0) && (!b->local_temperature || b->heat_ratio >= 0))
        return STATUS_OK;
    return fault_set(fault, STATUS_BAD_INPUT,
                     "no bed: phibar %g, T/(m b') %g R, layer %g R, column %g R, sides %g and %g R",
                     b->phibar, b->a_R, b->layer_R, b->column_R, b->width_R[0], b->width_R[1]);
}

/* A spacing of a tenth of the edge's width or less, 12 a/(1 - phibar) as solved profiles have it.
 */
static size_t cells_in_half_layer(const struct hydrostatic_bed *b) {
    double wanted = b->spacing_R > 0 ? b->spacing_R : fmin(0.25, 1.2 * b->a_R / (1 - b->phibar));
    return (size_t)fmax(2, ceil(b->layer_R / 2 / wanted - 1e-9));
}

/* The tail of the dilute end, and a bulk of phibar: 1/(1 + exp x). */
static void first_guess(const struct problem *q, double tail) {
    const struct hydrostatic_bed *b = q->bed;
    double top = q->floor + b->column_R / b->phibar, total = 0;
    q->column[q->n] = 0;
    for (size_t c = q->n; c >= 1; c--) {
        double x = (q->floor + ((double)c - 0.5) * q->delta - top) / tail;
        q->column[c - 1] = q->column[c] + (x > 0 ? exp(-x) : 1) / (1 + exp(-fabs(x)));
    }
    total = q->column[0];
    for (size_t j = 0; j <= q->n; j++)
        q->column[j] *= b->column_R / total;
}

static enum status set_up(const struct hydrostatic_bed *b, struct problem *q, struct fault *fault) {
    double hottest = hydrostatic_temperature(b, 0), tail = b->a_R * hottest / b->phibar;
    *q = (struct problem){.bed = b, .reach = cells_in_half_layer(b)};
    q->delta = b->layer_R / 2 / (double)q->reach;
    q->home = hydrostatic_bulk_of(b, b->phibar);
    q->floor = b->floor ? hydrostatic_depth_R(q->home) : 0;
    double height = b->column_R / b->phibar + 40 * b->a_R * hottest + 30 * tail;
    double cells = ceil(height / q->delta);
    if (!(cells < CELLS_MAX))
        return fault_set(fault, STATUS_BAD_INPUT, "a bed at rest of %g cells is too fine", cells);
    q->n = (size_t)cells;
    q->width = 3 * q->reach + 2;
    q->column = calloc(q->n + 1, sizeof *q->column);
    q->rest = calloc(q->n, sizeof *q->rest);
    q->band = calloc(q->n * q->width, sizeof *q->band);
    q->cell = calloc(q->n + 1, sizeof *q->cell);
    if (!q->column || !q->rest || !q->band || !q->cell)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a bed of %zu cells", q->n);
    first_guess(q, tail);
    return STATUS_OK;
}

static enum status deliver(const struct problem *q, struct hydrostatic_profile *out,
                           struct fault *fault) {
    out->height_R = malloc(q->n * sizeof *out->height_R);
    out->fraction = malloc(q->n * sizeof *out->fraction);
    if (!out->height_R || !out->fraction)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a bed of %zu cells", q->n);
    out->count = q->n;
    out->spacing_R = q->delta;
    for (size_t c = 1; c <= q->n; c++) {
        out->height_R[c - 1] = q->floor + ((double)c - 0.5) * q->delta;
        out->fraction[c - 1] = fraction_in(q, c);
    }
    return STATUS_OK;
}

enum status hydrostatic_solve(const struct hydrostatic_bed *bed, struct hydrostatic_profile *out,
                              struct fault *fault) {
    struct problem q = {0};
    *out = (struct hydrostatic_profile){0};
    enum status status = check(bed, fault);
    if (!status)
        status = set_up(bed, &q, fault);
    if (!status)
        status = iterate(&q, fault);
    if (!status)
        status = deliver(&q, out, fault);
    if (status)
        hydrostatic_free(out);
    free(q.column);
    free(q.rest);
    free(q.band);
    free(q.cell);
    return status;
}

void hydrostatic_free(struct hydrostatic_profile *p) {
    free(p->height_R);
    free(p->fraction);
    *p = (struct hydrostatic_profile){0};
}
