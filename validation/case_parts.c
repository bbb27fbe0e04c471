/* case_parts.c -- what a case's tiers share: observables, across, tags. */
#include "validation/case_read.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_NAMES = 256 };

static bool is_identifier(const char *name) {
    return strchr(name, '/') == NULL && case_name_is_safe(name);
}

static void check_own_name(struct case_reader *r, const struct yaml_node *n, const char *what) {
    if (!is_identifier(n->key))
        case_read_fault(r, n, "%s %s: a name has lower-case letters, digits, - and _", what,
                        n->key);
}

static void read_settings(struct case_reader *r, const struct yaml_node *n,
                          struct case_observable *o) {
    struct schema_field field[RECIPE_MAX_SETTINGS + 1] = {
        {"recipe", SCHEMA_TEXT, true, 0, 0, NULL}};
    size_t count = 1;
    for (size_t i = 0; i < RECIPE_MAX_SETTINGS && o->recipe->setting[i].name != NULL; i++) {
        const struct recipe_setting *s = &o->recipe->setting[i];
        field[count++] =
            (struct schema_field){s->name, SCHEMA_REAL, isnan(s->standard), s->min, s->max, NULL};
        o->setting[i] = s->standard;
    }
    if (!case_read_fields(r, n, o->recipe->name, field, count))
        return;
    for (size_t i = 0; i + 1 < count; i++) {
        const struct yaml_node *value = yaml_get(n, field[i + 1].key);
        if (value != NULL)
            yaml_real(value, &o->setting[i], r->fault);
    }
}

static void read_observable(struct case_reader *r, const struct yaml_node *n,
                            struct case_observable *o) {
    o->name = n->key;
    o->node = n;
    check_own_name(r, n, "observable");
    const struct yaml_node *recipe = n->kind == YAML_MAP ? yaml_get(n, "recipe") : NULL;
    if (recipe == NULL || recipe->kind != YAML_SCALAR) {
        case_read_fault(r, n, "observable %s: must be {recipe: NAME, ...}", n->key);
        return;
    }
    o->recipe = recipe_find(recipe->text);
    if (o->recipe != NULL) {
        read_settings(r, n, o);
        return;
    }
    size_t count;
    const struct recipe *const *all = recipe_all(&count);
    const char *name[MAX_NAMES];
    for (size_t i = 0; i < count && i < MAX_NAMES; i++)
        name[i] = all[i]->name;
    case_read_unknown(r, recipe, "recipe", recipe->text, name,
                      count < MAX_NAMES ? count : MAX_NAMES);
}

static void read_observables(struct case_reader *r) {
    const struct yaml_node *n = yaml_get(r->root, "observables");
    if (n == NULL || n->kind != YAML_MAP)
        return;
    struct case_observable *list = case_read_take(r, n->count, sizeof *list);
    r->observable_used = case_read_take(r, n->count, sizeof *r->observable_used);
    if (list == NULL || r->observable_used == NULL)
        return;
    r->c->observable = list;
    r->c->observable_count = n->count;
    for (size_t i = 0; i < n->count; i++)
        read_observable(r, &n->child[i], &list[i]);
}

/* Index of the output called `name` in a NULL-terminated list, or the count. */
static size_t find_output(const char *const *names, size_t count, const char *name) {
    size_t i = 0;
    while (i < count && strcmp(names[i], name) != 0)
        i++;
    return i;
}

static bool number_of(struct case_reader *r, const struct yaml_node *n, const char *owner,
                      const char *output, const char *const *names, size_t count,
                      struct case_number *out) {
    out->output = find_output(names, count, output);
    if (out->output < count)
        return true;
    char what[160];
    snprintf(what, sizeof what, "output of %s", owner);
    case_read_unknown(r, n, what, output, names, count);
    return false;
}

static bool number_of_observable(struct case_reader *r, const struct yaml_node *n, size_t index,
                                 const char *output, struct case_number *out) {
    const struct case_observable *o = &r->c->observable[index];
    const char *names[RECIPE_MAX_OUTPUTS];
    size_t count = 0;
    *out = (struct case_number){.across = false, .index = index};
    r->observable_used[index] = true;
    if (o->recipe == NULL)
        return false; /* told where the observable is declared */
    while (count < RECIPE_MAX_OUTPUTS && o->recipe->output[count].name != NULL) {
        names[count] = o->recipe->output[count].name;
        count++;
    }
    return number_of(r, n, o->name, output, names, count, out);
}

