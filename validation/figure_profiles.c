/* figure_profiles.c -- packing fraction over height at several times: FZ, Figs. 1, 4, 5 and 6.
 *
 * A figure for each point shown; its title says which, and the reading.  Profiles are read from
 * profiles/packing_fraction, which the case must write, and averaged over seeds at equal times; the
 * band is their standard error.  Heights above the highest sphere are left out.
 *
 * `times`        since the change of phibar, or since the start where it stays; one that the run
 *                does not reach is left out, and the caption says so.
 * `collisions`   of each sphere since then, 2 N_coll/N: each seed's nearest sample, labelled by
 *                the mean number that it has. Two numbers of one sample are drawn once.
 * `theory`       kinematic (no pressure), pressure, or inertial (pressure and inertia), at the
 *                same times, of the first seed's parameters, from the functions that predictions
 *                and observables use.
 * `curve`        or a curve of the observable `of`, of the first usable seed.
 * `bin_R`        whole slabs of the run make a bin of about this height, 1 R if nothing is said.
 *
 * Source:     Fiege & Zippelius, Figs. 1, 4-6.
 * Checked by: tests/unit/test_figure_beds.c.
 */
#include "validation/figure_beds.h"
#include "validation/figure_recipes.h"
#include "validation/kinematic_wave.h"
#include "validation/pressure_wave.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

static const char PROFILES[] = "profiles/packing_fraction";

enum { COLOURS = 6, MAX_TIMES = 12, MAX_SEEDS = 256, MAX_SERIES = 3 * MAX_TIMES };
enum { TIMES, NUMBERS, THEORY, CURVE, BIN_R }; /* settings */

/* One time shown: fraction[seed*bins + bin]. */
struct moment {
    double asked, time_s, collisions; /* the last two: means over seeds */
    size_t seeds, frame;              /* frame: of the last seed read */
    double *fraction;
};

struct drawing {
    const struct figure_input *in;
    const struct measured_point *point;
    struct arena *arena;
    bool by_collisions, changes;
    size_t joined;           /* slabs of the run that make a bin */
    size_t bins, shown;      /* shown: up to the highest sphere */
    double bin_R, *height_R; /* height_R[0 .. bins-1], middles of bins */
    size_t moment_count, series_count, theories;
    struct moment moment[MAX_TIMES];
    const char *missing;
    struct report_series *series; /* room for MAX_SERIES */
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "profiles: out of memory");
}

/* -- samples ---------------------------------------------------------------- */

/* The first seed says how high and how fine. */
static enum status take_heights(struct drawing *d, const struct figure_bed *b,
                                const struct series *s, struct fault *fault) {
    double wanted_R = d->in->wanted->setting[BIN_R].number;
    double slab_R = b->spheres.box_m[2] / b->spheres.radius_m / (double)(s->size ? s->size : 1);
    size_t joined = (size_t)fmax(1, nearbyint(wanted_R / slab_R));
    if (s->rank != 1 || s->size < joined || (d->height_R && s->size / joined != d->bins))
        return fault_set(fault, STATUS_BAD_INPUT, "%s: %s has not the bins of other seeds",
                         run_view_path(b->view), PROFILES);
    if (d->height_R)
        return STATUS_OK;
    d->joined = joined;
    d->bins = s->size / joined;
    d->bin_R = (double)joined * slab_R;
    d->changes = b->changes;
    d->height_R = arena_take(d->arena, d->bins, sizeof *d->height_R);
    for (size_t k = 0; d->height_R && k < d->bins; k++)
        d->height_R[k] = ((double)k + .5) * d->bin_R;
    for (size_t i = 0; i < d->moment_count; i++)
        if (!(d->moment[i].fraction =
                  arena_take(d->arena, d->bins * d->point->run_count, sizeof(double))))
            return no_memory(fault);
    return d->height_R ? STATUS_OK : no_memory(fault);
}

