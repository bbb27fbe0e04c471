/* test_bed_profile.c -- the top of made-up beds, on a lattice of 8 x 20 sites. */
#include "tests/unit/unit.h"
#include "validation/bed_profile.h"

#include <math.h>

enum { NX = 8, NY = 20 };

/* Rows below `full` at rho, the next one at `share` of it, then dilute. */
static void fill(double *field, int full, double rho, double share, double dilute) {
    for (int j = 0; j < NY; j++)
        for (int i = 0; i < NX; i++)
            field[j * NX + i] = j < full ? rho : j == full ? share * rho : dilute;
}

START_TEST(side_walls_count_half) {
    const double row[] = {0.9, 0.1, 0.2, 0.31, 0.4, 0.5, 0.6, 0.17};
    double inner = 0.1 + 0.2 + 0.31 + 0.4 + 0.5 + 0.6;
    ck_assert_double_eq_tol(bed_profile_row(row, NX, 0), (inner + 0.45 + 0.085) / 7, 1e-15);
}
END_TEST

START_TEST(the_top_lies_where_the_profile_is_half_the_bulk) {
    double field[NX * NY];
    fill(field, 12, 0.563, 0.8, 0); /* .8 at row 12, 0 at row 13: .5 at 12.375 */
    ck_assert_double_eq_tol(bed_profile_top(field, NX, NY), 12 + 0.3 / 0.8, 1e-12);
    fill(field, 12, 0.563, 0.2, 0); /* 1 at row 11, .2 at row 12 */
    ck_assert_double_eq_tol(bed_profile_top(field, NX, NY), 11 + 0.5 / 0.8, 1e-12);
    ck_assert_double_eq_tol(bed_profile_bulk(field, NX, NY), 0.563, 1e-15);
}
END_TEST

START_TEST(neither_a_gap_at_the_floor_nor_spray_moves_it) {
    double field[NX * NY], top;
    fill(field, 12, 0.517, 0.8, 0.021);
    top = bed_profile_top(field, NX, NY);
    for (int k = 0; k < 4 * NX; k++)
        field[k] = 0.037;      /* four rows of gas below a plug */
    field[17 * NX + 3] = 0.61; /* one clump high up */
    ck_assert_double_eq(bed_profile_top(field, NX, NY), top);
    ck_assert_double_eq_tol(top, 12 + 0.3 * 0.517 / (0.8 * 0.517 - 0.021), 1e-12);
}
END_TEST

START_TEST(the_bulk_is_a_median) {
    double field[NX * NY];
    fill(field, 11, 0.517, 0.1, 0);
    for (int k = 0; k < 2 * NX; k++)
        field[k] = 0.593 + 0.01 * (k / NX); /* a denser layer of two rows at the floor */
    ck_assert_double_eq_tol(bed_profile_bulk(field, NX, NY), 0.517, 1e-15);
}
END_TEST

START_TEST(no_bed_has_no_top_and_a_full_box_ends_at_its_lid) {
    double field[NX * NY];
    fill(field, 12, 0.29, 1, 0.01);
    ck_assert(isnan(bed_profile_top(field, NX, NY)));
    ck_assert(isnan(bed_profile_bulk(field, NX, NY)));
    fill(field, NY, 0.43, 1, 0);
    ck_assert_double_eq(bed_profile_top(field, NX, NY), NY - 1);
}
END_TEST

int main(void) {
    const TTest *const tests[] = {side_walls_count_half,
                                  the_top_lies_where_the_profile_is_half_the_bulk,
                                  neither_a_gap_at_the_floor_nor_spray_moves_it,
                                  the_bulk_is_a_median,
                                  no_bed_has_no_top_and_a_full_box_ends_at_its_lid,
                                  NULL};
    return unit_run("bed_profile", tests);
}
