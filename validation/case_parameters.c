/* case_parameters.c -- parameters and sweep of a tier: values, labels, readings.
 *
 * The case's fixed parameters that the tier leaves alone, then the tier's own; the same
 * for the sweep.  A parameter that a tier fixes is swept no more.  An axis that is a map
 * has labels, each of which stands for parameters of its own.  How they come together in
 * one point is told at case_point (case.h).
 */
#include "validation/case_read.h"

#include <string.h>

enum { MAX_NAMES = 256 };

static const struct yaml_node *get_map(const struct yaml_node *from, const char *key) {
    const struct yaml_node *n = yaml_get(from, key);
    return n != NULL && n->kind == YAML_MAP ? n : NULL;
}

/* The case's map and the tier's, either may be NULL. */
struct sources {
    const struct yaml_node *fixed[2], *swept[2];
};

/* Text that can stand in the name of a point; spaces within a label only. */
static bool can_name(const char *text, bool label) {
    size_t length = strlen(text);
    if (length == 0 || length > 100 || strpbrk(text, ",=;[]{}'\"\\#:") != NULL)
        return false;
    return strchr(text, ' ') == NULL || (label && text[0] != ' ' && text[length - 1] != ' ');
}

static void check_parameter(struct case_reader *r, const struct yaml_node *n) {
    if (!case_parameter_name_is_good(n->key))
        case_read_fault(r, n, "%s: not a name of a parameter", n->key);
    if (!case_value_is_good(n))
        case_read_fault(r, n, "%s: must be a value or a list of values", n->key);
}

static bool can_be_swept(const struct yaml_node *v, bool label) {
    if (v->kind == YAML_SCALAR)
        return case_value_is_good(v) && can_name(v->text, label);
    for (size_t i = 0; i < v->count; i++) {
        if (v->child[i].kind != YAML_SCALAR || !can_be_swept(&v->child[i], false))
            return false;
    }
    return v->kind == YAML_LIST;
}

static void check_list(struct case_reader *r, const struct yaml_node *n, bool labels) {
    for (size_t i = 0; i < n->count; i++) {
        const struct yaml_node *v = &n->child[i];
        if (!can_be_swept(v, labels))
            case_read_fault(r, v, "%s: not a value that can be swept", n->key);
        for (size_t j = 0; j < i && v->kind == YAML_SCALAR; j++) {
            if (n->child[j].kind == YAML_SCALAR && case_value_equal(v->text, n->child[j].text))
                case_read_fault(r, v, "%s: %s stands twice in the sweep", n->key, v->text);
        }
    }
}

static void check_labels(struct case_reader *r, const struct yaml_node *n) {
    for (size_t i = 0; i < n->count; i++) {
        const struct yaml_node *label = &n->child[i];
        if (!can_name(label->key, true))
            case_read_fault(r, label,
                            "%s: '%s' is no label: text without , = : ; # quotes and brackets",
                            n->key, label->key);
        for (size_t j = 0; j < i; j++) {
            if (case_value_equal(label->key, n->child[j].key))
                case_read_fault(r, label, "%s: the same label as %s", label->key, n->child[j].key);
        }
        if (label->kind != YAML_MAP) {
            case_read_fault(r, label, "%s: a label is a map of parameters, as {phibar: 0.3}",
                            label->key);
            continue;
        }
        for (size_t k = 0; k < label->count; k++) {
            check_parameter(r, &label->child[k]);
            if (strcmp(label->child[k].key, n->key) == 0)
                case_read_fault(r, &label->child[k], "%s: is the name of the axis itself", n->key);
        }
    }
}

/* labelled: the case sweeps it by labels, of which a list chooses. */
static void check_axis(struct case_reader *r, const struct yaml_node *n, bool labelled) {
    if (!case_parameter_name_is_good(n->key))
        case_read_fault(r, n, "%s: not a name of a parameter", n->key);
    if (n->kind == YAML_SCALAR || n->count == 0)
        case_read_fault(r, n, "%s: a sweep needs a list of values or a map of labels", n->key);
    else if (n->kind == YAML_LIST)
        check_list(r, n, labelled);
    else if (strcmp(n->key, "reading") == 0)
        case_read_fault(r, n, "reading: a list of readings; they stand in %s/readings/%s.yaml",
                        r->folder, r->c->model == NULL ? "MODEL" : r->c->model);
    else
        check_labels(r, n);
}

