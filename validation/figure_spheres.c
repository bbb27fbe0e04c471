/* figure_spheres.c -- the spheres of one run seen from the side, at several times and moving: FZ,
 * Fig. 3.
 *
 * Drawn is the first usable seed of the first point shown (choose it with `points:`); caption and
 * title say which, and the reading.  The view is along y, x to the right, nearest spheres in front.
 * Spheres keep the colour of the fifth of the bed in which they were at the first time
 * shown, counted from the floor.  The case must write particles/spheres/position, with its
 * observables or `also_write`.
 *
 * sphere-sequence, at `times` (s), and sphere-animation, every `every_s`, choose samples as
 * figure_frames.h says, since phibar changed or since the start.
 *
 * Source:     Fiege & Zippelius, Fig. 3.
 * Leaves out: the box above the highest sphere shown.
 * Checked by: tests/unit/test_figure_beds.c.
 */
#include "validation/figure_beds.h"
#include "validation/figure_frames.h"
#include "validation/figure_recipes.h"

#include <gsl/gsl_sort.h>
#include <math.h>

static const double ROUND_R = 10; /* the picture's height is a multiple of it */

enum { DEFAULT_FRAMES = 61, MAX_FRAMES = 200 };

struct shown {
    const struct figure_input *in;
    struct arena *arena;
    const struct measured_point *point;
    const struct measured_run *run;
    struct figure_bed bed;
    const struct series *place;
    struct figure_frames frames;
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "spheres: out of memory");
}

static enum status open_run(struct shown *s, bool moving, struct fault *fault) {
    enum status status = figure_frames_run(s->in, &s->point, &s->run, fault);
    if (!status)
        status = figure_bed_open(s->run, &s->bed, fault);
    if (!status)
        status =
            observe_spheres_vectors(s->bed.view, "position", &s->bed.spheres, &s->place, fault);
    if (status)
        return status;
    s->frames = (struct figure_frames){.path = run_view_path(s->bed.view),
                                       .unit = "s",
                                       .time = s->place->time,
                                       .frames = s->place->frames,
                                       .from = s->bed.from_s,
                                       .slack = figure_bed_slack(s->place)};
    return figure_frames_choose(&s->frames, s->in->wanted, moving, s->arena, fault);
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
    gsl_sort_index(order, observe_spheres_at(s->place, s->frames.shown[0], 0) + 2, 3, n);
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
    size_t n = s->bed.spheres.count, frame = s->frames.shown[number];
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
    *out = (struct report_frame){
        .time = figure_frames_time(&s->frames, number), .position = position, .depth = depth};
    return STATUS_OK;
}

static enum status take_frames(struct shown *s, struct report_sequence *out, struct fault *fault) {
    struct report_frame *frame = arena_take(s->arena, s->frames.count, sizeof *frame);
    double highest = 0;
    enum status status = frame ? STATUS_OK : no_memory(fault);
    for (size_t i = 0; i < s->frames.count && !status; i++)
        status = take_frame(s, i, &frame[i], &highest, fault);
    out->frame = frame;
    out->frame_count = s->frames.count;
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
                   s->point->point->name, s->run->run->name, s->frames.missing);
    return out->name && out->title && out->caption ? STATUS_OK : no_memory(fault);
}

static enum status build(const struct figure_input *in, bool moving, struct figure_output *out,
                         struct fault *fault) {
    struct shown s = {.in = in, .arena = out->arena};
    struct report_sequence r = {0};
    enum status status = open_run(&s, moving, fault);
    if (!status)
        status = take_kinds(&s, &r, fault);
    if (!status)
        status = take_frames(&s, &r, fault);
    if (!status)
        status = moving ? describe(&s, "sphere-animation", out->animation_count + 1, "Animation",
                                   &r, fault)
                        : describe(&s, "sphere-sequence", out->sequence_count + 1,
                                   "Spheres in time", &r, fault);
    if (!status)
        status =
            moving ? figure_add_animation(out, &r, fault) : figure_add_sequence(out, &r, fault);
    run_view_close(s.bed.view);
    return status;
}

static enum status build_sequence(const struct figure_input *in, struct figure_output *out,
                                  struct fault *fault) {
    return build(in, false, out, fault);
}

static enum status build_animation(const struct figure_input *in, struct figure_output *out,
                                   struct fault *fault) {
    return build(in, true, out, fault);
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
                {"frames", "most frames taken, evenly", FIGURE_NUMBER, false, DEFAULT_FRAMES, 2,
                 MAX_FRAMES}},
    .build = build_animation,
};
