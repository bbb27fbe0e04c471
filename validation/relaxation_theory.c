/* relaxation_theory.c -- see relaxation_theory.h. */
#include "validation/relaxation_theory.h"

#include "validation/bed_track.h"

#include <math.h>
#include <stdlib.h>

enum { SAMPLES = 75 };

double relaxation_theory_window(const struct bed_change *change) {
    return 2 * change->load_m / (bed_change_slope(change) * change->after * change->after);
}

static struct bed_reading reading_of(const struct bed_change *c) {
    double top_R = c->load_m / fmin(c->before, c->after) / c->radius_m;
    return (struct bed_reading){.before = c->before,
                                .after = c->after,
                                .smooth_R = 1,
                                .bin_R = 1,
                                .bins = (size_t)ceil(1.2 * top_R + 40)};
}

/* time[0 .. count] begins with the change itself. */
static enum status find_squares(const struct bed_change *c, bool pressure, const double *time,
                                size_t count, double *square, struct fault *fault) {
    struct bed_reading r = reading_of(c);
    struct bed_track t = {0};
    double floor;
    double *profile = calloc((count + 1) * r.bins, sizeof *profile);
    enum status status =
        !profile   ? fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu profiles", count)
        : pressure ? bed_track_pressure(c, &r, time, count + 1, &t, profile, fault)
                   : bed_track_kinematic(c, &r, time, count + 1, &t, profile, fault);
    if (!status)
        status = relaxation_square(profile, count + 1, r.bins, r.bin_R, 1, square, &floor, fault);
    bed_track_free(&t);
    free(profile);
    return status;
}

enum status relaxation_theory_length(const struct bed_change *change, bool pressure,
                                     const double *time_s, size_t count, double *length,
                                     struct fault *fault) {
    double *time = calloc(2 * (count + 1), sizeof *time), *square = time + count + 1;
    if (!time)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for %zu times", count);
    for (size_t k = 0; k < count; k++)
        time[k + 1] = time_s[k];
    enum status status = find_squares(change, pressure, time, count, square, fault);
    for (size_t k = 0; !status && k < count; k++)
        length[k] = relaxation_length(square[k + 1]);
    free(time);
    return status;
}

enum status relaxation_theory_fit(const struct bed_change *change, bool pressure, double window_s,
                                  struct relaxation_fit *out, struct fault *fault) {
    double time[SAMPLES], length[SAMPLES];
    if (!(window_s > 0))
        window_s = relaxation_theory_window(change);
    for (size_t k = 0; k < SAMPLES; k++)
        time[k] = window_s * (double)(k + 1) / SAMPLES;
    enum status status = relaxation_theory_length(change, pressure, time, SAMPLES, length, fault);
    return status ? status : relaxation_fit(time, length, SAMPLES, out, fault);
}
