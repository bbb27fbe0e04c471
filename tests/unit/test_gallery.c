/* test_gallery.c -- validation/gallery.h: figures that stand for the papers', found and hung. */
#include "tests/unit/unit.h"
#include "validation/assemble.h"
#include "validation/gallery.h"

#include <sys/stat.h>

static const char case_text[] =
    "name: fake/bed\ntitle: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
    "samples: [1]\nobservables: {bed: {recipe: contacts}}\n"
    "checks:\n"
    "  - {name: value, observable: bed.largest_overlap, expect: 1.37,\n"
    "     margin: 3 %, scatter: 0.5 %, kind: model, because: b}\n"
    "figures:\n"
    "  - {recipe: outputs, of: bed, title: All}\n"
    "  - {recipe: outputs, of: bed, title: Again, tiers: [paper]}\n"
    "  - {recipe: snapshot}\n"
    "tiers: {smoke: {}, paper: {}}\n";

static const char good[] =
    "figures:\n"
    "  - paper: FAKE\n"
    "    figure: Fig. 1\n"
    "    shows: a curve\n"
    "    axes: x, y\n"
    "    ours: [{case: fake/bed, recipe: snapshot}, {case: fake/bed, recipe: outputs, title: "
    "Again}]\n"
    "  - {paper: FAKE, figure: Fig. 2, shows: a drawing, axes: none, none: it is a drawing}\n";

static const char *stage(const char *from, const char *to) {
    const char *folder = unit_folder(), *at = strstr(good, from);
    char text[4096];
    ck_assert_msg(at != NULL, "no '%s' in the gallery", from);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, to, at + strlen(from));
    ck_assert_int_eq(mkdir(unit_path(folder, "cases"), 0755), 0);
    ck_assert_int_eq(mkdir(unit_path(folder, "cases/fake"), 0755), 0);
    unit_write(unit_path(folder, "cases/fake/bed.yaml"), case_text);
    unit_write(unit_path(folder, "gallery.yaml"), text);
    return folder;
}

START_TEST(figures_are_found) {
    struct fault fault = FAULT_NONE;
    struct gallery *g;
    const char *folder = stage("FAKE", "FAKE");
    unit_ok(gallery_load(unit_path(folder, "cases"), &g, &fault), &fault);
    ck_assert_uint_eq(g->count, 2);
    ck_assert_uint_eq(g->entry[0].count, 2);
    ck_assert_uint_eq(g->entry[0].source[0].figure, 2);
    ck_assert_uint_eq(g->entry[0].source[1].figure, 1);
    ck_assert(g->entry[0].source[0].in_tier[TIER_SMOKE]);
    ck_assert(!g->entry[0].source[1].in_tier[TIER_SMOKE]);
    ck_assert(g->entry[0].source[1].in_tier[TIER_PAPER]);
    ck_assert_str_eq(g->entry[1].none, "it is a drawing");
    gallery_free(g);
    unit_remove(folder);
}
END_TEST

static const struct {
    const char *from, *to, *says;
} bad[] = {
    {"figures:", "figure:", "did you mean 'figures'?"},
    {"    shows: a curve\n", "", "shows: missing"},
    {"axes: x, y", "axes: ' '", "axes: must not be empty"},
    {"case: fake/bed, recipe: snapshot", "case: fake/bad, recipe: snapshot", "fake/bad"},
    {"recipe: snapshot", "recipe: snapshots", "did you mean 'snapshot'?"},
    {"Again}", "Agian}", "with the title 'Agian' there; did you mean 'Again'?"},
    {", title: Again", "", "2 figures by outputs there: which `title`?"},
    {", none: it is a drawing", "", "FAKE, Fig. 2: either `ours` or `none`"},
    {"figure: Fig. 2", "figure: Fig. 1", "FAKE, Fig. 1 stands in line 2, too"},
};

START_TEST(every_fault_is_told) {
    struct fault fault = FAULT_NONE;
    struct gallery *g;
    const char *folder = stage(bad[_i].from, bad[_i].to);
    ck_assert_int_ne(gallery_load(unit_path(folder, "cases"), &g, &fault), STATUS_OK);
    ck_assert_ptr_null(g);
    unit_says(&fault, bad[_i].says);
    unit_remove(folder);
}
END_TEST

START_TEST(no_file_is_an_empty_gallery_and_ours_is_whole) {
    struct fault fault = FAULT_NONE;
    struct gallery *g;
    const char *folder = unit_folder();
    unit_ok(gallery_load(unit_path(folder, "cases"), &g, &fault), &fault);
    ck_assert_uint_eq(g->count, 0);
    gallery_free(g);
    unit_ok(gallery_load("validation/cases", &g, &fault), &fault);
    ck_assert_uint_eq(g->count, 11); /* MFM 2 to 5, FZ 1 to 7 */
    gallery_free(g);
    unit_remove(folder);
}
END_TEST

START_TEST(what_is_not_there_is_told) {
    struct fault fault = FAULT_NONE;
    struct gallery *g;
    struct case_file *c;
    struct arena a = {0};
    struct report_gallery out;
    const char *folder = stage("FAKE", "FAKE");
    unit_ok(gallery_load(unit_path(folder, "cases"), &g, &fault), &fault);
    unit_ok(case_load(unit_path(folder, "cases"), "fake/bed", &c, &fault), &fault);
    struct plan_case plan = {.file = c, .tier = &c->tier[TIER_SMOKE]};
    struct rows rows = {.count = 0};
    struct assemble_case one = {.plan = &plan, .rows = &rows};
    struct report_case report = {.name = "fake/bed"};
    struct report_gallery_item item[3] = {{0}};
    const struct report_gallery_item *items[] = {item};
    struct gallery_input in = {TIER_SMOKE, &one, &report, items, 1};
    item[2].end[GALLERY_PICTURE] = 1;
    unit_ok(gallery_hang(g, &in, &a, &out, &fault), &fault);
    const struct report_gallery_item *hung = out.entry[0].item;
    ck_assert_ptr_null(hung[0].missing);
    ck_assert_ptr_eq(hung[0].in, &report);
    ck_assert_uint_eq(hung[0].end[GALLERY_PICTURE], 1);
    ck_assert_str_eq(hung[1].missing, "not in this tier");
    item[2].end[GALLERY_PICTURE] = 0;
    unit_ok(gallery_hang(g, &in, &a, &out, &fault), &fault);
    ck_assert_ptr_nonnull(strstr(out.entry[0].item[0].missing, "do not suit"));
    one.rows = NULL;
    one.not_run = "stopped";
    items[0] = NULL;
    unit_ok(gallery_hang(g, &in, &a, &out, &fault), &fault);
    ck_assert_str_eq(out.entry[0].item[0].missing, "stopped");
    in.case_count = 0;
    unit_ok(gallery_hang(g, &in, &a, &out, &fault), &fault);
    ck_assert_str_eq(out.entry[0].item[0].missing, "case not selected");
    arena_free(&a);
    case_free(c);
    gallery_free(g);
    unit_remove(folder);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("gallery");
    TCase *group = tcase_create("gallery");
    tcase_add_test(group, figures_are_found);
    tcase_add_loop_test(group, every_fault_is_told, 0, sizeof bad / sizeof *bad);
    tcase_add_test(group, no_file_is_an_empty_gallery_and_ours_is_whole);
    tcase_add_test(group, what_is_not_there_is_told);
    suite_add_tcase(suite, group);
    return unit_finish(suite);
}