static bool has(const struct yaml_node *map, const char *key) {
    return map != NULL && yaml_get(map, key) != NULL;
}

static void refuse_both(struct case_reader *r, const struct yaml_node *fixed,
                        const struct yaml_node *swept) {
    for (size_t i = 0; fixed != NULL && swept != NULL && i < fixed->count; i++) {
        if (yaml_get(swept, fixed->child[i].key) != NULL)
            case_read_fault(r, &fixed->child[i], "%s: is fixed and swept at once",
                            fixed->child[i].key);
    }
}

/* -- labels ----------------------------------------------------------------------- */

static void unknown_label(struct case_reader *r, const struct yaml_node *n, const char *text,
                          const struct yaml_node *labels) {
    const char *names[MAX_NAMES];
    size_t count = labels->count < MAX_NAMES ? labels->count : MAX_NAMES;
    for (size_t i = 0; i < count; i++)
        names[i] = labels->child[i].key;
    case_read_unknown(r, n, "label of this axis", text, names, count);
}

/* The labels of a map as a list of values, each of the place where its label stands. */
static const struct yaml_node *list_labels(struct case_reader *r, const struct yaml_node *map) {
    struct yaml_node *list = case_read_take(r, 1, sizeof *list);
    struct yaml_node *value = case_read_take(r, map->count, sizeof *value);
    if (list == NULL || value == NULL)
        return NULL;
    for (size_t i = 0; i < map->count; i++) {
        const struct yaml_node *label = &map->child[i];
        value[i] = (struct yaml_node){.kind = YAML_SCALAR,
                                      .file = label->file,
                                      .line = label->key_line,
                                      .column = label->key_column,
                                      .text = label->key};
    }
    *list = *map;
    list->kind = YAML_LIST;
    list->child = value;
    return list;
}

static bool are_maps(const struct yaml_node *labels) {
    for (size_t i = 0; i < labels->count; i++) {
        if (labels->child[i].kind != YAML_MAP)
            return false; /* told by check_labels */
    }
    return true;
}

/* An axis from the case's node, the tier's, or both (either may be NULL). */
static bool make_axis(struct case_reader *r, const struct yaml_node *base,
                      const struct yaml_node *over, struct case_axis *out) {
    const struct yaml_node *n = over != NULL ? over : base;
    *out = (struct case_axis){.name = n->key, .list = n};
    if (n->kind == YAML_SCALAR || n->count == 0)
        return false; /* told by check_axis */
    if (n->kind == YAML_MAP) {
        if (base != NULL && base->kind == YAML_LIST)
            case_read_fault(r, n, "%s: has values in the case and labels in the tier", n->key);
        out->labels = n;
        out->list = list_labels(r, n);
        return out->list != NULL && are_maps(n);
    }
    if (over == NULL || base == NULL || base->kind != YAML_MAP)
        return true;
    out->labels = base;
    for (size_t i = 0; i < n->count; i++) {
        const struct yaml_node *v = &n->child[i];
        if (v->kind == YAML_SCALAR && case_label_find(base, v->text) != NULL)
            continue;
        unknown_label(r, v, v->kind == YAML_SCALAR ? v->text : "?", base);
        return false;
    }
    return are_maps(base);
}

/* A fixed parameter; one that the case sweeps by labels is one of these. */
static struct case_parameter make_parameter(struct case_reader *r, const struct yaml_node *n,
                                            const struct yaml_node *swept) {
    struct case_parameter p = {.name = n->key, .value = n, .label = strcmp(n->key, "reading") == 0};
    const struct yaml_node *labels = get_map(swept, n->key);
    if (labels == NULL)
        return p;
    p.label = true;
    p.sets = n->kind == YAML_SCALAR ? case_label_find(labels, n->text) : NULL;
    if (!are_maps(labels))
        p.sets = NULL;
    else if (p.sets == NULL)
        unknown_label(r, n, n->kind == YAML_SCALAR ? n->text : "?", labels);
    return p;
}

/* -- the tier --------------------------------------------------------------------- */

