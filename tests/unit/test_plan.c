/* test_plan.c -- validation/plan.h: points, seeds, shared runs and starts. */
#include "common/runfile.h"
#include "tests/unit/unit.h"
#include "validation/plan.h"

#include <sys/stat.h>

static const char head[] = "title: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
                           "observables: {bed: {recipe: contacts}}\n"
                           "checks: [{name: c, observable: bed.sweeps_max, expect: 1, margin: 1, "
                           "kind: model, because: b}]\n";

static struct case_file *load(const char *name, const char *rest) {
    struct fault fault = FAULT_NONE;
    struct case_file *c;
    const char *folder = unit_folder(), *path = unit_path(folder, "");
    char file[256];
    ck_assert_int_eq(mkdir(unit_path(folder, "fake"), 0755), 0);
    snprintf(file, sizeof file, "%s%s.yaml", path, name);
    FILE *out = fopen(file, "w");
    ck_assert_ptr_nonnull(out);
    fprintf(out, "name: %s\n%s%s", name, head, rest);
    fclose(out);
    unit_ok(case_load(folder, name, &c, &fault), &fault);
    unit_remove(folder);
    return c;
}

static const char steady[] = "parameters: {grains: 137, label: 'a: \"b\"', bands: [.31, 0.2]}\n"
                             "sweep: {height_l: [58, 64], start: [random, lattice]}\n"
                             "samples: [0, 1.37e-3]\n"
                             "seeds: {first: 1101, count: [{points: {start: random}, count: 3}, "
                             "{count: 1}]}\n"
                             "tiers: {smoke: {}}\n";

static struct plan *plan_of(struct case_file *const *all, size_t count, size_t selected,
                            long long offset, struct fault *fault) {
    struct plan_order order[4] = {{0}};
    struct plan *p = NULL;
    *fault = FAULT_NONE;
    for (size_t i = 0; i < selected; i++)
        order[i].file = all[i];
    plan_make(order, selected, (const struct case_file *const *)all, count, TIER_SMOKE, offset, &p,
              fault);
    return p;
}

START_TEST(points_and_seeds_are_expanded_in_order) {
    struct fault fault;
    struct case_file *c = load("fake/steady", steady);
    struct plan *p = plan_of(&c, 1, 1, 0, &fault);
    unit_ok(fault.status, &fault);
    ck_assert_uint_eq(p->run_count, 8);
    ck_assert_uint_eq(p->cases[0].point_count, 4);
    ck_assert_str_eq(p->cases[0].point[0].name, "height_l=58,start=random");
    ck_assert_str_eq(p->cases[0].point[3].name, "height_l=64,start=lattice");
    ck_assert_uint_eq(p->cases[0].point[2].run_count, 3);
    ck_assert_int_eq((int)p->cases[0].point[2].run[2]->seed, 1103);
    const char *id = p->run[0]->id;
    ck_assert(strncmp(id, "fake.steady.", 12) == 0 && strlen(id) == 20);
    ck_assert_str_eq(p->run[1]->id, id); /* seeds share the run file */
    ck_assert_str_ne(p->run[3]->id, id);
    for (size_t i = 0; i < p->run_count; i++)
        ck_assert_uint_eq(p->run[i]->index, i);
    struct plan *fresh = plan_of(&c, 1, 1, 5000, &fault);
    ck_assert_int_eq((int)fresh->run[0]->seed, 6101);
    ck_assert_str_eq(fresh->run[0]->id, id);
    plan_free(fresh);
    plan_free(p);
    case_free(c);
}
END_TEST

