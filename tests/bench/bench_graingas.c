/* bench_graingas.c -- what a grain-gas run costs, and its pressure solve beside hypre's.
 *
 * One run of the paper's size (18104 grains, 60 x 92 l, published law, random
 * start): seconds to 50 tau; then on to the settled bed.  In three windows of
 * time it prints CPU time a step by part and collisions a step.  At the end of
 * each window the very equations of the next step are solved turn by turn by
 * our multigrid and by hypre's Struct PFMG-PCG, from the same guess to the same
 * residual.  CPU time of one core; compare within one run only. */
#include "solver/graingas/graingas.h"
#include "tests/bench/bench.h"

#include <HYPRE_struct_ls.h>
#include <math.h>
#include <mpi.h>
#include <string.h>

enum { TURNS = 40 };

static struct graingas *paper_run(void) {
    static const char yaml[] = "grains: 18104\nwidth_l: 60\nheight_l: 92\n";
    struct fault fault = FAULT_NONE;
    struct yaml_document *document = NULL;
    struct parameter_set set;
    void *state = NULL;
    yaml_parse("bench", yaml, strlen(yaml), &document, &fault);
    stop_on(&fault);
    parameters_read(&graingas_model, yaml_root(document), NULL, 0, &set, &fault);
    stop_on(&fault);
    graingas_model.create(&state, &set, NULL, 1101, &fault);
    stop_on(&fault);
    parameters_free(&set);
    yaml_free(document);
    return state;
}

static void run_to(struct graingas *s, double time) {
    struct fault fault = FAULT_NONE;
    while (!graingas_model.reached(s, time))
        if (graingas_model.step(s, &fault) != STATUS_OK)
            stop_on(&fault);
}

/* -- hypre ------------------------------------------------------------------------ */

struct peer {
    HYPRE_StructGrid grid;
    HYPRE_StructStencil stencil;
    HYPRE_StructMatrix matrix;
    HYPRE_StructVector b, x;
    HYPRE_StructSolver pcg, pfmg;
    int lower[2], upper[2];
    double *values; /* [5 sites], the stencil's entries of each site */
};

