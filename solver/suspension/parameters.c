#include "solver/suspension/parameters.h"

#include <math.h>
#include <string.h>

static const char *const boundary_choices[] = {"periodic", "hard", NULL};
static const char *const guard_choices[] = {"none", "contact-time", "cut-off", NULL};
static const char *const noise_choices[] = {"none",       "enskog", "measured", "feedback",
                                            "fixed-kick", "given",  NULL};
static const char *const change_choices[] = {"recompute", "keep", NULL};
static const char *const schedule_choices[] = {"poisson", "round-robin", "synchronous", NULL};
static const char *const drive_choices[] = {"none", "linear", "full", NULL};
static const char *const layer_choices[] = {"exact", "histogram", NULL};
static const char *const start_choices[] = {"random", "from-file", "list", "sharp", NULL};

#define REAL(name, unit, standard, min, max, source, doc)                                          \
    { name, PARAMETER_REAL, unit, standard, min, max, NULL, source, doc }
#define INTEGER(name, unit, standard, min, max, source, doc)                                       \
    { name, PARAMETER_INTEGER, unit, standard, min, max, NULL, source, doc }
#define CHOICE(name, standard, choices, source, doc)                                               \
    { name, PARAMETER_CHOICE, "1", standard, 0, 0, choices, source, doc }
#define LIST(name, unit, min, max, source, doc)                                                    \
    { name, PARAMETER_REAL_LIST, unit, "[]", min, max, NULL, source, doc }