/* The sample whose number of collisions since the origin is nearest. */
static enum status find_collisions(const struct figure_bed *b, const struct series *profiles,
                                   struct moment *m, struct fault *fault) {
    const struct series *count;
    size_t origin;
    enum status status = observe_values(b->view, "observables/collisions", 1, &count, fault);
    if (!status)
        status = observe_spheres_together(b->view, profiles, count, fault);
    if (!status)
        status = figure_bed_frame(b, "observables/collisions", count, 0, &origin, fault);
    if (status)
        return status;
    double each = 2 / (double)b->spheres.count, best = INFINITY;
    for (size_t f = origin; f < count->frames; f++) {
        double away = fabs(each * (count->value[f] - count->value[origin]) - m->asked);
        if (away < best) {
            best = away;
            m->frame = f;
        }
    }
    m->collisions += each * (count->value[m->frame] - count->value[origin]);
    return STATUS_OK;
}

/* *reached: the seed has the moment. */
static enum status find_sample(const struct drawing *d, const struct figure_bed *b,
                               const struct series *profiles, struct moment *m, bool *reached,
                               struct fault *fault) {
    *reached = d->by_collisions || figure_bed_reaches(b, profiles, m->asked);
    if (!*reached)
        return STATUS_OK;
    return d->by_collisions ? find_collisions(b, profiles, m, fault)
                            : figure_bed_frame(b, PROFILES, profiles, m->asked, &m->frame, fault);
}

static enum status take_seed(struct drawing *d, const struct measured_run *run,
                             struct fault *fault) {
    struct figure_bed b;
    const struct series *s;
    enum status status = figure_bed_open(run, &b, fault);
    if (status)
        return status;
    status = run_view_series(b.view, PROFILES, &s, fault);
    if (!status)
        status = take_heights(d, &b, s, fault);
    for (size_t i = 0; i < d->moment_count && !status; i++) {
        struct moment *m = &d->moment[i];
        bool reached;
        status = find_sample(d, &b, s, m, &reached, fault);
        if (status || !reached)
            continue;
        m->time_s += s->time[m->frame] - b.from_s;
        const double *slab = s->value + m->frame * s->size;
        for (size_t k = 0; k < d->bins; k++)
            m->fraction[m->seeds * d->bins + k] =
                gsl_stats_mean(slab + k * d->joined, 1, d->joined);
        m->seeds++;
    }
    run_view_close(b.view);
    return status;
}

/* Means of times; moments that no seed has, or that show the sample before, are taken out. */
static enum status finish_moments(struct drawing *d, struct fault *fault) {
    size_t kept = 0;
    d->missing = "";
    for (size_t i = 0; i < d->moment_count; i++) {
        struct moment m = d->moment[i];
        m.time_s /= (double)m.seeds;
        m.collisions /= (double)m.seeds;
        if (m.seeds > 0 && (kept == 0 || m.time_s > d->moment[kept - 1].time_s))
            d->moment[kept++] = m;
        else
            d->missing = arena_text(d->arena, "%s%s %g", d->missing,
                                    *d->missing        ? ","
                                    : d->by_collisions ? " No sample of its own (collisions):"
                                                       : " Not reached (s):",
                                    m.asked);
        if (!d->missing)
            return no_memory(fault);
    }
    d->moment_count = kept;
    if (*d->missing)
        d->missing = arena_text(d->arena, "%s.", d->missing);
    if (kept == 0)
        return fault_set(fault, STATUS_BAD_INPUT, "no run reaches any of the times");
    return d->missing ? STATUS_OK : no_memory(fault);
}

