/* test_queue.c -- solver/suspension/queue.h: the earliest event first, whatever the buckets. */
#include "solver/suspension/queue.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_rng.h>
#include <math.h>

enum { COUNT = 10000, LEAVES = 16384 };

/* A queue, and a tournament of all events that knows their order by itself. */
struct race {
    struct event *event;
    struct queue queue;
    uint32_t winner[2 * LEAVES]; /* winner[LEAVES + i]: i; winner[1]: the first of all */
    gsl_rng *rng;
};

static bool is_before(const struct event *event, uint32_t a, uint32_t b) {
    if (a >= COUNT || b >= COUNT)
        return a < COUNT;
    return event[a].time < event[b].time || (event[a].time == event[b].time && a < b);
}

static void play(struct race *r, size_t node) {
    uint32_t a = r->winner[2 * node], b = r->winner[2 * node + 1];
    r->winner[node] = is_before(r->event, a, b) ? a : b;
}

static void play_all(struct race *r) {
    for (size_t i = 0; i < LEAVES; i++)
        r->winner[LEAVES + i] = (uint32_t)i;
    for (size_t node = LEAVES - 1; node > 0; node--)
        play(r, node);
}

static struct race *race_new(void) {
    struct fault fault = FAULT_NONE;
    struct race *r = malloc(sizeof *r);
    ck_assert_ptr_nonnull(r);
    r->event = spheres_memory(COUNT * sizeof *r->event);
    ck_assert_ptr_nonnull(r->event);
    memset(r->event, 0, COUNT * sizeof *r->event);
    unit_ok(queue_create(&r->queue, r->event, COUNT, &fault), &fault);
    r->rng = gsl_rng_alloc(gsl_rng_mt19937);
    return r;
}

static void race_free(struct race *r) {
    queue_free(&r->queue);
    free(r->event);
    gsl_rng_free(r->rng);
    free(r);
}

static void set_time(struct race *r, uint32_t i, double time) {
    r->event[i].time = time;
    queue_move(&r->queue, i);
    for (size_t node = (LEAVES + i) / 2; node > 0; node /= 2)
        play(r, node);
}

/* Times in [now, now + 1), uniform in [0, 1) to begin with. */
static void start(struct race *r, double now, double width) {
    for (size_t i = 0; i < COUNT; i++)
        r->event[i].time = now + gsl_rng_uniform(r->rng);
    play_all(r);
    queue_rebuild(&r->queue, now, width);
}

static uint32_t expect_first(struct race *r, double limit) {
    uint32_t first = r->winner[1];
    ck_assert_uint_eq(queue_first(&r->queue, limit),
                      r->event[first].time <= limit ? first : QUEUE_NONE);
    return first;
}

/* From one event a hundred buckets to all in one, which overflows 16 slots by far. */
static const double widths[] = {1e-6, 3.7e-4, 0.0113, 0.31, 2.9, 1e5};
enum { WIDTHS = sizeof widths / sizeof widths[0] };

START_TEST(all_come_in_the_order_of_time_and_each_once) {
    struct race *r = race_new();
    for (int n = 0; n < WIDTHS; n++) {
        double last = -1;
        start(r, 0, widths[n]);
        for (int k = 0; k < COUNT; k++) {
            uint32_t i = expect_first(r, 1);
            ck_assert_uint_lt(i, COUNT);
            ck_assert_double_ge(r->event[i].time, last);
            last = r->event[i].time;
            set_time(r, i, INFINITY);
        }
        ck_assert_uint_eq(queue_first(&r->queue, 1e3), QUEUE_NONE);
    }
    race_free(r);
}
END_TEST

/* What the engine does: the first is put off, others are put off, brought forward,
 * taken out or put in again; now and then by far more or less than a bucket. */
