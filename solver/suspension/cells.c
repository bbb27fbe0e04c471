/* cells.c -- see cells.h. */
#include "solver/suspension/cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS_A_SPHERE = 2, CELLS_AT_LEAST = 64 };

/* Cells of at least `least`, along a thin axis one; two along a periodic one. */
static double count_cells(struct cells *c, const double extent[3], double least) {
    double total = 1;
    for (int a = 0; a < 3; a++) {
        double n = fmin(floor(extent[a] / least), CELLS_MOST);
        c->n[a] = (uint32_t)fmax(n, c->periodic[a] ? 2 : 1);
        total *= c->n[a];
    }
    return total;
}

static enum status make_edges(struct cells *c, const double low[3], const double high[3]) {
    for (int a = 0; a < 3; a++) {
        c->edge[a] = malloc((c->n[a] + 1) * sizeof *c->edge[a]);
        if (!c->edge[a])
            return STATUS_NO_MEMORY;
        for (uint32_t k = 0; k <= c->n[a]; k++)
            c->edge[a][k] = low[a] + (high[a] - low[a]) * k / c->n[a];
        c->edge[a][c->n[a]] = high[a];
    }
    return STATUS_OK;
}

enum status cells_create(struct cells *c, size_t count, const double low[3], const double high[3],
                         const bool periodic[3], double least, struct fault *fault) {
    double extent[3], most = fmax(CELLS_AT_LEAST, CELLS_A_SPHERE * (double)count);
    *c = (struct cells){.total = 0};
    for (int a = 0; a < 3; a++) {
        c->periodic[a] = periodic[a];
        extent[a] = c->side[a] = high[a] - low[a];
    }
    /* A dilute system has larger cells rather than many empty ones; 9/8 a turn does. */
    double total = count_cells(c, extent, least);
    for (double larger = least; total > most && total > 8; total = count_cells(c, extent, larger))
        larger *= 1.125;
    c->total = (uint32_t)total;
    c->spare = (uint32_t)(count / 3 + 2);
    c->label = spheres_memory(((size_t)c->total + c->spare) * CELL_LABELS * sizeof *c->label);
    if (!c->label || make_edges(c, low, high) != STATUS_OK) {
        cells_free(c);
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for the cells of %zu spheres", count);
    }
    cells_clear(c);
    return STATUS_OK;
}

void cells_free(struct cells *c) {
    for (int a = 0; a < 3; a++)
        free(c->edge[a]);
    free(c->label);
    *c = (struct cells){.total = 0};
}

size_t cells_bytes(const struct cells *c) {
    size_t edges = c->n[0] + c->n[1] + c->n[2] + 3;
    return ((size_t)c->total + c->spare) * CELL_LABELS * sizeof *c->label + edges * sizeof(double);
}

/* Free blocks form a chain through their first labels. */
void cells_clear(struct cells *c) {
    memset(c->label, 0xff, ((size_t)c->total + c->spare) * CELL_LABELS * sizeof *c->label);
    for (uint32_t k = 0; k < c->spare; k++)
        c->label[CELL_LABELS * (size_t)(c->total + k)] = c->total + k + 1;
    c->free_block = c->total;
}

uint16_t cells_find(const struct cells *c, int axis, double x) {
    const double *edge = c->edge[axis];
    uint32_t last = c->n[axis] - 1;
    double guess = floor((x - edge[0]) / (edge[last + 1] - edge[0]) * c->n[axis]);
    uint32_t k = guess > 0 ? (guess < last ? (uint32_t)guess : last) : 0;
    while (k > 0 && x < edge[k])
        k--;
    while (k < last && x >= edge[k + 1])
        k++;
    return (uint16_t)k;
}

static inline bool is_link(uint32_t label) {
    return (label & CELLS_LINK) != 0 && label != CELLS_EMPTY;
}

void cells_insert(struct cells *c, uint32_t cell, uint32_t sphere) {
    uint32_t *label = c->label + CELL_LABELS * (size_t)cell;
    while (is_link(label[3]))
        label = c->label + CELL_LABELS * (size_t)(label[3] & ~CELLS_LINK);
    for (int k = 0; k < CELL_LABELS; k++)
        if (label[k] == CELLS_EMPTY) {
            label[k] = sphere;
            return;
        }
    uint32_t block = c->free_block, *more = c->label + CELL_LABELS * (size_t)block;
    c->free_block = more[0];
    more[0] = label[3];
    more[1] = sphere;
    label[3] = CELLS_LINK | block;
}

/* Take out the last label of a cell; a block left with one gives it to the one before. */
static uint32_t take_last(struct cells *c, uint32_t cell) {
    uint32_t *before = NULL, *label = c->label + CELL_LABELS * (size_t)cell;
    while (is_link(label[3])) {
        before = label;
        label = c->label + CELL_LABELS * (size_t)(label[3] & ~CELLS_LINK);
    }
    int k = CELL_LABELS - 1;
    while (k > 0 && label[k] == CELLS_EMPTY)
        k--;
    uint32_t last = label[k];
    label[k] = CELLS_EMPTY;
    if (before != NULL && k == 1) {
        uint32_t block = before[3] & ~CELLS_LINK;
        before[3] = label[0];
        label[0] = c->free_block;
        c->free_block = block;
    }
    return last;
}

void cells_remove(struct cells *c, uint32_t cell, uint32_t sphere) {
    uint32_t last = take_last(c, cell), *label = c->label + CELL_LABELS * (size_t)cell;
    if (last == sphere)
        return;
    for (;;) {
        for (int k = 0; k < CELL_LABELS; k++)
            if (label[k] == sphere) {
                label[k] = last;
                return;
            }
        label = c->label + CELL_LABELS * (size_t)(label[3] & ~CELLS_LINK);
    }
}

void cells_renumber(struct cells *c, uint32_t *place) {
    uint32_t next = 0;
    for (uint32_t cell = 0; cell < c->total; cell++) {
        uint32_t *label = c->label + CELL_LABELS * (size_t)cell;
        for (int k = 0; k < CELL_LABELS && label[k] != CELLS_EMPTY; k++) {
            if (is_link(label[k])) {
                label = c->label + CELL_LABELS * (size_t)(label[k] & ~CELLS_LINK);
                k = -1;
                continue;
            }
            place[label[k]] = next;
            label[k] = next++;
        }
    }
}
