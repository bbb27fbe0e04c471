/* components.c -- see components.h. */
#include "validation/components.h"

#include "validation/closures.h"

#include <math.h>
#include <stdlib.h>

/* What is added up over the sites of a region. */
struct component_sums {
    double weight, weight_x, weight_y; /* area times depth */
    double x, y, xx, yy;               /* moments of the control volumes (l^3, l^4) */
    double dome, bowl;                 /* T and B of the header */
    size_t column;                     /* the last column seen, from 1 */
    double top_l;                      /* upper edge in that column so far */
};

enum status components_create(struct components *c, size_t nx, size_t ny, struct fault *fault) {
    size_t sites = nx * ny, most = sites / 2 + 1; /* a chessboard has most regions */
    *c = (struct components){.nx = nx, .ny = ny};
    if (nx < 2 || ny < 2)
        return fault_set(fault, STATUS_BAD_INPUT, "a lattice of %zu x %zu sites has no regions", nx,
                         ny);
    c->list = calloc(most, sizeof *c->list);
    c->sums = calloc(most, sizeof *c->sums);
    c->label = calloc(sites, sizeof *c->label);
    c->stack = calloc(sites, sizeof *c->stack);
    if (c->list && c->sums && c->label && c->stack)
        return STATUS_OK;
    components_free(c);
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for the regions of %zu sites", sites);
}

void components_free(struct components *c) {
    if (!c)
        return;
    free(c->list);
    free(c->sums);
    free(c->label);
    free(c->stack);
    *c = (struct components){0};
}

/* The control volume of column or row i of n, along one axis. */
struct span {
    double low, high;
};

static struct span span_of(size_t i, size_t n) {
    return (struct span){fmax((double)i - 0.5, 0), fmin((double)i + 0.5, (double)n - 1)};
}

static void push(struct components *c, const double *field, double threshold, size_t site,
                 long label, size_t *depth) {
    if (c->label[site] >= 0 || !(field[site] < threshold))
        return;
    c->label[site] = label;
    c->stack[(*depth)++] = site;
}

/* Label all sites that are connected with `site`. */
static void fill(struct components *c, const double *field, double threshold, size_t site,
                 long label) {
    size_t depth = 0;
    push(c, field, threshold, site, label, &depth);
    while (depth) {
        size_t k = c->stack[--depth], i = k % c->nx, j = k / c->nx;
        if (i > 0)
            push(c, field, threshold, k - 1, label, &depth);
        if (i + 1 < c->nx)
            push(c, field, threshold, k + 1, label, &depth);
        if (j > 0)
            push(c, field, threshold, k - c->nx, label, &depth);
        if (j + 1 < c->ny)
            push(c, field, threshold, k + c->nx, label, &depth);
    }
}

/* Add one site to its region's area, extents, moments. */
static void add_site(struct components *c, size_t i, size_t j, double depth) {
    long label = c->label[j * c->nx + i];
    struct component *r = &c->list[label];
    struct component_sums *s = &c->sums[label];
    struct span x = span_of(i, c->nx), y = span_of(j, c->ny);
    double area = closure_site_volume(i, j, c->nx, c->ny), weight = area * depth;
    double mid_x = (x.low + x.high) / 2, mid_y = (y.low + y.high) / 2;
    double wide = x.high - x.low, high = y.high - y.low;
    r->left_l = r->sites ? fmin(r->left_l, x.low) : x.low;
    r->right_l = r->sites ? fmax(r->right_l, x.high) : x.high;
    r->bottom_l = r->sites ? fmin(r->bottom_l, y.low) : y.low;
    r->top_l = r->sites ? fmax(r->top_l, y.high) : y.high;
    r->sites++;
    r->area_l2 += area;
    r->walls |= (i == 0 ? COMPONENT_LEFT : 0u) | (i + 1 == c->nx ? COMPONENT_RIGHT : 0u) |
                (j == 0 ? COMPONENT_BOTTOM : 0u) | (j + 1 == c->ny ? COMPONENT_TOP : 0u);
    s->weight += weight;
    s->weight_x += weight * mid_x;
    s->weight_y += weight * mid_y;
    s->x += area * mid_x;
    s->y += area * mid_y;
    s->xx += area * (mid_x * mid_x + wide * wide / 12);
    s->yy += area * (mid_y * mid_y + high * high / 12);
}

/* Distance from an inner site to where the field reaches the threshold, towards an outer one. */
static double reach(const double *field, double threshold, size_t inner, size_t outer) {
    return (threshold - field[inner]) / (field[outer] - field[inner]);
}

/* Add a site's upper and lower edge, where it has them, to the bows of its region. */
static void add_edges(struct components *c, const double *field, double threshold, size_t i,
                      size_t j) {
    size_t k = j * c->nx + i;
    const struct component *r = &c->list[c->label[k]];
    struct component_sums *s = &c->sums[c->label[k]];
    double first = ceil(r->left_l), last = floor(r->right_l), columns = last - first + 1;
    double off = (double)i - (first + last) / 2, q = off * off - (columns * columns - 1) / 12;
    if (s->column != i + 1) { /* the region's first site in this column */
        s->bowl += q * (j ? (double)j - reach(field, threshold, k, k - c->nx) : 0);
        s->column = i + 1;
        s->top_l = 0;
    }
    if (j + 1 < c->ny && c->label[k + c->nx] >= 0) /* the region goes on */
        return;
    double top = j + 1 < c->ny ? (double)j + reach(field, threshold, k, k + c->nx) : (double)j;
    s->dome -= q * (top - s->top_l); /* takes the place of a lower edge of the same column */
    s->top_l = top;
}

static void conclude(struct component *r, const struct component_sums *s) {
    double x = s->x / r->area_l2, y = s->y / r->area_l2;
    double columns = floor(r->right_l) - ceil(r->left_l) + 1, bows = fabs(s->dome) + fabs(s->bowl);
    r->x_l = s->weight_x / s->weight;
    r->y_l = s->weight_y / s->weight;
    r->aspect = sqrt((s->yy / r->area_l2 - y * y) / (s->xx / r->area_l2 - x * x));
    /* Edges that are straight but for round-off have no bow. */
    r->flatness = bows > 1e-9 * r->area_l2 ? (s->dome - s->bowl) / bows : 0;
    if (columns < 3)
        r->flatness = NAN;
}

void components_find(struct components *c, const double *field, double threshold) {
    c->count = 0;
    for (size_t k = 0; k < c->nx * c->ny; k++)
        c->label[k] = -1;
    for (size_t k = 0; k < c->nx * c->ny; k++) {
        if (c->label[k] >= 0 || !(field[k] < threshold))
            continue;
        c->list[c->count] = (struct component){0};
        c->sums[c->count] = (struct component_sums){0};
        fill(c, field, threshold, k, (long)c->count++);
    }
    for (size_t j = 0; j < c->ny; j++)
        for (size_t i = 0; i < c->nx; i++)
            if (c->label[j * c->nx + i] >= 0)
                add_site(c, i, j, threshold - field[j * c->nx + i]);
    for (size_t i = 0; i < c->nx; i++) /* column by column, upwards */
        for (size_t j = 0; j < c->ny; j++)
            if (c->label[j * c->nx + i] >= 0)
                add_edges(c, field, threshold, i, j);
    for (size_t n = 0; n < c->count; n++)
        conclude(&c->list[n], &c->sums[n]);
}
