/* figure_spheres.c -- the spheres of one run seen from the side, at several times and moving: FZ,
 * Fig. 3.
 *
 * Drawn is the first usable seed of the first point shown (choose it with `points:`); caption and
 * title say which, and the reading.  The view is along y, x to the right, nearest spheres in front.
 * Spheres keep the colour of the fifth of the bed in which they were at the first time
 * shown, counted from the floor.  The case must write particles/spheres/position, with its
 * observables or `also_write`.
 *
 * sphere-sequence    at `times` (s) since phibar changed, or since the start; without it six,
 *                    spread over what follows. A time not reached is left out and said; one between
 *                    two samples is a fault.
 * sphere-animation   all samples since then, or those at multiples of `every_s`, `frames` at the
 * most.
 *
 * Source:     Fiege & Zippelius, Fig. 3.
 * Leaves out: the box above the highest sphere shown.
 * Checked by: tests/unit/test_figure_beds.c.
 */
#include "validation/figure_beds.h"
#include "validation/figure_recipes.h"

#include <gsl/gsl_sort.h>
#include <math.h>

static const char POSITIONS[] = "particles/spheres/position";
static const double ROUND_R = 10; /* the picture's height is a multiple of it */

enum { STANDARD_PANELS = 6, MAX_PANELS = 24, MAX_FRAMES = 200 };
enum { TIMES };           /* settings of the sequence */
enum { EVERY_S, FRAMES }; /* of the animation */

struct shown {
    const struct figure_input *in;
    struct arena *arena;
    const struct measured_point *point;
    const struct measured_run *run;
    struct figure_bed bed;
    const struct series *place;
    size_t first;               /* sample of the change, or 0 */
    size_t *frame, frame_count; /* frame[0 .. frame_count-1]: samples shown */
    const char *missing;
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "spheres: out of memory");
}

/* -- which run and which samples -------------------------------------------- */

static enum status open_run(struct shown *s, struct fault *fault) {
    const struct measured_case *data = s->in->data;
    for (size_t i = 0; i < data->point_count && !s->run; i++) {
        s->point = &data->point[i];
        s->run = figure_bed_run(s->point);
    }
    if (!s->run)
        return fault_set(fault, STATUS_BAD_INPUT, "no run can be used");
    enum status status = figure_bed_open(s->run, &s->bed, fault);
    if (!status)
        status =
            observe_spheres_vectors(s->bed.view, "position", &s->bed.spheres, &s->place, fault);
    if (status)
        return status;
    while (s->first + 1 < s->place->frames && s->place->time[s->first] < s->bed.from_s * (1 - 1e-9))
        s->first++;
    s->missing = "";
    s->frame = arena_take(s->arena, s->place->frames + MAX_PANELS, sizeof *s->frame);
    return s->frame ? STATUS_OK : no_memory(fault);
}

static enum status take_times(struct shown *s, const struct case_figure_setting *times,
                              struct fault *fault) {
    if (times->count > MAX_PANELS)
        return fault_set(fault, STATUS_BAD_INPUT, "times: %zu are too many, %d can be shown",
                         times->count, (int)MAX_PANELS);
    for (size_t i = 0; i < times->count; i++) {
        double time = times->numbers[i];
        enum status status = STATUS_OK;
        if (figure_bed_reaches(&s->bed, s->place, time))
            status = figure_bed_frame(&s->bed, POSITIONS, s->place, time,
                                      &s->frame[s->frame_count++], fault);
        else
            s->missing = arena_text(s->arena, "%s%s %g", s->missing,
                                    *s->missing ? "," : " Not reached (s):", time);
        if (status || !s->missing)
            return status ? status : no_memory(fault);
    }
    if (*s->missing)
        s->missing = arena_text(s->arena, "%s.", s->missing);
    if (s->frame_count == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "times: the run reaches none of them");
    return s->missing ? STATUS_OK : no_memory(fault);
}

