/* case_points.c -- what the points of a tier must offer to its seeds, checks and figures. */
#include "validation/case_read.h"

#include <stdlib.h>
#include <string.h>

/* All points of the tier: parameter[point * room .. + size[point]-1]. */
struct grid {
    size_t room, count, *size;
    struct case_parameter *parameter;
};

static const struct case_parameter *grid_at(const struct grid *g, size_t point) {
    return &g->parameter[point * g->room];
}

static const struct yaml_node *grid_find(const struct grid *g, size_t point, const char *name) {
    return case_parameter_find(grid_at(g, point), g->size[point], name);
}

static bool grid_takes(const struct grid *g, const struct case_filter *f, size_t point) {
    return case_filter_takes(f, grid_at(g, point), g->size[point]);
}

/* Does some point have a parameter of this name? */
static bool grid_has(const struct grid *g, const char *name) {
    for (size_t p = 0; p < g->count; p++) {
        if (grid_find(g, p, name) != NULL)
            return true;
    }
    return false;
}

static void name_parameters(struct case_reader *r, const struct grid *g, const struct yaml_node *n,
                            const char *name) {
    const char *names[256];
    size_t count = g->size[0] < 256 ? g->size[0] : 256;
    for (size_t i = 0; i < count; i++)
        names[i] = g->parameter[i].name;
    case_read_unknown(r, n, "parameter of this case", name, names, count);
}

/* Every name of a filter is a parameter; the values that some point has are marked. */
static void use_filter(struct case_reader *r, const struct grid *g, const struct case_filter *f) {
    for (size_t i = 0; i < f->count; i++) {
        const struct yaml_node *n = &f->map->child[i];
        if (!grid_has(g, n->key)) {
            name_parameters(r, g, n, n->key);
            continue;
        }
        size_t values = n->kind == YAML_LIST ? n->count : 1;
        for (size_t k = 0; k < values; k++) {
            const struct yaml_node *v = n->kind == YAML_LIST ? &n->child[k] : n;
            for (size_t p = 0; v->kind == YAML_SCALAR && p < g->count; p++) {
                const struct yaml_node *has = grid_find(g, p, n->key);
                if (has != NULL && has->kind == YAML_SCALAR && case_value_equal(has->text, v->text))
                    case_read_mark(r, v, true);
            }
        }
    }
}

/* A prediction's inputs that are parameters of the case must be numbers. */
static void use_inputs(struct case_reader *r, const struct grid *g, const struct case_prediction *p,
                       const struct yaml_node *node, size_t point) {
    for (size_t i = 0;
         p->prediction != NULL && i < PREDICTION_MAX_INPUTS && p->prediction->input[i] != NULL;
         i++) {
        const struct case_binding *in = &p->input[i];
        const struct yaml_node *value =
            in->kind == BINDING_PARAMETER ? grid_find(g, point, in->parameter) : NULL;
        if (value == NULL ||
            (value->kind == YAML_SCALAR && !value->quoted &&
             (strcmp(value->text, "true") == 0 || strcmp(value->text, "false") == 0)))
            continue; /* the solver's default, or a switch: 1 or 0 */
        struct fault found = FAULT_NONE;
        double ignored;
        if (case_value_real(value, &ignored, &found) == STATUS_OK)
            continue;
        case_read_merge(r, &found);
        case_read_fault(r, node, "%s: its input %s is the parameter %s, which is no number",
                        p->prediction->name, p->prediction->input[i], in->parameter);
    }
}

