/* test_unchanged.c -- validation/unchanged.h: same bits, other bits, another build, another text.
 */
#include "common/h5.h"
#include "tests/unit/judged_stage.h"
#include "validation/bits.h"

static const char text[] = STAGE_HEAD "checks:\n"
                                      "  - {name: same, observable: bed.largest_overlap, kind: "
                                      "regression, detects: 9 %, because: b,\n"
                                      "     points: {height_l: 3.7}}\n"
                                      "tiers: {smoke: {}}\n";

static const char record[] = "{\"build\": {\"compiler\": \"gcc 13.2.0\", \"flags\": \"-O2\"}}";

/* A result of every dataset of the case, one number each. */
static void write_result(struct stage *s, struct measured_run *r, double value) {
    struct fault fault = FAULT_NONE;
    struct h5_writer *w;
    struct arena *a = &s->m->arena;
    const struct case_file *c = s->m->plan->file;
    r->result_path = folder_result(s->results, a, r->run);
    unit_ok(h5_create(r->result_path, &w, &fault), &fault);
    for (size_t i = 0; i < c->dataset_count; i++)
        unit_ok(h5_write(w, c->dataset[i], H5_REAL, 0, NULL, &value, "1", &fault), &fault);
    unit_ok(h5_commit(w, &fault), &fault);
    unit_write(folder_run_record(s->results, a, r->run), record);
}

static struct reference bits_line(struct stage *s, const struct measured_run *r, size_t point,
                                  struct digest *d, struct bits_build *build) {
    struct fault fault = FAULT_NONE;
    struct arena *a = &s->m->arena;
    const struct case_file *c = s->m->plan->file;
    struct reference line = stage_line(s, 0, point, ORIGIN_ENSEMBLE, NAN, NAN);
    unit_ok(bits_of_result(r->result_path, c->dataset, c->dataset_count, d, &fault), &fault);
    unit_ok(bits_read_build(folder_run_record(s->results, a, r->run), build, &fault), &fault);
    line.origin = ORIGIN_BITS;
    line.observable = arena_text(a, "bits@%lld", r->run->seed);
    line.digest = d->hex;
    line.build = build->name;
    line.seeds = 1;
    line.meaning = arena_copy(a, reference_run_meaning(r->run));
    return line;
}

static void store(struct stage *s, struct reference *line, size_t count) {
    struct fault fault;
    stage_write(s, line, count);
    unit_ok(stage_open(s, TIER_SMOKE, &fault), &fault);
    stage_attach(s);
}

START_TEST(a_row_says_whether_its_bits_are_those_of_the_reference) {
    struct stage s;
    struct fault fault;
    struct digest d[2];
    struct bits_build build;
    stage_begin(&s, text);
    unit_ok(stage_open(&s, TIER_SMOKE, &fault), &fault);
    stage_measure(&s);
    struct measured_run *run = s.m->point[0].run;
    for (int i = 0; i < 2; i++) {
        write_result(&s, &run[i], 0.731 + 0.1 * i);
        run[i].sample[0].measured = 1.3641 + 0.013 * i;
    }
    s.m->point[1].run[0].usable = s.m->point[1].run[1].usable = false;
    s.m->point[1].run[0].failure = s.m->point[1].run[1].failure = "not made";
    struct reference line[3] = {bits_line(&s, &run[0], 0, &d[0], &build),
                                bits_line(&s, &run[1], 0, &d[1], &build),
                                stage_line(&s, 0, 0, ORIGIN_ENSEMBLE, 1.3712, 0.0131)};
    store(&s, line, 3);
    const struct report_row *row = stage_judge(&s, "same", "height_l=3.7");
    ck_assert_str_eq(row->bits, "same bits as the reference");
    ck_assert_ptr_nonnull(strstr(row->reason, "same bits as the reference: 1.3706 lies within"));
    ck_assert_int_eq(row->verdict, VERDICT_PASS);
    ck_assert(s.rows->bits.same == 2 && s.rows->bits.other == 0 && s.rows->bits.unknown == 2);

    run[0].sample[0].measured = run[1].sample[0].measured + 9; /* only the recipe has changed */
    row = stage_judge(&s, "same", "height_l=3.7");
    ck_assert_int_eq(row->verdict, VERDICT_FAIL);
    run[0].sample[0].measured = 1.3641;

    write_result(&s, &run[1], nextafter(0.831, 1));
    row = stage_judge(&s, "same", "height_l=3.7");
    ck_assert_str_eq(row->bits, "other bits than the reference in 1 of 2 runs");
    ck_assert_int_eq(row->verdict, VERDICT_PASS); /* by statistics */

    line[0].meaning = "00000000"; /* bits of another text */
    store(&s, line, 3);
    write_result(&s, &run[1], 0.831);
    row = stage_judge(&s, "same", "height_l=3.7");
    ck_assert_str_eq(row->bits, "same bits as the reference in 1 of 2 runs");
    line[0].build = line[1].build = "clang-16/-O3/unknown/unknown";
    store(&s, line, 3);
    ck_assert_ptr_null(stage_judge(&s, "same", "height_l=3.7")->bits);
    stage_end(&s);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_row_says_whether_its_bits_are_those_of_the_reference, NULL};
    return unit_run("unchanged", tests);
}