const struct parameter suspension_parameter_table[] = {
    INTEGER("particles", "1", "10000", 1, 1e8, "FZ, Section III", "number of spheres N"),
    REAL("radius_m", "m", "6e-4", 1e-15, 1e15, "FZ, Section III", "radius R"),
    REAL("mass_kg", "kg", "2.262e-6", 1e-30, 1e30, "FZ, Section III", "mass m of a sphere"),
    REAL("width_x_R", "R", "0", 0, 1e7, "not stated by FZ",
         "inner side along x; all three 0: a cube of packing_fraction"),
    REAL("width_y_R", "R", "0", 0, 1e7, "not stated by FZ", "inner side along y"),
    REAL("height_R", "R", "0", 0, 1e7, "not stated by FZ",
         "inner height; 0 beside widths: from packing_fraction"),
    REAL("packing_fraction", "1", "0.3", 1e-12, 0.74, "FZ, Section III",
         "of the spheres in the whole box at the start"),
    CHOICE("boundary_x", "hard", boundary_choices, "FZ, Section III",
           "both walls across x: elastic, or none at all"),
    CHOICE("boundary_y", "hard", boundary_choices, "FZ, Section III", "across y"),
    CHOICE("boundary_z", "hard", boundary_choices, "FZ, Section III", "floor and lid"),
    REAL("restitution", "1", "0.7", 1e-3, 1, "FZ, Eq. 2", "normal restitution of pairs; walls: 1"),
    CHOICE("guard", "contact-time", guard_choices, "FZ, Section III; docs/theory.md",
           "against inelastic collapse: elastic within contact_time_s of the last collision, or "
           "below cutoff_speed_m_per_s"),
    REAL("contact_time_s", "s", "1e-6", 0, 1e15, "docs/theory.md", "guard contact-time: t_c"),
    REAL("cutoff_speed_m_per_s", "m/s", "1e-6", 0, 1e15, "docs/theory.md",
         "guard cut-off: normal relative speed below which a collision is elastic"),
    REAL("drag_per_s", "1/s", "5", 0, 1e15, "FZ, Section III", "gamma0 of a sphere alone"),
    REAL("exponent", "1", "4.65", 0, 100, "FZ, Eqs. 4 and 6", "n of Richardson and Zaki"),
    REAL("phibar", "1", "0.3", 0, 0.74, "FZ, Eq. 7", "packing fraction that the flow supports"),
    LIST("phibar_times_s", "s", 0, 1e15, "FZ, Section IV B", "times at which phibar changes"),
    LIST("phibar_values", "1", 0, 0.74, "FZ, Section IV B", "what it changes to"),
    REAL("thermal_energy_J", "J", "2e-9", 0, 1e30, "FZ, Section III", "granular temperature kT"),
    REAL("temperature_scale", "1", "1", 0, 1e6, "docs/theory.md", "multiplies thermal_energy_J"),
    CHOICE("noise_rate", "enskog", noise_choices, "FZ, Section III; docs/theory.md",
           "collision rate that the random kicks' variance makes up for"),
    CHOICE("noise_after_change", "recompute", change_choices, "not stated by FZ",
           "variance after a change of phibar"),
    REAL("kick_rate_per_s", "1/s", "250", 0, 1e15, "not stated by FZ", "f_dr of each sphere"),
    CHOICE("kick_schedule", "poisson", schedule_choices, "not stated by FZ",
           "at random, one after the other, or all at once"),
    REAL("kick_variance_m2_per_s2", "m^2/s^2", "0", 0, 1e30, "verification cases",
         "noise_rate given: variance of a random kick, each component"),
    CHOICE("drive", "none", drive_choices, "FZ, Eqs. 9 and 1",
           "Eq. 9 (linear), Eq. 1 with the local drag (full), or none"),
    REAL("drive_scale", "1", "1", 0, 1e6, "docs/theory.md", "multiplies the reduced gravity"),
    REAL("gravity_m_per_s2", "m/s^2", "9.81", 0, 1e30, "FZ, Eq. 1", "g"),
    REAL("density_contrast", "1", "0.6", -1e3, 1, "FZ, Section III", "(rho_s - rho_f)/rho_s"),
    REAL("layer_R", "R", "10", 0.1, 1e7, "FZ, Section III", "Delta: thickness of the layer"),
    CHOICE("layer_count", "histogram", layer_choices, "docs/theory.md",
           "count of the spheres in a layer: each one at each kick, or a cumulative histogram"),
    REAL("histogram_bin_R", "R", "0.25", 1e-3, 1e7, "docs/theory.md", "its bins"),
    REAL("histogram_refresh", "1/f_dr", "0.1", 1e-3, 100, "docs/theory.md",
         "how often it is made anew; also how often measured rates are read"),
    CHOICE(
        "start", "random", start_choices, "FZ, Section IV A",
        "placed at random and grown in the whole box, or (sharp) under a lid that leaves them at "
        "phibar and is lifted then; a result file; lists"),
    REAL("start_growth_rate", "thermal speeds", "0.05", 1e-4, 1, "docs/theory.md",
         "start random, sharp: growth of the diameter"),
    REAL("start_temperature", "T", "1", 0, 1e6, "docs/theory.md",
         "start random, sharp: temperature over temperature_scale thermal_energy_J"),
    INTEGER("wave_mode", "1", "0", 0, 1000, "verification cases",
            "start random: waves of density in the periodic height"),
    REAL("wave_amplitude", "1", "0", 0, 0.5, "verification cases", "their relative amplitude"),
    LIST("sphere_x", "m", -1e30, 1e30, "verification cases", "start list: centres"),
    LIST("sphere_y", "m", -1e30, 1e30, "verification cases", "start list: centres"),
    LIST("sphere_z", "m", -1e30, 1e30, "verification cases", "start list: centres"),
    LIST("sphere_velocity_x", "m/s", -1e30, 1e30, "verification cases", "start list: velocities"),
    LIST("sphere_velocity_y", "m/s", -1e30, 1e30, "verification cases", "start list: velocities"),
    LIST("sphere_velocity_z", "m/s", -1e30, 1e30, "verification cases", "start list: velocities"),
    REAL("profile_bin_R", "R", "1", 1e-2, 1e7, "FZ, Eq. 11",
         "bins of the profiles, made to divide the height"),
};

_Static_assert(sizeof suspension_parameter_table ==
                   SUSPENSION_PARAMETER_COUNT * sizeof *suspension_parameter_table,
               "SUSPENSION_PARAMETER_COUNT must count the table");

double suspension_parameters_volume(const struct suspension_parameters *v) {
    return 4 * M_PI / 3 * (v->radius * v->radius * v->radius);
}

double suspension_parameters_packing(const struct suspension_parameters *v) {
    return (double)v->particles * suspension_parameters_volume(v) /
           (v->box[0] * v->box[1] * v->box[2]);
}

double suspension_parameters_filled_height(const struct suspension_parameters *v) {
    return (double)v->particles * suspension_parameters_volume(v) /
           (v->phibar * v->box[0] * v->box[1]);
}

double suspension_parameters_drag(const struct suspension_parameters *v, double phi) {
    return v->drag * pow(1 - phi, -v->exponent);
}

