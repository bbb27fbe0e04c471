/* test_yaml.c -- common/yaml.h: what is read, and what is refused and where. */
#include "common/yaml.h"
#include "tests/unit/unit.h"

static struct yaml_document *parse(const char *text) {
    struct fault fault = FAULT_NONE;
    struct yaml_document *d;
    unit_ok(yaml_parse("f.yaml", text, strlen(text), &d, &fault), &fault);
    return d;
}

static void refused(const char *text, const char *words) {
    struct fault fault = FAULT_NONE;
    struct yaml_document *d;
    ck_assert_int_eq(yaml_parse("f.yaml", text, strlen(text), &d, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(d);
    unit_says(&fault, words);
}

START_TEST(nodes_know_their_places_and_keys) {
    struct yaml_document *d = parse("a: 1.37e-6\nb:\n  - x\n  - {c: 'y'}\n");
    const struct yaml_node *root = yaml_root(d), *b = yaml_get(root, "b");
    ck_assert_int_eq(root->kind, YAML_MAP);
    ck_assert_uint_eq(root->count, 2);
    ck_assert_int_eq(b->kind, YAML_LIST);
    ck_assert_uint_eq(b->line, 3);
    ck_assert_uint_eq(b->key_line, 2);
    const struct yaml_node *c = yaml_get(&b->child[1], "c");
    ck_assert_str_eq(c->text, "y");
    ck_assert(c->quoted && !b->child[0].quoted);
    ck_assert_uint_eq(c->line, 4);
    ck_assert_uint_eq(c->column, 9);
    ck_assert_str_eq(c->file, "f.yaml");
    ck_assert_ptr_null(yaml_get(root, "c"));
    ck_assert_ptr_null(yaml_get(b, "a"));
    yaml_free(d);
    yaml_free(NULL);
}
END_TEST

START_TEST(json_is_a_subset) {
    struct yaml_document *d = parse("{\"seconds\": 1.5, \"runs\": [\"a\", null], \"ok\": true}\n");
    double seconds = 0;
    struct fault fault = FAULT_NONE;
    unit_ok(yaml_real(yaml_get(yaml_root(d), "seconds"), &seconds, &fault), &fault);
    ck_assert_double_eq(seconds, 1.5);
    yaml_free(d);
}
END_TEST

START_TEST(everything_clever_is_refused_with_its_place) {
    refused("a: &x 1\nb: 2\n", "f.yaml:1:4: anchors are refused");
    refused("a: 1\nb: *x\n", "f.yaml:2:4: aliases are refused");
    refused("a: !!str 1\n", "f.yaml:1:4: tags are refused");
    refused("a: 1\n---\nb: 2\n", "f.yaml:2:1: a second document");
    refused("a: 1\nb: 2\na: 3\n", "f.yaml:3:1: a: already given in line 1");
    refused("? [a, b]\n: 1\n", "a key must be plain text");
    refused("", "f.yaml:1:1: nothing in it");
    refused("# only a comment\n", "nothing in it");
    refused("a: [1, 2\n", "f.yaml:");
    refused("a: \"\\0b\"\n", "NUL");
    refused("a: \xff\xfe\n", "f.yaml:");
    refused("%TAG ! tag:example.org,2000:\n---\na: 1\n", "tags are refused");
}
END_TEST

START_TEST(all_findings_come_at_once) {
    struct fault fault = FAULT_NONE;
    struct yaml_document *d;
    const char *text = "a: &x 1\na: !t 2\nb: *x\n";
    ck_assert_int_eq(yaml_parse("f", text, strlen(text), &d, &fault), STATUS_BAD_INPUT);
    ck_assert_int_eq(fault.findings, 4);
}
END_TEST

START_TEST(depth_eight_is_read_and_nine_is_not) {
    yaml_free(parse("[[[[[[[[7]]]]]]]]"));
    refused("[[[[[[[[[7]]]]]]]]]", "f.yaml:1:9: nested deeper than 8");
    char deep[100001];
    memset(deep, '[', sizeof deep - 1);
    deep[sizeof deep - 1] = '\0';
    refused(deep, "nested deeper");
}
END_TEST

START_TEST(numbers_are_read_whole_or_not_at_all) {
    struct yaml_document *d =
        parse("a: -1.37e-6\nb: 123456789012\nc: 1e3\nd: 1.5x\ne: nan\nf: .inf\n"
              "g: 1e999\nh: '5'\ni: 0x10\nj: 99999999999999999999\nk: [1]\n"
              "l:\nm: 1e-999\n");
    const struct yaml_node *root = yaml_root(d);
    struct fault fault = FAULT_NONE;
    double real = 0;
    long long integer = 0;
    unit_ok(yaml_real(yaml_get(root, "a"), &real, &fault), &fault);
    ck_assert_double_eq(real, -1.37e-6);
    unit_ok(yaml_integer(yaml_get(root, "b"), &integer, &fault), &fault);
    ck_assert_int_eq(integer, 123456789012);
    unit_ok(yaml_real(yaml_get(root, "c"), &real, &fault), &fault);
    ck_assert_double_eq(real, 1000);
    ck_assert_int_eq(yaml_integer(yaml_get(root, "c"), &integer, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "f.yaml:3:4: c: '1e3' is not an integer");
    for (const char *key = "defghiklm"; *key != '\0'; key++) {
        char name[2] = {*key, '\0'};
        ck_assert_msg(yaml_real(yaml_get(root, name), &real, &fault) == STATUS_BAD_INPUT, "%s",
                      name);
    }
    ck_assert_int_eq(yaml_integer(yaml_get(root, "j"), &integer, &fault), STATUS_BAD_INPUT);
    ck_assert_double_eq(real, 1000);
    ck_assert_int_eq(integer, 123456789012);
    ck_assert_int_eq(fault.findings, 11);
    unit_says(&fault, "h: quoted '5' is not a number");
    unit_says(&fault, "k: a list is not a number");
    unit_says(&fault, "l: no value: a number is needed");
    yaml_free(d);
}
END_TEST

START_TEST(truth_and_text) {
    struct yaml_document *d = parse("a: true\nb: yes\nc: ''\nd: {x: 1}\ne: \xce\xb7\n");
    const struct yaml_node *root = yaml_root(d);
    struct fault fault = FAULT_NONE;
    bool truth = false;
    const char *text = NULL;
    unit_ok(yaml_boolean(yaml_get(root, "a"), &truth, &fault), &fault);
    ck_assert(truth);
    unit_ok(yaml_string(yaml_get(root, "c"), &text, &fault), &fault);
    ck_assert_str_eq(text, "");
    unit_ok(yaml_string(yaml_get(root, "e"), &text, &fault), &fault);
    ck_assert_str_eq(text, "\xce\xb7");
    ck_assert_int_eq(yaml_boolean(yaml_get(root, "b"), &truth, &fault), STATUS_BAD_INPUT);
    ck_assert_int_eq(yaml_string(yaml_get(root, "d"), &text, &fault), STATUS_BAD_INPUT);
    yaml_free(d);
}
END_TEST

START_TEST(files_have_a_limit_and_a_name) {
    struct fault fault = FAULT_NONE;
    struct yaml_document *d;
    const char *folder = unit_folder(), *path = unit_path(folder, "big.yaml");
    unit_write(path, "a: 12345678901234567890\n");
    ck_assert_int_eq(yaml_load(path, 10, &d, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "big.yaml: 24 bytes, more than the 10 allowed");
    unit_ok(yaml_load(path, 24, &d, &fault), &fault);
    yaml_free(d);
    ck_assert_int_eq(yaml_load(unit_path(folder, "none.yaml"), 10, &d, &fault), STATUS_NOT_FOUND);
    ck_assert_int_eq(yaml_load(folder, 10, &d, &fault), STATUS_BAD_INPUT);
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {nodes_know_their_places_and_keys,
                                  json_is_a_subset,
                                  everything_clever_is_refused_with_its_place,
                                  all_findings_come_at_once,
                                  depth_eight_is_read_and_nine_is_not,
                                  numbers_are_read_whole_or_not_at_all,
                                  truth_and_text,
                                  files_have_a_limit_and_a_name,
                                  NULL};
    return unit_run("yaml", tests);
}