static enum status take_moments(struct drawing *d, struct fault *fault) {
    const struct case_figure_setting *setting = d->in->wanted->setting;
    const struct case_figure_setting *asked = &setting[setting[TIMES].given ? TIMES : NUMBERS];
    if (setting[TIMES].given == setting[NUMBERS].given)
        return fault_set(fault, STATUS_BAD_INPUT, "profiles: say either times or collisions");
    if (asked->count > MAX_TIMES)
        return fault_set(fault, STATUS_BAD_INPUT, "%zu profiles cannot be told apart, %d can",
                         asked->count, (int)MAX_TIMES);
    d->by_collisions = setting[NUMBERS].given;
    d->moment_count = asked->count;
    for (size_t i = 0; i < asked->count; i++)
        d->moment[i] = (struct moment){.asked = asked->numbers[i]};
    enum status status = STATUS_OK;
    for (size_t i = 0; i < d->point->run_count && !status; i++)
        if (d->point->run[i].usable)
            status = take_seed(d, &d->point->run[i], fault);
    return status ? status : finish_moments(d, fault);
}

/* -- series ----------------------------------------------------------------- */

/* Up to the highest bin with a sphere, and one more. */
static void find_shown(struct drawing *d) {
    for (size_t i = 0; i < d->moment_count; i++)
        for (size_t k = 0; k < d->moment[i].seeds * d->bins; k++)
            if (d->moment[i].fraction[k] > 0 && k % d->bins + 2 > d->shown)
                d->shown = k % d->bins + 2;
    d->shown = d->shown < d->bins ? d->shown : d->bins;
}

static struct report_series *next_series(struct drawing *d, size_t number) {
    struct report_series *s = &d->series[d->series_count++];
    bool grey = number == COLOURS; /* the seventh; theory of no moment is grey too, but dashed */
    *s = (struct report_series){.label = "",
                                .style = number <= COLOURS ? SERIES_LINE : SERIES_LINE_POINTS,
                                .colour = grey ? -1 : (int)(number % COLOURS),
                                .count = d->shown,
                                .x = d->height_R};
    return s;
}

static const char *label_of(const struct drawing *d, const struct moment *m) {
    return d->by_collisions
               ? arena_text(d->arena, "%.0f collisions, %.2g s", m->collisions, m->time_s)
               : arena_text(d->arena, "%g s", m->time_s);
}

static enum status add_moment(struct drawing *d, size_t number, struct fault *fault) {
    const struct moment *m = &d->moment[number];
    double *y = arena_take(d->arena, d->shown, sizeof *y);
    double *error = m->seeds > 1 ? arena_take(d->arena, d->shown, sizeof *error) : NULL;
    struct report_series *s = next_series(d, number);
    s->label = label_of(d, m);
    if (!y || (m->seeds > 1 && !error) || !s->label)
        return no_memory(fault);
    for (size_t k = 0; k < d->shown; k++) {
        y[k] = gsl_stats_mean(m->fraction + k, d->bins, m->seeds);
        if (error)
            error[k] =
                gsl_stats_sd_m(m->fraction + k, d->bins, m->seeds, y[k]) / sqrt((double)m->seeds);
    }
    s->y = y;
    s->error = error;
    return STATUS_OK;
}

/* -- theory ----------------------------------------------------------------- */

/* An entry of the key for all of theory, and room for its curve at a moment. */
static double *next_theory(struct drawing *d, size_t number) {
    double *y = arena_take(d->arena, d->bins, sizeof *y);
    struct report_series *s = next_series(d, number);
    s->style = SERIES_DASHED;
    s->y = y;
    d->theories++;
    return y;
}

static enum status add_kinematic(struct drawing *d, const struct bed_change *change, double bin_m,
                                 struct fault *fault) {
    struct kinematic_wave *w = NULL;
    enum status status = kinematic_wave_create(change, &w, fault);
    for (size_t i = 0; i < d->moment_count && !status; i++) {
        status = kinematic_wave_advance(w, fmax(d->moment[i].time_s, 0), fault);
        double *y = status ? NULL : next_theory(d, i);
        if (y)
            kinematic_wave_profile(w, bin_m, y, d->bins);
        else if (!status)
            status = no_memory(fault);
    }
    kinematic_wave_free(w);
    return status;
}

