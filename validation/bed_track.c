/* bed_track.c -- see bed_track.h. */
#include "validation/bed_track.h"

#include "validation/kinematic_wave.h"
#include "validation/pressure_wave.h"

#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdlib.h>

static const double PRESSURE_CELL_R = 0.5, GAP_LEAST_R = 20;

enum status bed_track_create(size_t count, struct bed_track *out, struct fault *fault) {
    *out = (struct bed_track){.count = count, .time_s = calloc(5 * count + 1, sizeof(double))};
    if (!out->time_s)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu profiles", count);
    out->centre_R = out->time_s + count;
    out->top_R = out->centre_R + count;
    out->front_R = out->top_R + count;
    out->rise = out->front_R + count;
    return STATUS_OK;
}

void bed_track_free(struct bed_track *t) {
    free(t->time_s);
    *t = (struct bed_track){0};
}

/* -- one profile -------------------------------------------------------------------- */

static void smooth(const struct bed_reading *r, const double *fraction, double *out) {
    long half = lround((r->smooth_R / r->bin_R - 1) / 2), bins = (long)r->bins;
    for (long i = 0; i < bins; i++) {
        long reach = half < i ? half : i;
        reach = reach < bins - 1 - i ? reach : bins - 1 - i;
        out[i] = 0;
        for (long k = i - reach; k <= i + reach; k++)
            out[i] += fraction[k] / (double)(2 * reach + 1);
    }
}

static double middle(const struct bed_reading *r, size_t bin) {
    return ((double)bin + 0.5) * r->bin_R;
}

/* Where the line from bin i to i + 1 has this level. */
static double cross(const struct bed_reading *r, const double *phi, size_t i, double level) {
    return middle(r, i) + r->bin_R * (level - phi[i]) / (phi[i + 1] - phi[i]);
}

static double find_top(const struct bed_reading *r, const double *phi) {
    double level = fmin(r->before, r->after) / 2;
    for (size_t i = r->bins - 1; i-- > 0;)
        if (phi[i] >= level && phi[i + 1] < level)
            return cross(r, phi, i, level);
    return NAN;
}

static size_t first_bin(const struct bed_reading *r) {
    return (size_t)ceil(r->above_R / r->bin_R);
}

static double find_front(const struct bed_reading *r, const double *phi) {
    double level = (r->before + r->after) / 2;
    bool dense = r->after > r->before;
    size_t i = first_bin(r);
    if (i + 1 >= r->bins || (phi[i] > level) != dense)
        return NAN;
    for (; i + 1 < r->bins; i++)
        if ((phi[i + 1] > level) != dense)
            return cross(r, phi, i, level);
    return NAN;
}

static double find_rise(const struct bed_reading *r, const double *phi) {
    double lowest = INFINITY, rise = 0;
    for (size_t i = first_bin(r); i < r->bins; i++) {
        lowest = fmin(lowest, phi[i]);
        rise = fmax(rise, phi[i] - lowest);
    }
    return rise;
}

void bed_track_read(struct bed_track *t, size_t at, double time_s, const struct bed_reading *r,
                    const double *fraction, double *scratch) {
    double sum = 0, moment = 0;
    for (size_t i = 0; i < r->bins; i++) {
        sum += fraction[i];
        moment += fraction[i] * middle(r, i);
    }
    smooth(r, fraction, scratch);
    t->time_s[at] = time_s;
    t->centre_R[at] = moment / sum;
    t->top_R[at] = find_top(r, scratch);
    t->front_R[at] = find_front(r, scratch);
    t->rise[at] = find_rise(r, scratch);
}

/* -- theory ---------------------------------------------------------------------------- */

struct theory {
    struct kinematic_wave *kinematic; /* one of the two */
    struct pressure_wave *pressure;
};

static enum status create(const struct bed_change *c, bool pressure, struct theory *w,
                          struct fault *fault) {
    if (!pressure)
        return kinematic_wave_create(c, &w->kinematic, fault);
    enum status status =
        pressure_wave_create(c, PRESSURE_CELL_R * c->radius_m, &w->pressure, fault);
    if (!status && !c->sharp)
        status = pressure_wave_settle(w->pressure, fault);
    if (!status)
        pressure_wave_change(w->pressure);
    return status;
}

static enum status follow(const struct bed_change *c, const struct bed_reading *r, bool pressure,
                          struct bed_track *out, double *profile, struct fault *fault) {
    struct theory w = {NULL, NULL};
    double *own = calloc(2 * r->bins + 1, sizeof *own);
    enum status status = own ? create(c, pressure, &w, fault)
                             : fault_set(fault, STATUS_NO_MEMORY, "no memory for profiles");
    for (size_t k = 0; !status && k < out->count; k++) {
        double *phi = profile ? profile + k * r->bins : own, bin_m = r->bin_R * c->radius_m;
        status = pressure ? pressure_wave_advance(w.pressure, out->time_s[k], fault)
                          : kinematic_wave_advance(w.kinematic, out->time_s[k], fault);
        if (status)
            break;
        if (pressure)
            pressure_wave_profile(w.pressure, bin_m, phi, r->bins);
        else
            kinematic_wave_profile(w.kinematic, bin_m, phi, r->bins);
        bed_track_read(out, k, out->time_s[k], r, phi, own + r->bins);
    }
    kinematic_wave_free(w.kinematic);
    pressure_wave_free(w.pressure);
    free(own);
    return status;
}

