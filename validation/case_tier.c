/* case_tier.c -- one tier: samples, seeds and start, overrides applied. */
#include "validation/case_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_POINTS = 4096, MAX_SAMPLES = 100000, MAX_SEEDS = 100000 };

static const struct schema_field tier_fields[] = {
    {"parameters", SCHEMA_MAP, false, 0, 0, NULL},
    {"sweep", SCHEMA_MAP, false, 0, 0, NULL},
    {"samples", SCHEMA_ANY, false, 0, 0, NULL},
    {"particle_samples", SCHEMA_ANY, false, 0, 0, NULL},
    {"start", SCHEMA_MAP, false, 0, 0, NULL},
    {"seeds", SCHEMA_MAP, false, 0, 0, NULL},
    {"limit_s", SCHEMA_REAL, false, 0.01, 1e7, NULL},
    {"expect_s", SCHEMA_ANY, false, 0, 0, NULL},
    {"checks", SCHEMA_MAP, false, 0, 0, NULL},
};

/* A key of the tier, else of the case; NULL where it has the wrong kind. */
static const struct yaml_node *get(struct case_reader *r, const struct yaml_node *over,
                                   const char *key) {
    const struct yaml_node *n = yaml_get(over, key);
    return n != NULL ? n : yaml_get(r->runs, key);
}

static const struct yaml_node *get_map(const struct yaml_node *from, const char *key) {
    const struct yaml_node *n = yaml_get(from, key);
    return n != NULL && n->kind == YAML_MAP ? n : NULL;
}

static bool has(const struct yaml_node *map, const char *key) {
    return map != NULL && yaml_get(map, key) != NULL;
}

static void count_points(struct case_reader *r, struct case_tier *t) {
    t->point_count = 1;
    for (size_t i = 0; i < t->axis_count; i++) {
        t->point_count *= t->axis[i].list->count;
        if (t->point_count > MAX_POINTS) {
            case_read_fault(r, t->axis[i].list, "sweep: more than %d points", (int)MAX_POINTS);
            t->point_count = 0;
            return;
        }
    }
}

static void read_time_range(struct case_reader *r, const struct yaml_node *n,
                            struct case_samples *out) {
    static const struct schema_field field[] = {{"from", SCHEMA_REAL, true, 0, 1e12, NULL},
                                                {"to", SCHEMA_REAL, true, 0, 1e12, NULL},
                                                {"every", SCHEMA_REAL, true, 1e-12, 1e12, NULL}};
    double from = 0, to = 0, every = 0;
    struct fault ignored = FAULT_NONE; /* the schema has told it */
    if (!case_read_fields(r, n, "range of samples", field, 3))
        return;
    yaml_real(yaml_get(n, "from"), &from, &ignored);
    yaml_real(yaml_get(n, "to"), &to, &ignored);
    yaml_real(yaml_get(n, "every"), &every, &ignored);
    double steps = (to - from) / every;
    if (steps < 0 || fabs(steps - round(steps)) > 1e-6 || steps > MAX_SAMPLES) {
        case_read_fault(r, n, "%s: from %g to %g is no whole number of steps of %g (at most %d)",
                        n->key, from, to, every, (int)MAX_SAMPLES);
        return;
    }
    size_t count = (size_t)llround(steps) + 1;
    double *time = case_read_take(r, count, sizeof *time);
    for (size_t i = 0; time != NULL && i < count; i++) {
        char text[32]; /* 3 * 0.1 is meant to be 0.3 */
        snprintf(text, sizeof text, "%.12g", from + (double)i * every);
        time[i] = strtod(text, NULL);
    }
    out->time = time;
    out->count = time == NULL ? 0 : count;
}

static void read_time_list(struct case_reader *r, const struct yaml_node *n,
                           struct case_samples *out) {
    double *time = case_read_take(r, n->count, sizeof *time);
    if (time == NULL)
        return;
    for (size_t i = 0; i < n->count; i++) {
        struct fault found = FAULT_NONE;
        if (yaml_real(&n->child[i], &time[i], &found) != STATUS_OK)
            case_read_merge(r, &found);
        else if (time[i] < 0 || (i > 0 && time[i] <= time[i - 1]))
            case_read_fault(r, &n->child[i], "%s: times are >= 0 and increase", n->key);
    }
    out->time = time;
    out->count = n->count;
}

static void read_samples(struct case_reader *r, const struct yaml_node *n,
                         struct case_samples *out) {
    *out = (struct case_samples){.node = n};
    if (n == NULL)
        return;
    if (n->kind == YAML_MAP)
        read_time_range(r, n, out);
    else if (n->kind == YAML_LIST && n->count > 0)
        read_time_list(r, n, out);
    else
        case_read_fault(r, n, "%s: must be a list of times or {from: , to: , every: }", n->key);
}

/* -- numbers by point ------------------------------------------------------------- */

static double read_number(struct case_reader *r, const struct yaml_node *n,
                          const struct schema_field *value) {
    struct fault found = FAULT_NONE;
    double number = 0;
    if (schema_check_value(n, value, &found) == STATUS_OK)
        yaml_real(n, &number, &found);
    case_read_merge(r, &found);
    return number;
}

static void read_rule(struct case_reader *r, const struct yaml_node *n,
                      const struct schema_field *value, struct case_rule *out) {
    const struct schema_field field[] = {{"points", SCHEMA_MAP, false, 0, 0, NULL}, *value};
    struct fault ignored = FAULT_NONE; /* the schema has told it */
    if (!case_read_fields(r, n, "rule", field, 2))
        return;
    yaml_real(yaml_get(n, value->key), &out->value, &ignored);
    case_read_filter(r, yaml_get(n, "points"), &out->points);
}

