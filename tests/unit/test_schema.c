/* test_schema.c -- common/schema.h: every mistake in one pass, with its place. */
#include "common/schema.h"
#include "tests/unit/unit.h"

static const char *const LAWS[] = {"published", "corrected", NULL};
static const struct schema_field FIELDS[] = {
    {.key = "restitution", .type = SCHEMA_REAL, .min = 0.125, .max = 1},
    {.key = "grains", .type = SCHEMA_INTEGER, .required = true, .min = 1, .max = 9e6},
    {.key = "darcy", .type = SCHEMA_CHOICE, .choices = LAWS},
    {.key = "mirror", .type = SCHEMA_BOOLEAN},
    {.key = "bed", .type = SCHEMA_REAL_LIST, .min = 0, .max = 0.9},
    {.key = "title", .type = SCHEMA_TEXT},
    {.key = "tiers", .type = SCHEMA_MAP},
    {.key = "checks", .type = SCHEMA_LIST},
    {.key = "free", .type = SCHEMA_ANY},
};
enum { FIELD_COUNT = sizeof FIELDS / sizeof *FIELDS };

static enum status check(const char *text, struct fault *fault) {
    struct yaml_document *d;
    *fault = FAULT_NONE;
    unit_ok(yaml_parse("f.yaml", text, strlen(text), &d, fault), fault);
    enum status status = schema_check(yaml_root(d), "case", FIELDS, FIELD_COUNT, fault);
    yaml_free(d);
    return status;
}

START_TEST(a_good_map_passes) {
    struct fault fault;
    unit_ok(check("restitution: .8\ngrains: 18104\ndarcy: corrected\nmirror: false\n"
                  "bed: [.13, .41]\ntitle: A bed\ntiers: {}\nchecks: []\nfree: [{a: 1}]\n",
                  &fault),
            &fault);
    ck_assert_int_eq(fault.findings, 0);
}
END_TEST

START_TEST(all_mistakes_are_told_at_once) {
    struct fault fault;
    ck_assert_int_eq(check("restitutoin: .8\ndarcy: corected\nmirror: maybe\nbed: [.13, 1.7]\n"
                           "tiers: []\nchecks: x\ntitle: [a]\n",
                           &fault),
                     STATUS_BAD_INPUT);
    unit_says(&fault,
              "f.yaml:1:1: restitutoin: no such key in a case; did you mean 'restitution'?");
    unit_says(&fault, "f.yaml:2:8: darcy: 'corected' is none of published, corrected; did you mean "
                      "'corrected'?");
    unit_says(&fault, "f.yaml:3:9: mirror: 'maybe' is not true or false");
    unit_says(&fault, "f.yaml:4:12: bed: 1.7 is outside 0 .. 0.9");
    unit_says(&fault, "f.yaml:5:8: tiers: a map is needed");
    unit_says(&fault, "f.yaml:6:9: checks: a list is needed");
    unit_says(&fault, "f.yaml:7:8: title: a list is not a text");
    unit_says(&fault, "f.yaml:1:1: grains: missing in this case");
    ck_assert_int_eq(fault.findings, 8);
}
END_TEST

START_TEST(ranges_are_closed_and_integers_are_whole) {
    struct fault fault;
    unit_ok(check("grains: 1\nrestitution: 0.125\n", &fault), &fault);
    ck_assert_int_eq(check("grains: 0\n", &fault), STATUS_BAD_INPUT);
    ck_assert_int_eq(check("grains: 18104.5\n", &fault), STATUS_BAD_INPUT);
    ck_assert_int_eq(check("grains: 2\nrestitution: 1.0000000001\n", &fault), STATUS_BAD_INPUT);
    ck_assert_int_eq(check("[1, 2]\n", &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "a case is a map");
}
END_TEST

START_TEST(only_a_near_word_is_suggested) {
    const char *const names[] = {"peclet", "froude", "width_l", "height_l"};
    ck_assert_str_eq(schema_nearest("peklet", names, 4), "peclet");
    ck_assert_str_eq(schema_nearest("hieght_l", names, 4), "height_l");
    ck_assert_str_eq(schema_nearest("width", names, 4), "width_l");
    ck_assert_ptr_null(schema_nearest("restitution", names, 4));
    ck_assert_ptr_null(schema_nearest("xy", names, 4));
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_good_map_passes, all_mistakes_are_told_at_once,
                                  ranges_are_closed_and_integers_are_whole,
                                  only_a_near_word_is_suggested, NULL};
    return unit_run("schema", tests);
}
