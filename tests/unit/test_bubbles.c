/* test_bubbles.c -- round voids that rise, meet, part and burst in a bed 33 l high. */
#include "tests/unit/disc_field.h"
#include "tests/unit/unit.h"
#include "validation/bubbles.h"

enum { NX = 31, NY = 45, BED_TOP = 33, MAX_DISCS = 4 };
static const double DT = 0.5;

static struct fault fault;

static struct bubbles *tracker(double area_min) {
    struct bubble_rule rule = {.threshold = 0.285, .area_min_l2 = area_min, .layer_span = 0.5};
    struct bubbles *b;
    fault = FAULT_NONE;
    unit_ok(bubbles_create(&rule, NX, NY, &b, &fault), &fault);
    return b;
}

/* Discs in a bed that ends between rows BED_TOP and BED_TOP + 1. */
static void add(struct bubbles *b, double time, const struct disc *discs, size_t count) {
    double field[NX * NY];
    disc_field(field, NX, NY, discs, count);
    for (size_t k = (BED_TOP + 1) * NX; k < NX * NY; k++)
        field[k] = 0.011;
    unit_ok(bubbles_add(b, time, field, &fault), &fault);
}

/* The only event of a kind; *others: how many there are of other kinds. */
static struct bubble_event only(const struct bubbles *b, enum bubble_event_kind kind,
                                size_t *others) {
    struct bubble_history h = bubbles_history(b);
    struct bubble_event found = {.track = BUBBLE_NONE};
    *others = 0;
    for (size_t i = 0; i < h.events; i++) {
        if (h.event[i].kind != kind) {
            ++*others;
            continue;
        }
        ck_assert_uint_eq(found.track, BUBBLE_NONE);
        found = h.event[i];
    }
    ck_assert_uint_ne(found.track, BUBBLE_NONE);
    return found;
}

START_TEST(two_rise_at_their_own_speeds) {
    struct bubbles *b = tracker(4);
    struct bubble_stretch *s;
    size_t count;
    for (int f = 0; f < 20; f++) {
        double t = f * DT;
        struct disc d[] = {{8.3, 6.1 + 0.83 * t, 2.21}, {21.7 + 0.1 * t, 9.4 + 1.27 * t, 3.37}};
        add(b, t, d, 2);
    }
    struct bubble_history h = bubbles_history(b);
    ck_assert_uint_eq(h.tracks, 2);
    ck_assert_uint_eq(h.points, 40);
    ck_assert_uint_eq(h.events, 0);
    ck_assert(h.track[0].initial && h.track[1].initial);
    ck_assert_double_eq_tol(h.frame[3].top_l, BED_TOP + 0.5, 0.05);
    unit_ok(bubbles_stretches(b, 5, 1e6, &s, &count, &fault), &fault);
    ck_assert_uint_eq(count, 2);
    ck_assert_double_eq_tol(s[0].speed_u0, 0.83, 0.01);
    ck_assert_double_eq_tol(s[1].speed_u0, 1.27, 0.01);
    ck_assert_double_eq_tol(s[0].area_l2 / (M_PI * 2.21 * 2.21), 1, 0.04);
    ck_assert_double_eq_tol(s[1].area_l2 / (M_PI * 3.37 * 3.37), 1, 0.04);
    ck_assert(!s[0].at_side_wall);
    free(s);
    unit_ok(bubbles_stretches(b, 5, 3, &s, &count, &fault), &fault); /* 7 + 7 + 6 frames each */
    ck_assert_uint_eq(count, 6);
    ck_assert_uint_eq(s[2].points, 6);
    ck_assert_double_eq_tol(s[2].speed_u0, 0.83, 0.06);
    free(s);
    bubbles_free(b);
}
END_TEST

