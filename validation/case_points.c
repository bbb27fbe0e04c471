/* case_points.c -- what the points of a tier must offer to its seeds, checks and figures. */
#include "validation/case_read.h"

#include <stdlib.h>
#include <string.h>

/* All points of the tier: parameters[point * size .. + size-1]. */
struct grid {
    size_t size, count;
    struct case_parameter *parameter;
};

static const struct case_parameter *grid_at(const struct grid *g, size_t point) {
    return &g->parameter[point * g->size];
}

static void name_parameters(struct case_reader *r, const struct grid *g, const struct yaml_node *n,
                            const char *name) {
    const char *names[256];
    size_t count = g->size < 256 ? g->size : 256;
    for (size_t i = 0; i < count; i++)
        names[i] = g->parameter[i].name;
    case_read_unknown(r, n, "parameter of this case", name, names, count);
}

/* Every name of a filter is a parameter; the values that some point has are marked. */
static void use_filter(struct case_reader *r, const struct grid *g, const struct case_filter *f) {
    for (size_t i = 0; i < f->count; i++) {
        const struct yaml_node *n = &f->map->child[i];
        if (case_parameter_find(g->parameter, g->size, n->key) == NULL) {
            name_parameters(r, g, n, n->key);
            continue;
        }
        size_t values = n->kind == YAML_LIST ? n->count : 1;
        for (size_t k = 0; k < values; k++) {
            const struct yaml_node *v = n->kind == YAML_LIST ? &n->child[k] : n;
            for (size_t p = 0; v->kind == YAML_SCALAR && p < g->count; p++) {
                const struct yaml_node *has = case_parameter_find(grid_at(g, p), g->size, n->key);
                if (has->kind == YAML_SCALAR && case_value_equal(has->text, v->text))
                    case_read_mark(r, v, true);
            }
        }
    }
}

/* Follow the tables of an expectation for one point. */
static void use_expect(struct case_reader *r, const struct grid *g, const struct case_check *k,
                       size_t point) {
    const struct case_parameter *p = grid_at(g, point);
    for (const struct case_expect *e = &k->expect; e->kind == EXPECT_TABLE && e->by != NULL;) {
        const struct yaml_node *value = case_parameter_find(p, g->size, e->by);
        const struct case_expect *next = NULL;
        if (value == NULL || value->kind != YAML_SCALAR) {
            name_parameters(r, g, yaml_get(e->node, "by"), e->by);
            return;
        }
        for (size_t i = 0; i < e->count; i++) {
            if (!case_value_equal(e->entry[i].node->key, value->text))
                continue;
            case_read_mark(r, e->entry[i].node, true);
            next = &e->entry[i].expect;
        }
        if (next == NULL) {
            case_read_fault(r, e->node, "check %s: no entry for %s = %s", k->name, e->by,
                            value->text);
            return;
        }
        e = next;
    }
}

/* Do two points differ in no parameter but `along`? */
static bool same_group(const struct grid *g, size_t a, size_t b, const char *along) {
    for (size_t i = 0; i < g->size; i++) {
        if (grid_at(g, a)[i].value != grid_at(g, b)[i].value &&
            strcmp(g->parameter[i].name, along) != 0)
            return false;
    }
    return true;
}

/* Each group of points has enough values, all of them numbers, to fit along. */
static void use_across(struct case_reader *r, const struct grid *g, const struct case_tier *t,
                       const struct case_across *a) {
    bool swept = false;
    for (size_t i = 0; i < t->axis_count; i++)
        swept |= strcmp(t->axis[i].name, a->along) == 0;
    if (!swept) {
        case_read_fault(r, yaml_get(a->node, "along"),
                        "along: %s is not swept in every tier that "
                        "uses %s",
                        a->along, a->name);
        return;
    }
    for (size_t p = 0; p < g->count; p++) {
        size_t points = 0;
        if (!case_filter_takes(&a->points, grid_at(g, p), g->size))
            continue;
        for (size_t q = 0; q < g->count; q++)
            points += same_group(g, p, q, a->along) &&
                      case_filter_takes(&a->points, grid_at(g, q), g->size);
        if (points < a->fit->min_points) {
            case_read_fault(r, a->node, "across %s: %zu points in a fit, %s needs %zu", a->name,
                            points, a->fit->name, a->fit->min_points);
            return;
        }
        double x;
        struct fault found = FAULT_NONE;
        if (yaml_real(case_parameter_find(grid_at(g, p), g->size, a->along), &x, &found) !=
            STATUS_OK)
            case_read_merge(r, &found);
    }
}