START_TEST(a_run_file_is_read_back_with_every_value) {
    struct fault fault;
    struct case_file *c = load("fake/steady", steady);
    struct plan *p = plan_of(&c, 1, 1, 0, &fault);
    const char *folder = unit_folder(), *path = unit_path(folder, "a.yaml");
    struct runfile r = {0};
    unit_write(path, p->run[7]->text);
    unit_ok(runfile_load(path, &r, &fault), &fault);
    ck_assert_str_eq(r.case_name, "fake/steady");
    ck_assert_str_eq(r.point, "height_l=64,start=lattice");
    ck_assert_uint_eq(r.sample_count, 2);
    ck_assert_double_eq(r.samples[1], 1.37e-3);
    ck_assert(runfile_wants(&r, "observables/sweeps_max"));
    ck_assert_str_eq(yaml_get(r.parameters, "label")->text, "a: \"b\"");
    ck_assert_str_eq(yaml_get(r.parameters, "height_l")->text, "64");
    ck_assert_uint_eq(yaml_get(r.parameters, "bands")->count, 2);
    ck_assert_ptr_nonnull(strstr(p->run[7]->text, "fake/steady.yaml:9"));
    ck_assert_ptr_null(strstr(p->run[7]->meaning, "#"));
    runfile_free(&r);
    unit_remove(folder);
    plan_free(p);
    case_free(c);
}
END_TEST

/* The line that a value stands on is not what a run depends on. */
START_TEST(only_the_meaning_names_a_run) {
    struct fault fault;
    struct case_file *a = load("fake/steady", steady);
    char moved[1024], changed[1024];
    snprintf(moved, sizeof moved, "# a comment\n\n%s", steady);
    snprintf(changed, sizeof changed, "%s", steady);
    memcpy(strstr(changed, "137"), "138", 3);
    struct case_file *b = load("fake/steady", moved), *d = load("fake/steady", changed);
    struct plan *p = plan_of(&a, 1, 1, 0, &fault), *q = plan_of(&b, 1, 1, 0, &fault),
                *r = plan_of(&d, 1, 1, 0, &fault);
    ck_assert_str_eq(p->run[0]->id, q->run[0]->id);
    ck_assert_str_eq(p->run[0]->meaning, q->run[0]->meaning);
    ck_assert_str_ne(p->run[0]->text, q->run[0]->text);
    ck_assert_str_ne(p->run[0]->id, r->run[0]->id);
    plan_free(p);
    plan_free(q);
    plan_free(r);
    case_free(a);
    case_free(b);
    case_free(d);
}
END_TEST

static const char heir[] =
    "sweep: {height_l: [58, 64]}\nsamples: [3]\nseeds: {first: 1102, count: 2}\n"
    "start: {case: fake/steady, point: {start: random}}\n"
    "tiers: {smoke: {}}\n";

START_TEST(many_spheres_make_a_large_file) {
    static const char kept[] =
        "parameters: {particles: 123457, height_R: 230, profile_bin_R: 0.5}\n"
        "samples: {from: 0, to: 0.7, every: 0.1}\n"
        "particle_samples: [0.3, 0.5, 0.7]\n"
        "also_write: [particles/spheres/position, "
        "profiles/packing_fraction]\n"
        "seeds: {first: 7}\ntiers: {smoke: {}}\n";
    struct fault fault;
    struct case_file *c = load("fake/many", kept);
    struct plan *p = plan_of(&c, 1, 1, 0, &fault);
    unit_ok(fault.status, &fault);
    double written = 3 * 3 * 8 * 123457.0 + 8 * 8 * 460.0;
    ck_assert_double_gt(p->run[0]->bytes, written);
    ck_assert_double_lt(p->run[0]->bytes, 1.02 * written);
    plan_free(p);
    case_free(c);
}
END_TEST

START_TEST(a_start_is_planned_first_and_shared) {
    struct fault fault;
    struct case_file *all[] = {load("fake/heir", heir), load("fake/steady", steady)};
    struct plan *p = plan_of(all, 2, 1, 0, &fault);
    unit_ok(fault.status, &fault);
    ck_assert_uint_eq(p->run_count, 8); /* four of its own, four that they start from */
    for (size_t i = 0; i < p->run_count; i++) {
        const struct plan_run *run = p->run[i];
        if (run->start == NULL)
            continue;
        ck_assert_uint_lt(run->start->index, run->index);
        ck_assert_int_eq((int)run->start->seed, (int)run->seed);
        ck_assert_ptr_nonnull(strstr(run->text, run->start->name));
        ck_assert_str_ne(run->run_file, p->run[0]->run_file); /* one run file a seed */
    }
    ck_assert_str_eq(p->cases[0].point[1].run[0]->start->point, "height_l=64,start=random");
    struct plan *both = plan_of(all, 2, 2, 0, &fault);
    ck_assert_uint_eq(both->run_count, 4 + 8 + 0); /* seeds 1102, 1103 of the starts are shared */
    plan_free(both);
    plan_free(p);
    case_free(all[0]);
    case_free(all[1]);
}
END_TEST