static void take_fixed(struct case_reader *r, const struct sources *s, int level,
                       struct case_parameter *out, struct case_tier *t) {
    const struct yaml_node *map = s->fixed[level];
    for (size_t i = 0; map != NULL && i < map->count; i++) {
        const struct yaml_node *n = &map->child[i];
        check_parameter(r, n);
        if (level == 1 || (!has(s->fixed[1], n->key) && !has(s->swept[1], n->key)))
            out[t->parameter_count++] = make_parameter(r, n, level == 1 ? s->swept[0] : NULL);
    }
}

static void take_swept(struct case_reader *r, const struct sources *s, int level,
                       struct case_axis *out, struct case_tier *t) {
    const struct yaml_node *map = s->swept[level];
    for (size_t i = 0; map != NULL && i < map->count; i++) {
        const struct yaml_node *n = &map->child[i];
        check_axis(r, n, level == 1 && get_map(s->swept[0], n->key) != NULL);
        if (level == 0 && has(s->fixed[1], n->key))
            continue;
        if (level == 1 && has(s->swept[0], n->key))
            continue; /* stands in the case's place, above */
        const struct yaml_node *over = level == 1 ? n : yaml_get(s->swept[1], n->key);
        t->axis_count += make_axis(r, level == 0 ? n : NULL, over, &out[t->axis_count]);
    }
}

/* Does a label of this owner, a fixed parameter or else an axis, set the name? */
static bool owner_sets(const struct case_tier *t, size_t owner, const char *name) {
    if (owner < t->parameter_count)
        return has(t->parameter[owner].sets, name);
    const struct yaml_node *labels = t->axis[owner - t->parameter_count].labels;
    for (size_t i = 0; labels != NULL && i < labels->count; i++) {
        if (has(&labels->child[i], name))
            return true;
    }
    return false;
}

static const char *owner_name(const struct case_tier *t, size_t owner) {
    return owner < t->parameter_count ? t->parameter[owner].name
                                      : t->axis[owner - t->parameter_count].name;
}

/* What the label of an owner sets must be neither swept nor set by another's labels. */
static void check_label(struct case_reader *r, const struct case_tier *t, size_t owner,
                        const struct yaml_node *sets) {
    for (size_t i = 0; i < sets->count; i++) {
        const struct yaml_node *n = &sets->child[i];
        for (size_t k = 0; k < t->axis_count; k++) {
            if (strcmp(t->axis[k].name, n->key) == 0)
                case_read_fault(r, n, "%s: is swept, and set by a label of %s", n->key,
                                owner_name(t, owner));
        }
        for (size_t other = owner + 1; other < t->parameter_count + t->axis_count; other++) {
            if (owner_sets(t, other, n->key))
                case_read_fault(r, n, "%s: is set by labels of %s and of %s", n->key,
                                owner_name(t, owner), owner_name(t, other));
        }
    }
}

/* A parameter that no label would leave in force is a mistake. */
static void check_in_force(struct case_reader *r, const struct sources *s,
                           const struct case_tier *t) {
    for (size_t i = 0; i < t->parameter_count; i++) {
        const struct case_parameter *p = &t->parameter[i];
        size_t axis = case_axis_of(t, p->name);
        if (axis < t->axis_count &&
            (has(s->fixed[1], p->name) || !has(s->swept[1], t->axis[axis].name)))
            case_read_fault(r, p->value, "%s: every label of %s sets it", p->name,
                            t->axis[axis].name);
    }
}

static void check_all_labels(struct case_reader *r, const struct sources *s,
                             const struct case_tier *t) {
    for (size_t i = 0; i < t->parameter_count; i++) {
        if (t->parameter[i].sets != NULL)
            check_label(r, t, i, t->parameter[i].sets);
    }
    for (size_t i = 0; i < t->axis_count; i++) {
        const struct yaml_node *labels = t->axis[i].labels;
        for (size_t k = 0; labels != NULL && k < labels->count; k++)
            check_label(r, t, t->parameter_count + i, &labels->child[k]);
    }
    check_in_force(r, s, t);
}

/* -- readings --------------------------------------------------------------------- */

