/* test_runfile.c -- common/runfile.h: run files, cases by hand, and start files that stay inside.
 */
#include "common/file.h"
#include "common/runfile.h"
#include "tests/unit/unit.h"

#define HEAD                                                                                       \
    "format: bedcheck-run 1\ncase: graingas/a\npoint: width_l=61\nmodel: graingas\n"               \
    "datasets: [fields/pressure, observables/collisions]\n"

static enum status load(const char *folder, const char *text, struct runfile *r,
                        struct fault *fault) {
    *fault = FAULT_NONE;
    unit_write(unit_path(folder, "runs/a.yaml"), text);
    return runfile_load(unit_path(folder, "runs/a.yaml"), r, fault);
}

static const char *new_folder(void) {
    struct fault fault = FAULT_NONE;
    const char *folder = unit_folder();
    unit_ok(file_make_folder(unit_path(folder, "runs/sub"), &fault), &fault);
    unit_ok(file_make_folder(unit_path(folder, "h5"), &fault), &fault);
    unit_write(unit_path(folder, "h5/x.h5"), "x");
    unit_write(unit_path(folder, "runs/sub/y.h5"), "y");
    return folder;
}

START_TEST(a_run_file_is_read) {
    struct fault fault;
    struct runfile r;
    const char *folder = new_folder();
    unit_ok(load(folder,
                 HEAD "samples: [0, 1.37, 2.5]\nparticle_samples: {from: 0, to: 2.5, every: 1.25}\n"
                      "start_file: ../h5/x.h5\nparameters:\n  width_l: 61\n",
                 &r, &fault),
            &fault);
    ck_assert_str_eq(r.case_name, "graingas/a");
    ck_assert_str_eq(r.point, "width_l=61");
    ck_assert_uint_eq(r.sample_count, 3);
    ck_assert_double_eq(r.samples[1], 1.37);
    ck_assert_uint_eq(r.particle_sample_count, 3);
    ck_assert_double_eq(r.particle_samples[1], 1.25);
    ck_assert(runfile_wants(&r, "fields/pressure") && !runfile_wants(&r, "fields/pressur"));
    ck_assert_str_eq(yaml_get(r.parameters, "width_l")->text, "61");
    ck_assert_str_eq(r.start_file, unit_path(folder, "runs/../h5/x.h5"));
    ck_assert_ptr_null(r.notice);
    runfile_free(&r);
    runfile_free(&r);
    unit_ok(load(folder, HEAD "samples: [7]\nstart_file: sub/y.h5\n", &r, &fault), &fault);
    ck_assert_double_eq(r.particle_samples[0], 7);
    ck_assert_ptr_null(r.parameters);
    runfile_free(&r);
    unit_remove(folder);
}
END_TEST

START_TEST(a_start_file_stays_inside) {
    struct fault fault;
    struct runfile r;
    const char *folder = new_folder();
    const char *const bad[] = {"/etc/passwd", "../../etc/passwd", "../h5/../../x", "sub/../y", "..",
                               "../"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[512];
        snprintf(text, sizeof text, HEAD "samples: [1]\nstart_file: %s\n", bad[i]);
        ck_assert_int_eq(load(folder, text, &r, &fault), STATUS_BAD_INPUT);
        unit_says(&fault, "start_file");
    }
    ck_assert_int_eq(load(folder, HEAD "samples: [1]\nstart_file: ../h5/no.h5\n", &r, &fault),
                     STATUS_NOT_FOUND);
    ck_assert_int_eq(symlink("/etc/passwd", unit_path(folder, "h5/link.h5")), 0);
    ck_assert_int_eq(load(folder, HEAD "samples: [1]\nstart_file: ../h5/link.h5\n", &r, &fault),
                     STATUS_BAD_INPUT);
    unit_says(&fault, "leads out of the run's folders");
    unit_remove(folder);
}
END_TEST

