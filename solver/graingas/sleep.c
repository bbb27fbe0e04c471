#include "solver/graingas/sleep.h"

#include <math.h>
#include <stdlib.h>

/* In units of g: pressed down enough to fall asleep, too little to stay so. */
static const double PRESSED = 0.1, RELIEVED = 0.05;
/* Of `after`: memory of the mean load; free fall to the speed of a hit that wakes. */
static const double MEMORY = 0.1, HARD = 0.1;
/* A neighbour is whoever is nearer than this, in displacements. */
static const double REACH = 5;

enum status sleep_create(struct sleep *s, const struct grains *g, struct fault *fault) {
    size_t n = g->count;
    *s = (struct sleep){.count = n};
    s->anchor = calloc(2 * n + 1, sizeof *s->anchor);
    s->load = calloc(n + 1, sizeof *s->load);
    s->quiet = calloc(n + 1, sizeof *s->quiet);
    s->hits = calloc(n + 1, sizeof *s->hits);
    s->asleep = calloc(n + 1, sizeof *s->asleep);
    if (s->anchor && s->load && s->quiet && s->hits && s->asleep)
        return STATUS_OK;
    sleep_free(s);
    return fault_set(fault, STATUS_NO_MEMORY, "no memory for the sleep of %zu grains", n);
}

void sleep_free(struct sleep *s) {
    free(s->anchor);
    free(s->load);
    free(s->quiet);
    free(s->hits);
    free(s->asleep);
    *s = (struct sleep){0};
}

static void drop_anchor(struct sleep *s, const struct grains *g, size_t i) {
    int32_t id = g->id[i];
    s->anchor[2 * id] = g->x[i];
    s->anchor[2 * id + 1] = g->y[i];
    s->quiet[id] = 0;
}

static void wake(struct sleep *s, struct grains *g, size_t i) {
    int32_t id = g->id[i];
    if (!s->asleep[id])
        return;
    s->asleep[id] = false;
    s->sleeping--;
    g->inverse_mass[i] = 1 / g->area[i];
    drop_anchor(s, g, i);
}

/* Without gravity nothing is pressed down. */
static bool is_off(const struct sleep_rule *rule) {
    return rule->displacement <= 0 || rule->fall <= 0;
}

/* Mean loads at a look; who is no longer pressed down wakes. */
static void weigh(struct sleep *s, struct grains *g, const struct sleep_rule *rule,
                  const double *ay) {
    double share = rule->elapsed / (MEMORY * rule->after + rule->elapsed);
    for (size_t i = 0; i < g->count; i++) {
        int32_t id = g->id[i];
        double net = ay[i] - rule->fall + s->hits[id] / (g->area[i] * rule->elapsed);
        s->load[id] += share * (net - s->load[id]);
        s->hits[id] = 0;
        if (s->load[id] > -RELIEVED * rule->fall)
            wake(s, g, i);
    }
}

void sleep_hold(struct sleep *s, struct grains *g, const struct sleep_rule *rule, double *ax,
                double *ay) {
    if (is_off(rule))
        return;
    if (rule->elapsed > 0)
        weigh(s, g, rule, ay);
    for (size_t i = 0; i < g->count && s->sleeping > 0; i++)
        if (g->inverse_mass[i] == 0) {
            ax[i] = 0;
            ay[i] = rule->fall;
        }
}

/* Has grain i left its place? */
static bool has_moved(const struct sleep *s, const struct grains *g, const struct sleep_rule *rule,
                      size_t i) {
    int32_t id = g->id[i];
    double dx = g->x[i] - s->anchor[2 * id], dy = g->y[i] - s->anchor[2 * id + 1];
    return dx * dx + dy * dy > rule->displacement * rule->displacement;
}

/* Does the waking grain i disturb the sleeping grain j, by going or by coming? */
static bool disturbs(const struct sleep *s, const struct grains *g, const struct sleep_rule *rule,
                     size_t i, size_t j) {
    double dx = g->x[i] - g->x[j], dy = g->y[i] - g->y[j], touch = g->radius[i] + g->radius[j];
    double square = dx * dx + dy * dy, reach = touch + REACH * rule->displacement;
    if (square >= reach * reach)
        return false;
    if (rule->elapsed > 0 && has_moved(s, g, rule, i))
        return true;
    double approach = -(g->vx[i] * dx + g->vy[i] * dy), hard = HARD * rule->fall * rule->after;
    return square < touch * touch && approach > 0 && approach * approach > hard * hard * square;
}

static void wake_disturbed(struct sleep *s, struct grains *g, const struct sleep_rule *rule,
                           const struct neighbours *n) {
    for (size_t i = 0; i < g->count; i++)
        for (size_t p = n->first[i]; p < n->first[i + 1]; p++) {
            size_t j = (size_t)n->other[p];
            bool asleep = g->inverse_mass[i] == 0;
            if ((g->inverse_mass[j] == 0) == asleep)
                continue;
            size_t mover = asleep ? j : i, sleeper = asleep ? i : j;
            if (disturbs(s, g, rule, mover, sleeper))
                wake(s, g, sleeper);
        }
}

void sleep_disturb(struct sleep *s, struct grains *g, const struct sleep_rule *rule,
                   const struct neighbours *n) {
    if (is_off(rule))
        return;
    if (s->sleeping > 0)
        wake_disturbed(s, g, rule, n);
    for (size_t i = 0; i < g->count && rule->elapsed > 0; i++)
        if (g->inverse_mass[i] > 0 && has_moved(s, g, rule, i))
            drop_anchor(s, g, i);
}

static void note_hits(struct sleep *s, const struct grains *g, const struct contacts *c) {
    for (size_t k = 0; k < c->count; k++) {
        const struct contact *t = &c->contact[k];
        if (t->impulse == 0 || t->wall >= 0)
            continue;
        if (g->inverse_mass[t->i] == 0)
            s->hits[g->id[t->i]] += t->impulse * t->ny;
        if (g->inverse_mass[t->j] == 0)
            s->hits[g->id[t->j]] -= t->impulse * t->ny;
    }
}

double sleep_settle(struct sleep *s, struct grains *g, const struct sleep_rule *rule,
                    const struct contacts *c) {
    double taken = 0;
    if (is_off(rule))
        return 0;
    if (s->sleeping > 0)
        note_hits(s, g, c);
    for (size_t i = 0; i < g->count && rule->elapsed > 0; i++) {
        int32_t id = g->id[i];
        if (s->asleep[id] && g->inverse_mass[i] > 0)
            wake(s, g, i); /* the collisions gave it its mass back */
        if (s->asleep[id])
            continue;
        s->quiet[id] += rule->elapsed;
        if (s->quiet[id] < rule->after || s->load[id] > -PRESSED * rule->fall)
            continue;
        taken += 0.5 * g->area[i] * (g->vx[i] * g->vx[i] + g->vy[i] * g->vy[i]);
        g->vx[i] = g->vy[i] = 0;
        g->inverse_mass[i] = 0;
        s->asleep[id] = true;
        s->sleeping++;
    }
    return taken;
}

void sleep_restore(struct sleep *s, struct grains *g) {
    s->sleeping = 0;
    for (size_t i = 0; i < g->count; i++)
        if (s->asleep[g->id[i]]) {
            g->inverse_mass[i] = 0;
            s->sleeping++;
        }
}