/* One number for all points, or a list of rules, whose numbers stand under the value's name. */
static void read_rules(struct case_reader *r, const struct yaml_node *n,
                       const struct schema_field *value, struct case_rules *out) {
    size_t count = n->kind == YAML_LIST ? n->count : 1;
    struct case_rule *rule = case_read_take(r, count, sizeof *rule);
    if (rule == NULL)
        return;
    if (n->kind != YAML_LIST)
        rule[0].value = read_number(r, n, value);
    for (size_t i = 0; n->kind == YAML_LIST && i < count; i++)
        read_rule(r, &n->child[i], value, &rule[i]);
    *out = (struct case_rules){.count = count, .rule = rule};
}

/* -- seeds ------------------------------------------------------------------------ */

/* `first` and `count` are overridden one by one. */
static void read_seeds(struct case_reader *r, const struct yaml_node *over,
                       struct case_seeds *out) {
    static const struct schema_field seeds = {"count", SCHEMA_INTEGER, true, 1, MAX_SEEDS, NULL};
    static const struct case_rule one = {.value = 1};
    static const struct schema_field field[] = {{"first", SCHEMA_INTEGER, false, 0, 1e15, NULL},
                                                {"count", SCHEMA_ANY, false, 0, 0, NULL}};
    const struct yaml_node *first = NULL, *count = NULL;
    const struct yaml_node *level[] = {get_map(r->runs, "seeds"), get_map(over, "seeds")};
    for (int i = 0; i < 2; i++) {
        if (level[i] == NULL)
            continue;
        case_read_fields(r, level[i], "choice of seeds", field, 2);
        first = has(level[i], "first") ? yaml_get(level[i], "first") : first;
        count = has(level[i], "count") ? yaml_get(level[i], "count") : count;
    }
    out->first = 1;
    struct fault ignored = FAULT_NONE; /* the schema has told it */
    if (first != NULL)
        yaml_integer(first, &out->first, &ignored);
    out->count = (struct case_rules){.count = 1, .rule = &one};
    if (count != NULL)
        read_rules(r, count, &seeds, &out->count);
}

static void read_start(struct case_reader *r, const struct yaml_node *n, struct case_start *out) {
    static const struct schema_field field[] = {{"case", SCHEMA_TEXT, true, 0, 0, NULL},
                                                {"point", SCHEMA_MAP, false, 0, 0, NULL}};
    if (n == NULL || n->kind != YAML_MAP || !case_read_fields(r, n, "start", field, 2))
        return;
    out->node = n;
    out->case_name = yaml_get(n, "case")->text;
    out->point = yaml_get(n, "point");
    if (!case_name_is_safe(out->case_name))
        case_read_fault(r, yaml_get(n, "case"), "case: %s is no name of a case", out->case_name);
    for (size_t i = 0; out->point != NULL && i < out->point->count; i++) {
        if (out->point->child[i].kind != YAML_SCALAR)
            case_read_fault(r, &out->point->child[i], "%s: must be one value",
                            out->point->child[i].key);
    }
}

/* Of wall clock, where the case says none: a busy machine may stop a run for long. */
static const double LEAST_LIMIT_S = 60;

static void read_limits(struct case_reader *r, const struct yaml_node *over, struct case_tier *t) {
    static const struct schema_field seconds = {"s", SCHEMA_REAL, true, 0.001, 1e6, NULL};
    struct fault ignored = FAULT_NONE; /* the schema has told it */
    const struct yaml_node *expect = get(r, over, "expect_s"), *limit = get(r, over, "limit_s");
    if (expect != NULL)
        read_rules(r, expect, &seconds, &t->expect_s);
    double most = case_rule_largest(&t->expect_s);
    if (yaml_get(over, "expect_s") != NULL)
        limit = yaml_get(over, "limit_s"); /* the case's limit was for its own expectation */
    t->limit_s = fmax(10 * most, LEAST_LIMIT_S);
    if (limit != NULL)
        yaml_real(limit, &t->limit_s, &ignored);
    if (t->limit_s < most)
        case_read_fault(r, limit, "limit_s: %g is less than expect_s, %g", t->limit_s, most);
}

/* Where the runs of the tier are described: here, or in the case that they are of. */
static const struct yaml_node *find_runs(struct case_reader *r, enum tier tier,
                                         const struct yaml_node *over) {
    const struct case_file *of = r->c->runs;
    if (of == NULL)
        return over;
    for (size_t i = 0; i < over->count; i++)
        if (strcmp(over->child[i].key, "checks") != 0)
            case_read_fault(r, &over->child[i], "%s: the runs are those of %s", over->child[i].key,
                            of->name);
    if (!of->tier[tier].present)
        case_read_fault(r, over, "%s: %s, whose runs it reads, has no such tier",
                        case_tier_name(tier), of->name);
    return of->tier[tier].present ? of->tier[tier].node : over;
}

void case_read_tier(struct case_reader *r, enum tier tier, const struct yaml_node *own) {
    struct case_tier *t = &r->c->tier[tier];
    case_read_fields(r, own, "tier", tier_fields, sizeof tier_fields / sizeof *tier_fields);
    const struct yaml_node *over = find_runs(r, tier, own);
    case_read_parameters(r, over, t);
    count_points(r, t);
    read_samples(r, get(r, over, "samples"), &t->samples);
    read_samples(r, get(r, over, "particle_samples"), &t->particle_samples);
    read_seeds(r, over, &t->seeds);
    read_start(r, get(r, over, "start"), &t->start);
    read_limits(r, over, t);
}
