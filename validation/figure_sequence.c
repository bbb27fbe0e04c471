/* figure_sequence.c -- the grains of one run at several times, side by side and as an animation.
 *
 * Drawn is the first usable seed of the first point shown (choose it with `points:`); the caption
 * says which.  Grains keep the colour of the layer that they started in: even species dark, odd
 * ones light.  The case must write particles/grains/species, with its observables or `also_write`.
 *
 * time-sequence   at the times of `times` (tau), or at six spread over the run.  A time that the
 *                 run does not reach is left out, and the caption says so; one that lies between
 *                 two frames is a fault.
 * animation       all frames, or those at multiples of `every_tau`, `frames` at the most.
 *
 * Source:     MFM, Fig. 5.
 * Leaves out: the gas.
 * Checked by: tests/unit/test_figure_recipes.c.
 */
#include "validation/figure_recipes.h"
#include "validation/observe.h"

#include <math.h>

static const char POSITIONS[] = "particles/grains/position";

enum { STANDARD_PANELS = 6, MAX_PANELS = 24, MAX_FRAMES = 400 };
enum { TIMES };             /* settings of the time sequence */
enum { EVERY_TAU, FRAMES }; /* settings of the animation */

struct shown {
    const struct figure_input *in;
    struct arena *arena;
    const struct measured_point *point;
    const struct measured_run *run;
    struct run_view *view;
    struct observe_box box;
    struct observe_grains grains;
    size_t *frame, frame_count; /* frame[0 .. frame_count-1]: frames of the run */
    const char *missing;        /* ", not reached: 50 tau", or empty */
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "time sequence: out of memory");
}

/* -- which run and which frames --------------------------------------------- */

static enum status choose_run(struct shown *s, struct fault *fault) {
    const struct measured_case *data = s->in->data;
    for (size_t i = 0; i < data->point_count && !s->run; i++)
        for (size_t k = 0; k < data->point[i].run_count && !s->run; k++)
            if (data->point[i].run[k].usable) {
                s->point = &data->point[i];
                s->run = &s->point->run[k];
            }
    return s->run ? STATUS_OK : fault_set(fault, STATUS_BAD_INPUT, "no run can be used");
}

static enum status open_run(struct shown *s, struct fault *fault) {
    enum status status = choose_run(s, fault);
    if (!status)
        status = run_view_open(s->run->run_path, s->run->result_path, &s->view, fault);
    if (!status)
        status = observe_box(s->view, &s->box, fault);
    if (!status)
        status = observe_grains(s->view, false, &s->grains, fault);
    if (status)
        return status;
    s->missing = "";
    s->frame = arena_take(s->arena, s->grains.frames + MAX_PANELS, sizeof *s->frame);
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
        if (observe_reaches(s->grains.series, time))
            status = observe_frame(s->view, POSITIONS, s->grains.series, time,
                                   &s->frame[s->frame_count++], fault);
        else
            s->missing = arena_text(s->arena, "%s%s %g", s->missing,
                                    *s->missing ? "," : " Not reached (tau):", time);
        if (status || !s->missing)
            return status ? status : no_memory(fault);
    }
    if (*s->missing)
        s->missing = arena_text(s->arena, "%s.", s->missing);
    if (s->frame_count == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "times: the run reaches none of them");
    return s->missing ? STATUS_OK : no_memory(fault);
}

/* `count` frames spread evenly over the run, first and last among them. */
static void take_spread(struct shown *s, size_t count) {
    size_t frames = s->grains.frames;
    count = count < frames ? count : frames;
    for (size_t i = 0; i < count; i++)
        s->frame[i] =
            count < 2 ? 0 : (size_t)llround((double)(i * (frames - 1)) / (double)(count - 1));
    s->frame_count = count;
}

static enum status take_all(struct shown *s, double every, size_t most, struct fault *fault) {
    for (size_t f = 0; f < s->grains.frames; f++) {
        double time = s->grains.time[f];
        if (every == 0 || fabs(time - every * nearbyint(time / every)) < 1e-3 * every)
            s->frame[s->frame_count++] = f;
    }
    if (s->frame_count == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "every_tau: no frame at a multiple of %g tau",
                         every);
    size_t stride = (s->frame_count + most - 1) / most, kept = 0;
    for (size_t i = 0; i < s->frame_count; i += stride)
        s->frame[kept++] = s->frame[i];
    s->frame_count = kept;
    return STATUS_OK;
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
    struct report_frame *frame = arena_take(s->arena, s->frame_count, sizeof *frame);
    if (!frame)
        return no_memory(fault);
    for (size_t i = 0; i < s->frame_count; i++) {
        double *position = arena_take(s->arena, 2 * s->grains.count, sizeof *position);
        if (!position)
            return no_memory(fault);
        const double *from = observe_vector(s->grains.position, &s->grains, s->frame[i], 0);
        for (size_t k = 0; k < 2 * s->grains.count; k++)
            position[k] = from[k];
        frame[i] = (struct report_frame){.time = s->grains.time[s->frame[i]], .position = position};
    }
    out->frame = frame;
    out->frame_count = s->frame_count;
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
        s->box.height_l, run->seed, s->point->point->name, run->name, s->missing);
    return out->name && out->caption ? STATUS_OK : no_memory(fault);
}

static enum status fill(struct shown *s, const char *kind, size_t number, const char *title,
                        struct report_sequence *out, struct fault *fault) {
    enum status status = take_grains(s, out, fault);
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
        status = fill(&s, "time-sequence", out->sequence_count + 1, "Grains in time", &r, fault);
    if (!status)
        status = figure_add_sequence(out, &r, fault);
    run_view_close(s.view);
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
            take_all(&s, setting[EVERY_TAU].number, (size_t)lround(setting[FRAMES].number), fault);
    if (!status)
        status = fill(&s, "animation", out->animation_count + 1, "Animation", &r, fault);
    if (!status)
        status = figure_add_animation(out, &r, fault);
    run_view_close(s.view);
    return status;
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
                {"frames", "most frames taken, evenly", FIGURE_NUMBER, false, 161, 2, MAX_FRAMES}},
    .build = build_animation,
};
