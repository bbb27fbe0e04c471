/* checkpoint.c -- the complete state in one file; a run that is loaded goes on
 * to the same bits.
 *
 * The pair list is not stored: it follows from the grains' order and their
 * places at the last rebuild, which are.  Grains are stored in memory order. */
#include "solver/graingas/graingas.h"

#include <stdlib.h>
#include <string.h>

struct item {
    const char *name;
    enum h5_type type;
    size_t count;
    void *data; /* doubles, or int64 for H5_INTEGER */
};

enum { ITEM_COUNT = 13, COUNTER_COUNT = 24, LABELS = 4 };

static void list_items(struct graingas *s, struct item *item) {
    struct grains *g = &s->grains;
    struct neighbours *n = &s->contacts.neighbours;
    struct sleep *z = &s->sleep;
    struct item all[ITEM_COUNT] = {
        {"state/x", H5_REAL, g->count, g->x},
        {"state/y", H5_REAL, g->count, g->y},
        {"state/vx", H5_REAL, g->count, g->vx},
        {"state/vy", H5_REAL, g->count, g->vy},
        {"state/radius", H5_REAL, g->count, g->radius},
        {"state/rebuild_x", H5_REAL, g->count, n->x},
        {"state/rebuild_y", H5_REAL, g->count, n->y},
        {"state/pressure", H5_REAL, s->lattice.sites, s->gas.pressure},
        {"state/collision_virial", H5_REAL, s->lattice.sites, s->contacts.virial_field},
        {"state/anchor", H5_REAL, 2 * g->count, z->anchor},
        {"state/load", H5_REAL, g->count, z->load},
        {"state/quiet", H5_REAL, g->count, z->quiet},
        {"state/hits", H5_REAL, g->count, z->hits}};
    memcpy(item, all, sizeof all);
}

/* Counters as doubles: integers below 2^53 are exact. */
static void pack_counters(const struct graingas *s, double *c) {
    const struct contact_tally *t = &s->contacts.tally;
    const double all[] = {(double)s->step,
                          s->start_collisions,
                          (double)s->pressure_cycles,
                          s->contacts.neighbours.built,
                          (double)s->contacts.neighbours.rebuilds,
                          s->gas.outcome.iterations,
                          s->gas.outcome.residual,
                          (double)t->collisions,
                          (double)t->elastic,
                          (double)t->sweeps,
                          t->dissipated,
                          t->virial,
                          t->largest_overlap,
                          t->last_sweeps,
                          t->most_sweeps};
    memset(c, 0, COUNTER_COUNT * sizeof *c);
    memcpy(c, all, sizeof all);
    memcpy(c + 15, t->wall_impulse, sizeof t->wall_impulse);
    memcpy(c + 19, t->wall_virial, sizeof t->wall_virial);
}

static void unpack_counters(struct graingas *s, const double *c) {
    struct contact_tally *t = &s->contacts.tally;
    s->step = (long long)c[0];
    s->start_collisions = c[1];
    s->pressure_cycles = (long long)c[2];
    s->contacts.neighbours.built = c[3] != 0;
    s->contacts.neighbours.rebuilds = (long long)c[4];
    s->gas.outcome.iterations = (int)c[5];
    s->gas.outcome.residual = c[6];
    t->collisions = (long long)c[7];
    t->elastic = (long long)c[8];
    t->sweeps = (long long)c[9];
    t->dissipated = c[10];
    t->virial = c[11];
    t->largest_overlap = c[12];
    t->last_sweeps = (int)c[13];
    t->most_sweeps = (int)c[14];
    memcpy(t->wall_impulse, c + 15, sizeof t->wall_impulse);
    memcpy(t->wall_virial, c + 19, sizeof t->wall_virial);
}

/* Ids, species, last hits and sleep side by side: labels[LABELS count]. */
static void pack_labels(const struct graingas *s, int64_t *labels) {
    const struct grains *g = &s->grains;
    for (size_t i = 0; i < g->count; i++) {
        int64_t *label = labels + LABELS * i;
        label[0] = g->id[i];
        label[1] = g->species[i];
        label[2] = g->last_hit[i];
        label[3] = s->sleep.asleep[g->id[i]];
    }
}

