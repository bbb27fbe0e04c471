#include "solver/graingas/gas.h"

#include "solver/graingas/darcy.h"

#include <math.h>
#include <stdlib.h>

static void spread_fixed_bed(struct gas *gas, const struct list *bands) {
    const struct lattice *l = gas->lattice;
    for (int j = 0; j < l->ny && bands->count > 0; j++) {
        size_t band = (size_t)j * bands->count / (size_t)(l->ny - 1);
        if (band == bands->count)
            band--;
        for (int i = 0; i < l->nx; i++)
            gas->fixed_fraction[(size_t)j * (size_t)l->nx + (size_t)i] = bands->value[band];
    }
}

static void start_pressure(struct gas *gas, const struct graingas_parameters *p) {
    const struct lattice *l = gas->lattice;
    for (int j = 0; j < l->ny; j++)
        for (int i = 0; i < l->nx; i++)
            gas->pressure[(size_t)j * (size_t)l->nx + (size_t)i] =
                p->pressure_amplitude * cos(M_PI * p->pressure_mode_x * i / (l->nx - 1)) *
                cos(M_PI * p->pressure_mode_y * j / (l->ny - 1));
}

enum status gas_create(struct gas *gas, const struct lattice *l,
                       const struct graingas_parameters *p, struct fault *fault) {
    *gas = (struct gas){.lattice = l};
    double **array[] = {&gas->fixed_fraction,
                        &gas->solid_fraction,
                        &gas->clipped,
                        &gas->coefficient,
                        &gas->ux,
                        &gas->uy,
                        &gas->pressure,
                        &gas->east,
                        &gas->north,
                        &gas->mass,
                        &gas->rhs};
    for (size_t i = 0; i < sizeof array / sizeof *array; i++)
        if (!(*array[i] = calloc(l->sites, sizeof(double))))
            goto no_memory;
    gas->pull = calloc(l->sites, sizeof *gas->pull);
    gas->load = calloc(l->sites, sizeof *gas->load);
    if (!gas->pull || !gas->load)
        goto no_memory;
    if (multigrid_create(&gas->solver, l->nx, l->ny, fault) != STATUS_OK)
        goto failed;
    spread_fixed_bed(gas, &p->fixed_bed);
    start_pressure(gas, p);
    return STATUS_OK;
no_memory:
    fault_set(fault, STATUS_NO_MEMORY, "no memory for the gas on %zu sites", l->sites);
failed:
    gas_free(gas);
    return fault->status;
}

void gas_free(struct gas *gas) {
    double *array[] = {
        gas->fixed_fraction, gas->solid_fraction, gas->clipped, gas->coefficient, gas->ux, gas->uy,
        gas->pressure,       gas->east,           gas->north,   gas->mass,        gas->rhs};
    for (size_t i = 0; i < sizeof array / sizeof *array; i++)
        free(array[i]);
    free(gas->pull);
    free(gas->load);
    multigrid_free(gas->solver);
    *gas = (struct gas){0};
}

void gas_take_grains(struct gas *gas, const struct graingas_parameters *p, const struct grains *g) {
    const struct lattice *l = gas->lattice;
    halo_deposit(l, g, gas->load);
    for (size_t k = 0; k < l->sites; k++) {
        double to_fraction = p->area_to_volume / l->volume[k];
        double rho = gas->fixed_fraction[k] + to_fraction * gas->load[k].area;
        double clipped = fmax(rho, p->solid_fraction_min);
        gas->solid_fraction[k] = rho;
        gas->clipped[k] = clipped;
        gas->coefficient[k] = darcy_coefficient(p->darcy, clipped);
        gas->ux[k] = to_fraction * gas->load[k].flux_x / clipped;
        gas->uy[k] = to_fraction * gas->load[k].flux_y / clipped;
    }
}

/* Length of the faces that a row (column) of sites shares with its neighbours. */
static inline double face_length(int index, int count) {
    return index == 0 || index == count - 1 ? 0.5 : 1;
}

/* Conductances Pe x (1/Pe) K L of all faces; under `full` times the mean (1+p). */
static void set_faces(struct gas *gas, const struct graingas_parameters *p) {
    const struct lattice *l = gas->lattice;
    const double *c = gas->coefficient, *rho = gas->clipped, *pr = gas->pressure;
    size_t nx = (size_t)l->nx;
    bool full = p->gas == GAS_FULL;
    for (int j = 0; j < l->ny; j++)
        for (int i = 0; i < l->nx; i++) {
            size_t k = (size_t)j * nx + (size_t)i;
            if (i + 1 < l->nx)
                gas->east[k] = face_length(j, l->ny) *
                               darcy_face(p->face, p->darcy, c[k], c[k + 1], rho[k], rho[k + 1]) *
                               (full ? 1 + 0.5 * (pr[k] + pr[k + 1]) : 1);
            if (j + 1 < l->ny)
                gas->north[k] =
                    face_length(i, l->nx) *
                    darcy_face(p->face, p->darcy, c[k], c[k + nx], rho[k], rho[k + nx]) *
                    (full ? 1 + 0.5 * (pr[k] + pr[k + nx]) : 1);
        }
}

