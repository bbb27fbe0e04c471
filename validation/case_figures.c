/* case_figures.c -- figures of a case: recipe, what it draws, whose runs, its settings.
 *
 * A recipe declares its settings; a key that it does not know, a number out of range, a curve
 * that the observable does not give, and points or tiers that do not exist are faults of the file.
 */
#include "validation/case_read.h"

#include "validation/figures.h"

#include <stdio.h>
#include <string.h>

enum { MAX_NAMES = 256, COMMON = 6 };

static const struct schema_field common_field[COMMON] = {
    {"recipe", SCHEMA_TEXT, true, 0, 0, NULL}, {"of", SCHEMA_ANY, false, 0, 0, NULL},
    {"points", SCHEMA_MAP, false, 0, 0, NULL}, {"tiers", SCHEMA_LIST, false, 0, 0, NULL},
    {"title", SCHEMA_TEXT, false, 0, 0, NULL}, {"caption", SCHEMA_TEXT, false, 0, 0, NULL}};

static void read_drawn(struct case_reader *r, const struct yaml_node *of, struct case_figure *f) {
    size_t count = of == NULL ? 0 : of->kind == YAML_LIST ? of->count : 1;
    size_t *index = case_read_take(r, count, sizeof *index);
    if (index == NULL)
        return;
    f->observable = index;
    for (size_t i = 0; i < count; i++) {
        const struct yaml_node *n = of->kind == YAML_LIST ? &of->child[i] : of;
        const char *names[MAX_NAMES];
        size_t k = 0,
               known = r->c->observable_count < MAX_NAMES ? r->c->observable_count : MAX_NAMES;
        for (size_t j = 0; j < known; j++)
            names[j] = r->c->observable[j].name;
        while (n->kind == YAML_SCALAR && k < known && strcmp(names[k], n->text) != 0)
            k++;
        if (n->kind != YAML_SCALAR || k == known) {
            case_read_unknown(r, n, "observable of this case",
                              n->kind == YAML_SCALAR ? n->text : "?", names, known);
            continue;
        }
        r->observable_used[k] = true;
        index[f->observable_count++] = k;
    }
}

static const struct figure_recipe *find_recipe(struct case_reader *r, const struct yaml_node *n) {
    size_t count;
    const struct figure_recipe *const *all = figure_all(&count);
    const struct yaml_node *recipe = yaml_get(n, "recipe");
    if (recipe == NULL || recipe->kind != YAML_SCALAR) {
        case_read_fault(r, n, "figure: recipe: missing");
        return NULL;
    }
    const struct figure_recipe *found = figure_find(recipe->text);
    if (found != NULL)
        return found;
    const char *name[MAX_NAMES];
    for (size_t i = 0; i < count && i < MAX_NAMES; i++)
        name[i] = all[i]->name;
    case_read_unknown(r, recipe, "figure", recipe->text, name,
                      count < MAX_NAMES ? count : MAX_NAMES);
    return NULL;
}

/* -- settings --------------------------------------------------------------- */

static struct schema_field field_of(const struct figure_setting *s) {
    static const enum schema_type type[] = {[FIGURE_NUMBER] = SCHEMA_REAL,
                                            [FIGURE_NUMBERS] = SCHEMA_REAL_LIST,
                                            [FIGURE_TEXT] = SCHEMA_TEXT,
                                            [FIGURE_CURVE] = SCHEMA_TEXT};
    return (struct schema_field){s->name, type[s->kind], s->required, s->min, s->max, NULL};
}

static void read_numbers(struct case_reader *r, const struct yaml_node *n,
                         struct case_figure_setting *out) {
    double *number = case_read_take(r, n->count, sizeof *number);
    if (number == NULL)
        return;
    if (n->count == 0)
        case_read_fault(r, n, "%s: an empty list", n->key);
    for (size_t i = 0; i < n->count; i++) {
        struct fault told = FAULT_NONE; /* by the fields */
        yaml_real(&n->child[i], &number[i], &told);
        if (i > 0 && number[i] <= number[i - 1])
            case_read_fault(r, &n->child[i], "%s: numbers must increase", n->key);
    }
    out->numbers = number;
    out->count = n->count;
}