enum status graingas_save(const void *state, const char *path, struct fault *fault) {
    struct graingas *s = (struct graingas *)state; /* only read */
    struct item item[ITEM_COUNT];
    double counter[COUNTER_COUNT];
    struct h5_writer *w = NULL;
    size_t counters = COUNTER_COUNT, label_count = LABELS * s->grains.count;
    int64_t *labels = malloc((label_count + 1) * sizeof *labels);
    if (!labels)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a checkpoint");
    list_items(s, item);
    pack_counters(s, counter);
    pack_labels(s, labels);
    if (h5_create(path, &w, fault) != STATUS_OK)
        goto done;
    for (size_t k = 0; k < ITEM_COUNT; k++)
        if (h5_write(w, item[k].name, item[k].type, 1, &item[k].count, item[k].data, "1", fault))
            goto done;
    if (h5_write(w, "state/labels", H5_INTEGER, 1, &label_count, labels, "1", fault) ||
        h5_write(w, "state/counters", H5_REAL, 1, &counters, counter, "1", fault))
        goto done;
    struct h5_writer *complete = w;
    w = NULL;
    h5_commit(complete, fault);
done:
    h5_discard(w);
    free(labels);
    return fault->status;
}

static enum status load_labels(struct h5_reader *r, struct graingas *s, struct fault *fault) {
    struct grains *g = &s->grains;
    double *labels = malloc((LABELS * g->count + 1) * sizeof *labels);
    if (!labels)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for a checkpoint");
    if (h5_read_exactly(r, "state/labels", LABELS * g->count, labels, fault) == STATUS_OK)
        for (size_t i = 0; i < g->count; i++) {
            const double *label = labels + LABELS * i;
            g->id[i] = (int32_t)label[0];
            g->species[i] = (int32_t)label[1];
            g->last_hit[i] = (int64_t)label[2];
            s->sleep.asleep[g->id[i]] = label[3] != 0;
        }
    free(labels);
    return fault->status;
}

/* Make the pair list that the stored places had at their rebuild. */
static enum status restore_neighbours(struct graingas *s, struct fault *fault) {
    struct grains *g = &s->grains;
    struct neighbours *n = &s->contacts.neighbours;
    if (!n->built)
        return STATUS_OK;
    long long rebuilds = n->rebuilds;
    memcpy(s->ax, g->x, g->count * sizeof *g->x);
    memcpy(s->ay, g->y, g->count * sizeof *g->y);
    memcpy(g->x, n->x, g->count * sizeof *g->x);
    memcpy(g->y, n->y, g->count * sizeof *g->y);
    n->built = false;
    if (neighbours_update(n, g, fault) != STATUS_OK)
        return fault->status;
    memcpy(g->x, s->ax, g->count * sizeof *g->x);
    memcpy(g->y, s->ay, g->count * sizeof *g->y);
    n->rebuilds = rebuilds;
    return STATUS_OK;
}

enum status graingas_load(void *state, const char *path, struct fault *fault) {
    struct graingas *s = state;
    struct item item[ITEM_COUNT];
    double counter[COUNTER_COUNT];
    struct h5_reader *r = NULL;
    list_items(s, item);
    if (h5_open(path, &r, fault) != STATUS_OK)
        return fault->status;
    for (size_t k = 0; k < ITEM_COUNT; k++)
        if (h5_read_exactly(r, item[k].name, item[k].count, item[k].data, fault))
            goto done;
    if (h5_read_exactly(r, "state/counters", COUNTER_COUNT, counter, fault) ||
        load_labels(r, s, fault))
        goto done;
    unpack_counters(s, counter);
    grains_weigh(&s->grains);
    sleep_restore(&s->sleep, &s->grains);
    restore_neighbours(s, fault);
done:
    h5_close(r);
    return fault->status;
}