/* rhs -= Pe (1+p) div u, face by face: what leaves one site enters the other. */
static void subtract_divergence(struct gas *gas, const struct graingas_parameters *p) {
    const struct lattice *l = gas->lattice;
    size_t nx = (size_t)l->nx;
    double *rhs = gas->rhs;
    bool full = p->gas == GAS_FULL;
    for (int j = 0; j < l->ny; j++)
        for (int i = 0; i < l->nx; i++) {
            size_t k = (size_t)j * nx + (size_t)i;
            double here = full ? 1 + gas->pressure[k] : 1;
            if (i + 1 < l->nx) {
                double flow =
                    p->peclet * face_length(j, l->ny) * 0.5 * (gas->ux[k] + gas->ux[k + 1]);
                rhs[k] -= here * flow;
                rhs[k + 1] += (full ? 1 + gas->pressure[k + 1] : 1) * flow;
            }
            if (j + 1 < l->ny) {
                double flow =
                    p->peclet * face_length(i, l->nx) * 0.5 * (gas->uy[k] + gas->uy[k + nx]);
                rhs[k] -= here * flow;
                rhs[k + nx] += (full ? 1 + gas->pressure[k + nx] : 1) * flow;
            }
        }
}

static void inject(struct gas *gas, const struct graingas_parameters *p, double flux) {
    const struct lattice *l = gas->lattice;
    double *bottom = gas->rhs, *top = gas->rhs + (l->sites - (size_t)l->nx);
    for (int i = 0; i < l->nx; i++) {
        double amount = p->peclet * flux * face_length(i, l->nx);
        bottom[i] += amount;
        top[i] -= amount;
    }
}

/* Adjoint gradient at site (i, j): the mean of the two face differences,
 * one-sided at walls. */
static inline void gradient_at(const struct lattice *l, const double *p, int i, int j, double *gx,
                               double *gy) {
    size_t nx = (size_t)l->nx, k = (size_t)j * nx + (size_t)i;
    size_t east = i + 1 < l->nx ? k + 1 : k, west = i > 0 ? k - 1 : k;
    size_t north = j + 1 < l->ny ? k + nx : k, south = j > 0 ? k - nx : k;
    *gx = (p[east] - p[west]) / (double)(east - west);
    *gy = (p[north] - p[south]) / (double)((north - south) / nx);
}

/* mass and rhs of the unknown p: accumulation, and advection under `full`. */
static void set_accumulation(struct gas *gas, const struct graingas_parameters *p) {
    const struct lattice *l = gas->lattice;
    for (int j = 0; j < l->ny; j++)
        for (int i = 0; i < l->nx; i++) {
            size_t k = (size_t)j * (size_t)l->nx + (size_t)i;
            double amount = p->peclet * l->volume[k] * (1 - gas->clipped[k]);
            gas->mass[k] = amount / p->dt_tau;
            gas->rhs[k] = gas->mass[k] * gas->pressure[k];
            if (p->gas == GAS_FULL) {
                double gx, gy;
                gradient_at(l, gas->pressure, i, j, &gx, &gy);
                gas->rhs[k] -= amount * (gas->ux[k] * gx + gas->uy[k] * gy);
            }
        }
}

enum status gas_step(struct gas *gas, const struct graingas_parameters *p, double flux,
                     struct fault *fault) {
    set_faces(gas, p);
    set_accumulation(gas, p);
    subtract_divergence(gas, p);
    if (flux != 0)
        inject(gas, p, flux);
    multigrid_set(gas->solver, gas->east, gas->north, gas->mass);
    if (multigrid_solve(gas->solver, gas->rhs, p->pressure_tolerance, gas->pressure, &gas->outcome,
                        fault) == STATUS_OK)
        return STATUS_OK;
    double low = INFINITY, high = 0;
    for (size_t k = 0; k < gas->lattice->sites; k++) {
        low = fmin(low, gas->coefficient[k]);
        high = fmax(high, gas->coefficient[k]);
    }
    return fault_within(fault, "Darcy coefficients from %.4g to %.4g", low, high);
}

void gas_find_pull(struct gas *gas, const struct graingas_parameters *p) {
    const struct lattice *l = gas->lattice;
    double scale = -1 / (p->froude * p->peclet);
    for (int j = 0; j < l->ny; j++)
        for (int i = 0; i < l->nx; i++) {
            size_t k = (size_t)j * (size_t)l->nx + (size_t)i;
            double gx, gy;
            gradient_at(l, gas->pressure, i, j, &gx, &gy);
            gas->pull[k].x = scale * gx / gas->clipped[k];
            gas->pull[k].y = scale * gy / gas->clipped[k];
        }
}

double gas_densest(const struct gas *gas) {
    double most = 0;
    for (size_t k = 0; k < gas->lattice->sites; k++)
        most = fmax(most, gas->solid_fraction[k]);
    return most;
}

void gas_unabsorbed(const struct gas *gas, const struct graingas_parameters *p, double force[2]) {
    force[0] = force[1] = 0;
    for (size_t k = 0; k < gas->lattice->sites; k++) {
        double missing = gas->lattice->volume[k] * (gas->clipped[k] - gas->solid_fraction[k]);
        force[0] += p->froude * missing * gas->pull[k].x;
        force[1] += p->froude * missing * gas->pull[k].y;
    }
}
