/* test_reference_use.c -- validation/reference.h: keys of rows, and lines that nobody uses. */
#include "tests/unit/case_stage.h"
#include "validation/reference.h"
#include "validation/reference_curve.h"
#include "validation/scatter.h"

static const char body[] =
    "name: fake/steady\ntitle: t\nsource: s\nquestion: q\nmodel: fake\nexpect_s: 2\n"
    "parameters: {value: 0.0213}\n"
    "sweep: {height_l: [3.7, 5.1], width_l: [3, 6, 12]}\nsamples: [0, 1.37]\n"
    "seeds: {first: 1101, count: 2}\n"
    "observables: {bed: {recipe: contacts}}\n"
    "across: {fit: {fit: order, of: bed.largest_overlap, along: width_l}}\n"
    "checks:\n"
    "  - {name: overlap, observable: bed.largest_overlap, expect: 0.02, margin: 1, kind: model, "
    "because: b, points: {height_l: 3.7}}\n"
    "  - {name: sweeps, observable: bed.sweeps_max, expect: 7, margin: 1, kind: round-off, "
    "because: b}\n"
    "  - {name: slope, observable: fit.order, expect: 2, margin: 1, kind: order, because: b}\n"
    "  - {name: along, observable: bed.solid_fraction_max, expect: {along: bed.largest_overlap, "
    "values: {0: 0.1, 1: 0.4}}, margin: 1, kind: model, because: b}\n"
    "  - {name: pair, observable: bed.sweeps_max, kind: regression, paired: true, margin: 0.1, "
    "detects: 0.3, because: b, points: {height_l: 5.1}}\n"
    "  - {name: read, observable: bed.sweeps_max, expect: {reference: published}, margin: 0.1, "
    "kind: model, because: b, points: {height_l: 5.1}}\n"
    "tiers: {smoke: {}, paper: {parameters: {value: 0.0217}}}\n";

struct stage {
    const char *folder;
    struct case_file *file;
    struct plan *plan;
};

static struct stage set_up(const char *text, enum tier tier) {
    struct fault fault;
    struct stage s = {.folder = unit_folder()};
    s.file = stage_case(s.folder, "fake/steady", text, &fault);
    unit_ok(fault.status, &fault);
    s.plan = stage_plan(s.file, tier);
    return s;
}

static void tear_down(struct stage *s) {
    plan_free(s->plan);
    case_free(s->file);
    unit_remove(s->folder);
}

static struct reference_key key_of(const struct stage *s, size_t check, size_t point,
                                   struct arena *a) {
    struct fault fault = FAULT_NONE;
    struct reference_key key;
    unit_ok(reference_key_make(&s->plan->cases[0], check, point, a, &key, &fault), &fault);
    return key;
}

START_TEST(rows_have_keys_of_their_own) {
    struct arena a = {0};
    struct stage s = set_up(body, TIER_SMOKE);
    const struct plan_case *c = &s.plan->cases[0];
    struct reference_key one = key_of(&s, 0, 0, &a), two = key_of(&s, 0, 1, &a);
    ck_assert_str_eq(one.point, "height_l=3.7,width_l=3");
    ck_assert_str_eq(one.observable, "bed.largest_overlap");
    ck_assert(!one.difference && one.tier == TIER_SMOKE && strlen(one.meaning) == 8);
    ck_assert_str_ne(one.meaning, two.meaning);
    ck_assert_str_ne(one.meaning, key_of(&s, 1, 0, &a).meaning);          /* another observable */
    ck_assert(reference_has_row(c, 0, 2) && !reference_has_row(c, 0, 3)); /* `points` */
    struct reference_key fit = key_of(&s, 2, 0, &a);
    ck_assert_str_eq(fit.point, "height_l=3.7");
    ck_assert_str_eq(fit.observable, "fit.order");
    ck_assert(reference_has_row(c, 2, 0) && !reference_has_row(c, 2, 1) &&
              reference_has_row(c, 2, 3));
    struct reference_key along = key_of(&s, 3, 0, &a);
    ck_assert(along.difference);
    ck_assert_ptr_eq(
        strstr(along.observable, "bed.solid_fraction_max - curve(bed.largest_overlap,"),
        along.observable);
    arena_free(&a);
    tear_down(&s);
}
END_TEST

