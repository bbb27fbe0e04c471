#include "solver/graingas/parameters.h"

#include "solver/graingas/darcy.h"

#include <math.h>

static const char *const darcy_choices[] = {"published", "corrected", NULL};
static const char *const gas_choices[] = {"linear", "full", "none", NULL};
static const char *const face_choices[] = {"arithmetic", "harmonic", "of-mean", NULL};
static const char *const start_choices[] = {"random", "equilibrated", "from-file", "list", NULL};

#define REAL(name, unit, standard, min, max, source, doc)                                          \
    { name, PARAMETER_REAL, unit, standard, min, max, NULL, source, doc }
#define INTEGER(name, unit, standard, min, max, source, doc)                                       \
    { name, PARAMETER_INTEGER, unit, standard, min, max, NULL, source, doc }
#define CHOICE(name, standard, choices, source, doc)                                               \
    { name, PARAMETER_CHOICE, "1", standard, 0, 0, choices, source, doc }
#define LIST(name, unit, min, max, source, doc)                                                    \
    { name, PARAMETER_REAL_LIST, unit, "[]", min, max, NULL, source, doc }

const struct parameter graingas_parameter_table[] = {
    INTEGER("grains", "1", "18104", 0, 4e6, "MFM, Figs. 3-5", "number of grains"),
    INTEGER("width_l", "l", "60", 2, 4096, "MFM, Section III", "inner width of the box"),
    INTEGER("height_l", "l", "92", 2, 4096, "MFM, Fig. 3", "inner height of the box"),
    REAL("diameter_max_l", "l", "0.5", 1e-3, 1, "MFM, Section III", "largest diameter"),
    REAL("diameter_ratio_min", "1", "0.7", 1e-2, 1, "MFM, Section III",
         "smallest diameter over the largest; uniform in between"),
    REAL("restitution", "1", "0.8", 0, 1, "MFM, Section II B", "normal restitution, walls too"),
    REAL("dt_tau", "tau", "0.0125", 1e-7, 1, "not stated by MFM",
         "time step; also the contact time of the collision rule"),
    REAL("peclet", "1", "2e-4", 1e-8, 1e3, "MFM, Eq. 9", "Pe = rho_g l g/P0"),
    REAL("froude", "1", "1", 1e-6, 1e6, "MFM, Eq. 12", "Fr = U0^2/(g l)"),
    REAL("gravity", "g", "1", 0, 1e3, "MFM, Eq. 11", "gravity in units of g; 0 turns it off"),
    CHOICE("darcy", "published", darcy_choices, "MFM, Eqs. 3 and 8; docs/theory.md",
           "gas flux phi kappa/mu grad P (published) or kappa/mu grad P (corrected)"),
    CHOICE("gas", "linear", gas_choices, "MFM, Eqs. 8 and 6",
           "Eq. 8 (linear), the full Eq. 6, or no gas at all"),
    CHOICE("face", "arithmetic", face_choices, "not stated by MFM",
           "average of the Darcy coefficient on a face between two sites"),
    REAL("solid_fraction_min", "1", "0.25", 1e-3, 0.6, "MFM, Section II C", "cut-off rho_min"),
    REAL("area_to_volume", "1", "0.66666666666666663", 1e-2, 1, "MFM, Section II C",
         "solid volume fraction over area fraction"),
    REAL("approach_threshold", "g dt/Fr", "1", 0, 100, "docs/theory.md",
         "approach speeds up to this make no collision; 0: every approach does"),
    REAL("sleep_displacement_l", "l", "0.01", 0, 1, "docs/theory.md",
         "a grain that stays within this of one place, pressed down, falls asleep; 0: none does"),
    REAL("sleep_after_tau", "tau", "1", 1e-3, 1e6, "docs/theory.md",
         "for how long it must have stayed there"),
    CHOICE("start", "random", start_choices, "not stated by MFM",
           "initial state: pushed apart, then elastic motion, a result file, or lists"),
    REAL("equilibrate_tau", "tau", "20", 0, 1e4, "docs/theory.md",
         "start equilibrated: duration of the elastic motion"),
    REAL("equilibrate_speed", "U0", "1", 1e-3, 1e3, "docs/theory.md",
         "start equilibrated: standard deviation of each velocity component"),
    REAL("start_speed", "U0", "0", 0, 1e3, "verification cases",
         "standard deviation of each velocity component at the start"),
    LIST("grain_x", "l", 0, 4096, "verification cases", "start list: centres"),
    LIST("grain_y", "l", 0, 4096, "verification cases", "start list: centres"),
    LIST("grain_diameter", "l", 1e-3, 1, "verification cases", "start list: diameters"),
    LIST("grain_velocity_x", "U0", -1e3, 1e3, "verification cases", "start list: velocities"),
    LIST("grain_velocity_y", "U0", -1e3, 1e3, "verification cases", "start list: velocities"),
    {"mirror", PARAMETER_BOOLEAN, "1", "false", 0, 1, NULL, "verification cases",
     "start random: the right half is the mirror image of the left"},
    REAL("hold_tau", "tau", "0", 0, 1e6, "verification cases",
         "grains stay in place until then; the gas feels their velocities"),
    LIST("fixed_bed", "1", 0, 0.65, "verification cases",
         "solid fractions of equal horizontal bands of an immobile packing, bottom first"),
    REAL("flux_l_per_tau", "l/tau", "0", -1e3, 1e3, "MFM, Section IV",
         "gas volume at P0 injected at the bottom row, a width and time; taken out on top"),
    REAL("flux_on_tau", "tau", "0", 0, 1e9, "MFM, Section IV", "injection begins"),
    REAL("flux_off_tau", "tau", "1e9", 0, 1e9, "MFM, Section IV", "injection ends"),
    LIST("flux_schedule_l_per_tau", "l/tau", -1e3, 1e3, "minimum fluidization",
         "fluxes one after the other from flux_on_tau, in place of flux_l_per_tau"),
    REAL("flux_schedule_every_tau", "tau", "5", 1e-3, 1e6, "minimum fluidization",
         "duration of each of them"),
    INTEGER("pressure_mode_x", "1", "0", 0, 4096, "verification cases",
            "start pressure A cos(pi mx x/W) cos(pi my y/H): mx"),
    INTEGER("pressure_mode_y", "1", "0", 0, 4096, "verification cases", "my of the same"),
    REAL("pressure_amplitude", "P0", "0", -0.9, 10, "verification cases", "A of the same"),
    REAL("pressure_tolerance", "1", "1e-8", 1e-14, 1e-2, "docs/theory.md",
         "residual of the pressure equation over its right-hand side"),
    INTEGER("layers", "1", "0", 0, 1000, "MFM, Fig. 5",
            "species alternate in so many horizontal layers of the initial state"),
};

