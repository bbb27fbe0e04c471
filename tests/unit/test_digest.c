/* test_digest.c -- common/digest.h against the values of FIPS 180-2, and its own promises. */
#include "common/digest.h"
#include "tests/unit/unit.h"

START_TEST(bytes_and_files_give_sha256) {
    struct digest a, b;
    struct fault fault = FAULT_NONE;
    digest_bytes("abc", 3, &a);
    ck_assert_str_eq(a.hex, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    const char *folder = unit_folder(), *path = unit_path(folder, "abc");
    unit_write(path, "abc");
    unit_ok(digest_file(path, &b, &fault), &fault);
    ck_assert_str_eq(a.hex, b.hex);
    ck_assert_int_eq(digest_file(unit_path(folder, "none"), &b, &fault), STATUS_NOT_FOUND);
    unit_says(&fault, "none");
    ck_assert_int_eq(digest_file(folder, &b, &fault), STATUS_IO);
    unit_remove(folder);
}
END_TEST

START_TEST(texts_differ_by_order_and_by_where_they_are_cut) {
    struct digest a, b, c;
    digest_texts((const char *const[]){"ab", "c"}, 2, &a);
    digest_texts((const char *const[]){"a", "bc"}, 2, &b);
    digest_texts((const char *const[]){"c", "ab"}, 2, &c);
    ck_assert_str_ne(a.hex, b.hex);
    ck_assert_str_ne(a.hex, c.hex);
    digest_texts((const char *const[]){"ab", "c"}, 2, &b);
    ck_assert_str_eq(a.hex, b.hex);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {bytes_and_files_give_sha256,
                                  texts_differ_by_order_and_by_where_they_are_cut, NULL};
    return unit_run("digest", tests);
}