START_TEST(random_moves_leave_the_first_where_sorting_finds_it) {
    struct race *r = race_new();
    for (int n = 0; n < WIDTHS; n++) {
        start(r, 17.3, widths[n]);
        for (int k = 0; k < 60000; k++) {
            uint32_t i = expect_first(r, 1e9);
            double now = r->event[i].time, u = gsl_rng_uniform(r->rng);
            uint32_t other = (uint32_t)gsl_rng_uniform_int(r->rng, COUNT);
            set_time(r, i, now + u * pow(10, -6 * gsl_rng_uniform(r->rng)));
            switch (k % 8) {
            case 0:
                set_time(r, other, INFINITY);
                break;
            case 1:
                set_time(r, other, now + 1e-4 * u);
                break;
            case 2:
                set_time(r, other, now + 300 * u * u * u);
                break;
            case 3:
                set_time(r, other, now); /* at once */
                break;
            case 4:
                set_time(r, other, now + u);
                break;
            default:
                break;
            }
        }
    }
    race_free(r);
}
END_TEST

START_TEST(equal_times_come_in_the_order_of_places) {
    struct race *r = race_new();
    for (int n = 0; n < WIDTHS; n++) {
        for (size_t i = 0; i < COUNT; i++)
            r->event[i].time = 0.0137 * (double)gsl_rng_uniform_int(r->rng, 71);
        play_all(r);
        queue_rebuild(&r->queue, 0, widths[n]);
        for (int k = 0; k < 30000; k++) {
            uint32_t i = expect_first(r, 1e9);
            uint32_t other = (uint32_t)gsl_rng_uniform_int(r->rng, COUNT);
            double now = r->event[i].time;
            set_time(r, i, now + 0.0137 * (double)gsl_rng_uniform_int(r->rng, 9));
            if (k % 3 == 0)
                set_time(r, other, now);
        }
    }
    race_free(r);
}
END_TEST

/* The engine stops at samples and kicks: what is later stays, what a kick puts before the
 * next stop comes, also if the queue has looked far beyond it. */
START_TEST(nothing_comes_after_the_limit_and_all_up_to_it_does) {
    struct race *r = race_new();
    for (int n = 0; n < WIDTHS; n++) {
        start(r, 0, widths[n]);
        for (int k = 1; k <= 400; k++) {
            double limit = 0.00917 * k;
            uint32_t kicked = (uint32_t)gsl_rng_uniform_int(r->rng, COUNT);
            for (uint32_t i; (i = expect_first(r, limit)), r->event[i].time <= limit;)
                set_time(r, i, r->event[i].time + 1 + gsl_rng_uniform(r->rng));
            set_time(r, kicked, limit);
            expect_first(r, nextafter(limit, 0));
            ck_assert_uint_eq(queue_first(&r->queue, nextafter(limit, 0)), QUEUE_NONE);
            ck_assert_uint_eq(expect_first(r, limit), kicked);
            set_time(r, kicked, limit + 1e-3 * gsl_rng_uniform(r->rng));
        }
    }
    race_free(r);
}
END_TEST

/* Times from 1 to 1e270 in ten steps: found, and soon, though no bucket is near. */
START_TEST(an_event_beyond_a_long_void_is_found) {
    struct race *r = race_new();
    start(r, 0, 1e-6);
    for (uint32_t i = 0; i < COUNT; i++)
        set_time(r, i, i % 1000 == 0 ? exp2(0.1 * i) * (1 + gsl_rng_uniform(r->rng)) : INFINITY);
    for (int k = 0; k < COUNT / 1000; k++) {
        uint32_t i = expect_first(r, 1e300);
        ck_assert_uint_eq(i % 1000, 0);
        expect_first(r, 0.5 * r->event[i].time);
        set_time(r, (i + 1) % COUNT, 0.7 * r->event[i].time); /* before what was found */
        ck_assert_uint_eq(expect_first(r, 1e300), (i + 1) % COUNT);
        set_time(r, (i + 1) % COUNT, INFINITY);
        set_time(r, i, INFINITY);
    }
    ck_assert_uint_eq(queue_first(&r->queue, 1e300), QUEUE_NONE);
    race_free(r);
}
END_TEST