/* A disc of radius 2.43 that runs into one of 3.1: they touch at frame 6. */
START_TEST(two_merge_at_a_known_frame) {
    struct bubbles *b = tracker(4);
    struct bubble_stretch *s;
    size_t others, count;
    for (int f = 0; f < 12; f++) {
        double gap = 6 - f; /* between the edges: -1 from frame 7 on */
        struct disc d[] = {{12.3, 10.2 + 0.4 * f, 3.1},
                           {12.3 + 3.1 + 2.43 + fmax(gap, -1), 10.2 + 0.4 * f, 2.43}};
        add(b, f * DT, d, 2);
    }
    struct bubble_event e = only(b, BUBBLE_MERGE, &others);
    ck_assert_uint_eq(others, 0);
    ck_assert_double_ge(e.time_tau, 5 * DT); /* sites see the neck within one of its width */
    ck_assert_double_le(e.time_tau, 7 * DT);
    ck_assert_uint_eq(bubbles_history(b).tracks, 2);
    ck_assert_double_eq_tol(e.area_l2, M_PI * 2.43 * 2.43, 1.5); /* the smaller one ends */
    ck_assert_double_eq_tol(e.other_l2, M_PI * 3.1 * 3.1, 1.5);
    unit_ok(bubbles_stretches(b, 4, 1e6, &s, &count, &fault), &fault);
    ck_assert_uint_eq(count, 3); /* two before, one after: the merge breaks the motion */
    for (size_t i = 0; i < count; i++)
        ck_assert_double_eq_tol(s[i].speed_u0, 0.8, 0.05);
    free(s);
    bubbles_free(b);
}
END_TEST

START_TEST(one_splits_into_two) {
    struct bubbles *b = tracker(4);
    size_t others;
    for (int f = 0; f < 10; f++) {
        double apart = f < 5 ? 3 : 6.7;
        struct disc d[] = {{15 - 0.6 * apart, 12.3, 2.81}, {15 + 0.4 * apart, 12.3, 2.33}};
        add(b, 3.1 + f * DT, d, 2);
    }
    struct bubble_event e = only(b, BUBBLE_SPLIT, &others);
    ck_assert_uint_eq(others, 0);
    ck_assert_double_eq(e.time_tau, 3.1 + 5 * DT);
    ck_assert_uint_eq(e.other, 0);
    ck_assert_double_lt(e.area_l2, e.other_l2); /* the larger part keeps the number */
    ck_assert_int_eq(bubbles_history(b).track[e.track].origin, BUBBLE_SPLIT);
    bubbles_free(b);
}
END_TEST

START_TEST(one_bursts_through_the_top) {
    struct bubbles *b = tracker(4);
    size_t others;
    for (int f = 0; f < 14; f++) {
        struct disc d = {15.3, 25.2 + 0.6 * f, 2.7};
        add(b, f * DT, &d, 1);
    }
    struct bubble_event e = only(b, BUBBLE_BURST, &others);
    ck_assert_uint_eq(others, 0);
    ck_assert_double_eq_tol(e.time_tau, DT * (33.5 - 25.2 - 2.7) / 0.6, 2 * DT);
    bubbles_free(b);
}
END_TEST

START_TEST(a_void_at_a_wall_is_known_as_such) {
    struct bubbles *b = tracker(4);
    struct bubble_stretch *s;
    size_t count;
    for (int f = 0; f < 9; f++) {
        struct disc d = {0.4, 8.2 + 0.55 * f, 3.3};
        add(b, f * DT, &d, 1);
    }
    unit_ok(bubbles_stretches(b, 5, 1e6, &s, &count, &fault), &fault);
    ck_assert_uint_eq(count, 1);
    ck_assert(s[0].at_side_wall);
    ck_assert_double_eq_tol(s[0].speed_u0, 1.1, 0.03);
    free(s);
    bubbles_free(b);
}
END_TEST

