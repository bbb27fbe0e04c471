/* test_json.c -- common/json.h: what comes out is JSON, whatever goes in. */
#include "common/json.h"
#include "tests/unit/unit.h"

#include <math.h>

START_TEST(a_document_is_indented_and_escaped) {
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    struct json j = json_to(out);
    json_begin_object(&j);
    json_key(&j, "a\"b");
    json_text(&j, "line\n\\ \x01 \xce\xb7 \xff");
    json_key(&j, "none");
    json_text(&j, NULL);
    json_key(&j, "list");
    json_begin_array(&j);
    json_real(&j, 0.1);
    json_real(&j, NAN);
    json_real(&j, -INFINITY);
    json_integer(&j, -1234567890123LL);
    json_boolean(&j, true);
    json_begin_object(&j);
    json_end_object(&j);
    json_end_array(&j);
    json_end_object(&j);
    fclose(out);
    ck_assert_str_eq(text, "{\n"
                           "  \"a\\\"b\": \"line\\n\\\\ \\u0001 \xce\xb7 \\ufffd\",\n"
                           "  \"none\": null,\n"
                           "  \"list\": [\n"
                           "    0.10000000000000001,\n"
                           "    null,\n"
                           "    null,\n"
                           "    -1234567890123,\n"
                           "    true,\n"
                           "    {}\n"
                           "  ]\n"
                           "}\n");
    free(text);
}
END_TEST

START_TEST(reals_come_back_as_they_were) {
    const double values[] = {1.37e-6, -2.2250738585072014e-308, 1.7976931348623157e308, 1.0 / 3};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        char text[64] = "";
        FILE *out = fmemopen(text, sizeof text, "w");
        struct json j = json_to(out);
        json_real(&j, values[i]);
        fclose(out);
        ck_assert_double_eq(strtod(text, NULL), values[i]);
    }
}
END_TEST

START_TEST(overlong_and_surrogate_bytes_are_replaced) {
    char text[128] = "";
    FILE *out = fmemopen(text, sizeof text, "w");
    struct json j = json_to(out);
    json_text(&j, "\xc0\xaf|\xed\xa0\x80|\xf0\x9f\x98\x80");
    fclose(out);
    ck_assert_str_eq(text, "\"\\ufffd\\ufffd|\\ufffd\\ufffd\\ufffd|\xf0\x9f\x98\x80\"");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_document_is_indented_and_escaped, reals_come_back_as_they_were,
                                  overlong_and_surrogate_bytes_are_replaced, NULL};
    return unit_run("json", tests);
}