static struct readings *load_readings(struct case_reader *r, const struct yaml_node *n) {
    struct case_file *c = r->c->runs != NULL ? r->c->runs : r->c;
    struct fault found = FAULT_NONE;
    if (c->readings != NULL || c->model == NULL)
        return c->readings;
    enum status status = readings_load(r->folder, c->model, &c->readings, &found);
    if (status == STATUS_NOT_FOUND)
        case_read_fault(r, n, "reading: %s has none: there is no %s/readings/%s.yaml", c->model,
                        r->folder, c->model);
    else
        case_read_merge(r, &found);
    return c->readings;
}

/* `reading: NAME`, wherever it stands. */
static void use_reading(struct case_reader *r, const struct yaml_node *n, struct case_tier *t) {
    const struct readings *all = t->readings = load_readings(r, n);
    if (all == NULL)
        return;
    if (n->kind == YAML_SCALAR && readings_parameters(all, n->text) != NULL)
        return;
    const struct yaml_node *map = readings_all(all);
    const char *names[MAX_NAMES];
    size_t count = map->count < MAX_NAMES ? map->count : MAX_NAMES;
    for (size_t i = 0; i < count; i++)
        names[i] = map->child[i].key;
    case_read_unknown(r, n, "reading", n->kind == YAML_SCALAR ? n->text : "a list", names, count);
}

static void use_readings(struct case_reader *r, struct case_tier *t) {
    for (size_t i = 0; i < t->parameter_count; i++) {
        const struct case_parameter *p = &t->parameter[i];
        const struct yaml_node *set = yaml_get(p->sets, "reading");
        if (strcmp(p->name, "reading") == 0)
            use_reading(r, p->value, t);
        if (set != NULL)
            use_reading(r, set, t);
    }
    for (size_t i = 0; i < t->axis_count; i++) {
        const struct case_axis *a = &t->axis[i];
        for (size_t k = 0; strcmp(a->name, "reading") == 0 && k < a->list->count; k++)
            use_reading(r, &a->list->child[k], t);
        for (size_t k = 0; a->labels != NULL && k < a->labels->count; k++) {
            const struct yaml_node *set = yaml_get(&a->labels->child[k], "reading");
            if (set != NULL)
                use_reading(r, set, t);
        }
    }
}

/* No point can have more parameters than this. */
static size_t find_room(const struct case_tier *t) {
    size_t room = t->parameter_count + t->axis_count, most = 0;
    for (size_t i = 0; i < t->parameter_count; i++)
        room += t->parameter[i].sets == NULL ? 0 : t->parameter[i].sets->count;
    for (size_t i = 0; i < t->axis_count; i++) {
        const struct yaml_node *labels = t->axis[i].labels;
        size_t widest = 0;
        for (size_t k = 0; labels != NULL && k < labels->count; k++)
            widest = labels->child[k].count > widest ? labels->child[k].count : widest;
        room += widest;
    }
    const struct yaml_node *all = t->readings == NULL ? NULL : readings_all(t->readings);
    for (size_t i = 0; all != NULL && i < all->count; i++) {
        const struct yaml_node *sets = yaml_get(&all->child[i], "parameters");
        most = sets->count > most ? sets->count : most;
    }
    return room + most;
}

void case_read_parameters(struct case_reader *r, const struct yaml_node *over,
                          struct case_tier *t) {
    struct sources s = {{get_map(r->runs, "parameters"), get_map(over, "parameters")},
                        {get_map(r->runs, "sweep"), get_map(over, "sweep")}};
    size_t room = 0;
    for (int level = 0; level < 2; level++) {
        refuse_both(r, s.fixed[level], s.swept[level]);
        room += s.fixed[level] == NULL ? 0 : s.fixed[level]->count;
        room += s.swept[level] == NULL ? 0 : s.swept[level]->count;
    }
    struct case_parameter *parameter = case_read_take(r, room, sizeof *parameter);
    struct case_axis *axis = case_read_take(r, room, sizeof *axis);
    if (parameter == NULL || axis == NULL)
        return;
    t->parameter = parameter;
    t->axis = axis;
    for (int level = 0; level < 2; level++) {
        take_fixed(r, &s, level, parameter, t);
        take_swept(r, &s, level, axis, t);
    }
    check_all_labels(r, &s, t);
    use_readings(r, t);
    t->room = find_room(t);
}