/* `count` samples spread evenly from the first one on, the last among them. */
static void take_spread(struct shown *s, size_t count) {
    size_t last = s->place->frames - 1 - s->first;
    count = count < last + 1 ? count : last + 1;
    for (size_t i = 0; i < count; i++)
        s->frame[i] =
            s->first + (count < 2 ? 0 : (size_t)llround((double)(i * last) / (double)(count - 1)));
    s->frame_count = count;
}

static enum status take_all(struct shown *s, double every, size_t most, struct fault *fault) {
    for (size_t f = s->first; f < s->place->frames; f++) {
        double time = s->place->time[f] - s->bed.from_s;
        if (every == 0 || fabs(time - every * nearbyint(time / every)) < 1e-3 * every)
            s->frame[s->frame_count++] = f;
    }
    if (s->frame_count == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "every_s: no sample at a multiple of %g s",
                         every);
    size_t stride = (s->frame_count + most - 1) / most, kept = 0;
    for (size_t i = 0; i < s->frame_count; i += stride)
        s->frame[kept++] = s->frame[i];
    s->frame_count = kept;
    return STATUS_OK;
}

/* -- what the report is given ----------------------------------------------- */

/* kind[sphere]: its fifth of the bed, from below, in the first frame shown. */
static enum status take_kinds(struct shown *s, struct report_sequence *out, struct fault *fault) {
    size_t n = s->bed.spheres.count;
    size_t *order = arena_take(s->arena, n, sizeof *order);
    unsigned char *kind = arena_take(s->arena, n, sizeof *kind);
    double *radius = arena_take(s->arena, n, sizeof *radius);
    if (!order || !kind || !radius)
        return no_memory(fault);
    gsl_sort_index(order, observe_spheres_at(s->place, s->frame[0], 0) + 2, 3, n);
    for (size_t i = 0; i < n; i++) {
        kind[order[i]] = (unsigned char)(i * REPORT_KINDS / n);
        radius[i] = 1;
    }
    out->count = n;
    out->kind = kind;
    out->radius = radius;
    return STATUS_OK;
}

/* The run is closed before the report is written: places are copied, in R. */
static enum status take_frame(struct shown *s, size_t number, struct report_frame *out,
                              double *highest_R, struct fault *fault) {
    size_t n = s->bed.spheres.count, frame = s->frame[number];
    double *position = arena_take(s->arena, 2 * n, sizeof *position);
    double *depth = arena_take(s->arena, n, sizeof *depth);
    if (!position || !depth)
        return no_memory(fault);
    for (size_t i = 0; i < n; i++) {
        const double *at = observe_spheres_at(s->place, frame, i);
        position[2 * i] = at[0] / s->bed.spheres.radius_m;
        position[2 * i + 1] = at[2] / s->bed.spheres.radius_m;
        depth[i] = at[1] / s->bed.spheres.radius_m;
        *highest_R = fmax(*highest_R, position[2 * i + 1] + 1);
    }
    double time = s->place->time[frame] - s->bed.from_s;
    *out = (struct report_frame){
        .time = fabs(time) < 1e-9 ? 0 : time, .position = position, .depth = depth};
    return STATUS_OK;
}

static enum status take_frames(struct shown *s, struct report_sequence *out, struct fault *fault) {
    struct report_frame *frame = arena_take(s->arena, s->frame_count, sizeof *frame);
    double highest = 0;
    enum status status = frame ? STATUS_OK : no_memory(fault);
    for (size_t i = 0; i < s->frame_count && !status; i++)
        status = take_frame(s, i, &frame[i], &highest, fault);
    out->frame = frame;
    out->frame_count = s->frame_count;
    out->width = s->bed.spheres.box_m[0] / s->bed.spheres.radius_m;
    out->height =
        fmin(ROUND_R * ceil(highest / ROUND_R), s->bed.spheres.box_m[2] / s->bed.spheres.radius_m);
    return status;
}

