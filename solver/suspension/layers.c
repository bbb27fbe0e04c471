#include "solver/suspension/layers.h"

#include <gsl/gsl_sort_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum status layers_create(struct layers *l, const struct layers_setup *s, struct fault *fault) {
    double bins = fmax(1, round(s->height_m / s->bin_m));
    *l = (struct layers){.thickness = s->thickness_m,
                         .height = s->height_m,
                         .rise = s->rise_m,
                         .periodic = s->periodic,
                         .count = s->count};
    if (!(bins < 1e8))
        return fault_set(fault, STATUS_BAD_INPUT, "%g bins of height are too many", bins);
    l->bins = (size_t)bins;
    l->below = calloc(l->bins + 1, sizeof *l->below);
    if (l->below)
        return STATUS_OK;
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu bins of height", (size_t)bins);
}

void layers_free(struct layers *l) {
    free(l->below);
    *l = (struct layers){0};
}

void layers_refresh(struct layers *l, const double *position) {
    double scale = (double)l->bins / l->height;
    memset(l->below, 0, (l->bins + 1) * sizeof *l->below);
    for (size_t i = 0; i < l->count; i++) {
        size_t k = (size_t)fmax(0, position[3 * i + 2] * scale);
        l->below[(k < l->bins ? k : l->bins - 1) + 1] += 1;
    }
    for (size_t k = 0; k < l->bins; k++)
        l->below[k + 1] += l->below[k];
}

/* Centres below z, which may lie up to one height outside a periodic box. */
static double interpolate(const struct layers *l, double z) {
    double turns = 0;
    if (z < 0) {
        turns = l->periodic ? -1 : 0;
        z = l->periodic ? z + l->height : 0;
    } else if (z >= l->height) {
        turns = l->periodic ? 1 : 0;
        z = l->periodic ? z - l->height : l->height;
    }
    double x = z * ((double)l->bins / l->height);
    size_t k = x < (double)l->bins ? (size_t)x : l->bins - 1;
    return turns * (double)l->count + l->below[k] +
           (x - (double)k) * (l->below[k + 1] - l->below[k]);
}

/* Part of the layer around z that lies inside the box (m). */
static double thickness_inside(const struct layers *l, double z) {
    double half = 0.5 * l->thickness;
    return l->periodic ? l->thickness : fmin(z + half, l->height) - fmax(z - half, 0);
}

double layers_fraction(const struct layers *l, double z) {
    double half = 0.5 * l->thickness;
    return (interpolate(l, z + half) - interpolate(l, z - half)) * l->rise / thickness_inside(l, z);
}

double layers_exact(const struct layers *l, const double *position, double z) {
    double half = 0.5 * l->thickness;
    size_t n = 0;
    for (size_t i = 0; i < l->count; i++) {
        double apart = fabs(position[3 * i + 2] - z);
        if (l->periodic && l->height - apart < apart)
            apart = l->height - apart;
        n += apart <= half;
    }
    return (double)n * l->rise / thickness_inside(l, z);
}

/* How many of sorted[0 .. count-1] are <= z, or < z. */
static double rank(const double *sorted, size_t count, double z, bool or_equal) {
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        bool under = or_equal ? sorted[middle] <= z : sorted[middle] < z;
        low = under ? middle + 1 : low;
        high = under ? high : middle;
    }
    return (double)low;
}

/* The same count as layers_exact, from sorted heights. */
static double exact_from_sorted(const struct layers *l, const double *sorted, double z) {
    double low = z - 0.5 * l->thickness, high = z + 0.5 * l->thickness;
    double n = rank(sorted, l->count, high, true) - rank(sorted, l->count, low, false);
    if (l->periodic && l->thickness >= l->height)
        n = (double)l->count;
    else if (l->periodic && high >= l->height)
        n += rank(sorted, l->count, high - l->height, true);
    else if (l->periodic && low < 0)
        n += (double)l->count - rank(sorted, l->count, low + l->height, false);
    return n * l->rise / thickness_inside(l, z);
}

enum status layers_error(const struct layers *l, const double *position, double *rms,
                         double *largest, struct fault *fault) {
    double sum = 0, *sorted = malloc((l->count + 1) * sizeof *sorted);
    if (!sorted)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu heights", l->count);
    *largest = 0;
    for (size_t i = 0; i < l->count; i++)
        sorted[i] = position[3 * i + 2];
    gsl_sort(sorted, 1, l->count);
    for (size_t i = 0; i < l->count; i++) {
        double z = position[3 * i + 2];
        double error = fabs(layers_fraction(l, z) - exact_from_sorted(l, sorted, z));
        sum += error * error;
        *largest = fmax(*largest, error);
    }
    *rms = l->count > 0 ? sqrt(sum / (double)l->count) : 0;
    free(sorted);
    return STATUS_OK;
}

double layers_mean(const struct layers *l) {
    double sum = 0, width = l->height / (double)l->bins;
    for (size_t k = 0; k < l->bins; k++) {
        double n = l->below[k + 1] - l->below[k];
        if (n > 0)
            sum += n * layers_fraction(l, ((double)k + 0.5) * width);
    }
    return l->count > 0 ? sum / (double)l->count : 0;
}