/* `old` replaced by `new` in the case's text: does the meaning of check 0 at point 0 stay? */
static bool same_meaning(const char *old, const char *new) {
    struct arena a = {0};
    char text[4096];
    const char *at = strstr(body, old);
    ck_assert_ptr_nonnull(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - body), body, new, at + strlen(old));
    struct stage s = set_up(body, TIER_SMOKE), t = set_up(text, TIER_SMOKE);
    bool same = strcmp(key_of(&s, 0, 0, &a).meaning, key_of(&t, 0, 0, &a).meaning) == 0;
    arena_free(&a);
    tear_down(&s);
    tear_down(&t);
    return same;
}

START_TEST(a_changed_case_text_is_another_meaning) {
    ck_assert(!same_meaning("value: 0.0213", "value: 0.0214"));
    ck_assert(!same_meaning("[0, 1.37]", "[0, 1.38]"));
    ck_assert(
        !same_meaning("observable: bed.largest_overlap, expect", /* of the check, not the fit */
                      "observable: bed.sweeps_max, expect"));
    ck_assert(same_meaning("because: b", "because: another word"));
    ck_assert(same_meaning("title: t", "title: another"));
    ck_assert(same_meaning("count: 2}", "count: 3}"));
    ck_assert(same_meaning("expect: 0.02,", "expect: 0.03,"));
}
END_TEST

#define COMMIT "0123456789abcdef0123456789abcdef01234567"
#define HASH   "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff"
#define MADE   "1a2b3c4d\t" COMMIT "\t" HASH "\t2026-11-22\tfirst set\n"
#define HEADER                                                                                     \
    "tier\tpoint\tobservable\torigin\tvalue\tdeviation\tseeds\tmeaning\tcommit\tsolver_key\t"      \
    "date\treason\n"
#define READ  "-\t-\t-\t2026-11-21\tread off Fig. 3\n"
#define OTHER "height_l=5.1,width_l=12\t"
#define POINT "height_l=3.7,width_l=3\t"

static void check_line(const char *line, const char *why) {
    struct fault fault = FAULT_NONE;
    struct references *r;
    char text[1024];
    struct stage s = set_up(body, TIER_SMOKE);
    snprintf(text, sizeof text, HEADER "%s", line);
    unit_write(unit_path(s.folder, "fake/steady.tsv"), text);
    unit_ok(reference_load(s.folder, "fake/steady", &r, &fault), &fault);
    reference_check_tier(r, &s.plan->cases[0], &fault);
    if (why == NULL) {
        unit_ok(fault.status, &fault);
    } else {
        ck_assert_msg(fault.status == STATUS_BAD_INPUT, "accepted: %s", line);
        unit_says(&fault, "fake/steady.tsv:2: ");
        unit_says(&fault, why);
    }
    reference_free(r);
    tear_down(&s);
}

START_TEST(lines_that_nobody_uses_are_refused) {
    check_line("smoke\t" POINT "bed.largest_overlap\tensemble\t1\t2\t37\t" MADE, NULL);
    check_line("smoke\t" POINT "bed.largest_overlp\tensemble\t1\t2\t37\t" MADE,
               "did you mean bed.largest_overlap?");
    check_line("smoke\theight_l=3.7,width_l=4\tbed.largest_overlap\tensemble\t1\t2\t37\t" MADE,
               "no such point in this tier; did you mean height_l=3.7,width_l=");
    check_line("smoke\theight_l=5.1,width_l=3\tbed.largest_overlap\tensemble\t1\t2\t37\t" MADE,
               "no check of this point");
    check_line("smoke\t" POINT "bed.sweeps_max\tensemble\t1\t2\t37\t" MADE,
               "no check uses a reference of this origin");
    check_line("smoke\theight_l=5.1\tfit.order\tensemble\t1\t2\t37\t" MADE, NULL);
    check_line("smoke\t" POINT "fit.order\tensemble\t1\t2\t37\t" MADE, "no check of this point");
    check_line("large\t" POINT "bed.largest_overlap\tensemble\t1\t2\t37\t" MADE, "no such tier");
    check_line("paper\tanything\tat.all\tensemble\t1\t2\t37\t" MADE, NULL); /* that tier's turn */
    check_line("smoke\t" POINT "bits@1102\tbits\tgcc:" HASH "\t-\t1\t" MADE, NULL);
    check_line("smoke\t" POINT "bits@1103\tbits\tgcc:" HASH "\t-\t1\t" MADE, "no such seed");
    check_line("smoke\t" POINT "bed.largest_overlap@1101\tseed\t1\t-\t1\t" MADE,
               "no check uses a reference of this origin");
    check_line("smoke\t" OTHER "bed.sweeps_max@1101\tseed\t1\t-\t1\t" MADE, NULL);
    check_line("smoke\t" OTHER "bed.sweeps_max\tpublished\t1\t2\t0\t" READ, NULL);
    check_line("smoke\t" OTHER "bed.sweeps_max\tanalytic\t1\t2\t0\t" READ, "of this origin");
    check_line("smoke\t" POINT "bed.sweeps_max\tpublished\t1\t2\t0\t" READ, "of this origin");
    check_line("smoke\t" POINT "bed.sweeps_max\tcurve\t" HASH "\t-\t37\t" MADE, "of this origin");
}
END_TEST