static void peer_create(struct peer *p, const struct lattice *l) {
    static int offset[5][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    *p = (struct peer){.upper = {l->nx - 1, l->ny - 1}};
    HYPRE_StructGridCreate(MPI_COMM_WORLD, 2, &p->grid);
    HYPRE_StructGridSetExtents(p->grid, p->lower, p->upper);
    HYPRE_StructGridAssemble(p->grid);
    HYPRE_StructStencilCreate(2, 5, &p->stencil);
    for (int e = 0; e < 5; e++)
        HYPRE_StructStencilSetElement(p->stencil, e, offset[e]);
    p->values = calloc(5 * l->sites, sizeof *p->values);
}

static void peer_free(struct peer *p) {
    HYPRE_StructGridDestroy(p->grid);
    HYPRE_StructStencilDestroy(p->stencil);
    free(p->values);
}

/* The entries of site k: diagonal, east, west, north, south. */
static void fill_entries(const struct gas *gas, double *v) {
    const struct lattice *l = gas->lattice;
    size_t nx = (size_t)l->nx;
    for (size_t k = 0; k < l->sites; k++, v += 5) {
        size_t i = k % nx, j = k / nx;
        v[1] = i + 1 < nx ? -gas->east[k] : 0;
        v[2] = i > 0 ? -gas->east[k - 1] : 0;
        v[3] = j + 1 < (size_t)l->ny ? -gas->north[k] : 0;
        v[4] = j > 0 ? -gas->north[k - nx] : 0;
        v[0] = gas->mass[k] - v[1] - v[2] - v[3] - v[4];
    }
}

/* All that a step would have to do: new entries, set up, solve. Returns iterations. */
static int peer_solve(struct peer *p, const struct gas *gas, const double *guess, double *answer) {
    int entries[5] = {0, 1, 2, 3, 4}, iterations;
    HYPRE_StructMatrixCreate(MPI_COMM_WORLD, p->grid, p->stencil, &p->matrix);
    HYPRE_StructMatrixInitialize(p->matrix);
    fill_entries(gas, p->values);
    HYPRE_StructMatrixSetBoxValues(p->matrix, p->lower, p->upper, 5, entries, p->values);
    HYPRE_StructMatrixAssemble(p->matrix);
    HYPRE_StructVectorCreate(MPI_COMM_WORLD, p->grid, &p->b);
    HYPRE_StructVectorCreate(MPI_COMM_WORLD, p->grid, &p->x);
    HYPRE_StructVectorInitialize(p->b);
    HYPRE_StructVectorInitialize(p->x);
    HYPRE_StructVectorSetBoxValues(p->b, p->lower, p->upper, gas->rhs);
    HYPRE_StructVectorSetBoxValues(p->x, p->lower, p->upper, (double *)(void *)guess);
    HYPRE_StructPCGCreate(MPI_COMM_WORLD, &p->pcg);
    HYPRE_StructPFMGCreate(MPI_COMM_WORLD, &p->pfmg);
    HYPRE_StructPFMGSetMaxIter(p->pfmg, 1);
    HYPRE_StructPFMGSetTol(p->pfmg, 0);
    HYPRE_StructPFMGSetZeroGuess(p->pfmg);
    HYPRE_StructPFMGSetRelaxType(p->pfmg, 2); /* symmetric red-black Gauss-Seidel */
    HYPRE_StructPCGSetTol(p->pcg, 1e-8);
    HYPRE_StructPCGSetTwoNorm(p->pcg, 1);
    HYPRE_StructPCGSetMaxIter(p->pcg, 200);
    HYPRE_StructPCGSetPrecond(p->pcg, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, p->pfmg);
    HYPRE_StructPCGSetup(p->pcg, p->matrix, p->b, p->x);
    HYPRE_StructPCGSolve(p->pcg, p->matrix, p->b, p->x);
    HYPRE_StructPCGGetNumIterations(p->pcg, &iterations);
    HYPRE_StructVectorGetBoxValues(p->x, p->lower, p->upper, answer);
    HYPRE_StructPCGDestroy(p->pcg);
    HYPRE_StructPFMGDestroy(p->pfmg);
    HYPRE_StructVectorDestroy(p->b);
    HYPRE_StructVectorDestroy(p->x);
    HYPRE_StructMatrixDestroy(p->matrix);
    return iterations;
}

/* -- ours ----------------------------------------------------------------------------- */

static int own_solve(struct gas *gas, const double *guess, double *answer) {
    struct fault fault = FAULT_NONE;
    struct multigrid_outcome outcome;
    memcpy(answer, guess, gas->lattice->sites * sizeof *answer);
    multigrid_set(gas->solver, gas->east, gas->north, gas->mass);
    multigrid_solve(gas->solver, gas->rhs, 1e-8, answer, &outcome, &fault);
    stop_on(&fault);
    return outcome.iterations;
}

/* Both solve the equations of the step just made, turn by turn; prints ms a solve. */
static void compare_pressure(struct graingas *s, struct peer *peer) {
    size_t sites = s->lattice.sites;
    double *guess = malloc(sizeof(double) * sites), *own = malloc(sizeof(double) * sites);
    double *other = malloc(sizeof(double) * sites), own_s = 0, peer_s = 0, gap = 0, scale = 0;
    int own_cycles = 0, peer_cycles = 0;
    memcpy(guess, s->gas.pressure, sites * sizeof *guess);
    run_to(s, graingas_time(s) + s->parameters.dt_tau);
    for (int turn = 0; turn < TURNS; turn++) {
        double a = cpu_seconds();
        own_cycles = own_solve(&s->gas, guess, own);
        double b = cpu_seconds();
        peer_cycles = peer_solve(peer, &s->gas, guess, other);
        own_s += b - a;
        peer_s += cpu_seconds() - b;
    }
    for (size_t k = 0; k < sites; k++) {
        gap = fmax(gap, fabs(own[k] - other[k]));
        scale = fmax(scale, fabs(own[k]));
    }
    printf("  pressure %d x %d: ours %.3f ms (%d cycles), hypre PFMG-PCG %.3f ms (%d); "
           "answers differ by %.1e of the largest\n",
           s->lattice.nx, s->lattice.ny, 1e3 * own_s / TURNS, own_cycles, 1e3 * peer_s / TURNS,
           peer_cycles, gap / scale);
    free(guess);
    free(own);
    free(other);
}

/* -- windows of the run ------------------------------------------------------------------ */

static void measure_window(struct graingas *s, const char *name, double from, double to) {
    run_to(s, from);
    double before[PART_COUNT];
    memcpy(before, s->seconds, sizeof before);
    long long steps = s->step, collisions = s->contacts.tally.collisions;
    long long sweeps = s->contacts.tally.sweeps;
    run_to(s, to);
    double n = (double)(s->step - steps), ms[PART_COUNT], rest = 0, total = 0;
    for (int k = 0; k < PART_COUNT; k++) {
        ms[k] = 1e3 * (s->seconds[k] - before[k]) / n;
        total += ms[k];
        rest += k == PART_PRESSURE || k == PART_COLLISIONS ? 0 : ms[k];
    }
    double hits = (double)(s->contacts.tally.collisions - collisions) / n;
    printf("%s, %g to %g tau: %.2f ms a step; %.0f collisions in %.1f sweeps a step\n", name, from,
           to, total, hits, (double)(s->contacts.tally.sweeps - sweeps) / n);
    printf(
        "  halo %.3f, push %.3f, search %.3f, collisions %.3f (%.0f ns each), pressure %.3f ms\n",
        ms[PART_HALO], ms[PART_PUSH], ms[PART_SEARCH], ms[PART_COLLISIONS],
        hits > 0 ? 1e6 * ms[PART_COLLISIONS] / hits : 0, ms[PART_PRESSURE]);
    printf("  without collisions and pressure: %.1f ns a grain and step; largest overlap %.4f l\n",
           1e6 * rest / (double)s->grains.count, s->contacts.tally.largest_overlap);
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    HYPRE_Init();
    double began = cpu_seconds();
    struct graingas *s = paper_run();
    struct peer peer;
    peer_create(&peer, &s->lattice);
    printf("start: %.2f s\n", cpu_seconds() - began);
    measure_window(s, "dilute", 0, 5);
    measure_window(s, "settling", 20, 25);
    run_to(s, 50);
    printf("run to 50 tau: %.1f s of CPU\n", cpu_seconds() - began);
    compare_pressure(s, &peer);
    measure_window(s, "settled", 65, 68);
    compare_pressure(s, &peer);
    peer_free(&peer);
    graingas_model.free(s);
    HYPRE_Finalize();
    MPI_Finalize();
    return 0;
}