static void use_check(struct case_reader *r, const struct grid *g, const struct case_tier *t,
                      const struct case_check *k) {
    const struct case_across *a = k->number.across ? &r->c->across[k->number.index] : NULL;
    size_t taken = 0;
    use_filter(r, g, &k->points);
    if (a != NULL && a->fit != NULL && a->along != NULL) {
        use_filter(r, g, &a->points);
        use_across(r, g, t, a);
        if (k->points.map != NULL && yaml_get(k->points.map, a->along) != NULL)
            case_read_fault(r, k->points.map,
                            "check %s: %s is what the fit goes along; choose its "
                            "values in `across`",
                            k->name, a->along);
        if (k->expect.kind == EXPECT_TABLE && k->expect.by != NULL &&
            strcmp(k->expect.by, a->along) == 0)
            case_read_fault(r, k->expect.node, "check %s: one fit along %s has one expectation",
                            k->name, a->along);
    }
    for (size_t p = 0; p < g->count; p++) {
        if (!case_filter_takes(&k->points, grid_at(g, p), g->size) ||
            (a != NULL && !case_filter_takes(&a->points, grid_at(g, p), g->size)))
            continue;
        taken++;
        use_expect(r, g, k, p);
    }
    if (taken == 0)
        case_read_fault(r, k->node,
                        "check %s: applies to no point of tier %s; say `tiers: [...]` "
                        "in the check, or `%s: off` in the tier",
                        k->name, case_tier_name((enum tier)(t - r->c->tier)), k->name);
}

static void use_figure(struct case_reader *r, const struct grid *g, const struct case_tier *t,
                       const struct case_figure *f) {
    size_t taken = 0;
    enum tier tier = (enum tier)(t - r->c->tier);
    if (!f->in_tier[tier])
        return;
    use_filter(r, g, &f->points);
    for (size_t p = 0; p < g->count; p++)
        taken += case_filter_takes(&f->points, grid_at(g, p), g->size);
    if (taken == 0)
        case_read_fault(r, f->node,
                        "figure %s: shows no point of tier %s; say `tiers: [...]` in the figure",
                        f->recipe, case_tier_name(tier));
}

static void use_seeds(struct case_reader *r, const struct grid *g, const struct case_tier *t) {
    for (size_t i = 0; i < t->seeds.rule_count; i++)
        use_filter(r, g, &t->seeds.rule[i].points);
    for (size_t p = 0; p < g->count; p++) {
        if (t->seeds.rule_count > 0 && case_seed_count(&t->seeds, grid_at(g, p), g->size) == 0 &&
            r->fault->status == STATUS_OK)
            case_read_fault(r, t->node, "tier %s: no rule of `seeds` fits some point",
                            case_tier_name((enum tier)(t - r->c->tier)));
    }
}

void case_read_points(struct case_reader *r, enum tier tier) {
    struct case_tier *t = &r->c->tier[tier];
    struct grid g = {.size = t->parameter_count + t->axis_count, .count = t->point_count};
    g.parameter = case_read_take(r, g.size * g.count, sizeof *g.parameter);
    if (g.parameter == NULL || g.count == 0 || t->parameter == NULL)
        return;
    for (size_t p = 0; p < g.count; p++)
        case_point(t, p, &g.parameter[p * g.size]);
    use_seeds(r, &g, t);
    for (size_t i = 0; i < t->check_count; i++)
        use_check(r, &g, t, &t->check[i]);
    for (size_t i = 0; i < r->c->figure_count; i++)
        use_figure(r, &g, t, &r->c->figure[i]);
}