_Static_assert(sizeof graingas_parameter_table ==
                   GRAINGAS_PARAMETER_COUNT * sizeof *graingas_parameter_table,
               "GRAINGAS_PARAMETER_COUNT must count the table");

static struct list list_of(const struct parameter_set *p, const char *name) {
    struct list l;
    l.value = parameters_list(p, name, &l.count);
    return l;
}

static void read_grain_lists(const struct parameter_set *p, struct graingas_parameters *out) {
    out->grain_x = list_of(p, "grain_x");
    out->grain_y = list_of(p, "grain_y");
    out->grain_diameter = list_of(p, "grain_diameter");
    out->grain_velocity_x = list_of(p, "grain_velocity_x");
    out->grain_velocity_y = list_of(p, "grain_velocity_y");
    out->fixed_bed = list_of(p, "fixed_bed");
    out->flux_schedule = list_of(p, "flux_schedule_l_per_tau");
}

static void read_values(const struct parameter_set *p, struct graingas_parameters *out) {
    out->grains = (size_t)parameters_real(p, "grains");
    out->width_l = (int)parameters_real(p, "width_l");
    out->height_l = (int)parameters_real(p, "height_l");
    out->diameter_max_l = parameters_real(p, "diameter_max_l");
    out->diameter_ratio_min = parameters_real(p, "diameter_ratio_min");
    out->restitution = parameters_real(p, "restitution");
    out->dt_tau = parameters_real(p, "dt_tau");
    out->peclet = parameters_real(p, "peclet");
    out->froude = parameters_real(p, "froude");
    out->gravity = parameters_real(p, "gravity");
    out->darcy = (enum darcy_law)parameters_real(p, "darcy");
    out->gas = (enum gas_law)parameters_real(p, "gas");
    out->face = (enum face_rule)parameters_real(p, "face");
    out->solid_fraction_min = parameters_real(p, "solid_fraction_min");
    out->area_to_volume = parameters_real(p, "area_to_volume");
    out->approach_threshold = parameters_real(p, "approach_threshold");
    out->sleep_displacement = parameters_real(p, "sleep_displacement_l");
    out->sleep_after = parameters_real(p, "sleep_after_tau");
    out->start = (enum start_state)parameters_real(p, "start");
    out->equilibrate_tau = parameters_real(p, "equilibrate_tau");
    out->equilibrate_speed = parameters_real(p, "equilibrate_speed");
    out->start_speed = parameters_real(p, "start_speed");
    out->mirror = parameters_real(p, "mirror") != 0;
    out->hold_tau = parameters_real(p, "hold_tau");
    out->flux_l_per_tau = parameters_real(p, "flux_l_per_tau");
    out->flux_on_tau = parameters_real(p, "flux_on_tau");
    out->flux_off_tau = parameters_real(p, "flux_off_tau");
    out->flux_schedule_every = parameters_real(p, "flux_schedule_every_tau");
    out->pressure_mode_x = (int)parameters_real(p, "pressure_mode_x");
    out->pressure_mode_y = (int)parameters_real(p, "pressure_mode_y");
    out->pressure_amplitude = parameters_real(p, "pressure_amplitude");
    out->pressure_tolerance = parameters_real(p, "pressure_tolerance");
    out->layers = (int)parameters_real(p, "layers");
}

