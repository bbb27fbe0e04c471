/* test_parameters.c -- solver/parameters.c: defaults, run file, --set; every fault, with its place.
 */
#include "solver/model.h"
#include "tests/unit/unit.h"

static const char *const LAWS[] = {"published", "corrected", NULL};
static const struct parameter TABLE[] = {
    {.name = "grains", .type = PARAMETER_INTEGER, .standard = "18104", .min = 1, .max = 1e7},
    {.name = "peclet", .type = PARAMETER_REAL, .standard = "2e-4", .min = 1e-9, .max = 1e3},
    {.name = "darcy", .type = PARAMETER_CHOICE, .standard = "published", .choices = LAWS},
    {.name = "mirror", .type = PARAMETER_BOOLEAN, .standard = "false"},
    {.name = "bed", .type = PARAMETER_REAL_LIST, .standard = "[]", .min = 0, .max = 0.9},
};
static const struct model MODEL = {.name = "m", .parameters = TABLE, .parameter_count = 5};

static enum status read_set(const char *text, const char *const *settings, size_t count,
                            struct parameter_set *p, struct fault *fault) {
    struct yaml_document *d = NULL;
    *fault = FAULT_NONE;
    if (text != NULL)
        unit_ok(yaml_parse("r.yaml", text, strlen(text), &d, fault), fault);
    enum status status =
        parameters_read(&MODEL, d ? yaml_root(d) : NULL, settings, count, p, fault);
    yaml_free(d); /* what was read must not depend on the file's tree */
    return status;
}

START_TEST(defaults_stand_where_nothing_is_said) {
    struct fault fault;
    struct parameter_set p;
    size_t length = 7;
    unit_ok(read_set(NULL, NULL, 0, &p, &fault), &fault);
    ck_assert_double_eq(parameters_real(&p, "grains"), 18104);
    ck_assert_double_eq(parameters_real(&p, "peclet"), 2e-4);
    ck_assert_str_eq(parameters_choice(&p, "darcy"), "published");
    ck_assert_double_eq(parameters_real(&p, "mirror"), 0);
    ck_assert_ptr_nonnull(parameters_list(&p, "bed", &length));
    ck_assert_uint_eq(length, 0);
    ck_assert_str_eq(p.place[0], "default");
    parameters_free(&p);
    parameters_free(&p);
}
END_TEST

START_TEST(the_run_file_goes_before_and_set_before_both) {
    struct fault fault;
    struct parameter_set p;
    size_t length;
    const char *const settings[] = {"peclet=1.37e-6", "bed=[.25, .5]", "peclet=2.37e-6"};
    unit_ok(
        read_set("grains: 1373\npeclet: 3e-3\ndarcy: corrected\nmirror: true\nbed: [.1, .2, .3]\n",
                 settings, 3, &p, &fault),
        &fault);
    ck_assert_double_eq(parameters_real(&p, "grains"), 1373);
    ck_assert_double_eq(parameters_real(&p, "peclet"), 2.37e-6);
    ck_assert_str_eq(parameters_choice(&p, "darcy"), "corrected");
    ck_assert_double_eq(parameters_real(&p, "mirror"), 1);
    const double *bed = parameters_list(&p, "bed", &length);
    ck_assert_uint_eq(length, 2);
    ck_assert_double_eq(bed[1], .5);
    ck_assert_str_eq(p.place[0], "r.yaml:1:9");
    parameters_fault(&p, "grains", &fault, "%d do not fit", 1373);
    parameters_fault(&p, "peclet", &fault, "too small");
    ck_assert_str_eq(fault.text,
                     "r.yaml:1:9: grains: 1373 do not fit\n--set peclet: peclet: too small");
    parameters_free(&p);
}
END_TEST

START_TEST(every_fault_is_found) {
    struct fault fault;
    struct parameter_set p;
    const char *const settings[] = {"peclat=1", "grains", "=3", "mirror=yes", "bed=[1", "bed=[1]"};
    ck_assert_int_eq(read_set("grain: 5\ngrains: 0\npeclet: fast\ndarcy: corected\nbed: .5\n",
                              settings, 6, &p, &fault),
                     STATUS_BAD_INPUT);
    unit_says(&fault, "r.yaml:1:1: grain: no such parameter of m; did you mean 'grains'?");
    unit_says(&fault, "r.yaml:2:9: grains: 0 is outside 1 .. 10000000");
    unit_says(&fault, "r.yaml:3:9: peclet: 'fast' is not a number");
    unit_says(&fault, "r.yaml:4:8: darcy: 'corected' is none of published, corrected");
    unit_says(&fault, "r.yaml:5:6: bed: a list is needed");
    unit_says(&fault, "--set: peclat: no such parameter of m; did you mean 'peclet'?");
    unit_says(&fault, "--set grains: name=value is needed");
    unit_says(&fault, "--set =3: name=value is needed");
    unit_says(&fault, "--set mirror:1:1: mirror: 'yes' is not true or false");
    unit_says(&fault, "bed: 1 is outside 0 .. 0.9");
    ck_assert_int_eq(fault.findings, 11);
    ck_assert_ptr_null(p.real);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {defaults_stand_where_nothing_is_said,
                                  the_run_file_goes_before_and_set_before_both,
                                  every_fault_is_found, NULL};
    return unit_run("parameters", tests);
}