static bool number_of_across(struct case_reader *r, const struct yaml_node *n, size_t index,
                             const char *output, struct case_number *out) {
    const struct case_across *a = &r->c->across[index];
    size_t count = 0;
    *out = (struct case_number){.across = true, .index = index};
    r->across_used[index] = true;
    const char *names[ENSEMBLE_MAX_OUTPUTS];
    if (a->ensemble != NULL) {
        for (; count < ENSEMBLE_MAX_OUTPUTS && a->ensemble->output[count].name != NULL; count++)
            names[count] = a->ensemble->output[count].name;
        return number_of(r, n, a->name, output, names, count, out);
    }
    if (a->fit == NULL)
        return false;
    while (count < ACROSS_MAX_OUTPUTS && a->fit->output[count] != NULL)
        count++;
    return number_of(r, n, a->name, output, a->fit->output, count, out);
}

bool case_read_number(struct case_reader *r, const struct yaml_node *n, struct case_number *out) {
    const char *dot = n->kind == YAML_SCALAR ? strchr(n->text, '.') : NULL;
    if (dot == NULL) {
        case_read_fault(r, n, "must be OBSERVABLE.OUTPUT, as settling.speed");
        return false;
    }
    const char *names[MAX_NAMES];
    size_t count = 0, length = (size_t)(dot - n->text);
    for (size_t i = 0; i < r->c->observable_count && count < MAX_NAMES; i++) {
        names[count++] = r->c->observable[i].name;
        if (strlen(names[count - 1]) == length && strncmp(names[count - 1], n->text, length) == 0)
            return number_of_observable(r, n, i, dot + 1, out);
    }
    for (size_t i = 0; i < r->c->across_count && count < MAX_NAMES; i++) {
        names[count++] = r->c->across[i].name;
        if (strlen(names[count - 1]) == length && strncmp(names[count - 1], n->text, length) == 0)
            return number_of_across(r, n, i, dot + 1, out);
    }
    char owner[128];
    snprintf(owner, sizeof owner, "%.*s", (int)length, n->text);
    case_read_unknown(r, n, "observable of this case", owner, names, count);
    return false;
}

const char *case_read_unit(const struct case_reader *r, const struct case_number *n) {
    const struct ensemble *e = n->across ? r->c->across[n->index].ensemble : NULL;
    if (n->across)
        return e == NULL ? "1" : e->output[n->output].unit; /* a fit over a sweep tells no units */
    const struct recipe *recipe = r->c->observable[n->index].recipe;
    return recipe == NULL ? "1" : recipe->output[n->output].unit;
}

static void find_fit(struct case_reader *r, const struct yaml_node *n, struct case_across *a) {
    a->fit = across_find(n->text);
    if (a->fit != NULL)
        return;
    if (ensemble_find(n->text) != NULL) {
        case_read_fault(r, n, "fit: %s is a fit over seeds: along: seeds", n->text);
        return;
    }
    size_t count;
    const struct across *const *all = across_all(&count);
    const char *name[MAX_NAMES];
    for (size_t i = 0; i < count && i < MAX_NAMES; i++)
        name[i] = all[i]->name;
    case_read_unknown(r, n, "fit", n->text, name, count < MAX_NAMES ? count : MAX_NAMES);
}

/* -- fits over seeds ---------------------------------------------------------------- */

static void find_ensemble(struct case_reader *r, const struct yaml_node *n, struct case_across *a) {
    a->ensemble = ensemble_find(n->text);
    if (a->ensemble != NULL)
        return;
    if (across_find(n->text) != NULL) {
        case_read_fault(r, n, "fit: %s goes along a swept parameter, not along seeds", n->text);
        return;
    }
    size_t count;
    const struct ensemble *const *all = ensemble_all(&count);
    const char *name[MAX_NAMES];
    for (size_t i = 0; i < count && i < MAX_NAMES; i++)
        name[i] = all[i]->name;
    case_read_unknown(r, n, "fit over seeds", n->text, name, count < MAX_NAMES ? count : MAX_NAMES);
}

static bool gives_curve(const struct recipe *recipe, const char *name) {
    for (size_t i = 0; recipe->curves != NULL && recipe->curves[i] != NULL; i++) {
        if (strcmp(recipe->curves[i], name) == 0)
            return true;
    }
    return false;
}

/* Does the observable hold what the fit reads? */
static void check_ensemble(struct case_reader *r, const struct yaml_node *n,
                           const struct case_across *a) {
    const struct case_observable *o = &r->c->observable[a->of.index];
    const struct ensemble *e = a->ensemble;
    if (e == NULL || o->recipe == NULL)
        return; /* told elsewhere */
    if (e->recipe != NULL && strcmp(e->recipe, o->recipe->name) != 0) {
        case_read_fault(r, n, "of: %s fits %s, and %s is of recipe %s", e->name, e->recipe, o->name,
                        o->recipe->name);
        return;
    }
    if (o->recipe->curves == NULL || o->recipe->curves[0] == NULL)
        case_read_fault(r, n, "of: %s fits curves, and %s gives none", e->name, o->recipe->name);
    for (size_t i = 0; e->curves != NULL && e->curves[i] != NULL; i++) {
        if (!gives_curve(o->recipe, e->curves[i]))
            case_read_fault(r, n, "of: %s needs the curve %s, which %s does not give", e->name,
                            e->curves[i], o->recipe->name);
    }
}

