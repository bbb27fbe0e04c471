/* observe_front.c -- how sharp the suspension's upper front is, and whether it stays so.
 *
 * The density profile is followed from the top down.  The front's width is the
 * distance between the heights where it first reaches 10 % and 90 % of the
 * plateau's density, each interpolated between two rows.  Its position is where
 * it first reaches 50 %.
 *
 * Source:     MFM, Section III: "the sharp front at the top of the vessel".
 * Leaves out: waves of the front along x: they count as width.
 * Checked by: graingas/sedimentation; tests/unit/test_observe_settling.c.
 */
#include "validation/observe_profile.h"
#include "validation/recipes.h"

#include <math.h>

enum { EARLY_TAU, LATE_TAU, ROW_L, MIN_ROWS };
enum { WIDTH_EARLY, WIDTH_LATE, GROWTH, FALL_SPEED };

/* Height where the profile, from the top down, first reaches `level`; NaN if never. */
static double height_of(const struct profile *p, double level) {
    double above = 0;
    for (size_t r = p->rows; r-- > 0;) {
        double here = p->solid_fraction[r];
        if (here >= level) {
            double share = here > above ? (level - above) / (here - above) : 1;
            return p->height[r] + (1 - share) * p->row_l;
        }
        above = here;
    }
    return NAN;
}

struct front {
    double width, position; /* (l); NaN where there is no plateau */
};

static enum status find_front(struct run_view *v, const struct observe_box *box,
                              const struct observe_grains *g, struct profile *p, double to_volume,
                              const double *settings, double time, struct front *out,
                              struct fault *fault) {
    size_t frame;
    out->width = out->position = NAN;
    if (!observe_reaches(g->series, time)) /* sampled for less long: no value, no fault */
        return STATUS_OK;
    enum status status =
        observe_frame(v, "particles/grains/position", g->series, time, &frame, fault);
    if (!status)
        status = profile_measure(p, v, box, g, to_volume, frame, fault);
    if (status)
        return status;
    struct plateau flat = profile_plateau(p, &PLATEAU_RULE);
    if ((double)flat.rows < settings[MIN_ROWS])
        return STATUS_OK;
    out->width = height_of(p, 0.1 * flat.solid_fraction) - height_of(p, 0.9 * flat.solid_fraction);
    out->position = height_of(p, 0.5 * flat.solid_fraction);
    return STATUS_OK;
}

static enum status measure(struct run_view *v, const double *settings, struct measurement *out,
                           struct fault *fault) {
    struct observe_box box;
    struct observe_grains g;
    struct profile p;
    struct front early, late;
    double to_volume;
    enum status status = observe_box(v, &box, fault);
    if (!status)
        status = observe_grains(v, true, &g, fault);
    if (!status)
        status = run_view_parameter(v, "area_to_volume", &to_volume, fault);
    if (!status)
        status = profile_create(&p, &box, settings[ROW_L], fault);
    if (status)
        return status;
    status = find_front(v, &box, &g, &p, to_volume, settings, settings[EARLY_TAU], &early, fault);
    if (!status)
        status = measurement_add_curve(out, "density profile", "early", p.height, p.solid_fraction,
                                       p.rows, fault);
    if (!status)
        status = find_front(v, &box, &g, &p, to_volume, settings, settings[LATE_TAU], &late, fault);
    if (!status)
        status = measurement_add_curve(out, "density profile", "late", p.height, p.solid_fraction,
                                       p.rows, fault);
    profile_free(&p);
    if (status)
        return status;
    out->value[WIDTH_EARLY] = early.width;
    out->value[WIDTH_LATE] = late.width;
    out->value[GROWTH] = late.width - early.width;
    out->value[FALL_SPEED] =
        (early.position - late.position) / (settings[LATE_TAU] - settings[EARLY_TAU]);
    const double when[] = {settings[EARLY_TAU], settings[LATE_TAU], settings[LATE_TAU],
                           settings[LATE_TAU]};
    for (size_t i = 0; i <= FALL_SPEED; i++)
        if (isnan(out->value[i]))
            observe_none(out, i, "no plateau of %g rows at %g tau, or no sample so late",
                         settings[MIN_ROWS], when[i]);
    return STATUS_OK;
}

static const char *const DATASETS[] = {"particles/grains/position", "particles/grains/velocity",
                                       "particles/grains/radius", NULL};
static const char *const CURVES[] = {"density profile", NULL};

const struct recipe recipe_front = {
    .name = "front",
    .title = "Width of the settling front",
    .source = "MFM, Section III and Fig. 3",
    .datasets = DATASETS,
    .setting = {{"early_tau", "tau", "first time", 20, 0, 1e6},
                {"late_tau", "tau", "second time", 40, 0, 1e6},
                {"row_l", "l", "height of a row", 1, 0.1, 10},
                {"min_rows", "1", "rows that the plateau below must have", 4, 1, 1000}},
    .output = {{"width_early", "l", "10-90 % width at early_tau"},
               {"width_late", "l", "10-90 % width at late_tau"},
               {"growth", "l", "how much wider it has become"},
               {"fall_speed", "U0", "speed of the 50 % height between the two, downwards"}},
    .curves = CURVES,
    .measure = measure,
};
