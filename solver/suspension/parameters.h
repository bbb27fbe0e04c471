/* parameters.h -- what a suspension run can be told, and what that means.
 *
 * One table says name, unit, default, range and source of each parameter; the
 * struct holds the same in SI units, with the box worked out.  Faults that only
 * several values together show (spheres beyond what a start can pack, a layer
 * thicker than the box, a drive without kicks, a schedule out of order) are
 * found here, before any step.
 *
 * Lengths are multiples of radius_m and nothing else sets a scale, so that a run
 * whose units are changed by powers of two gives the same bits.
 *
 * Source: Fiege & Zippelius, "Dynamics of driven granular suspensions" (2014),
 *         "FZ" below.
 */
#ifndef SUSPENSION_PARAMETERS_H
#define SUSPENSION_PARAMETERS_H

#include "solver/model.h"
#include "solver/suspension/engine.h"

enum noise_rate {
    NOISE_NONE,
    NOISE_ENSKOG,
    NOISE_MEASURED,
    NOISE_FEEDBACK,
    NOISE_FIXED_KICK,
    NOISE_GIVEN
};
enum kick_schedule { KICKS_POISSON, KICKS_ROUND_ROBIN, KICKS_SYNCHRONOUS };
enum drive_law { DRIVE_NONE, DRIVE_LINEAR, DRIVE_FULL };
enum sphere_start { SPHERES_RANDOM, SPHERES_FROM_FILE, SPHERES_LIST, SPHERES_SHARP };

/* Packing fractions that Lubachevsky-Stillinger growth at the default speed reached
 * with 1e4 spheres: beyond, it is refused rather than tried. */
#define SUSPENSION_PACKING_PERIODIC 0.60
#define SUSPENSION_PACKING_HARD     0.58

struct real_list {
    const double *value; /* value[0 .. count-1], owned by the parameter set */
    size_t count;
};

struct suspension_parameters {
    size_t particles;
    double radius, mass; /* (m, kg) */
    double box[3];       /* inner sides (m) */
    enum boundary boundary[3];
    double restitution;
    enum guard guard;
    double contact_time, cutoff_speed; /* (s, m/s) */
    double drag, exponent;             /* gamma0 (1/s), n */
    double phibar;                     /* before the first change */
    struct real_list phibar_times;     /* (s) */
    struct real_list phibar_values;
    double temperature; /* temperature_scale times thermal_energy_J (J) */
    enum noise_rate noise_rate;
    bool keep_noise;  /* noise_after_change: keep */
    double kick_rate; /* f_dr, of each sphere (1/s) */
    enum kick_schedule schedule;
    double kick_variance; /* noise_rate given (m^2/s^2) */
    enum drive_law drive;
    double drive_scale, gravity, density_contrast;
    double layer;           /* thickness Delta (m) */
    bool exact_layers;      /* layer_count: exact */
    double bin, look_every; /* of the cumulative histogram (m, s) */
    enum sphere_start start;
    double growth_rate; /* of the diameter (thermal speeds) */
    double start_temperature;
    int wave_mode;
    double wave_amplitude;
    struct real_list place[3], velocity[3]; /* start list (m, m/s) */
    double profile_bin;                     /* (m) */
};

enum { SUSPENSION_PARAMETER_COUNT = 46 };
extern const struct parameter suspension_parameter_table[SUSPENSION_PARAMETER_COUNT];

/* Fill *out; lists stay owned by p.  Every fault of the values is added to fault. */
enum status suspension_parameters_read(const struct parameter_set *p,
                                       struct suspension_parameters *out, struct fault *fault);

/* 4 pi R^3/3 (m^3); spheres' volume over that of the box. */
double suspension_parameters_volume(const struct suspension_parameters *v);
double suspension_parameters_packing(const struct suspension_parameters *v);

/* Height that the spheres fill at packing fraction phibar, across the whole box (m): N V/(phibar
 * A). */
double suspension_parameters_filled_height(const struct suspension_parameters *v);

/* gamma(phi) = gamma0 (1 - phi)^-n (1/s), FZ Eq. 6. */
double suspension_parameters_drag(const struct suspension_parameters *v, double phi);

/* Are spheres kicked at all? */
bool suspension_parameters_kicks(const struct suspension_parameters *v);

#endif
