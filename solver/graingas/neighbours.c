#include "solver/graingas/neighbours.h"

#include <stdlib.h>
#include <string.h>

enum status neighbours_create(struct neighbours *n, size_t count, double width, double height,
                              double diameter_max, struct fault *fault) {
    *n = (struct neighbours){.width = width, .height = height, .count = count};
    n->skin = 0.2 * diameter_max;
    n->columns = (int)(width / (diameter_max + n->skin));
    n->rows = (int)(height / (diameter_max + n->skin));
    if (n->columns < 1)
        n->columns = 1;
    if (n->rows < 1)
        n->rows = 1;
    n->capacity = 4 * count + 16;
    n->cell_start = calloc((size_t)n->columns * (size_t)n->rows + 1, sizeof *n->cell_start);
    n->cell_of = calloc(count + 1, sizeof *n->cell_of);
    n->order = calloc(count + 1, sizeof *n->order);
    n->x = calloc(count + 1, sizeof *n->x);
    n->y = calloc(count + 1, sizeof *n->y);
    n->first = calloc(count + 1, sizeof *n->first);
    n->other = malloc(n->capacity * sizeof *n->other);
    if (n->cell_start && n->cell_of && n->order && n->x && n->y && n->first && n->other)
        return STATUS_OK;
    neighbours_free(n);
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for the neighbours of %zu grains", count);
}

void neighbours_free(struct neighbours *n) {
    free(n->cell_start);
    free(n->cell_of);
    free(n->order);
    free(n->x);
    free(n->y);
    free(n->first);
    free(n->other);
    *n = (struct neighbours){0};
}

static int clamp(int value, int count) {
    return value < 0 ? 0 : value >= count ? count - 1 : value;
}

/* Counting sort of the grains by cell; equal cells keep their order. */
static void sort_into_cells(struct neighbours *n, struct grains *g) {
    size_t cells = (size_t)n->columns * (size_t)n->rows;
    double per_x = n->columns / n->width, per_y = n->rows / n->height;
    int32_t *start = n->cell_start;
    memset(start, 0, (cells + 1) * sizeof *start);
    for (size_t i = 0; i < n->count; i++) {
        int cx = clamp((int)(g->x[i] * per_x), n->columns);
        int cy = clamp((int)(g->y[i] * per_y), n->rows);
        n->cell_of[i] = cy * n->columns + cx;
        start[n->cell_of[i] + 1]++;
    }
    for (size_t c = 0; c < cells; c++)
        start[c + 1] += start[c];
    for (size_t i = 0; i < n->count; i++)
        n->order[start[n->cell_of[i]]++] = (int32_t)i;
    memmove(start + 1, start, cells * sizeof *start); /* ends of cells back to starts */
    start[0] = 0;
    grains_permute(g, n->order);
}

static size_t collect_run(const struct neighbours *n, const struct grains *g, size_t i, size_t from,
                          size_t to, int32_t *out) {
    double x = g->x[i], y = g->y[i], reach = g->radius[i] + n->skin;
    size_t found = 0;
    for (size_t j = from; j < to; j++) {
        double dx = g->x[j] - x, dy = g->y[j] - y, near = reach + g->radius[j];
        out[found] = (int32_t)j;
        found += dx * dx + dy * dy < near * near;
    }
    return found;
}

static enum status make_room(struct neighbours *n, size_t needed, struct fault *fault) {
    if (needed <= n->capacity)
        return STATUS_OK;
    size_t capacity = 2 * needed;
    int32_t *grown = realloc(n->other, capacity * sizeof *grown);
    if (!grown)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu pairs", capacity);
    n->other = grown;
    n->capacity = capacity;
    return STATUS_OK;
}

/* The two runs of candidates of each grain in cell (cx, cy). */
static enum status collect_cell(struct neighbours *n, const struct grains *g, int cx, int cy,
                                size_t *pairs, struct fault *fault) {
    const int32_t *start = n->cell_start;
    int c = cy * n->columns + cx;
    int right = cx + 1 < n->columns ? c + 1 : c;
    bool top = cy + 1 == n->rows;
    int above_left = c + n->columns - (cx > 0), above_right = right + n->columns;
    size_t above = top ? 0 : (size_t)start[above_left];
    size_t above_end = top ? 0 : (size_t)start[above_right + 1];
    for (size_t i = (size_t)start[c]; i < (size_t)start[c + 1]; i++) {
        size_t end = (size_t)start[right + 1], candidates = end - i + above_end - above;
        if (make_room(n, *pairs + candidates, fault) != STATUS_OK)
            return fault->status;
        n->first[i] = *pairs;
        *pairs += collect_run(n, g, i, i + 1, end, n->other + *pairs);
        *pairs += collect_run(n, g, i, above, above_end, n->other + *pairs);
    }
    return STATUS_OK;
}

static bool is_stale(const struct neighbours *n, const struct grains *g) {
    double limit = 0.25 * n->skin * n->skin;
    if (!n->built)
        return true;
    for (size_t i = 0; i < n->count; i++) {
        double dx = g->x[i] - n->x[i], dy = g->y[i] - n->y[i];
        if (dx * dx + dy * dy > limit)
            return true;
    }
    return false;
}

enum status neighbours_update(struct neighbours *n, struct grains *g, struct fault *fault) {
    if (!is_stale(n, g))
        return STATUS_OK;
    sort_into_cells(n, g);
    size_t pairs = 0;
    for (int cy = 0; cy < n->rows; cy++)
        for (int cx = 0; cx < n->columns; cx++)
            if (collect_cell(n, g, cx, cy, &pairs, fault) != STATUS_OK)
                return fault->status;
    n->first[n->count] = pairs;
    memcpy(n->x, g->x, n->count * sizeof *n->x);
    memcpy(n->y, g->y, n->count * sizeof *n->y);
    n->rebuilds++;
    n->built = true;
    return STATUS_OK;
}