static enum status make(const struct bed_change *c, const struct bed_reading *r, bool pressure,
                        const double *time_s, size_t count, struct bed_track *out, double *profile,
                        struct fault *fault) {
    enum status status = bed_track_create(count, out, fault);
    if (status)
        return status;
    for (size_t k = 0; k < count; k++)
        out->time_s[k] = time_s[k];
    status = follow(c, r, pressure, out, profile, fault);
    if (status)
        bed_track_free(out);
    return status;
}

enum status bed_track_kinematic(const struct bed_change *change, const struct bed_reading *r,
                                const double *time_s, size_t count, struct bed_track *out,
                                double *profile, struct fault *fault) {
    return make(change, r, false, time_s, count, out, profile, fault);
}

enum status bed_track_pressure(const struct bed_change *change, const struct bed_reading *r,
                               const double *time_s, size_t count, struct bed_track *out,
                               double *profile, struct fault *fault) {
    return make(change, r, true, time_s, count, out, profile, fault);
}

/* -- times ------------------------------------------------------------------------------ */

double bed_track_time(const struct bed_track *t, double start_R, double end_R, double share) {
    double last = 0, last_s = 0;
    for (size_t k = 0; k < t->count; k++) {
        double gone = (t->centre_R[k] - start_R) / (end_R - start_R);
        if (gone >= share && t->time_s[k] > 0)
            return last_s + (t->time_s[k] - last_s) * (share - last) / (gone - last);
        if (t->time_s[k] >= 0) {
            last = gone;
            last_s = t->time_s[k];
        }
    }
    return NAN;
}

double bed_track_meeting(const struct bed_track *t) {
    double start = t->count > 0 ? t->top_R[0] : NAN, c0, c1, c00, c01, c11, sum;
    double *x = calloc(2 * t->count + 1, sizeof *x), *y = x + t->count;
    size_t n = 0;
    for (size_t k = 0; x && k < t->count; k++) {
        double gap = (t->top_R[k] - t->front_R[k]) / start;
        if (t->time_s[k] > 0 && gap > 0.2 && gap < 0.8) {
            x[n] = t->time_s[k];
            y[n++] = gap;
        }
    }
    double meeting = NAN;
    if (n >= 3) {
        gsl_fit_linear(x, 1, y, 1, n, &c0, &c1, &c00, &c01, &c11, &sum);
        meeting = -c0 / c1;
    }
    free(x);
    return meeting;
}

/* -- against theory --------------------------------------------------------------------- */

static double largest_distance(const double *seen, const double *theory, const bool *use,
                               size_t count) {
    double largest = NAN;
    for (size_t k = 0; k < count; k++)
        if (use[k] && !isnan(seen[k]) && !isnan(theory[k]))
            largest = fmax(largest, fabs(seen[k] - theory[k]));
    return largest;
}

enum status bed_track_distances(const struct bed_track *seen, size_t skip,
                                const struct bed_track *theory, double share, double distance_R[3],
                                struct fault *fault) {
    size_t count = theory->count;
    bool *moving = calloc(2 * count + 1, sizeof *moving), *apart = moving + count;
    if (!moving)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu samples", count);
    double end = bed_track_time(theory, theory->centre_R[0], theory->centre_R[count - 1], share);
    for (size_t k = 1; k < count; k++) {
        moving[k] = isnan(end) || theory->time_s[k] <= end;
        apart[k] = moving[k] && theory->top_R[k] - theory->front_R[k] > GAP_LEAST_R;
    }
    distance_R[0] = largest_distance(seen->centre_R + skip, theory->centre_R, moving, count);
    distance_R[1] = largest_distance(seen->top_R + skip, theory->top_R, moving, count);
    distance_R[2] = largest_distance(seen->front_R + skip, theory->front_R, apart, count);
    free(moving);
    return STATUS_OK;
}

enum status bed_track_curve(const struct bed_track *t, const double *y, const char *name,
                            const char *label, struct measurement *out, struct fault *fault) {
    if (t->count == 0)
        return STATUS_OK;
    double *own = calloc(2 * t->count, sizeof *own);
    size_t n = 0;
    if (!own)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a curve");
    for (size_t k = 0; k < t->count; k++)
        if (!isnan(y[k])) {
            own[n] = t->time_s[k];
            own[t->count + n++] = y[k];
        }
    enum status status = measurement_add_curve(out, name, label, own, own + t->count, n, fault);
    free(own);
    return status;
}