double graingas_parameters_dt_bound(const struct graingas_parameters *p) {
    return 2 / darcy_drag_rate(p->darcy, 0.62, p->froude);
}

static void check_lists(const struct parameter_set *p, const struct graingas_parameters *v,
                        struct fault *fault) {
    const struct {
        const char *name;
        size_t count;
    } lists[] = {{"grain_x", v->grain_x.count},
                 {"grain_y", v->grain_y.count},
                 {"grain_diameter", v->grain_diameter.count},
                 {"grain_velocity_x", v->grain_velocity_x.count},
                 {"grain_velocity_y", v->grain_velocity_y.count}};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        if (v->start == START_LIST && lists[i].count != v->grains)
            parameters_fault(p, lists[i].name, fault, "%zu values where start: list has %zu grains",
                             lists[i].count, v->grains);
        else if (v->start != START_LIST && lists[i].count > 0)
            parameters_fault(p, lists[i].name, fault, "is used with start: list only");
}

/* Discs of the mean area in the box: above .80 the push-apart start jams. */
static void check_packing(const struct parameter_set *p, const struct graingas_parameters *v,
                          struct fault *fault) {
    double d = v->diameter_max_l, q = v->diameter_ratio_min;
    double area = M_PI / 4 * d * d * (1 + q + q * q) / 3;
    double fraction = (double)v->grains * area / (v->width_l * (double)v->height_l);
    bool placed = v->start == START_RANDOM || v->start == START_EQUILIBRATED;
    if (placed && fraction > 0.80)
        parameters_fault(
            p, "grains", fault,
            "%zu grains fill %.3f of the area of %d x %d l; at most 0.80 can be placed", v->grains,
            fraction, v->width_l, v->height_l);
    if (v->mirror && (v->start != START_RANDOM || v->grains % 2))
        parameters_fault(p, "mirror", fault,
                         "needs start: random and an even number of grains, here %zu", v->grains);
}

enum status graingas_parameters_read(const struct parameter_set *p, struct graingas_parameters *out,
                                     struct fault *fault) {
    read_values(p, out);
    read_grain_lists(p, out);
    check_lists(p, out, fault);
    check_packing(p, out, fault);
    double bound = graingas_parameters_dt_bound(out);
    if (out->gas != GAS_NONE && out->grains > 0 && !(out->dt_tau < bound))
        parameters_fault(p, "dt_tau", fault,
                         "%g is beyond the drag's stability bound %.4g at solid fraction 0.62",
                         out->dt_tau, bound);
    if (out->flux_off_tau < out->flux_on_tau)
        parameters_fault(p, "flux_off_tau", fault, "%g is before flux_on_tau %g", out->flux_off_tau,
                         out->flux_on_tau);
    if (out->flux_schedule.count > 0 && out->flux_l_per_tau != 0)
        parameters_fault(p, "flux_l_per_tau", fault, "%g beside a schedule of %zu fluxes",
                         out->flux_l_per_tau, out->flux_schedule.count);
    if (out->fixed_bed.count > (size_t)out->height_l)
        parameters_fault(p, "fixed_bed", fault, "%zu bands in a box of %d rows",
                         out->fixed_bed.count, out->height_l);
    return fault->status;
}