static enum status add_pressure(struct drawing *d, const struct bed_change *change, double bin_m,
                                struct fault *fault) {
    struct pressure_wave *w = NULL;
    enum status status = pressure_wave_create(change, change->radius_m / 2, &w, fault);
    if (!status && !change->sharp)
        status = pressure_wave_settle(w, fault);
    if (!status)
        pressure_wave_change(w);
    for (size_t i = 0; i < d->moment_count && !status; i++) {
        status = pressure_wave_advance(w, fmax(d->moment[i].time_s, 0), fault);
        double *y = status ? NULL : next_theory(d, i);
        if (y)
            pressure_wave_profile(w, bin_m, y, d->bins);
        else if (!status)
            status = no_memory(fault);
    }
    pressure_wave_free(w);
    return status;
}

static enum status add_wave(struct drawing *d, const char *theory, struct fault *fault) {
    struct figure_bed b;
    struct bed_change change;
    double change_s;
    enum status status = figure_bed_open(figure_first_run(d->point), &b, fault);
    if (status)
        return status;
    status = bed_change_read(b.view, &change, &change_s, fault);
    double bin_m = d->bin_R * b.spheres.radius_m;
    run_view_close(b.view);
    if (status)
        return status;
    if (strcmp(theory, "kinematic") == 0)
        return add_kinematic(d, &change, bin_m, fault);
    change.inertia = strcmp(theory, "inertial") == 0;
    if (change.inertia || strcmp(theory, "pressure") == 0)
        return add_pressure(d, &change, bin_m, fault);
    return fault_set(fault, STATUS_BAD_INPUT, "theory: kinematic, pressure or inertial, not \"%s\"",
                     theory);
}

static enum status add_curve(struct drawing *d, const char *name, struct fault *fault) {
    const struct curve *c;
    const struct measurement *m = &figure_first_run(d->point)->observable[d->in->observable[0]];
    for (size_t nth = 0; (c = figure_curve_find(m, name, nth)) != NULL; nth++) {
        if (d->series_count >= MAX_SERIES - 1)
            return fault_set(fault, STATUS_BAD_INPUT, "too many curves %s", name);
        struct report_series *s = next_series(d, 0);
        *s = (struct report_series){.label = "",
                                    .style = SERIES_DASHED,
                                    .colour = -1,
                                    .count = c->count,
                                    .x = c->x,
                                    .y = c->y};
        d->theories++;
    }
    return STATUS_OK;
}

/* For the key, where long entries take room, and for the caption. */
static const char *wave_name(const char *theory, bool in_full) {
    if (strcmp(theory, "kinematic") == 0)
        return "kinematic wave";
    if (strcmp(theory, "pressure") == 0)
        return in_full ? "wave with pressure" : "pressure wave";
    return in_full ? "wave with pressure and inertia" : "inertial wave";
}

/* Dashed curves and their one entry in the key. */
static enum status add_theory(struct drawing *d, struct fault *fault) {
    const struct case_figure_setting *setting = d->in->wanted->setting;
    enum status status = STATUS_OK;
    if (setting[THEORY].given)
        status = add_wave(d, setting[THEORY].text, fault);
    if (!status && setting[CURVE].given)
        status = add_curve(d, setting[CURVE].text, fault);
    if (status || d->theories == 0)
        return status;
    const char *label =
        setting[THEORY].given ? wave_name(setting[THEORY].text, false) : setting[CURVE].text;
    d->series[d->series_count++] =
        (struct report_series){.label = label, .style = SERIES_DASHED, .colour = -1};
    return STATUS_OK;
}

/* -- the figure ------------------------------------------------------------- */

static const char *caption_of(const struct drawing *d) {
    const char *own = d->in->wanted->caption;
    size_t seeds = d->moment[0].seeds;
    const char *origin = d->changes ? "since phibar changed" : "since the start";
    const char *mean =
        seeds > 1 ? arena_text(d->arena, "means over %zu seeds, with their standard error", seeds)
                  : "one seed";
    const struct case_figure_setting *wave = &d->in->wanted->setting[THEORY];
    const char *theory =
        d->theories == 0
            ? ""
            : arena_text(d->arena, " Dashed: theory%s%s, for the parameters of the first seed.",
                         wave->given ? ", the " : "",
                         wave->given ? wave_name(wave->text, true) : "");
    const char *what = d->by_collisions ? "Collisions are those of each sphere, two of a pair's "
                                          "one; each seed's nearest sample. "
                                        : "";
    return mean && theory
               ? arena_text(d->arena, "%s%sSolid: %s; times and collisions %s. %s%s%s%s",
                            own ? own : "", own ? " " : "", mean, origin, what,
                            "The floor is at 0: no centre is below R.", theory, d->missing)
               : NULL;
}

