/* figure_sequence.c -- the grains of one run at several times, side by side and as an animation.
 *
 * Drawn is the first usable seed of the first point shown (choose it with `points:`); the caption
 * says which.  Grains keep the colour of the layer that they started in: even species dark, odd
 * ones light.  The case must write particles/grains/species, with its observables or `also_write`.
 *
 * time-sequence, at `times` (tau), and animation, every `every_tau`, choose frames as
 * figure_frames.h says; a frame is at a time within half a step, `dt_tau`.
 *
 * Source:     MFM, Fig. 5.
 * Leaves out: the gas.
 * Checked by: tests/unit/test_figure_recipes.c.
 */
#include "validation/figure_frames.h"
#include "validation/figure_recipes.h"
#include "validation/observe.h"

#include <math.h>

enum { DEFAULT_FRAMES = 161, MAX_FRAMES = 400 };

struct shown {
    const struct figure_input *in;
    struct arena *arena;
    const struct measured_point *point;
    const struct measured_run *run;
    struct run_view *view;
    struct observe_box box;
    struct observe_grains grains;
    struct figure_frames frames;
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "time sequence: out of memory");
}

static enum status open_run(struct shown *s, bool moving, struct fault *fault) {
    double dt = 0;
    enum status status = figure_frames_run(s->in, &s->point, &s->run, fault);
    if (!status)
        status = run_view_open(s->run->run_path, s->run->result_path, &s->view, fault);
    if (!status)
        status = observe_box(s->view, &s->box, fault);
    if (!status)
        status = observe_grains(s->view, false, &s->grains, fault);
    if (!status)
        status = run_view_parameter(s->view, "dt_tau", &dt, fault);
    if (status)
        return status;
    s->frames = (struct figure_frames){.path = run_view_path(s->view),
                                       .unit = "tau",
                                       .time = s->grains.time,
                                       .frames = s->grains.frames,
                                       .slack = 0.5001 * dt};
    return figure_frames_choose(&s->frames, s->in->wanted, moving, s->arena, fault);
}

/* -- what the report is given ----------------------------------------------- */

static enum status take_grains(struct shown *s, struct report_sequence *out, struct fault *fault) {
    const double *species;
    size_t count, n = s->grains.count;
    enum status status =
        run_view_array(s->view, "particles/grains/species", &species, &count, fault);
    if (status)
        return status;
    if (count != n)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %zu species for %zu grains",
                         run_view_path(s->view), count, n);
    double *radius = arena_take(s->arena, n, sizeof *radius);
    unsigned char *kind = arena_take(s->arena, n, sizeof *kind);
    if (!radius || !kind)
        return no_memory(fault);
    for (size_t i = 0; i < n; i++) {
        radius[i] = s->grains.radius[i];
        kind[i] = fabs(fmod(species[i], 2)) > .5;
    }
    out->count = n;
    out->radius = radius;
    out->kind = kind;
    return STATUS_OK;
}

/* The run is closed before the report is written: places are copied. */
static enum status take_frames(struct shown *s, struct report_sequence *out, struct fault *fault) {
    struct report_frame *frame = arena_take(s->arena, s->frames.count, sizeof *frame);
    if (!frame)
        return no_memory(fault);
    for (size_t i = 0; i < s->frames.count; i++) {
        double *position = arena_take(s->arena, 2 * s->grains.count, sizeof *position);
        if (!position)
            return no_memory(fault);
        const double *from = observe_vector(s->grains.position, &s->grains, s->frames.shown[i], 0);
        for (size_t k = 0; k < 2 * s->grains.count; k++)
            position[k] = from[k];
        frame[i] =
            (struct report_frame){.time = figure_frames_time(&s->frames, i), .position = position};
    }
    out->frame = frame;
    out->frame_count = s->frames.count;
    return STATUS_OK;
}

static enum status describe(struct shown *s, const char *kind, size_t number, const char *title,
                            struct report_sequence *out, struct fault *fault) {
    const struct case_figure *wanted = s->in->wanted;
    const struct plan_run *run = s->run->run;
    out->time_unit = "tau";
    out->kind_label[0] = "dark layers";
    out->kind_label[1] = "light layers";
    out->ground_label = "gas";
    out->width = s->box.width_l;
    out->height = s->box.height_l;
    out->name = arena_text(s->arena, "%s-%zu", kind, number);
    out->title = wanted->title ? wanted->title : title;
    out->alt = "Grains in their box, coloured by the layer that they started in";
    out->caption = arena_text(
        s->arena,
        "%s%sGrains keep the colour of the layer that they started in. Box %g x %g l, seed %lld "
        "of %s (run %s).%s",
        wanted->caption ? wanted->caption : "", wanted->caption ? " " : "", s->box.width_l,
        s->box.height_l, run->seed, s->point->point->name, run->name, s->frames.missing);
    return out->name && out->caption ? STATUS_OK : no_memory(fault);
}

static enum status build(const struct figure_input *in, bool moving, struct figure_output *out,
                         struct fault *fault) {
    struct shown s = {.in = in, .arena = out->arena};
    struct report_sequence r = {0};
    enum status status = open_run(&s, moving, fault);
    if (!status)
        status = take_grains(&s, &r, fault);
    if (!status)
        status = take_frames(&s, &r, fault);
    if (!status)
        status = moving
                     ? describe(&s, "animation", out->animation_count + 1, "Animation", &r, fault)
                     : describe(&s, "time-sequence", out->sequence_count + 1, "Grains in time", &r,
                                fault);
    if (!status)
        status =
            moving ? figure_add_animation(out, &r, fault) : figure_add_sequence(out, &r, fault);
    run_view_close(s.view);
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

const struct figure_recipe figure_sequence_panels = {
    .name = "time-sequence",
    .title = "All grains of a run at several times, in the colours of their initial layers",
    .observables = 0,
    .setting = {{"times", "times shown (tau); without it six, spread over the run", FIGURE_NUMBERS,
                 false, 0, 0, 1e6}},
    .build = build_sequence,
};

const struct figure_recipe figure_sequence_animation = {
    .name = "animation",
    .title = "The same as an animation: a page with a player beside the report",
    .observables = 0,
    .setting = {{"every_tau", "only frames at multiples of this; 0: all", FIGURE_NUMBER, false, 0,
                 0, 1e6},
                {"frames", "most frames taken, evenly", FIGURE_NUMBER, false, DEFAULT_FRAMES, 2,
                 MAX_FRAMES}},
    .build = build_animation,
};
