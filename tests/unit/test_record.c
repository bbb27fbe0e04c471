/* test_record.c -- validation/record.h: members of what bedcheck wrote, each of its kind. */
#include "tests/unit/unit.h"
#include "validation/record.h"

#include <math.h>

static const char text[] = "{\"check\": \"sigma\", \"unit\": null, \"measured\": 6.89,\n"
                           " \"uncertainty\": null, \"pass\": 24, \"fail\": -3, \"runs\": [],\n"
                           " \"tier\": large, \"known\": {}}\n";

struct stage {
    struct yaml_document *d;
    struct arena arena;
    struct fault fault;
    struct record r;
    const struct yaml_node *map;
};

static void set_up(struct stage *s) {
    *s = (struct stage){.fault = FAULT_NONE};
    unit_ok(yaml_parse("some.json", text, strlen(text), &s->d, &s->fault), &s->fault);
    s->r = (struct record){&s->arena, &s->fault, "write it again"};
    s->map = yaml_root(s->d);
}

static void tear_down(struct stage *s) {
    yaml_free(s->d);
    arena_free(&s->arena);
}

static void refused(struct stage *s, const char *says) {
    ck_assert_int_eq(s->fault.status, STATUS_BAD_INPUT);
    unit_says(&s->fault, says);
    s->fault = FAULT_NONE;
}

START_TEST(members_are_read_by_kind) {
    struct stage s;
    set_up(&s);
    ck_assert_str_eq(record_text(&s.r, s.map, "check"), "sigma");
    ck_assert_str_eq(record_optional_text(&s.r, s.map, "check"), "sigma");
    ck_assert_ptr_null(record_optional_text(&s.r, s.map, "unit"));
    ck_assert_double_eq(record_real(&s.r, s.map, "measured"), 6.89);
    ck_assert(isnan(record_real(&s.r, s.map, "uncertainty")));
    ck_assert_uint_eq(record_count(&s.r, s.map, "pass"), 24);
    ck_assert_uint_eq(record_member(&s.r, s.map, "runs", YAML_LIST)->count, 0);
    unit_ok(s.fault.status, &s.fault);
    tear_down(&s);
}
END_TEST

START_TEST(what_is_missing_or_of_another_kind_is_said) {
    struct stage s;
    set_up(&s);
    ck_assert_ptr_null(record_member(&s.r, s.map, "verdict", YAML_SCALAR));
    refused(&s, "some.json:1:1: verdict is missing: write it again");
    ck_assert_ptr_null(record_member(&s.r, s.map, "runs", YAML_MAP));
    refused(&s, "runs: must be a map");
    ck_assert(isnan(record_real(&s.r, s.map, "known")));
    refused(&s, "known: must be a single value");
    ck_assert_ptr_null(record_text(&s.r, s.map, "unit"));
    refused(&s, "unit: must be a text");
    ck_assert_ptr_null(record_optional_text(&s.r, s.map, "tier"));
    refused(&s, "tier: must be a text");
    ck_assert_uint_eq(record_count(&s.r, s.map, "fail"), 0);
    refused(&s, "fail: must not be negative");
    ck_assert(isnan(record_real(&s.r, s.map, "check")));
    refused(&s, "is not a number");
    ck_assert_ptr_null(record_member(&s.r, yaml_get(s.map, "runs"), "check", YAML_SCALAR));
    refused(&s, "check is missing");
    tear_down(&s);
}
END_TEST

int main(void) {
    const TTest *tests[] = {members_are_read_by_kind, what_is_missing_or_of_another_kind_is_said,
                            NULL};
    return unit_run("record", tests);
}
