/* beds_stage.h -- a case of the suspension with results of known content, for tests of its figures.
 */
#ifndef BEDS_STAGE_H
#define BEDS_STAGE_H

#include "tests/unit/case_stage.h"
#include "tests/unit/spheres_fixture.h"

enum { BEDS_SPHERES = 7, BEDS_BINS = 52, BEDS_FRAMES = 9, BEDS_SEEDS = 2 };
#define BEDS_RADIUS_M 3.7e-4

/* All points share two results, one a seed; their measurements are the test's to fill. */
struct beds_stage {
    struct case_file *c;
    struct plan *plan;
    struct measured_case *m;
    struct fake_run run[BEDS_SEEDS];
    char folder[BEDS_SEEDS][64], parent[64];
    struct figure_output *out;
    struct arena arena;
};

/* Fraction of a bin, collisions of all, place of a sphere over R: by frame (.1 s each) and seed. */
static inline double beds_fraction(size_t bin, size_t frame, size_t seed) {
    return bin < 36 ? .31 + .0013 * (double)bin + .0071 * (double)frame + .0037 * (double)seed : 0;
}

static inline double beds_collisions(size_t frame, size_t seed) {
    return 37 * (double)(frame * frame) + 5 * (double)seed;
}

static inline void beds_place(size_t sphere, size_t frame, double at[3]) {
    at[0] = 1.13 + .91 * (double)sphere;
    at[1] = 1.7 + .53 * (double)(sphere * 3 % 5);
    at[2] = 1.3 + 1.9 * (double)(sphere * 4 % 7) + .11 * (double)frame;
}

static inline void beds_write(struct fake_run *f, size_t seed, bool change) {
    char parameters[1024];
    snprintf(parameters, sizeof parameters,
             "  particles: %d\n  radius_m: %.17g\n  mass_kg: 2.3e-6\n  thermal_energy_J: 1.7e-9\n"
             "  packing_fraction: 0.3\n  width_x_R: 8.3\n  width_y_R: 7.1\n  height_R: 26\n"
             "  boundary_x: hard\n  boundary_y: hard\n  boundary_z: hard\n  layer_R: 9.7\n"
             "  temperature_scale: 1.3\n  drag_per_s: 4.9\n  restitution: 0.73\n  phibar: 0.31\n  "
             "exponent: 4.65\n"
             "  gravity_m_per_s2: 9.7\n  density_contrast: 0.57\n  drive_scale: 0.031\n"
             "  drive: linear\n  start: random\n%s",
             (int)BEDS_SPHERES, BEDS_RADIUS_M,
             change ? "  phibar_times_s: [0.2]\n  phibar_values: [0.41]\n" : "");
    *f = fake_start(parameters);
    for (size_t frame = 0; frame < BEDS_FRAMES; frame++) {
        double time = .1 * (double)frame, fraction[BEDS_BINS], place[3 * BEDS_SPHERES];
        for (size_t k = 0; k < BEDS_BINS; k++)
            fraction[k] = beds_fraction(k, frame, seed);
        for (size_t i = 0; i < BEDS_SPHERES; i++) {
            beds_place(i, frame, &place[3 * i]);
            for (size_t a = 0; a < 3; a++)
                place[3 * i + a] *= BEDS_RADIUS_M;
        }
        size_t bins = BEDS_BINS;
        fake_append(f, "profiles/packing_fraction", 1, &bins, fraction, time, 1e-6);
        spheres_counter(f, "collisions", beds_collisions(frame, seed), time);
        spheres_vectors(f, "position", BEDS_SPHERES, place, time);
    }
    unit_ok(h5_commit(f->writer, &f->fault), &f->fault);
}

static inline void beds_fill(struct beds_stage *s, struct measured_point *p) {
    for (size_t i = 0; i < p->run_count; i++) {
        struct measured_run *r = &p->run[i];
        r->run_path = s->run[i % BEDS_SEEDS].run;
        r->result_path = s->run[i % BEDS_SEEDS].result;
        r->observable = arena_take(&s->m->arena, s->c->observable_count + 1, sizeof *r->observable);
        for (size_t k = 0; k < s->c->observable_count; k++)
            for (size_t j = 0; j < RECIPE_MAX_OUTPUTS; j++)
                r->observable[k].value[j] = NAN;
    }
}

/* `text`: of the case fake/case; `readings`: of its model, or NULL.  `change`: phibar changes. */
static inline void beds_set_up(struct beds_stage *s, const char *text, const char *readings,
                               bool change) {
    struct fault fault;
    *s = (struct beds_stage){0};
    for (size_t i = 0; i < BEDS_SEEDS; i++) {
        beds_write(&s->run[i], i, change);
        snprintf(s->folder[i], sizeof s->folder[i], "%s", s->run[i].folder);
    }
    snprintf(s->parent, sizeof s->parent, "%s", unit_folder());
    ck_assert_int_eq(mkdir(unit_path(s->parent, "readings"), 0755), 0);
    if (readings)
        unit_write(unit_path(s->parent, "readings/suspension.yaml"), readings);
    s->c = stage_case(s->parent, "fake/case", text, &fault);
    unit_ok(fault.status, &fault);
    s->plan = stage_plan(s->c, TIER_SMOKE);
    s->m = stage_runs(s->plan);
    for (size_t p = 0; p < s->m->point_count; p++)
        beds_fill(s, &s->m->point[p]);
    s->out = arena_take(&s->arena, 1, sizeof *s->out);
    s->out->arena = &s->arena;
}

static inline void beds_tear_down(struct beds_stage *s) {
    measured_case_free(s->m);
    plan_free(s->plan);
    case_free(s->c);
    arena_free(&s->arena);
    for (size_t i = 0; i < BEDS_SEEDS; i++)
        unit_remove(s->folder[i]);
    unit_remove(s->parent);
}

static inline enum status beds_build(struct beds_stage *s, size_t figure, struct fault *fault) {
    return stage_figure(s->m, &s->c->figure[figure], s->c, s->out, fault);
}

static inline void beds_says(const char *text, const char *words) {
    ck_assert_msg(strstr(text, words) != NULL, "'%s' is not in: %s", words, text);
}

#endif