bool suspension_parameters_kicks(const struct suspension_parameters *v) {
    return v->drive != DRIVE_NONE || v->noise_rate != NOISE_NONE;
}

/* -- reading ------------------------------------------------------------------ */

static struct real_list list_of(const struct parameter_set *p, const char *name) {
    struct real_list l;
    l.value = parameters_list(p, name, &l.count);
    return l;
}

static void read_lists(const struct parameter_set *p, struct suspension_parameters *out) {
    static const char *const place[] = {"sphere_x", "sphere_y", "sphere_z"};
    static const char *const velocity[] = {"sphere_velocity_x", "sphere_velocity_y",
                                           "sphere_velocity_z"};
    for (int a = 0; a < 3; a++) {
        out->place[a] = list_of(p, place[a]);
        out->velocity[a] = list_of(p, velocity[a]);
    }
    out->phibar_times = list_of(p, "phibar_times_s");
    out->phibar_values = list_of(p, "phibar_values");
}

static void read_spheres(const struct parameter_set *p, struct suspension_parameters *out) {
    static const char *const boundary[] = {"boundary_x", "boundary_y", "boundary_z"};
    out->particles = (size_t)parameters_real(p, "particles");
    out->radius = parameters_real(p, "radius_m");
    out->mass = parameters_real(p, "mass_kg");
    for (int a = 0; a < 3; a++)
        out->boundary[a] = parameters_real(p, boundary[a]) != 0 ? BOUNDARY_HARD : BOUNDARY_PERIODIC;
    out->restitution = parameters_real(p, "restitution");
    static const enum guard guards[] = {GUARD_NONE, GUARD_CONTACT_TIME, GUARD_CUTOFF_SPEED};
    out->guard = guards[(int)parameters_real(p, "guard")];
    out->contact_time = parameters_real(p, "contact_time_s");
    out->cutoff_speed = parameters_real(p, "cutoff_speed_m_per_s");
    out->start = (enum sphere_start)parameters_real(p, "start");
    out->growth_rate = parameters_real(p, "start_growth_rate");
    out->start_temperature = parameters_real(p, "start_temperature");
    out->wave_mode = (int)parameters_real(p, "wave_mode");
    out->wave_amplitude = parameters_real(p, "wave_amplitude");
    out->profile_bin = parameters_real(p, "profile_bin_R") * out->radius;
}

static void read_fluid(const struct parameter_set *p, struct suspension_parameters *out) {
    out->drag = parameters_real(p, "drag_per_s");
    out->exponent = parameters_real(p, "exponent");
    out->phibar = parameters_real(p, "phibar");
    out->temperature =
        parameters_real(p, "temperature_scale") * parameters_real(p, "thermal_energy_J");
    out->noise_rate = (enum noise_rate)parameters_real(p, "noise_rate");
    out->keep_noise = parameters_real(p, "noise_after_change") != 0;
    out->kick_rate = parameters_real(p, "kick_rate_per_s");
    out->schedule = (enum kick_schedule)parameters_real(p, "kick_schedule");
    out->kick_variance = parameters_real(p, "kick_variance_m2_per_s2");
    out->drive = (enum drive_law)parameters_real(p, "drive");
    out->drive_scale = parameters_real(p, "drive_scale");
    out->gravity = parameters_real(p, "gravity_m_per_s2");
    out->density_contrast = parameters_real(p, "density_contrast");
    out->layer = parameters_real(p, "layer_R") * out->radius;
    out->exact_layers = strcmp(parameters_choice(p, "layer_count"), "exact") == 0;
    out->bin = parameters_real(p, "histogram_bin_R") * out->radius;
    out->look_every =
        out->kick_rate > 0 ? parameters_real(p, "histogram_refresh") / out->kick_rate : 0;
}

/* Was the value given, in the run file or by --set? */
static bool given(const struct parameter_set *p, const char *name) {
    size_t i = 0;
    while (strcmp(p->table[i].name, name) != 0)
        i++;
    return strcmp(p->place[i], "default") != 0;
}

