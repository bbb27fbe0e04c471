/* test_components.c -- discs, halves and pairs on a lattice of 31 x 27 sites. */
#include "tests/unit/disc_field.h"
#include "tests/unit/unit.h"
#include "validation/components.h"

enum { NX = 31, NY = 27 };

/* Regions of a bed of .53 with these discs of .04 in it, below .285. */
static struct components regions_of(const struct disc *discs, size_t count, double *field) {
    struct components c;
    struct fault fault = FAULT_NONE;
    disc_field(field, NX, NY, discs, count);
    unit_ok(components_create(&c, NX, NY, &fault), &fault);
    components_find(&c, field, 0.285);
    return c;
}

START_TEST(a_disc_has_its_area_and_place) {
    double field[NX * NY];
    for (int n = 0; n < 7; n++) { /* at seven places between the sites */
        struct disc d = {14.3 + 0.17 * n, 11.1 + 0.41 * n, 4.37};
        struct components c = regions_of(&d, 1, field);
        ck_assert_uint_eq(c.count, 1);
        const struct component *r = &c.list[0];
        ck_assert_double_eq_tol(r->area_l2 / (M_PI * d.r * d.r), 1, 0.05);
        ck_assert_double_eq_tol(r->x_l, d.x, 0.08);
        ck_assert_double_eq_tol(r->y_l, d.y, 0.08);
        ck_assert_double_eq_tol(r->aspect, 1, 0.05);
        ck_assert_double_eq_tol(r->flatness, 0, 0.1);
        ck_assert_uint_eq(r->walls, 0);
        ck_assert_double_eq_tol(r->right_l - r->left_l, 2 * d.r, 1);
        ck_assert_double_eq_tol((r->top_l + r->bottom_l) / 2, d.y, 0.51);
        components_free(&c);
    }
}
END_TEST

START_TEST(control_volumes_at_walls_are_halved) {
    double field[NX * NY];
    struct disc d[] = {{0, 12.3, 3.9}, {30, 0, 5.2}, {17, 26, 3.3}};
    struct components c = regions_of(d, 3, field);
    ck_assert_uint_eq(c.count, 3);
    ck_assert_double_eq_tol(c.list[0].area_l2, M_PI * 5.2 * 5.2 / 4, 1.2);
    ck_assert_uint_eq(c.list[0].walls, COMPONENT_RIGHT | COMPONENT_BOTTOM);
    ck_assert_double_eq_tol(c.list[1].area_l2, M_PI * 3.9 * 3.9 / 2, 1.2);
    ck_assert_uint_eq(c.list[1].walls, COMPONENT_LEFT);
    ck_assert_double_eq(c.list[1].left_l, 0);
    ck_assert_double_eq_tol(c.list[1].aspect, 2, 0.15); /* half a disc, upright: r/2 over r/3.78 */
    ck_assert_uint_eq(c.list[2].walls, COMPONENT_TOP);
    ck_assert_double_eq(c.list[2].top_l, 26);
    components_free(&c);
}
END_TEST

START_TEST(corners_do_not_connect) {
    double field[NX * NY];
    disc_field(field, NX, NY, NULL, 0);
    field[5 * NX + 7] = field[6 * NX + 8] = 0.1; /* diagonal */
    field[9 * NX + 7] = field[9 * NX + 8] = 0.1; /* side by side */
    field[12 * NX + 3] = 0.285;                  /* at the threshold is not below it */
    struct components c;
    struct fault fault = FAULT_NONE;
    unit_ok(components_create(&c, NX, NY, &fault), &fault);
    components_find(&c, field, 0.285);
    ck_assert_uint_eq(c.count, 3);
    ck_assert_double_eq(c.list[2].area_l2, 2);
    ck_assert_int_eq(c.label[9 * NX + 8], 2);
    ck_assert_int_eq(c.label[12 * NX + 3], -1);
    components_free(&c);
}
END_TEST

START_TEST(a_flat_floor_is_told_from_a_round_one) {
    double field[NX * NY], nose_up, nose_down, bean;
    struct disc d = {15.2, 12.4, 5.6};
    struct components c = regions_of(&d, 1, field);
    for (int k = 0; k < 12 * NX; k++)
        field[k] = 0.53; /* the lower half is filled */
    components_find(&c, field, 0.285);
    ck_assert_uint_eq(c.count, 1);
    nose_up = c.list[0].flatness;
    ck_assert_double_lt(c.list[0].aspect, 0.65);
    for (int j = 12; j < 16; j++)
        for (int i = 14; i < 17; i++)
            field[j * NX + i] = 0.53; /* and the floor bulges into it */
    components_find(&c, field, 0.285);
    bean = c.list[0].flatness;
    disc_field(field, NX, NY, &d, 1);
    for (int k = 13 * NX; k < NY * NX; k++)
        field[k] = 0.53;
    components_find(&c, field, 0.285);
    nose_down = c.list[0].flatness;
    ck_assert_double_gt(nose_up, 0.9);
    ck_assert_double_eq_tol(bean, 1, 1e-12);
    ck_assert_double_lt(nose_down, -0.9);
    components_free(&c);
}
END_TEST

START_TEST(a_square_is_neither_and_two_columns_have_no_floor) {
    double field[NX * NY];
    disc_field(field, NX, NY, NULL, 0);
    for (int j = 4; j < 9; j++)
        for (int i = 11; i < 16; i++)
            field[j * NX + i] = 0.17;
    for (int j = 14; j < 19; j++)
        field[j * NX + 5] = field[j * NX + 6] = 0.17;
    struct components c;
    struct fault fault = FAULT_NONE;
    unit_ok(components_create(&c, NX, NY, &fault), &fault);
    components_find(&c, field, 0.285);
    ck_assert_double_eq_tol(c.list[0].aspect, 1, 1e-12);
    ck_assert_double_eq(c.list[0].flatness, 0);
    ck_assert(isnan(c.list[1].flatness));
    ck_assert_double_eq_tol(c.list[1].aspect, 2.5, 1e-12);
    components_free(&c);
}
END_TEST

START_TEST(a_chessboard_has_room_and_a_row_is_refused) {
    double field[NX * NY];
    struct components c;
    struct fault fault = FAULT_NONE;
    for (int k = 0; k < NX * NY; k++)
        field[k] = (k % NX + k / NX) % 2 ? 0.53 : 0.04;
    unit_ok(components_create(&c, NX, NY, &fault), &fault);
    components_find(&c, field, 0.285);
    ck_assert_uint_eq(c.count, (NX * NY + 1) / 2);
    components_free(&c);
    ck_assert_int_eq(components_create(&c, 31, 1, &fault), STATUS_BAD_INPUT);
    unit_says(&fault, "31 x 1 sites");
}
END_TEST

int main(void) {
    const TTest *const tests[] = {a_disc_has_its_area_and_place,
                                  control_volumes_at_walls_are_halved,
                                  corners_do_not_connect,
                                  a_flat_floor_is_told_from_a_round_one,
                                  a_square_is_neither_and_two_columns_have_no_floor,
                                  a_chessboard_has_room_and_a_row_is_refused,
                                  NULL};
    return unit_run("components", tests);
}
