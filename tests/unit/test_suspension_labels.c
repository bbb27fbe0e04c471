/* test_suspension_labels.c -- a sphere's number is a name: spheres listed in another order, or
 * mirrored, move as before. */
#include "tests/unit/suspension_fixture.h"

#include <math.h>

enum { N = 27 };
static const double R = 6e-4, SIDE_R = 13;

static double random_share(unsigned *state) {
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

struct motion {
    double place[3 * N], velocity[3 * N];
};

/* A loose lattice with random speeds. */
static struct motion lattice(void) {
    struct motion m;
    unsigned state = 97;
    for (int i = 0; i < N; i++) {
        int cell[3] = {i % 3, i / 3 % 3, i / 9};
        for (int a = 0; a < 3; a++) {
            m.place[3 * i + a] = (2.3 + 4.1 * cell[a] + 0.9 * (random_share(&state) - 0.5)) * R;
            m.velocity[3 * i + a] = 0.08 * (random_share(&state) - 0.5);
        }
    }
    return m;
}

static int write_list(char *text, size_t size, const char *name, const double *value, int axis) {
    int n = snprintf(text, size, "%s: [", name);
    for (int i = 0; i < N; i++)
        n += snprintf(text + n, size - (size_t)n, "%s%.17g", i ? ", " : "", value[3 * i + axis]);
    return n + snprintf(text + n, size - (size_t)n, "]\n");
}

/* Runs the motion for `time`; its end is put back. Returns the collisions. */
static long long run(struct motion *m, const char *boundary, double restitution, double time) {
    static const char *const place[] = {"sphere_x", "sphere_y", "sphere_z"};
    static const char *const speed[] = {"sphere_velocity_x", "sphere_velocity_y",
                                        "sphere_velocity_z"};
    char text[16384];
    int n = snprintf(text, sizeof text,
                     "particles: %d\nstart: list\nwidth_x_R: 13\nwidth_y_R: 13\nheight_R: 13\n"
                     "boundary_x: %s\nboundary_y: %s\nboundary_z: hard\nrestitution: %g\n"
                     "noise_rate: none\nguard: none\ndrag_per_s: 0.1\n",
                     N, boundary, boundary, restitution);
    for (int a = 0; a < 3; a++) {
        n += write_list(text + n, sizeof text - (size_t)n, place[a], m->place, a);
        n += write_list(text + n, sizeof text - (size_t)n, speed[a], m->velocity, a);
    }
    struct suspension *s = fixture_state(text, 5);
    fixture_run(s, time);
    fixture_look(s);
    memcpy(m->place, s->position, sizeof m->place);
    memcpy(m->velocity, s->velocity, sizeof m->velocity);
    long long collisions = engine_tally(s->engine)->collisions;
    suspension_model.free(s);
    return collisions;
}

/* Largest difference of sphere i and sphere to[i], in R and in .08 m/s. */
static double difference(const struct motion *a, const struct motion *b, const int *to) {
    double worst = 0;
    for (int i = 0; i < N; i++)
        for (int k = 0; k < 3; k++) {
            worst = fmax(worst, fabs(a->place[3 * i + k] - b->place[3 * to[i] + k]) / R);
            worst = fmax(worst, fabs(a->velocity[3 * i + k] - b->velocity[3 * to[i] + k]) / 0.08);
        }
    return worst;
}

/* Rounding, 1e-16, grows by ten or so in each of some 3 collisions of a sphere. */
START_TEST(another_order_of_the_list_changes_labels_only) {
    static const char *const boundary[] = {"periodic", "hard"};
    for (int n = 0; n < 2; n++) {
        struct motion a = lattice(), b;
        int to[N];
        for (int i = 0; i < N; i++) {
            to[i] = (7 * i + 11) % N;
            memcpy(b.place + 3 * to[i], a.place + 3 * i, 3 * sizeof *a.place);
            memcpy(b.velocity + 3 * to[i], a.velocity + 3 * i, 3 * sizeof *a.velocity);
        }
        struct motion start = a;
        long long collisions = run(&a, boundary[n], 0.9, 0.45);
        ck_assert_int_eq(run(&b, boundary[n], 0.9, 0.45), collisions);
        ck_assert_int_gt(collisions, N);
        ck_assert_double_lt(difference(&a, &b, to), 1e-7);
        for (int i = 0; i < N; i++)
            to[i] = i;
        ck_assert_double_gt(difference(&a, &start, to), 1);
    }
}
END_TEST

START_TEST(the_mirrored_box_moves_as_the_mirror_image) {
    struct motion a = lattice(), b = a;
    int to[N];
    for (int i = 0; i < N; i++) {
        to[i] = i;
        b.place[3 * i] = SIDE_R * R - a.place[3 * i];
        b.velocity[3 * i] = -a.velocity[3 * i];
    }
    long long collisions = run(&a, "hard", 0.9, 0.45);
    ck_assert_int_eq(run(&b, "hard", 0.9, 0.45), collisions);
    ck_assert_int_gt(collisions, N);
    for (int i = 0; i < N; i++) {
        b.place[3 * i] = SIDE_R * R - b.place[3 * i];
        b.velocity[3 * i] *= -1;
    }
    ck_assert_double_lt(difference(&a, &b, to), 1e-7);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {another_order_of_the_list_changes_labels_only,
                                  the_mirrored_box_moves_as_the_mirror_image, NULL};
    return unit_run("suspension_labels", tests);
}