START_TEST(a_start_that_does_not_fit_is_refused) {
    static const struct {
        const char *from, *to, *says;
    } bad[] = {{"case: fake/steady", "case: fake/nobody", "no case fake/nobody"},
               {"start: random}", "start: cold}", "no point of fake/steady"},
               {", point: {start: random}", "", "no point of fake/steady"},
               {"{start: random}", "{darcy: published}", "fake/steady has no parameter darcy"},
               {"case: fake/steady", "case: fake/heir", "fake/heir has no parameter start"},
               {"{case: fake/steady, point: {start: random}}", "{case: fake/heir}",
                "start from each other"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct fault fault;
        char text[512];
        const char *at = strstr(heir, bad[i].from);
        snprintf(text, sizeof text, "%.*s%s%s", (int)(at - heir), heir, bad[i].to,
                 at + strlen(bad[i].from));
        struct case_file *all[] = {load("fake/heir", text), load("fake/steady", steady)};
        ck_assert_ptr_null(plan_of(all, 2, 1, 0, &fault));
        unit_says(&fault, bad[i].says);
        case_free(all[0]);
        case_free(all[1]);
    }
}
END_TEST

static const char child[] =
    "parameters: {grains: 137}\nsamples: [3]\nseeds: {first: 1101}\n"
    "sweep: {step: {down: {height_l: 58}, up: {height_l: 64.0}}, start: [lattice]}\n"
    "start: {case: fake/steady, point: {height_l: same, start: random, grains: same}}\n"
    "tiers: {smoke: {}}\n";

START_TEST(a_start_has_the_same_value_as_its_run) {
    struct fault fault;
    struct case_file *all[] = {load("fake/child", child), load("fake/steady", steady)};
    struct plan *p = plan_of(all, 2, 1, 0, &fault);
    unit_ok(fault.status, &fault);
    const struct plan_point *point = p->cases[0].point;
    ck_assert_str_eq(point[0].run[0]->start->point, "height_l=58,start=random");
    ck_assert_str_eq(point[1].run[0]->start->point, "height_l=64,start=random");
    char wanted[256];
    snprintf(wanted, sizeof wanted, "start_file: ../h5/%s.h5\n", point[1].run[0]->start->name);
    ck_assert_ptr_nonnull(strstr(point[1].run[0]->text, wanted));
    plan_free(p);
    case_free(all[0]);
    case_free(all[1]);
}
END_TEST

START_TEST(a_start_that_cannot_be_the_same_is_refused) {
    static const struct {
        const char *from, *to, *says;
    } bad[] = {{"grains: 137", "grains: 138", "no point of fake/steady"},
               {"parameters: {grains: 137}\n", "", "grains: same, but step=down,start=lattice has"},
               {"grains: 137", "grains: [137]", "grains: same, but"},
               {"64.0", "65", "is meant by step=up"},
               {"height_l: same", "height_l: 'same'", "no point of fake/steady"},
               {"grains: same", "grain: same", "fake/steady has no parameter grain"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct fault fault;
        char text[512];
        const char *at = strstr(child, bad[i].from);
        snprintf(text, sizeof text, "%.*s%s%s", (int)(at - child), child, bad[i].to,
                 at + strlen(bad[i].from));
        struct case_file *all[] = {load("fake/child", text), load("fake/steady", steady)};
        ck_assert_ptr_null(plan_of(all, 2, 1, 0, &fault));
        unit_says(&fault, bad[i].says);
        case_free(all[0]);
        case_free(all[1]);
    }
}
END_TEST

int main(void) {
    const TTest *const tests[] = {points_and_seeds_are_expanded_in_order,
                                  a_run_file_is_read_back_with_every_value,
                                  only_the_meaning_names_a_run,
                                  many_spheres_make_a_large_file,
                                  a_start_is_planned_first_and_shared,
                                  a_start_that_does_not_fit_is_refused,
                                  a_start_has_the_same_value_as_its_run,
                                  a_start_that_cannot_be_the_same_is_refused,
                                  NULL};
    return unit_run("plan", tests);
}
