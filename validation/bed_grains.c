/* bed_grains.c -- see bed_grains.h. */
#include "validation/bed_grains.h"

#include <math.h>
#include <stdlib.h>

/* Index along one axis of pieces of a length; the last one also holds the far wall. */
static size_t piece(double x, double length, size_t pieces) {
    size_t i = (size_t)(x / length);
    return i < pieces ? i : pieces - 1;
}

static size_t pieces_of(double size, double length) {
    return (size_t)ceil(size / length - 1e-9);
}

static enum status check_inside(struct run_view *v, const struct observe_grains *g,
                                const struct observe_box *box, size_t frame, size_t grain,
                                struct fault *fault) {
    const double *x = observe_vector(g->position, g, frame, grain);
    if (x[0] >= 0 && x[0] <= box->width_l && x[1] >= 0 && x[1] <= box->height_l)
        return STATUS_OK;
    return fault_set(fault, STATUS_BAD_INPUT,
                     "%s: grain %zu is at (%g, %g) l at %g tau: outside the box", run_view_path(v),
                     grain, x[0], x[1], g->time[frame]);
}

/* -- mixing ------------------------------------------------------------------- */

/* all[0 .. cells-1] grains of each cell, `ones` of them of species 1. */
static double lacey(const double *all, const double *ones, size_t cells) {
    double total = 0, one = 0, used = 0, square = 0;
    for (size_t c = 0; c < cells; c++) {
        total += all[c];
        one += ones[c];
        used += all[c] > 0;
    }
    double share = one / total, segregated = share * (1 - share);
    for (size_t c = 0; c < cells; c++)
        if (all[c] > 0) {
            double off = ones[c] / all[c] - share;
            square += all[c] * off * off / total;
        }
    double random = segregated * (used - 1) / (total - 1);
    return segregated > 0 ? (segregated - square) / (segregated - random) : NAN;
}

enum status bed_grains_mixing(struct run_view *v, const struct observe_grains *g,
                              const struct observe_box *box, const double *species, size_t frame,
                              double cell_l, double *mixing, struct fault *fault) {
    size_t across = pieces_of(box->width_l, cell_l), up = pieces_of(box->height_l, cell_l);
    size_t cells = across * up;
    enum status status = STATUS_OK;
    double *all = calloc(2 * cells, sizeof *all);
    if (!all)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu cells", cells);
    double *ones = all + cells;
    for (size_t i = 0; i < g->count; i++) {
        const double *x = observe_vector(g->position, g, frame, i);
        status = check_inside(v, g, box, frame, i, fault);
        if (status)
            goto done;
        size_t c = piece(x[1], cell_l, up) * across + piece(x[0], cell_l, across);
        all[c] += 1;
        ones[c] += species[i] != 0;
    }
    *mixing = lacey(all, ones, cells);
done:
    free(all);
    return status;
}

/* -- what never moved ---------------------------------------------------------- */

/* count[r] grains started in row r, sum[r] is what they moved in all (l). */
static double height_below(const double *count, const double *sum, size_t rows, double row_l,
                           double limit) {
    double below = 0, last = 0; /* the floor does not move */
    for (size_t r = 0; r < rows && count[r] > 0; r++) {
        double here = sum[r] / count[r], height = ((double)r + 0.5) * row_l;
        if (here >= limit)
            return last + (height - last) * (limit - below) / (here - below);
        below = here;
        last = height;
    }
    return last > 0 ? last + row_l / 2 : 0;
}

enum status bed_grains_layers(struct run_view *v, const struct observe_grains *g,
                              const struct observe_box *box, size_t start, size_t end, double row_l,
                              double limit_l, struct bed_grains_layers *out, struct fault *fault) {
    size_t rows = pieces_of(box->height_l, row_l);
    enum status status = STATUS_OK;
    double *count = calloc(3 * rows, sizeof *count);
    if (!count)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu rows", rows);
    double *moved = count + rows, *risen = moved + rows;
    for (size_t i = 0; i < g->count; i++) {
        const double *from = observe_vector(g->position, g, start, i);
        const double *to = observe_vector(g->position, g, end, i);
        status = check_inside(v, g, box, start, i, fault);
        if (status)
            goto done;
        size_t r = piece(from[1], row_l, rows);
        count[r] += 1;
        moved[r] += hypot(to[0] - from[0], to[1] - from[1]);
        risen[r] += to[1] - from[1];
    }
    out->still = height_below(count, moved, rows, row_l, limit_l);
    out->left = height_below(count, risen, rows, row_l, limit_l);
done:
    free(count);
    return status;
}