/* Rebuilding sets the clock back (time and origin fall by now) with another width, as a
 * rebase of the engine does, and rescales times by a power of two: the order stays. */
START_TEST(times_that_are_shifted_or_rescaled_keep_their_order) {
    struct race *r = race_new();
    start(r, 0, 0.0113);
    for (int n = 0; n < 40; n++) {
        const double scale = n % 3 == 0 ? 0x1p-13 : n % 3 == 1 ? 0x1p17 : 0x1p-4;
        for (int k = 0; k < 1500; k++) {
            uint32_t i = expect_first(r, 1e300);
            set_time(r, i, r->event[i].time * (1 + gsl_rng_uniform(r->rng)));
        }
        uint32_t first = expect_first(r, 1e300);
        double now = r->event[first].time;
        for (size_t i = 0; i < COUNT; i++)
            r->event[i].time = n % 3 == 2 ? r->event[i].time - now : r->event[i].time * scale;
        play_all(r);
        queue_rebuild(&r->queue, n % 3 == 2 ? 0 : now * scale, scale * now * widths[n % WIDTHS]);
        ck_assert_uint_eq(expect_first(r, 1e300), first);
        for (size_t i = 0; i < COUNT; i++) /* times of 0 would not grow above */
            set_time(r, (uint32_t)i, r->event[i].time + 1e-3 * gsl_rng_uniform(r->rng));
    }
    race_free(r);
}
END_TEST

/* The same moves in other units: the same spheres, in the same order. */
START_TEST(other_units_give_the_same_order) {
    static const double unit[] = {1, 0x1p-30, 0x1p40};
    uint64_t digest[3];
    for (int n = 0; n < 3; n++) {
        struct race *r = race_new();
        for (size_t i = 0; i < COUNT; i++)
            r->event[i].time = unit[n] * gsl_rng_uniform(r->rng);
        play_all(r);
        queue_rebuild(&r->queue, 0, unit[n] * 1.7e-4);
        digest[n] = 0;
        for (int k = 0; k < 20000; k++) {
            uint32_t i = expect_first(r, unit[n] * 1e6);
            digest[n] = digest[n] * 6364136223846793005u + i;
            set_time(r, i, r->event[i].time + unit[n] * gsl_rng_uniform(r->rng));
        }
        race_free(r);
    }
    ck_assert_uint_eq(digest[0], digest[1]);
    ck_assert_uint_eq(digest[0], digest[2]);
}
END_TEST

START_TEST(queues_of_none_and_of_one_work) {
    struct fault fault = FAULT_NONE;
    struct event one = {.time = 3.71};
    struct queue q;
    unit_ok(queue_create(&q, &one, 0, &fault), &fault);
    queue_rebuild(&q, 0, 1);
    ck_assert_uint_eq(queue_first(&q, 1e6), QUEUE_NONE);
    queue_free(&q);
    unit_ok(queue_create(&q, &one, 1, &fault), &fault);
    queue_rebuild(&q, 0, 0.1);
    ck_assert_uint_eq(queue_first(&q, 3.7), QUEUE_NONE);
    ck_assert_uint_eq(queue_first(&q, 3.72), 0);
    ck_assert_uint_eq(queue_first(&q, 3.72), 0); /* looking takes nothing out */
    one.time = 3.9;
    queue_move(&q, 0);
    ck_assert_uint_eq(queue_first(&q, 3.72), QUEUE_NONE);
    ck_assert_uint_eq(queue_first(&q, 4), 0);
    queue_free(&q);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {all_come_in_the_order_of_time_and_each_once,
                                  random_moves_leave_the_first_where_sorting_finds_it,
                                  equal_times_come_in_the_order_of_places,
                                  nothing_comes_after_the_limit_and_all_up_to_it_does,
                                  an_event_beyond_a_long_void_is_found,
                                  times_that_are_shifted_or_rescaled_keep_their_order,
                                  other_units_give_the_same_order,
                                  queues_of_none_and_of_one_work,
                                  NULL};
    return unit_run("queue", tests);
}
