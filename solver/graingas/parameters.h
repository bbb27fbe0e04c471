/* parameters.h -- what a grain-gas run can be told, and what that means.
 *
 * One table says name, unit, default, range and source of each parameter; the
 * struct holds the same in the form the step uses.  Faults that only several
 * values together show (a time step beyond the stability of the drag, more
 * grains than fit, lists of unequal lengths) are found here, before any step.
 *
 * Units: length l (the lattice constant), time tau = l/U0, speed U0, pressure
 * P0; grain mass is its area (density 1), so that weight is area/Fr.
 *
 * Source: McNamara, Flekkoey & Maaloey, PRE 61, 4054 (2000), "MFM" below.
 */
#ifndef GRAINGAS_PARAMETERS_H
#define GRAINGAS_PARAMETERS_H

#include "solver/model.h"

enum darcy_law { DARCY_PUBLISHED, DARCY_CORRECTED };
enum gas_law { GAS_LINEAR, GAS_FULL, GAS_NONE };
enum face_rule { FACE_ARITHMETIC, FACE_HARMONIC, FACE_OF_MEAN };
enum start_state { START_RANDOM, START_EQUILIBRATED, START_FROM_FILE, START_LIST };

struct list {
    const double *value; /* value[0 .. count-1], owned by the parameter set's copy */
    size_t count;
};

struct graingas_parameters {
    size_t grains;
    int width_l, height_l;
    double diameter_max_l, diameter_ratio_min;
    double restitution;
    double dt_tau;
    double peclet, froude, gravity;
    enum darcy_law darcy;
    enum gas_law gas;
    enum face_rule face;
    double solid_fraction_min, area_to_volume;
    double approach_threshold; /* (gravity dt/Fr) */
    double sleep_displacement, sleep_after;
    enum start_state start;
    double equilibrate_tau, equilibrate_speed, start_speed;
    struct list grain_x, grain_y, grain_diameter, grain_velocity_x, grain_velocity_y;
    bool mirror;
    double hold_tau;
    struct list fixed_bed;
    double flux_l_per_tau, flux_on_tau, flux_off_tau, flux_schedule_every;
    struct list flux_schedule;
    int pressure_mode_x, pressure_mode_y;
    double pressure_amplitude, pressure_tolerance;
    int layers;
};

enum { GRAINGAS_PARAMETER_COUNT = 40 };
extern const struct parameter graingas_parameter_table[GRAINGAS_PARAMETER_COUNT];

/* Fill *out; lists stay owned by p.  Every fault of the values is added to fault. */
enum status graingas_parameters_read(const struct parameter_set *p, struct graingas_parameters *out,
                                     struct fault *fault);

/* The drag's largest stable step at solid fraction .62, the densest site seen in
 * settled beds: dt < 2/rate, rate = rho/(Fr (1-rho)^m).  (tau) */
double graingas_parameters_dt_bound(const struct graingas_parameters *p);

#endif