/* Sides from the three sizes, or from the packing fraction where they are left out. */
static void find_box(const struct parameter_set *p, struct suspension_parameters *out,
                     struct fault *fault) {
    const double x = parameters_real(p, "width_x_R"), y = parameters_real(p, "width_y_R"),
                 z = parameters_real(p, "height_R"), phi = parameters_real(p, "packing_fraction");
    double side[3] = {x, y, z};                                  /* (R) */
    double volume = 4 * M_PI / 3 * (double)out->particles / phi; /* (R^3) */
    if (x == 0 && y == 0 && z == 0)
        side[0] = side[1] = side[2] = cbrt(volume);
    else if (x == 0 || y == 0)
        parameters_fault(p, x == 0 ? "width_x_R" : "width_y_R", fault,
                         "0 beside other sides of the box; give both widths or none of the sides");
    else if (z == 0)
        side[2] = volume / (x * y);
    for (int a = 0; a < 3; a++)
        out->box[a] = side[a] * out->radius;
    double actual = volume * phi / (side[0] * side[1] * side[2]);
    if (x != 0 && y != 0 && z != 0 && given(p, "packing_fraction") &&
        fabs(actual - phi) > 1e-6 * phi)
        parameters_fault(p, "packing_fraction", fault,
                         "%g, but %zu spheres in %g x %g x %g R are %g; leave one of them out", phi,
                         out->particles, x, y, z, actual);
}

/* -- faults of several values together ------------------------------------------ */

static void check_box(const struct parameter_set *p, const struct suspension_parameters *v,
                      struct fault *fault) {
    static const char *const name[] = {"width_x_R", "width_y_R", "height_R"};
    for (int a = 0; a < 3; a++) {
        double side = v->box[a] / v->radius, least = v->boundary[a] == BOUNDARY_HARD ? 2 : 4;
        if (!(side > least))
            parameters_fault(p, name[a], fault, "a %s side of %g R; it must be longer than %g R",
                             boundary_choices[v->boundary[a] == BOUNDARY_HARD], side, least);
    }
}

/* Spheres that are grown in a space of packing fraction `phi`, before any wave is made. */
static void check_growth(const struct parameter_set *p, const struct suspension_parameters *v,
                         const char *name, double phi, struct fault *fault) {
    bool hard = v->start == SPHERES_SHARP || v->boundary[0] == BOUNDARY_HARD ||
                v->boundary[1] == BOUNDARY_HARD || v->boundary[2] == BOUNDARY_HARD;
    double most = hard ? SUSPENSION_PACKING_HARD : SUSPENSION_PACKING_PERIODIC;
    double grown = phi * pow(1 + v->wave_amplitude, 3);
    if (grown > most * (1 + 1e-9))
        parameters_fault(p, name, fault,
                         "%zu spheres fill %.4f of the box%s; the start reaches %.2f %s",
                         v->particles, grown, grown > phi ? " before the wave is made" : "", most,
                         hard ? "between hard walls" : "in a periodic box");
    if (grown > 0.12 && !(v->temperature > 0))
        parameters_fault(p, "thermal_energy_J", fault,
                         "0 J: spheres at a packing fraction of %.4f are grown while they move",
                         grown);
}

static void check_sharp(const struct parameter_set *p, const struct suspension_parameters *v,
                        struct fault *fault) {
    double top = suspension_parameters_filled_height(v) / v->radius; /* (R) */
    if (!(v->phibar > 0))
        parameters_fault(p, "phibar", fault, "0 with start: sharp, which is a bed of phibar");
    else if (v->boundary[2] != BOUNDARY_HARD)
        parameters_fault(p, "boundary_z", fault,
                         "start: sharp stands on a floor: boundary_z: hard");
    else if (!(top > 2))
        parameters_fault(p, "start", fault, "sharp: a bed %g R high; it must be higher than 2 R",
                         top);
    else if (!(v->box[2] / v->radius > top * (1 + 1e-9)))
        parameters_fault(p, "height_R", fault,
                         "a box %g R high; start: sharp fills %g R of it at phibar %g, and it must "
                         "be higher",
                         v->box[2] / v->radius, top, v->phibar);
    else
        check_growth(p, v, "phibar", v->phibar, fault);
}