static void check_curve(struct case_reader *r, const struct yaml_node *n,
                        const struct case_figure *f) {
    const struct recipe *recipe =
        f->observable_count > 0 ? r->c->observable[f->observable[0]].recipe : NULL;
    if (yaml_get(f->node, "of") == NULL)
        case_read_fault(r, n, "%s: a curve of which observable? name it with `of`", n->key);
    const char *names[RECIPE_MAX_CURVES];
    size_t count = 0;
    if (recipe == NULL)
        return; /* told elsewhere */
    for (; recipe->curves != NULL && count < RECIPE_MAX_CURVES && recipe->curves[count] != NULL;
         count++) {
        names[count] = recipe->curves[count];
        if (strcmp(names[count], n->text) == 0)
            return;
    }
    char what[160];
    snprintf(what, sizeof what, "curve of %s", recipe->name);
    case_read_unknown(r, n, what, n->text, names, count);
}

static void read_settings(struct case_reader *r, const struct yaml_node *n,
                          const struct figure_recipe *recipe, struct case_figure *f) {
    for (size_t i = 0; i < CASE_FIGURE_SETTINGS && recipe->setting[i].name != NULL; i++) {
        const struct figure_setting *s = &recipe->setting[i];
        const struct yaml_node *value = yaml_get(n, s->name);
        struct case_figure_setting *out = &f->setting[i];
        struct fault told = FAULT_NONE; /* by the fields */
        *out = (struct case_figure_setting){.given = value != NULL, .number = s->standard};
        if (value == NULL)
            continue;
        if (s->kind == FIGURE_NUMBER)
            yaml_real(value, &out->number, &told);
        else if (s->kind == FIGURE_NUMBERS)
            read_numbers(r, value, out);
        else
            out->text = value->text;
        if (s->kind == FIGURE_CURVE)
            check_curve(r, value, f);
    }
}

/* -- figures ---------------------------------------------------------------- */

static const char *text_of(const struct yaml_node *n, const char *key) {
    const struct yaml_node *value = yaml_get(n, key);
    return value == NULL ? NULL : value->text;
}

static bool read_figure(struct case_reader *r, const struct yaml_node *n, struct case_figure *f) {
    struct schema_field field[COMMON + CASE_FIGURE_SETTINGS];
    size_t count = COMMON;
    const struct figure_recipe *recipe = find_recipe(r, n);
    if (recipe == NULL)
        return false;
    memcpy(field, common_field, sizeof common_field);
    for (size_t i = 0; i < CASE_FIGURE_SETTINGS && recipe->setting[i].name != NULL; i++)
        field[count++] = field_of(&recipe->setting[i]);
    if (!case_read_fields(r, n, "figure", field, count))
        return false;
    f->node = n;
    f->recipe = recipe->name;
    f->title = text_of(n, "title");
    f->caption = text_of(n, "caption");
    case_read_filter(r, yaml_get(n, "points"), &f->points);
    case_read_tiers(r, yaml_get(n, "tiers"));
    if (yaml_get(n, "tiers") != NULL && yaml_get(n, "tiers")->count == 0)
        case_read_fault(r, yaml_get(n, "tiers"), "figure %s: is in no tier", f->recipe);
    for (enum tier t = 0; t < TIER_COUNT; t++)
        f->in_tier[t] = case_read_in_tier(n, t);
    read_drawn(r, yaml_get(n, "of"), f);
    if (recipe->observables != f->observable_count && !(recipe->optional && !f->observable_count))
        case_read_fault(r, n, "figure %s: `of` must name %zu observables, not %zu", f->recipe,
                        recipe->observables, f->observable_count);
    read_settings(r, n, recipe, f);
    return true;
}

void case_read_figures(struct case_reader *r) {
    const struct yaml_node *list = yaml_get(r->root, "figures");
    if (list == NULL || list->kind != YAML_LIST)
        return;
    struct case_figure *figure = case_read_take(r, list->count, sizeof *figure);
    if (figure == NULL)
        return;
    for (size_t i = 0; i < list->count; i++) {
        const struct yaml_node *n = &list->child[i];
        if (n->kind != YAML_MAP)
            case_read_fault(r, n, "figures: must be {recipe: NAME, of: OBSERVABLE}");
        else if (read_figure(r, n, &figure[r->c->figure_count]))
            r->c->figure_count++;
    }
    r->c->figure = figure;
}