static double highest(const struct drawing *d) {
    double most = 0;
    for (size_t i = 0; i < d->series_count; i++)
        for (size_t k = 0; k < d->series[i].count; k++)
            most = fmax(most, d->series[i].y[k]);
    return most;
}

static enum status draw(struct drawing *d, struct figure_output *out, struct fault *fault) {
    const struct case_figure *wanted = d->in->wanted;
    struct report_panel *panel = arena_take(d->arena, 1, sizeof *panel);
    const char *point = figure_bed_text(d->in->data, d->point, NULL, d->arena);
    if (!panel || !point)
        return no_memory(fault);
    *panel = (struct report_panel){.y_label = "packing fraction",
                                   .y_max = 1.05 * highest(d),
                                   .series_count = d->series_count,
                                   .series = d->series};
    const char *title = wanted->title ? wanted->title : "Packing fraction over height";
    struct report_figure f = {
        .name = arena_text(d->arena, "profiles-%zu", out->figure_count + 1),
        .title = *point ? arena_text(d->arena, "%s (%s)", title, point) : title,
        .caption = caption_of(d),
        .alt = arena_text(d->arena, "Packing fraction over height at %zu times%s", d->moment_count,
                          d->theories ? ", with theory" : ""),
        .x_label = "height z (R)",
        .panel_count = 1,
        .panel = panel};
    if (!f.name || !f.title || !f.caption || !f.alt)
        return no_memory(fault);
    return figure_add(out, &f, fault);
}

static enum status build_point(const struct figure_input *in, const struct measured_point *p,
                               struct figure_output *out, struct fault *fault) {
    struct drawing d = {.in = in, .point = p, .arena = out->arena};
    d.series = arena_take(d.arena, MAX_SERIES, sizeof *d.series);
    if (!d.series)
        return no_memory(fault);
    enum status status = take_moments(&d, fault);
    if (status)
        return status;
    find_shown(&d);
    for (size_t i = 0; i < d.moment_count && !status; i++)
        status = add_moment(&d, i, fault);
    if (!status)
        status = add_theory(&d, fault);
    return status ? status : draw(&d, out, fault);
}

static enum status build(const struct figure_input *in, struct figure_output *out,
                         struct fault *fault) {
    enum status status = STATUS_OK;
    bool any = false;
    for (size_t i = 0; i < in->data->point_count && !status; i++)
        if (figure_first_run(&in->data->point[i])) {
            status = build_point(in, &in->data->point[i], out, fault);
            any = true;
        }
    if (!status && !any)
        status = fault_set(fault, STATUS_BAD_INPUT, "no run can be used");
    return status;
}

const struct figure_recipe figure_profiles = {
    .name = "profiles",
    .title = "Packing fraction over height at several times, with theory: one figure a point",
    .observables = 1,
    .optional = true,
    .setting = {{"times", "since phibar changed, or the start (s)", FIGURE_NUMBERS, false, 0, 0,
                 1e6},
                {"collisions", "or so many of each sphere since then", FIGURE_NUMBERS, false, 0, 0,
                 1e12},
                {"theory", "kinematic, pressure or inertial: waves at the same times", FIGURE_TEXT,
                 false, 0, 0, 0},
                {"curve", "a curve of the observable, drawn too", FIGURE_CURVE, false, 0, 0, 0},
                {"bin_R", "slabs of the run are joined to bins of about this (R)", FIGURE_NUMBER,
                 false, 1, 0, 1e6}},
    .build = build,
};
