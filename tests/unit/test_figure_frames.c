/* test_figure_frames.c -- validation/figure_frames.h: frames by times, spread, and moving. */
#include "tests/unit/unit.h"
#include "validation/figure_frames.h"

/* Samples every .13 s; phibar changes at .39 s, with sample 3. */
static const double time_s[] = {0, 0.13, 0.26, 0.39, 0.52, 0.65, 0.78, 0.91, 1.04, 1.17, 1.30};

struct stage {
    struct arena arena;
    struct figure_frames frames;
    struct case_figure wanted;
    struct fault fault;
};

static void set_up(struct stage *s) {
    *s = (struct stage){.frames = {.path = "some.h5",
                                   .unit = "s",
                                   .time = time_s,
                                   .frames = sizeof time_s / sizeof *time_s,
                                   .from = 0.39,
                                   .slack = 1.3e-6},
                        .fault = FAULT_NONE};
}

static void ask_times(struct stage *s, const double *times, size_t count) {
    s->wanted.setting[0] =
        (struct case_figure_setting){.given = true, .numbers = times, .count = count};
}

static void ask_moving(struct stage *s, double every, double most) {
    s->wanted.setting[0].number = every;
    s->wanted.setting[1].number = most;
}

static enum status choose(struct stage *s, bool moving) {
    return figure_frames_choose(&s->frames, &s->wanted, moving, &s->arena, &s->fault);
}

static void shows(const struct stage *s, const size_t *frame, size_t count) {
    ck_assert_uint_eq(s->frames.count, count);
    for (size_t i = 0; i < count; i++)
        ck_assert_uint_eq(s->frames.shown[i], frame[i]);
}

START_TEST(times_count_from_the_change_and_those_beyond_the_end_are_named) {
    static const double times[] = {0, 0.26, 0.91, 2.6, 3.1};
    static const size_t frame[] = {3, 5, 10};
    struct stage s;
    set_up(&s);
    ask_times(&s, times, 5);
    unit_ok(choose(&s, false), &s.fault);
    shows(&s, frame, 3);
    ck_assert_str_eq(s.frames.missing, " Not reached (s): 2.6, 3.1.");
    ck_assert_double_eq(figure_frames_time(&s.frames, 0), 0);
    ck_assert_double_eq_tol(figure_frames_time(&s.frames, 1), 0.26, 1e-12);
    arena_free(&s.arena);
}
END_TEST

START_TEST(times_between_frames_too_many_or_all_too_late_are_faults) {
    static const double between[] = {0.13, 0.2}, late[] = {1.7, 1.9}, many[25] = {0};
    struct stage s;
    set_up(&s);
    ask_times(&s, between, 2);
    ck_assert_int_eq(choose(&s, false), STATUS_NOT_FOUND);
    unit_says(&s.fault, "some.h5: has no frame at 0.2 s after the change");
    ask_times(&s, late, 2);
    ck_assert_int_eq(choose(&s, false), STATUS_BAD_INPUT);
    unit_says(&s.fault, "the run reaches none of them");
    ask_times(&s, many, 25);
    ck_assert_int_eq(choose(&s, false), STATUS_BAD_INPUT);
    unit_says(&s.fault, "25 are too many, 24 can be shown");
    arena_free(&s.arena);
}
END_TEST

START_TEST(without_times_six_are_spread_from_the_change_to_the_end) {
    static const size_t frame[] = {3, 4, 6, 7, 9, 10}, few[] = {9, 10};
    struct stage s;
    set_up(&s);
    unit_ok(choose(&s, false), &s.fault);
    shows(&s, frame, 6);
    ck_assert_str_eq(s.frames.missing, "");
    s.frames.from = 1.17;
    unit_ok(choose(&s, false), &s.fault);
    shows(&s, few, 2);
    arena_free(&s.arena);
}
END_TEST

START_TEST(what_moves_takes_multiples_and_thins_them_evenly) {
    static const size_t all[] = {3, 4, 5, 6, 7, 8, 9, 10}, even[] = {3, 5, 7, 9}, thin[] = {3, 7};
    struct stage s;
    set_up(&s);
    ask_moving(&s, 0, 61);
    unit_ok(choose(&s, true), &s.fault);
    shows(&s, all, 8);
    ask_moving(&s, 0.26, 61);
    unit_ok(choose(&s, true), &s.fault);
    shows(&s, even, 4);
    ask_moving(&s, 0.26, 3);
    unit_ok(choose(&s, true), &s.fault);
    shows(&s, thin, 2);
    s.frames.from = 0.41;
    ask_moving(&s, 0.17, 61);
    ck_assert_int_eq(choose(&s, true), STATUS_BAD_INPUT);
    unit_says(&s.fault, "every_s: no frame at a multiple of 0.17 s");
    arena_free(&s.arena);
}
END_TEST

START_TEST(the_first_usable_run_is_taken) {
    struct measured_run run[] = {{.usable = false}, {.usable = false}, {.usable = true}};
    struct measured_point point[] = {{.run = run, .run_count = 2},
                                     {.run = run + 1, .run_count = 2}};
    struct measured_case data = {.point = point, .point_count = 2};
    struct figure_input in = {.data = &data};
    const struct measured_point *at;
    const struct measured_run *taken;
    struct fault fault = FAULT_NONE;
    unit_ok(figure_frames_run(&in, &at, &taken, &fault), &fault);
    ck_assert_ptr_eq(at, &point[1]);
    ck_assert_ptr_eq(taken, &run[2]);
    run[2].usable = false;
    ck_assert_int_eq(figure_frames_run(&in, &at, &taken, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no run can be used");
}
END_TEST

int main(void) {
    const TTest *tests[] = {times_count_from_the_change_and_those_beyond_the_end_are_named,
                            times_between_frames_too_many_or_all_too_late_are_faults,
                            without_times_six_are_spread_from_the_change_to_the_end,
                            what_moves_takes_multiples_and_thins_them_evenly,
                            the_first_usable_run_is_taken,
                            NULL};
    return unit_run("figure_frames", tests);
}