static enum status describe(struct shown *s, const char *kind, size_t number, const char *title,
                            struct report_sequence *out, struct fault *fault) {
    static const char *const label[REPORT_KINDS] = {"lowest fifth", "second", "middle", "fourth",
                                                    "highest fifth"};
    const struct case_figure *wanted = s->in->wanted;
    const double *box = s->bed.spheres.box_m;
    double r = s->bed.spheres.radius_m;
    for (size_t k = 0; k < REPORT_KINDS; k++)
        out->kind_label[k] = label[k];
    out->lit = true;
    out->time_unit = "s";
    out->length_unit = "R";
    out->name = arena_text(s->arena, "%s-%zu", kind, number);
    out->title = figure_bed_title(wanted->title ? wanted->title : title,
                                  figure_bed_reading(s->point), s->arena);
    out->alt = "Spheres in their box seen from the side, coloured by their height at the first "
               "time shown";
    out->caption =
        arena_text(s->arena,
                   "%s%s%zu spheres in a box of %g x %g x %g R, seen along its depth of %g R; the "
                   "picture ends "
                   "above the highest. Colours: fifths of the bed by height at %g s, which spheres "
                   "keep. Times "
                   "since %s. Seed %lld of %s (run %s).%s",
                   wanted->caption ? wanted->caption : "", wanted->caption ? " " : "", out->count,
                   box[0] / r, box[1] / r, box[2] / r, box[1] / r, out->frame[0].time,
                   s->bed.changes ? "phibar changed" : "the start", s->run->run->seed,
                   s->point->point->name, s->run->run->name, s->missing);
    return out->name && out->title && out->caption ? STATUS_OK : no_memory(fault);
}

static enum status fill(struct shown *s, const char *kind, size_t number, const char *title,
                        struct report_sequence *out, struct fault *fault) {
    enum status status = take_kinds(s, out, fault);
    if (!status)
        status = take_frames(s, out, fault);
    return status ? status : describe(s, kind, number, title, out, fault);
}

static enum status build_sequence(const struct figure_input *in, struct figure_output *out,
                                  struct fault *fault) {
    const struct case_figure_setting *times = &in->wanted->setting[TIMES];
    struct shown s = {.in = in, .arena = out->arena};
    struct report_sequence r = {0};
    enum status status = open_run(&s, fault);
    if (!status && times->given)
        status = take_times(&s, times, fault);
    else if (!status)
        take_spread(&s, STANDARD_PANELS);
    if (!status)
        status = fill(&s, "sphere-sequence", out->sequence_count + 1, "Spheres in time", &r, fault);
    if (!status)
        status = figure_add_sequence(out, &r, fault);
    run_view_close(s.bed.view);
    return status;
}

static enum status build_animation(const struct figure_input *in, struct figure_output *out,
                                   struct fault *fault) {
    const struct case_figure_setting *setting = in->wanted->setting;
    struct shown s = {.in = in, .arena = out->arena};
    struct report_sequence r = {0};
    enum status status = open_run(&s, fault);
    if (!status)
        status =
            take_all(&s, setting[EVERY_S].number, (size_t)lround(setting[FRAMES].number), fault);
    if (!status)
        status = fill(&s, "sphere-animation", out->animation_count + 1, "Animation", &r, fault);
    if (!status)
        status = figure_add_animation(out, &r, fault);
    run_view_close(s.bed.view);
    return status;
}

const struct figure_recipe figure_sphere_sequence = {
    .name = "sphere-sequence",
    .title = "All spheres of a run from the side at several times, coloured by initial height",
    .observables = 0,
    .setting = {{"times", "since phibar changed, or the start (s); without it six", FIGURE_NUMBERS,
                 false, 0, 0, 1e6}},
    .build = build_sequence,
};

const struct figure_recipe figure_sphere_animation = {
    .name = "sphere-animation",
    .title = "The same as an animation: a page with a player beside the report",
    .observables = 0,
    .setting = {{"every_s", "only samples at multiples of this; 0: all", FIGURE_NUMBER, false, 0, 0,
                 1e6},
                {"frames", "most frames taken, evenly", FIGURE_NUMBER, false, 61, 2, MAX_FRAMES}},
    .build = build_animation,
};