START_TEST(a_paper_reference_is_none_of_the_smoke_tier) {
    struct fault fault = FAULT_NONE;
    struct arena a = {0};
    struct references *r;
    struct stage s = set_up(body, TIER_SMOKE), t = set_up(body, TIER_PAPER);
    unit_write(unit_path(s.folder, "fake/steady.tsv"),
               HEADER "paper\t" POINT "bed.largest_overlap\tensemble\t1\t2\t37\t" MADE);
    unit_ok(reference_load(s.folder, "fake/steady", &r, &fault), &fault);
    struct reference_key smoke = key_of(&s, 0, 0, &a), paper = key_of(&t, 0, 0, &a);
    ck_assert_ptr_null(reference_find(r, &smoke, ORIGIN_ENSEMBLE));
    ck_assert_ptr_nonnull(reference_find(r, &paper, ORIGIN_ENSEMBLE));
    ck_assert_str_ne(smoke.meaning, paper.meaning);
    reference_free(r);
    arena_free(&a);
    tear_down(&s);
    tear_down(&t);
}
END_TEST

/* -- the folder ------------------------------------------------------------------------ */

static struct fault look_at(const char *folder) {
    static const char *const names[] = {"fake/other", "fake/steady"};
    struct fault fault = FAULT_NONE;
    reference_check_folder(folder, names, 2, &fault);
    return fault;
}

START_TEST(tables_of_no_case_and_curves_of_no_table_are_refused) {
    static const double x[] = {0.37, 1.41}, y[] = {0.61, 0.58}, e[] = {1.1e-3, 2.3e-3};
    const struct reference_curve curve = {2, 37, x, y, e};
    struct fault fault = FAULT_NONE;
    struct digest d;
    char name[128], text[1024];
    const char *folder = unit_folder();
    mkdir(unit_path(folder, "fake"), 0755);
    mkdir(unit_path(folder, "curves"), 0755);
    unit_write(unit_path(folder, "README.md"), "for people\n");
    unit_ok(reference_curve_write(unit_path(folder, "curves/new.h5"), &curve, &d, &fault), &fault);
    snprintf(name, sizeof name, "curves/%s.h5", d.hex);
    rename(unit_path(folder, "curves/new.h5"), unit_path(folder, name));
    snprintf(text, sizeof text, HEADER "smoke\t-\tbed.profile\tcurve\t%s\t-\t37\t" MADE, d.hex);
    unit_write(unit_path(folder, "fake/steady.tsv"), text);
    fault = look_at(folder);
    unit_ok(fault.status, &fault);

    unit_write(unit_path(folder, "fake/stead.tsv"), HEADER);
    fault = look_at(folder);
    unit_says(&fault, "fake/stead.tsv: there is no such case; did you mean fake/steady?");
    unlink(unit_path(folder, "fake/stead.tsv"));

    unit_write(unit_path(folder, "curves/notes.txt"), "mine\n");
    fault = look_at(folder);
    unit_says(&fault, "curves/notes.txt: no table names this file");
    unlink(unit_path(folder, "curves/notes.txt"));

    FILE *file = fopen(unit_path(folder, name), "r+b"); /* one byte of its content */
    ck_assert_ptr_nonnull(file);
    fseek(file, -1, SEEK_END);
    int last = fgetc(file);
    fseek(file, -1, SEEK_END);
    fputc(last ^ 1, file);
    fclose(file);
    fault = look_at(folder);
    unit_says(&fault, "fake/steady.tsv:2: ");
    unit_says(&fault, "does not fit its name");

    unlink(unit_path(folder, name));
    fault = look_at(folder);
    unit_says(&fault, "fake/steady.tsv:2: ");
    unit_remove(folder);
}
END_TEST

int main(void) {
    const TTest *tests[] = {rows_have_keys_of_their_own,
                            a_changed_case_text_is_another_meaning,
                            lines_that_nobody_uses_are_refused,
                            a_paper_reference_is_none_of_the_smoke_tier,
                            tables_of_no_case_and_curves_of_no_table_are_refused,
                            NULL};
    return unit_run("reference_use", tests);
}