/* A square of `side` sites has its side squared as area; half of area_min is followed. */
static void add_square(struct bubbles *b, double time, int side) {
    double field[NX * NY];
    disc_field(field, NX, NY, NULL, 0);
    for (size_t k = (BED_TOP + 1) * NX; k < NX * NY; k++)
        field[k] = 0.011;
    for (int j = 7; j < 7 + side; j++)
        for (int i = 11; i < 11 + side; i++)
            field[j * NX + i] = 0.13;
    for (int n = 0; n < 12; n++) /* noise: single sites that come and go */
        field[(20 + n / 6 * 3) * NX + 2 + 4 * (n % 6) + (int)time % 2] = 0.2;
    unit_ok(bubbles_add(b, time, field, &fault), &fault);
}

START_TEST(area_min_itself_counts_and_speckles_do_not) {
    struct bubbles *b = tracker(4);
    for (int f = 0; f < 4; f++)
        add_square(b, f, 2);
    struct bubble_history h = bubbles_history(b);
    ck_assert_uint_eq(h.tracks, 1);
    ck_assert_uint_eq(h.track[0].large, 4);
    ck_assert_uint_eq(h.events, 0);
    bubbles_free(b);
    b = tracker(4.001);
    for (int f = 0; f < 4; f++)
        add_square(b, f, 2);
    h = bubbles_history(b);
    ck_assert_uint_eq(h.tracks, 1); /* followed, but never large */
    ck_assert_uint_eq(h.track[0].large, 0);
    bubbles_free(b);
}
END_TEST

START_TEST(births_and_vanishings_are_told) {
    struct bubbles *b = tracker(9);
    for (int f = 0; f < 7; f++)
        add_square(b, f, f < 2 || f > 4 ? 0 : 3);
    struct bubble_history h = bubbles_history(b);
    ck_assert_uint_eq(h.events, 2);
    ck_assert_int_eq(h.event[0].kind, BUBBLE_BIRTH);
    ck_assert_double_eq(h.event[0].time_tau, 2);
    ck_assert_int_eq(h.event[1].kind, BUBBLE_VANISH);
    ck_assert_double_eq(h.event[1].time_tau, 5);
    ck_assert_double_eq(h.event[1].area_l2, 9);
    ck_assert_uint_eq(h.track[0].large, 3);
    ck_assert(!h.track[0].initial);
    bubbles_free(b);
}
END_TEST

/* A gas layer over .8 of the width; one disc comes off it, and joins it again. */
START_TEST(a_layer_is_no_bubble_but_sheds_them) {
    struct bubbles *b = tracker(4);
    double field[NX * NY];
    for (int f = 0; f < 6; f++) {
        struct disc d = {15, 9.2, 2.7};
        disc_field(field, NX, NY, &d, 1);
        for (size_t k = (BED_TOP + 1) * NX; k < NX * NY; k++)
            field[k] = 0.011;
        int top = f < 2 || f == 5 ? 8 : 5; /* the layer sinks away from the disc and comes back */
        for (int j = 0; j < top; j++)
            for (int i = 3; i < 27; i++)
                field[j * NX + i] = 0.07;
        unit_ok(bubbles_add(b, f, field, &fault), &fault);
    }
    struct bubble_history h = bubbles_history(b);
    ck_assert_uint_eq(h.tracks, 1);
    ck_assert_int_eq(h.track[0].origin, BUBBLE_SHED);
    ck_assert_uint_eq(h.events, 2);
    ck_assert_int_eq(h.event[0].kind, BUBBLE_SHED);
    ck_assert_double_eq(h.event[0].time_tau, 2);
    ck_assert_int_eq(h.event[1].kind, BUBBLE_ENGULF);
    ck_assert_double_eq_tol(h.frame[0].layer_span, 24 / 30., 1e-12);
    bubbles_free(b);
}
END_TEST

