/* engine_checkpoint.c -- the complete state of an engine in datasets, continued to the
 * same bits.
 *
 * Spheres are stored in memory order, which decides between equal times.  Cells and the
 * queue follow from them: the order of labels in a cell and of events in a bucket changes
 * no result. */
#include "solver/suspension/engine_state.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Columns of the table of spheres; all numbers are exact as doubles. */
enum {
    COLUMN_X = 0,
    COLUMN_T = 3,
    COLUMN_W = 4,
    COLUMN_CELL = 7,
    COLUMN_TIME = 10,
    COLUMN_PAIR_TIME,
    COLUMN_PARTNER,
    COLUMN_PARTNER_COUNT,
    COLUMN_COUNT,
    COLUMN_LAST_HIT,
    COLUMN_IMAGE,
    COLUMN_ID = COLUMN_IMAGE + 3,
    COLUMNS
};
enum { NAME_SIZE = 256, SETUP_NUMBERS = 14, TALLY_NUMBERS = 17, CLOCK_NUMBERS = 15 };

static void pack_sphere(const struct engine *e, size_t k, double *row) {
    const struct sphere *s = &e->sphere[k];
    const struct event *v = &e->event[k];
    for (int a = 0; a < 3; a++) {
        row[COLUMN_X + a] = s->x[a];
        row[COLUMN_W + a] = s->w[a];
        row[COLUMN_CELL + a] = v->cell[a];
        row[COLUMN_IMAGE + a] = e->image[k][a];
    }
    row[COLUMN_T] = s->t;
    row[COLUMN_TIME] = v->time;
    row[COLUMN_PAIR_TIME] = s->pair_time;
    row[COLUMN_PARTNER] = v->partner;
    row[COLUMN_PARTNER_COUNT] = v->partner_count;
    row[COLUMN_COUNT] = v->count;
    row[COLUMN_LAST_HIT] = e->last_hit[k];
    row[COLUMN_ID] = e->id[k];
}

static void unpack_sphere(struct engine *e, size_t k, const double *row) {
    struct sphere *s = &e->sphere[k];
    struct event *v = &e->event[k];
    *s = (struct sphere){.t = row[COLUMN_T], .pair_time = row[COLUMN_PAIR_TIME]};
    *v = (struct event){.time = row[COLUMN_TIME],
                        .partner = (uint32_t)row[COLUMN_PARTNER],
                        .partner_count = (uint32_t)row[COLUMN_PARTNER_COUNT],
                        .count = (uint32_t)row[COLUMN_COUNT]};
    for (int a = 0; a < 3; a++) {
        s->x[a] = row[COLUMN_X + a];
        s->w[a] = row[COLUMN_W + a];
        v->cell[a] = (uint16_t)row[COLUMN_CELL + a];
        e->image[k][a] = (int32_t)row[COLUMN_IMAGE + a];
    }
    e->last_hit[k] = row[COLUMN_LAST_HIT];
    e->id[k] = (uint32_t)row[COLUMN_ID];
}

static void pack_setup(const struct engine *e, double *n) {
    const struct engine_setup *s = &e->setup;
    const double all[SETUP_NUMBERS] = {
        (double)s->count, s->radius_m,       s->mass_kg,          s->box_m[0],    s->box_m[1],
        s->box_m[2],      s->boundary[0],    s->boundary[1],      s->boundary[2], s->restitution,
        s->guard,         s->contact_time_s, s->cutoff_speed_m_s, CELL_LABELS};
    memcpy(n, all, sizeof all);
}

static void pack_clock(const struct engine *e, double *n) {
    const double all[CLOCK_NUMBERS] = {e->gamma,
                                       e->origin_s,
                                       e->now,
                                       e->real_now_s,
                                       e->contact_span,
                                       e->diameter,
                                       e->growth,
                                       e->growth_from,
                                       e->rebase_at,
                                       (double)e->events,
                                       (double)e->rebuild_events,
                                       e->tuned_from,
                                       (double)e->standstill,
                                       e->broken,
                                       e->queue.per_width};
    memcpy(n, all, sizeof all);
}

static void unpack_clock(struct engine *e, const double *n) {
    e->gamma = n[0];
    e->origin_s = n[1];
    e->now = n[2];
    e->real_now_s = n[3];
    e->contact_span = n[4];
    e->diameter = n[5];
    e->growth = n[6];
    e->growth_from = n[7];
    e->rebase_at = n[8];
    e->events = (long long)n[9];
    e->rebuild_events = (long long)n[10];
    e->tuned_from = n[11];
    e->standstill = (long long)n[12];
    e->broken = (uint32_t)n[13];
    e->queue.per_width = n[14];
}

static void pack_tally(const struct engine *e, double *n) {
    const struct engine_tally *t = &e->tally;
    const double all[TALLY_NUMBERS - 6] = {(double)t->collisions,
                                           (double)t->elastic,
                                           (double)t->wall_collisions,
                                           (double)t->cell_crossings,
                                           (double)t->stale,
                                           (double)t->kicks,
                                           (double)t->rebases,
                                           (double)t->rebuilds,
                                           t->dissipated_J,
                                           t->virial_J,
                                           t->wall_virial_J};
    memcpy(n, all, sizeof all);
    memcpy(n + TALLY_NUMBERS - 6, t->wall_impulse, sizeof t->wall_impulse);
}