static void read_ensemble(struct case_reader *r, const struct yaml_node *n, struct case_across *a) {
    const struct yaml_node *of = yaml_get(n, "of");
    const char *names[MAX_NAMES];
    size_t count = 0;
    find_ensemble(r, yaml_get(n, "fit"), a);
    if (yaml_get(n, "exact") != NULL)
        case_read_fault(r, yaml_get(n, "exact"), "exact: a fit over seeds finds its own scatter");
    for (size_t i = 0; i < r->c->observable_count && count < MAX_NAMES; i++) {
        names[count++] = r->c->observable[i].name;
        if (strcmp(of->text, r->c->observable[i].name) != 0)
            continue;
        r->observable_used[i] = true;
        a->of = (struct case_number){.index = i};
        check_ensemble(r, of, a);
        return;
    }
    a->ensemble = NULL;
    if (strchr(of->text, '.') != NULL)
        case_read_fault(r, of, "of: a fit over seeds is of an observable, without an output");
    else
        case_read_unknown(r, of, "observable of this case", of->text, names, count);
}

/* What a fit over a sweep is of: an observable, or a fit over seeds that stands above. */
static void read_of(struct case_reader *r, const struct yaml_node *n, struct case_across *a) {
    if (case_read_number(r, n, &a->of) && a->of.across &&
        r->c->across[a->of.index].ensemble == NULL) {
        case_read_fault(r, n,
                        "of: %s is a fit over a sweep; a fit is made of observables or of "
                        "fits over seeds",
                        r->c->across[a->of.index].name);
        a->fit = NULL;
    }
}

static void read_across(struct case_reader *r, const struct yaml_node *n, struct case_across *a) {
    static const struct schema_field field[] = {{"fit", SCHEMA_TEXT, true, 0, 0, NULL},
                                                {"of", SCHEMA_TEXT, true, 0, 0, NULL},
                                                {"along", SCHEMA_TEXT, true, 0, 0, NULL},
                                                {"points", SCHEMA_MAP, false, 0, 0, NULL},
                                                {"exact", SCHEMA_BOOLEAN, false, 0, 0, NULL}};
    a->name = n->key;
    a->node = n;
    check_own_name(r, n, "across");
    if (n->kind != YAML_MAP) {
        case_read_fault(r, n,
                        "across %s: must be {fit: NAME, of: OBSERVABLE.OUTPUT, along: "
                        "PARAMETER}",
                        n->key);
        return;
    }
    for (size_t i = 0; i < r->c->observable_count; i++) {
        if (strcmp(r->c->observable[i].name, n->key) == 0)
            case_read_fault(r, n, "across %s: an observable has this name", n->key);
    }
    if (!case_read_fields(r, n, "across", field, sizeof field / sizeof *field))
        return;
    a->along = yaml_get(n, "along")->text;
    case_read_filter(r, yaml_get(n, "points"), &a->points);
    if (strcmp(a->along, "seeds") == 0) {
        read_ensemble(r, n, a);
        return;
    }
    find_fit(r, yaml_get(n, "fit"), a);
    if (yaml_get(n, "exact") != NULL)
        yaml_boolean(yaml_get(n, "exact"), &a->exact, r->fault);
    read_of(r, yaml_get(n, "of"), a);
}

static void read_all_across(struct case_reader *r) {
    const struct yaml_node *n = yaml_get(r->root, "across");
    if (n == NULL || n->kind != YAML_MAP)
        return;
    struct case_across *list = case_read_take(r, n->count, sizeof *list);
    r->across_used = case_read_take(r, n->count, sizeof *r->across_used);
    if (list == NULL || r->across_used == NULL)
        return;
    r->c->across = list;
    for (size_t i = 0; i < n->count; i++) {
        read_across(r, &n->child[i], &list[i]);
        r->c->across_count = i + 1; /* those above can be named, not itself */
    }
}

static void read_tags(struct case_reader *r) {
    const struct yaml_node *list = yaml_get(r->root, "tags");
    if (list == NULL || list->kind != YAML_LIST)
        return;
    const char **tag = case_read_take(r, list->count, sizeof *tag);
    for (size_t i = 0; tag != NULL && i < list->count; i++) {
        const struct yaml_node *n = &list->child[i];
        if (n->kind != YAML_SCALAR || !is_identifier(n->text))
            case_read_fault(r, n, "tags: a tag has lower-case letters, digits, - and _");
        else
            tag[r->c->tag_count++] = n->text;
    }
    r->c->tag = tag;
}

void case_read_parts(struct case_reader *r) {
    read_tags(r);
    read_observables(r);
    read_all_across(r);
    case_read_figures(r);
}