static void check_start(const struct parameter_set *p, const struct suspension_parameters *v,
                        struct fault *fault) {
    if (v->start == SPHERES_RANDOM)
        check_growth(p, v, "packing_fraction", suspension_parameters_packing(v), fault);
    if (v->start == SPHERES_SHARP)
        check_sharp(p, v, fault);
    if ((v->wave_mode > 0) != (v->wave_amplitude > 0))
        parameters_fault(p, "wave_mode", fault, "%d with a wave_amplitude of %g", v->wave_mode,
                         v->wave_amplitude);
    if (v->wave_mode > 0 && (v->start != SPHERES_RANDOM || v->boundary[2] != BOUNDARY_PERIODIC))
        parameters_fault(p, "wave_mode", fault, "needs start: random and boundary_z: periodic");
}

static void check_lists(const struct parameter_set *p, const struct suspension_parameters *v,
                        struct fault *fault) {
    const struct {
        const char *name;
        size_t count;
    } lists[] = {{"sphere_x", v->place[0].count},
                 {"sphere_y", v->place[1].count},
                 {"sphere_z", v->place[2].count},
                 {"sphere_velocity_x", v->velocity[0].count},
                 {"sphere_velocity_y", v->velocity[1].count},
                 {"sphere_velocity_z", v->velocity[2].count}};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        if (v->start == SPHERES_LIST && lists[i].count != v->particles)
            parameters_fault(p, lists[i].name, fault,
                             "%zu values where start: list has %zu particles", lists[i].count,
                             v->particles);
        else if (v->start != SPHERES_LIST && lists[i].count > 0)
            parameters_fault(p, lists[i].name, fault, "is used with start: list only");
}

static void check_kicks(const struct parameter_set *p, const struct suspension_parameters *v,
                        struct fault *fault) {
    if (v->drive != DRIVE_NONE && !(v->kick_rate > 0))
        parameters_fault(p, "kick_rate_per_s", fault, "0 with a drive, which acts by kicks");
    else if (suspension_parameters_kicks(v) && !(v->kick_rate > 0))
        parameters_fault(p, "kick_rate_per_s", fault,
                         "0 with random kicks; for none of them: noise_rate: none");
    if ((v->noise_rate == NOISE_GIVEN) != (v->kick_variance > 0))
        parameters_fault(p, "kick_variance_m2_per_s2", fault, "%g with noise_rate: %s",
                         v->kick_variance, noise_choices[v->noise_rate]);
    if (v->noise_rate == NOISE_FEEDBACK && (v->particles < 2 || !(v->temperature > 0)))
        parameters_fault(p, "noise_rate", fault,
                         "feedback needs a temperature above 0 and two particles or more");
    if (v->drive == DRIVE_NONE)
        return;
    if (v->layer > v->box[2])
        parameters_fault(p, "layer_R", fault, "a layer of %g R in a box %g R high",
                         v->layer / v->radius, v->box[2] / v->radius);
    if (!v->exact_layers && v->bin > v->layer)
        parameters_fault(p, "histogram_bin_R", fault, "bins of %g R for layers of %g R",
                         v->bin / v->radius, v->layer / v->radius);
    if (v->drive == DRIVE_FULL && !(v->drag > 0))
        parameters_fault(p, "drag_per_s", fault, "0 with drive: full, which is a drag");
}

static void check_schedule(const struct parameter_set *p, const struct suspension_parameters *v,
                           struct fault *fault) {
    const struct real_list *t = &v->phibar_times;
    if (t->count != v->phibar_values.count)
        parameters_fault(p, "phibar_values", fault, "%zu values for %zu phibar_times_s",
                         v->phibar_values.count, t->count);
    for (size_t k = 1; k < t->count; k++)
        if (!(t->value[k] > t->value[k - 1]))
            parameters_fault(p, "phibar_times_s", fault,
                             "out of order: %g s comes after %g s; times must increase",
                             t->value[k], t->value[k - 1]);
}

enum status suspension_parameters_read(const struct parameter_set *p,
                                       struct suspension_parameters *out, struct fault *fault) {
    *out = (struct suspension_parameters){0};
    read_spheres(p, out);
    read_fluid(p, out);
    read_lists(p, out);
    if ((out->start == SPHERES_RANDOM || out->start == SPHERES_SHARP) && out->particles < 2)
        parameters_fault(p, "particles", fault,
                         "a single sphere has no temperature; use start: list");
    find_box(p, out, fault);
    if (fault->status == STATUS_OK)
        check_box(p, out, fault);
    if (fault->status == STATUS_OK)
        check_start(p, out, fault);
    check_lists(p, out, fault);
    check_kicks(p, out, fault);
    check_schedule(p, out, fault);
    return fault->status;
}
