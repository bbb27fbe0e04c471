/* bed_rest.c -- see bed_rest.h. */
#include "validation/bed_rest.h"

#include "validation/sphere_laws.h"

#include <gsl/gsl_multifit.h>
#include <math.h>

double bed_rest_column_R(const double in[BED_INPUTS]) {
    return in[BED_PARTICLES] * 4 * M_PI / 3 / (in[BED_WIDTH_X_R] * in[BED_WIDTH_Y_R]);
}

double bed_rest_height_R(const double in[BED_INPUTS]) {
    return bed_rest_column_R(in) / in[BED_PHIBAR];
}

void bed_rest_bulk(const double in[BED_INPUTS], double *low_R, double *high_R) {
    *low_R = 0.4 * bed_rest_height_R(in);
    *high_R = 0.6 * bed_rest_height_R(in);
}

/* What collisions take over what drag takes, in the bulk. */
static double heat_ratio(const double in[BED_INPUTS], double bulk, double temperature_J) {
    struct spheres_gas g = {bulk, temperature_J, in[BED_RADIUS_M], in[BED_MASS_KG]};
    double eps = in[BED_RESTITUTION];
    double drag = spheres_drag(in[BED_DRAG], in[BED_PHIBAR], in[BED_EXPONENT]);
    return (1 - eps * eps) / 3 * spheres_collision_rate(&g) / (2 * drag);
}

static struct hydrostatic_bed bed_of(const double in[BED_INPUTS]) {
    double temperature_J = in[BED_THERMAL_J] * in[BED_TEMPERATURE_SCALE];
    double push = spheres_push(in[BED_EXPONENT], in[BED_GRAVITY], in[BED_CONTRAST],
                               in[BED_DRIVE_SCALE], in[BED_PHIBAR]);
    bool walls = in[BED_WALLS] > 0.5;
    return (struct hydrostatic_bed){.phibar = in[BED_PHIBAR],
                                    .a_R =
                                        temperature_J / (in[BED_MASS_KG] * push) / in[BED_RADIUS_M],
                                    .layer_R = in[BED_LAYER_R],
                                    .column_R = bed_rest_column_R(in),
                                    .width_R = {in[BED_WIDTH_X_R], in[BED_WIDTH_Y_R]},
                                    .walls = {walls, walls},
                                    .floor = true};
}

static struct hydrostatic_bed local_bed_of(const double in[BED_INPUTS]) {
    struct hydrostatic_bed bed = bed_of(in);
    bed.local_temperature = true;
    bed.restitution = in[BED_RESTITUTION];
    bed.heat_ratio = heat_ratio(in, hydrostatic_bulk_of(&bed, bed.phibar),
                                in[BED_THERMAL_J] * in[BED_TEMPERATURE_SCALE]);
    return bed;
}

enum status bed_rest_solve(const double in[BED_INPUTS], bool local, struct hydrostatic_profile *out,
                           struct fault *fault) {
    struct hydrostatic_bed bed = local ? local_bed_of(in) : bed_of(in);
    return hydrostatic_solve(&bed, out, fault);
}

double bed_rest_temperature(const double in[BED_INPUTS], double fraction) {
    struct hydrostatic_bed bed = local_bed_of(in);
    return hydrostatic_temperature(&bed, hydrostatic_bulk_of(&bed, fraction));
}

static enum status fit_temperature(const struct bed_rest_measured *m, struct hydrostatic_bed *bed,
                                   struct fault *fault) {
    if (m->count < 2 * HYDROSTATIC_TERMS)
        return fault_set(fault, STATUS_BAD_INPUT, "%zu temperatures are too few", m->count);
    gsl_matrix *x = gsl_matrix_alloc(m->count, HYDROSTATIC_TERMS);
    gsl_matrix *covariance = gsl_matrix_alloc(HYDROSTATIC_TERMS, HYDROSTATIC_TERMS);
    gsl_vector *y = gsl_vector_alloc(m->count);
    gsl_multifit_linear_workspace *w = gsl_multifit_linear_alloc(m->count, HYDROSTATIC_TERMS);
    enum status status = STATUS_OK;
    if (!x || !covariance || !y || !w)
        status = fault_set(fault, STATUS_NO_MEMORY, "no memory to fit %zu temperatures", m->count);
    for (size_t i = 0; i < m->count && !status; i++) {
        gsl_vector_set(y, i, log(m->temperature[i]));
        for (size_t k = 0; k < HYDROSTATIC_TERMS; k++)
            gsl_matrix_set(x, i, k, pow(m->fraction[i], (double)k));
        bed->measured_to = fmax(bed->measured_to, m->fraction[i]);
    }
    if (!status) {
        gsl_vector_const_view weight = gsl_vector_const_view_array(m->weight, m->count);
        gsl_vector_view c = gsl_vector_view_array(bed->c, HYDROSTATIC_TERMS);
        double chi;
        gsl_multifit_wlinear(x, &weight.vector, y, &c.vector, covariance, &chi, w);
    }
    gsl_matrix_free(x);
    gsl_matrix_free(covariance);
    gsl_vector_free(y);
    gsl_multifit_linear_free(w);
    return status;
}

enum status bed_rest_balance(const double in[BED_INPUTS], const struct bed_rest_measured *m,
                             struct hydrostatic_profile *out, struct fault *fault) {
    struct hydrostatic_bed bed = bed_of(in);
    bed.restitution = in[BED_RESTITUTION];
    *out = (struct hydrostatic_profile){0};
    enum status status = fit_temperature(m, &bed, fault);
    return status ? status : hydrostatic_solve(&bed, out, fault);
}

enum status bed_rest_fit(const double in[BED_INPUTS], const struct hydrostatic_profile *profile,
                         struct interface_fit *out, struct fault *fault) {
    struct interface_window window = {.above_R = in[BED_ABOVE_R],
                                      .phibar = in[BED_PHIBAR],
                                      .plateau_free = in[BED_PLATEAU_FREE] > 0.5};
    enum status status =
        interface_fit(profile->height_R, profile->fraction, profile->count, &window, out, fault);
    if (!status && out->sharp)
        status = fault_set(fault, STATUS_NUMERICAL, "the solved edge is sharper than its grid");
    return status;
}
