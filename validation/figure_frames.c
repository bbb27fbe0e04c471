/* figure_frames.c -- see figure_frames.h. */
#include "validation/figure_frames.h"

#include <math.h>

enum { STANDARD_PANELS = 6, MAX_PANELS = 24 };
enum { TIMES };         /* settings side by side */
enum { EVERY, FRAMES }; /* settings moving */

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "frames shown: out of memory");
}

enum status figure_frames_run(const struct figure_input *in, const struct measured_point **point,
                              const struct measured_run **run, struct fault *fault) {
    for (size_t i = 0; i < in->data->point_count; i++) {
        *point = &in->data->point[i];
        *run = figure_first_run(*point);
        if (*run)
            return STATUS_OK;
    }
    return fault_set(fault, STATUS_BAD_INPUT, "no run can be used");
}

double figure_frames_time(const struct figure_frames *f, size_t i) {
    double time = f->time[f->shown[i]] - f->from;
    return fabs(time) <= f->slack ? 0 : time;
}

/* -- side by side ----------------------------------------------------------- */

static bool reaches(const struct figure_frames *f, double time) {
    return f->from + time <= f->time[f->frames - 1] + f->slack;
}

static enum status take_time(struct figure_frames *f, double time, struct fault *fault) {
    for (size_t k = 0; k < f->frames; k++)
        if (fabs(f->time[k] - f->from - time) <= f->slack) {
            f->shown[f->count++] = k;
            return STATUS_OK;
        }
    return fault_set(fault, STATUS_NOT_FOUND, "%s: has no frame at %g %s%s", f->path, time, f->unit,
                     f->from > 0 ? " after the change" : "");
}

static enum status take_times(struct figure_frames *f, const struct case_figure_setting *times,
                              struct arena *a, struct fault *fault) {
    if (times->count > MAX_PANELS)
        return fault_set(fault, STATUS_BAD_INPUT, "times: %zu are too many, %d can be shown",
                         times->count, (int)MAX_PANELS);
    for (size_t i = 0; i < times->count; i++) {
        double time = times->numbers[i];
        enum status status = STATUS_OK;
        if (reaches(f, time))
            status = take_time(f, time, fault);
        else if (*f->missing)
            f->missing = arena_text(a, "%s, %g", f->missing, time);
        else
            f->missing = arena_text(a, " Not reached (%s): %g", f->unit, time);
        if (status || !f->missing)
            return status ? status : no_memory(fault);
    }
    if (f->count == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "times: the run reaches none of them");
    if (*f->missing)
        f->missing = arena_text(a, "%s.", f->missing);
    return f->missing ? STATUS_OK : no_memory(fault);
}

static size_t first_of(const struct figure_frames *f) {
    size_t first = 0;
    while (first + 1 < f->frames && f->time[first] < f->from - f->slack)
        first++;
    return first;
}

/* `count` frames spread evenly from the first one on, the last among them. */
static void take_spread(struct figure_frames *f, size_t count) {
    size_t first = first_of(f), last = f->frames - 1 - first;
    count = count < last + 1 ? count : last + 1;
    for (size_t i = 0; i < count; i++)
        f->shown[i] =
            first + (count < 2 ? 0 : (size_t)llround((double)(i * last) / (double)(count - 1)));
    f->count = count;
}

/* -- moving ----------------------------------------------------------------- */

static enum status take_all(struct figure_frames *f, double every, size_t most,
                            struct fault *fault) {
    for (size_t k = first_of(f); k < f->frames; k++) {
        double time = f->time[k] - f->from;
        if (every == 0 || fabs(time - every * nearbyint(time / every)) < 1e-3 * every)
            f->shown[f->count++] = k;
    }
    if (f->count == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "every_%s: no frame at a multiple of %g %s",
                         f->unit, every, f->unit);
    size_t stride = (f->count + most - 1) / most, kept = 0;
    for (size_t i = 0; i < f->count; i += stride)
        f->shown[kept++] = f->shown[i];
    f->count = kept;
    return STATUS_OK;
}

enum status figure_frames_choose(struct figure_frames *f, const struct case_figure *wanted,
                                 bool moving, struct arena *a, struct fault *fault) {
    const struct case_figure_setting *setting = wanted->setting;
    f->count = 0;
    f->missing = "";
    f->shown = arena_take(a, f->frames + MAX_PANELS, sizeof *f->shown);
    if (!f->shown)
        return no_memory(fault);
    if (moving)
        return take_all(f, setting[EVERY].number, (size_t)lround(setting[FRAMES].number), fault);
    if (setting[TIMES].given)
        return take_times(f, &setting[TIMES], a, fault);
    take_spread(f, STANDARD_PANELS);
    return STATUS_OK;
}