/* Follow the tables of an expectation for one point. */
static void use_expect(struct case_reader *r, const struct grid *g, const struct case_check *k,
                       size_t point) {
    for (const struct case_expect *e = &k->expect; e->kind == EXPECT_TABLE && e->by != NULL;) {
        const struct yaml_node *value = grid_find(g, point, e->by);
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
    const struct case_expect *found =
        case_expect_find(&k->expect, grid_at(g, point), g->size[point]);
    if (found != NULL && found->kind == EXPECT_PREDICTION)
        use_inputs(r, g, &found->prediction, found->node, point);
}

/* Each group of points has enough values, all of them numbers, to fit along. */
static void use_across(struct case_reader *r, const struct grid *g, const struct case_tier *t,
                       const struct case_across *a) {
    size_t axis = case_axis_of(t, a->along);
    if (axis == t->axis_count) {
        case_read_fault(r, yaml_get(a->node, "along"),
                        "along: %s is not swept in every tier that "
                        "uses %s",
                        a->along, a->name);
        return;
    }
    for (size_t p = 0; p < g->count; p++) {
        size_t points = 0;
        if (!grid_takes(g, &a->points, p))
            continue;
        for (size_t q = 0; q < g->count; q++)
            points += case_points_agree(t, grid_at(g, p), grid_at(g, q), axis) &&
                      grid_takes(g, &a->points, q);
        if (points < a->fit->min_points) {
            case_read_fault(r, a->node, "across %s: %zu points in a fit, %s needs %zu", a->name,
                            points, a->fit->name, a->fit->min_points);
            return;
        }
        const struct case_across *of = a->of.across ? &r->c->across[a->of.index] : NULL;
        if (of != NULL && !grid_takes(g, &of->points, p))
            case_read_fault(r, a->node, "across %s: %s leaves out points that it takes", a->name,
                            of->name);
        double x;
        struct fault found = FAULT_NONE;
        if (case_value_real(grid_find(g, p, a->along), &x, &found) != STATUS_OK)
            case_read_merge(r, &found);
    }
}

/* Each point that a fit over seeds takes has enough of them. */
static void use_ensemble(struct case_reader *r, const struct grid *g, const struct case_tier *t,
                         const struct case_across *a) {
    for (size_t p = 0; p < g->count; p++) {
        size_t seeds = case_seed_count(&t->seeds, grid_at(g, p), g->size[p]);
        if (!grid_takes(g, &a->points, p) || seeds >= a->ensemble->min_seeds)
            continue;
        case_read_fault(r, a->node, "across %s: %zu seeds in tier %s, %s needs %zu", a->name, seeds,
                        case_tier_name((enum tier)(t - r->c->tier)), a->ensemble->name,
                        a->ensemble->min_seeds);
        return;
    }
}

/* Is this name what a fit goes along: the parameter, or the axis that sets it? */
static bool is_along(const struct case_tier *t, const struct case_across *a, const char *name) {
    size_t axis = case_axis_of(t, a->along);
    return strcmp(name, a->along) == 0 ||
           (axis < t->axis_count && strcmp(name, t->axis[axis].name) == 0);
}

/* A check of a fit chooses groups of points, not points within a group. */
static void check_along(struct case_reader *r, const struct case_tier *t,
                        const struct case_check *k, const struct case_across *a) {
    for (size_t i = 0; i < k->points.count; i++) {
        if (is_along(t, a, k->points.map->child[i].key))
            case_read_fault(r, k->points.map,
                            "check %s: %s is what the fit goes along; choose its "
                            "values in `across`",
                            k->name, k->points.map->child[i].key);
    }
    if (k->expect.kind == EXPECT_TABLE && k->expect.by != NULL && is_along(t, a, k->expect.by))
        case_read_fault(r, k->expect.node, "check %s: one fit along %s has one expectation",
                        k->name, k->expect.by);
}

static void use_check(struct case_reader *r, const struct grid *g, const struct case_tier *t,
                      const struct case_check *k) {
    const struct case_across *a = k->number.across ? &r->c->across[k->number.index] : NULL;
    size_t taken = 0;
    use_filter(r, g, &k->points);
    if (a != NULL && a->fit != NULL && a->along != NULL) {
        use_filter(r, g, &a->points);
        use_across(r, g, t, a);
        check_along(r, t, k, a);
    }
    const struct case_across *of =
        a != NULL && a->fit != NULL && a->of.across ? &r->c->across[a->of.index] : a;
    if (of != NULL && of->ensemble != NULL) {
        use_filter(r, g, &of->points);
        use_ensemble(r, g, t, of);
    }
    for (size_t p = 0; p < g->count; p++) {
        if (!grid_takes(g, &k->points, p) || (a != NULL && !grid_takes(g, &a->points, p)))
            continue;
        taken++;
        use_expect(r, g, k, p);
        use_inputs(r, g, &k->per, k->node, p);
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
        taken += grid_takes(g, &f->points, p);
    if (taken == 0)
        case_read_fault(r, f->node,
                        "figure %s: shows no point of tier %s; say `tiers: [...]` in the figure",
                        f->recipe, case_tier_name(tier));
}

static void use_rules(struct case_reader *r, const struct grid *g, const struct case_tier *t,
                      const struct case_rules *rules, const char *key) {
    for (size_t i = 0; i < rules->count; i++)
        use_filter(r, g, &rules->rule[i].points);
    for (size_t p = 0; p < g->count; p++) {
        if (rules->count > 0 && !(case_rule_value(rules, grid_at(g, p), g->size[p]) > 0) &&
            r->fault->status == STATUS_OK)
            case_read_fault(r, t->node, "tier %s: no rule of `%s` fits some point",
                            case_tier_name((enum tier)(t - r->c->tier)), key);
    }
}

void case_read_points(struct case_reader *r, enum tier tier) {
    struct case_tier *t = &r->c->tier[tier];
    struct grid g = {.room = t->room, .count = t->point_count};
    g.parameter = case_read_take(r, g.room * g.count, sizeof *g.parameter);
    g.size = case_read_take(r, g.count, sizeof *g.size);
    if (g.parameter == NULL || g.size == NULL || g.count == 0 || t->parameter == NULL)
        return;
    for (size_t p = 0; p < g.count; p++)
        g.size[p] = case_point(t, p, &g.parameter[p * g.room]);
    use_rules(r, &g, t, &t->seeds.count, "seeds");
    use_rules(r, &g, t, &t->expect_s, "expect_s");
    for (size_t i = 0; i < t->check_count; i++)
        use_check(r, &g, t, &t->check[i]);
    for (size_t i = 0; i < r->c->figure_count; i++)
        use_figure(r, &g, t, &r->c->figure[i]);
}