START_TEST(faults_of_a_run_file_come_together) {
    struct fault fault;
    struct runfile r;
    const char *folder = new_folder();
    ck_assert_int_eq(load(folder, HEAD "sample: [1]\nparameters: []\n", &r, &fault),
                     STATUS_BAD_INPUT);
    unit_says(&fault, ":6:1: sample: no such key in a run file; did you mean 'samples'?");
    unit_says(&fault, "parameters: a map is needed");
    unit_says(&fault, "samples: missing in this run file");
    ck_assert_int_eq(load(folder, "format: bedcheck-run 2\n", &r, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "not 'bedcheck-run 1'");
    ck_assert_int_eq(load(folder, "a: 1\n", &r, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "neither a run file");
    ck_assert_int_eq(load(folder, "[1, 2]\n", &r, &fault), STATUS_BAD_INPUT);
    unit_remove(folder);
}
END_TEST

static void bad_times(const char *folder, const char *samples, const char *words) {
    struct fault fault;
    struct runfile r;
    char text[512];
    snprintf(text, sizeof text, HEAD "samples: %s\n", samples);
    ck_assert_int_eq(load(folder, text, &r, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, words);
}

START_TEST(times_increase) {
    const char *folder = new_folder();
    bad_times(folder, "[0, 2, 2]", ":6:17: samples: 2 is not after 2");
    bad_times(folder, "[-1]", "before 0");
    bad_times(folder, "[]", "no times");
    bad_times(folder, "5", "a list of times, or {from, to, every}");
    bad_times(folder, "{from: 0, to: 1, every: 0.3}", "not a whole number of steps");
    bad_times(folder, "{from: 2, to: 1, every: 1}", "not a whole number of steps");
    bad_times(folder, "{from: 0, to: 1e9, every: 1e-3}", "more than 1000000 times");
    bad_times(folder, "{from: 0, to: 1, evry: 1}", "did you mean 'every'");
    unit_remove(folder);
}
END_TEST

START_TEST(a_range_of_times_has_both_ends) {
    struct fault fault;
    struct runfile r;
    const char *folder = new_folder();
    unit_ok(load(folder, HEAD "samples: {from: 0.3, to: 1.7, every: 0.2}\n", &r, &fault), &fault);
    ck_assert_uint_eq(r.sample_count, 8);
    ck_assert_double_eq(r.samples[0], 0.3);
    ck_assert_double_eq(r.samples[7], 1.7);
    ck_assert_double_eq(r.samples[3], 0.9); /* not 0.3 + 3 * 0.2 */
    runfile_free(&r);
    unit_remove(folder);
}
END_TEST

static const char CASE[] = "name: graingas/b\nmodel: graingas\ntitle: B\n"
                           "parameters: {width_l: 61, height_l: 17}\n"
                           "sweep:\n  height_l: [58, 64]\n  darcy: [corrected, published, x]\n"
                           "samples: {from: 0, to: 50, every: 10}\n"
                           "tiers: {smoke: {parameters: {width_l: 9}}}\n";

START_TEST(a_case_runs_its_first_point_and_says_so) {
    struct fault fault;
    struct runfile r;
    const char *folder = new_folder();
    unit_ok(load(folder, CASE, &r, &fault), &fault);
    ck_assert_str_eq(r.case_name, "graingas/b");
    ck_assert_str_eq(r.notice, "height_l = 58 (first of 2)\ndarcy = corrected (first of 3)");
    ck_assert_uint_eq(r.parameters->count, 3);
    ck_assert_str_eq(yaml_get(r.parameters, "height_l")->text, "58");
    ck_assert_str_eq(yaml_get(r.parameters, "darcy")->text, "corrected");
    ck_assert_str_eq(yaml_get(r.parameters, "width_l")->text, "61");
    ck_assert_uint_eq(yaml_get(r.parameters, "height_l")->line, 6);
    ck_assert_uint_eq(r.sample_count, 6);
    ck_assert(runfile_wants(&r, "anything/at/all"));
    runfile_free(&r);
    unit_remove(folder);
}
END_TEST

START_TEST(a_case_that_needs_another_is_sent_to_bedcheck) {
    struct fault fault;
    struct runfile r;
    const char *folder = new_folder();
    char text[1024];
    snprintf(text, sizeof text, "%sstart: {case: graingas/a}\n", CASE);
    ck_assert_int_eq(load(folder, text, &r, &fault), STATUS_BAD_INPUT);
    unit_says(&fault,
              ":10:8: start: this case starts from the result of another; use bedcheck run");
    ck_assert_int_eq(load(folder, "name: a\nmodel: m\nsamples: [1]\nsweep: {x: 5}\n", &r, &fault),
                     STATUS_BAD_INPUT);
    unit_says(&fault, "x: a list of values to sweep is needed");
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_run_file_is_read,
                                  a_start_file_stays_inside,
                                  faults_of_a_run_file_come_together,
                                  times_increase,
                                  a_range_of_times_has_both_ends,
                                  a_case_runs_its_first_point_and_says_so,
                                  a_case_that_needs_another_is_sent_to_bedcheck,
                                  NULL};
    return unit_run("runfile", tests);
}