START_TEST(contact_that_does_not_last_is_brief) {
    struct bubbles *b = tracker(4);
    for (int f = 0; f < 20; f++) { /* they touch in frame 4, and for good from 12 on */
        double apart = f == 4 || f >= 12 ? 4.7 : 7.3;
        struct disc d[] = {{11.2, 12.3, 2.81}, {11.2 + apart, 12.3, 2.33}};
        add(b, f * DT, d, 2);
    }
    bubbles_mark_brief(b, 1);
    struct bubble_history h = bubbles_history(b);
    ck_assert_uint_eq(h.events, 3);
    ck_assert_int_eq(h.event[0].kind, BUBBLE_MERGE);
    ck_assert_int_eq(h.event[1].kind, BUBBLE_SPLIT);
    ck_assert(h.event[0].brief && h.event[1].brief);
    ck_assert_int_eq(h.event[2].kind, BUBBLE_MERGE);
    ck_assert(!h.event[2].brief);
    bubbles_mark_brief(b, 0.3); /* less than a frame: both count */
    ck_assert(!h.event[0].brief && !h.event[1].brief);
    bubbles_free(b);
}
END_TEST

/* Faster than its radius a frame: only its own velocity finds it again. */
START_TEST(velocity_carries_a_fast_one) {
    struct bubbles *b = tracker(4);
    double y = 4.3, speed = 1;
    for (int f = 0; f < 9; f++, y += speed, speed = fmin(speed * 1.4, 4)) {
        struct disc d = {14.2, y, 1.61};
        add(b, f, &d, 1);
    }
    ck_assert_uint_eq(bubbles_history(b).tracks, 1);
    ck_assert_uint_eq(bubbles_history(b).events, 0);
    ck_assert_double_gt(speed, 2 * 1.61);
    bubbles_free(b);
}
END_TEST

START_TEST(faults_are_told) {
    struct bubbles *b = tracker(4);
    double field[NX * NY] = {0};
    struct bubble_stretch *s;
    size_t count;
    ck_assert_int_eq(bubbles_add(b, 3.7, field, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "no bed at 3.7 tau");
    bubbles_free(b);
    b = tracker(4);
    struct disc d = {14.2, 9.1, 2.61};
    add(b, 3.7, &d, 1);
    ck_assert_int_eq(bubbles_add(b, 3.7, field, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "follows one at 3.7 tau");
    ck_assert_int_eq(bubbles_stretches(b, 2, 10, &s, &count, &fault), STATUS_BAD_INPUT);
    ck_assert_ptr_null(s);
    bubbles_free(b);
    bubbles_free(NULL);
}
END_TEST

START_TEST(a_crowd_beyond_the_table_is_refused) {
    enum { WIDE = 71, HIGH = 71 };
    double field[WIDE * HIGH];
    struct bubble_rule rule = {.threshold = 0.285, .area_min_l2 = 1, .layer_span = 0.5};
    struct bubbles *b;
    fault = FAULT_NONE;
    for (int k = 0; k < WIDE * HIGH; k++) /* every second site of every second row */
        field[k] = (k % WIDE) % 2 && (k / WIDE) % 2 && k / WIDE < 69 ? 0.1 : 0.53;
    unit_ok(bubbles_create(&rule, WIDE, HIGH, &b, &fault), &fault);
    ck_assert_int_eq(bubbles_add(b, 0, field, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "more than 1024 bubbles");
    bubbles_free(b);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {two_rise_at_their_own_speeds,
                                  two_merge_at_a_known_frame,
                                  one_splits_into_two,
                                  one_bursts_through_the_top,
                                  a_void_at_a_wall_is_known_as_such,
                                  area_min_itself_counts_and_speckles_do_not,
                                  births_and_vanishings_are_told,
                                  a_layer_is_no_bubble_but_sheds_them,
                                  contact_that_does_not_last_is_brief,
                                  velocity_carries_a_fast_one,
                                  faults_are_told,
                                  a_crowd_beyond_the_table_is_refused,
                                  NULL};
    return unit_run("bubbles", tests);
}