static void unpack_tally(struct engine *e, const double *n) {
    struct engine_tally *t = &e->tally;
    t->collisions = (long long)n[0];
    t->elastic = (long long)n[1];
    t->wall_collisions = (long long)n[2];
    t->cell_crossings = (long long)n[3];
    t->stale = (long long)n[4];
    t->kicks = (long long)n[5];
    t->rebases = (long long)n[6];
    t->rebuilds = (long long)n[7];
    t->dissipated_J = n[8];
    t->virial_J = n[9];
    t->wall_virial_J = n[10];
    memcpy(t->wall_impulse, n + TALLY_NUMBERS - 6, sizeof t->wall_impulse);
}

static enum status write_numbers(struct h5_writer *w, const char *group, const char *name,
                                 const double *n, size_t count, struct fault *fault) {
    char path[NAME_SIZE];
    snprintf(path, sizeof path, "%s/%s", group, name);
    return h5_write(w, path, H5_REAL, 1, &count, n, "1", fault);
}

static enum status read_numbers(struct h5_reader *r, const char *group, const char *name, double *n,
                                size_t count, struct fault *fault) {
    char path[NAME_SIZE];
    snprintf(path, sizeof path, "%s/%s", group, name);
    return h5_read_exactly(r, path, count, n, fault);
}

enum status engine_save(const struct engine *e, struct h5_writer *w, const char *group,
                        struct fault *fault) {
    double setup[SETUP_NUMBERS], clock[CLOCK_NUMBERS], tally[TALLY_NUMBERS];
    double *row = malloc((COLUMNS * e->count + 1) * sizeof *row);
    if (!row)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a checkpoint");
    for (size_t k = 0; k < e->count; k++)
        pack_sphere(e, k, row + COLUMNS * k);
    pack_setup(e, setup);
    pack_clock(e, clock);
    pack_tally(e, tally);
    if (write_numbers(w, group, "setup", setup, SETUP_NUMBERS, fault) == STATUS_OK &&
        write_numbers(w, group, "clock", clock, CLOCK_NUMBERS, fault) == STATUS_OK &&
        write_numbers(w, group, "tally", tally, TALLY_NUMBERS, fault) == STATUS_OK && e->count > 0)
        write_numbers(w, group, "spheres", row, COLUMNS * e->count, fault);
    free(row);
    return fault->status;
}

/* -- loading ------------------------------------------------------------------------- */

/* Numbers that index something must be in range before they are used. */
static bool row_is_sound(const struct engine *e, const double *row) {
    bool sound = row[COLUMN_ID] >= 0 && row[COLUMN_ID] < (double)e->count &&
                 ((row[COLUMN_PARTNER] >= 0 && row[COLUMN_PARTNER] < (double)e->count) ||
                  (row[COLUMN_PARTNER] == QUEUE_NONE && !(row[COLUMN_PAIR_TIME] < INFINITY)));
    for (int a = 0; a < 3; a++)
        sound = sound && row[COLUMN_CELL + a] >= 0 && row[COLUMN_CELL + a] < e->cells.n[a] &&
                isfinite(row[COLUMN_X + a]) && isfinite(row[COLUMN_W + a]) &&
                fabs(row[COLUMN_IMAGE + a]) < INT32_MAX;
    for (int k = COLUMN_PARTNER_COUNT; k <= COLUMN_COUNT; k++)
        sound = sound && row[k] >= 0 && row[k] <= UINT32_MAX;
    return sound && isfinite(row[COLUMN_T]) && !isnan(row[COLUMN_TIME]);
}

static enum status take_rows(struct engine *e, struct h5_reader *r, const double *row,
                             struct fault *fault) {
    for (size_t k = 0; k < e->count; k++)
        if (!row_is_sound(e, row + COLUMNS * k))
            return fault_set(fault, STATUS_BAD_INPUT, "%s: row %zu of the spheres makes no sense",
                             h5_path(r), k);
    cells_clear(&e->cells);
    for (size_t k = 0; k < e->count; k++) {
        unpack_sphere(e, k, row + COLUMNS * k);
        e->place[e->id[k]] = (uint32_t)k;
        cells_insert(&e->cells, cells_of(&e->cells, e->event[k].cell), (uint32_t)k);
    }
    return STATUS_OK;
}

enum status engine_load(struct engine *e, struct h5_reader *r, const char *group,
                        struct fault *fault) {
    double setup[SETUP_NUMBERS], own[SETUP_NUMBERS], clock[CLOCK_NUMBERS], tally[TALLY_NUMBERS];
    double *row = malloc((COLUMNS * e->count + 1) * sizeof *row);
    if (!row)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a checkpoint");
    pack_setup(e, own);
    if (read_numbers(r, group, "setup", setup, SETUP_NUMBERS, fault) != STATUS_OK ||
        read_numbers(r, group, "clock", clock, CLOCK_NUMBERS, fault) != STATUS_OK ||
        read_numbers(r, group, "tally", tally, TALLY_NUMBERS, fault) != STATUS_OK)
        goto done;
    if (memcmp(setup, own, sizeof own) != 0) {
        fault_set(fault, STATUS_BAD_INPUT, "%s: %s is of another set-up", h5_path(r), group);
        goto done;
    }
    if (e->count > 0 &&
        (read_numbers(r, group, "spheres", row, COLUMNS * e->count, fault) != STATUS_OK ||
         take_rows(e, r, row, fault) != STATUS_OK))
        goto done;
    unpack_clock(e, clock);
    unpack_tally(e, tally);
    e->placed = true;
    queue_rebuild(&e->queue, e->now, 1 / e->queue.per_width);
done:
    free(row);
    return fault->status;
}
