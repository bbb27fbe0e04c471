#include "validation/case.h"

#include <stdlib.h>
#include <string.h>

const char *case_tier_name(enum tier t) {
    static const char *const name[] = {"smoke", "paper", "large"};
    return name[t];
}

enum status case_tier_find(const char *name, enum tier *out, struct fault *fault) {
    for (enum tier t = 0; t < TIER_COUNT; t++) {
        if (strcmp(name, case_tier_name(t)) == 0) {
            *out = t;
            return STATUS_OK;
        }
    }
    return fault_set(fault, STATUS_BAD_INPUT,
                     "tier %s: no such tier; there are smoke, paper, large", name);
}

const char *case_comparison_name(enum comparison c) {
    static const char *const name[] = {"within", "outside", "at most", "at least"};
    return name[c];
}

const char *case_kind_name(enum check_kind k) {
    static const char *const name[] = {"round-off", "order", "model", "regression"};
    return name[k];
}

bool case_name_is_safe(const char *name) {
    bool inside = false; /* a part has begun */
    for (const char *p = name; *p != '\0'; p++) {
        bool letter = (*p >= 'a' && *p <= 'z') || (*p >= '0' && *p <= '9');
        if (letter || (inside && (*p == '-' || *p == '_')))
            inside = true;
        else if (inside && *p == '/')
            inside = false;
        else
            return false;
    }
    return inside && strlen(name) < 128;
}

bool case_parameter_name_is_good(const char *name) {
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    size_t length = strlen(name);
    return length > 0 && length < 128 && name[0] != '-' && strspn(name, letters) == length;
}

static bool is_line(const char *text) {
    for (const char *p = text; *p != '\0'; p++) {
        if ((unsigned char)*p < ' ' || *p == 127)
            return false;
    }
    return *text != '\0';
}

bool case_value_is_good(const struct yaml_node *n) {
    if (n->kind == YAML_SCALAR)
        return is_line(n->text);
    for (size_t i = 0; n->kind == YAML_LIST && i < n->count; i++) {
        if (n->child[i].kind != YAML_SCALAR || !is_line(n->child[i].text))
            return false;
    }
    return n->kind == YAML_LIST;
}

bool case_value_equal(const char *a, const char *b) {
    if (strcmp(a, b) == 0)
        return true;
    char *end_a, *end_b;
    double x = strtod(a, &end_a), y = strtod(b, &end_b);
    return end_a != a && end_b != b && *end_a == '\0' && *end_b == '\0' && x == y;
}

static bool value_takes(const struct yaml_node *wanted, const struct yaml_node *value) {
    if (value->kind != YAML_SCALAR)
        return false;
    if (wanted->kind == YAML_SCALAR)
        return case_value_equal(wanted->text, value->text);
    for (size_t i = 0; i < wanted->count; i++) {
        const struct yaml_node *w = &wanted->child[i];
        if (w->kind == YAML_SCALAR && case_value_equal(w->text, value->text))
            return true;
    }
    return false;
}

const struct yaml_node *case_parameter_find(const struct case_parameter *p, size_t count,
                                            const char *name) {
    for (size_t i = 0; i < count; i++) {
        if (strcmp(p[i].name, name) == 0)
            return p[i].value;
    }
    return NULL;
}

bool case_filter_takes(const struct case_filter *f, const struct case_parameter *p, size_t count) {
    for (size_t i = 0; i < f->count; i++) {
        const struct yaml_node *value = case_parameter_find(p, count, f->map->child[i].key);
        if (value == NULL || !value_takes(&f->map->child[i], value))
            return false;
    }
    return true;
}

const struct case_expect *case_expect_find(const struct case_expect *e,
                                           const struct case_parameter *p, size_t count) {
    while (e != NULL && e->kind == EXPECT_TABLE) {
        const struct yaml_node *value = case_parameter_find(p, count, e->by);
        const struct case_expect *next = NULL;
        for (size_t i = 0; value != NULL && value->kind == YAML_SCALAR && i < e->count; i++) {
            if (case_value_equal(e->entry[i].node->key, value->text))
                next = &e->entry[i].expect;
        }
        e = next;
    }
    return e;
}

const char *case_value_text(struct arena *a, const struct yaml_node *value) {
    if (value->kind == YAML_SCALAR)
        return value->text;
    const char *text = "[";
    for (size_t i = 0; i < value->count && text != NULL; i++)
        text =
            arena_text(a, "%s%s%s", text, i == 0 ? "" : ";", case_value_text(a, &value->child[i]));
    return text == NULL ? NULL : arena_text(a, "%s]", text);
}

/* In place of the parameter of that name, else at the end. */
static size_t put(struct case_parameter *out, size_t count, const struct case_parameter *p) {
    for (size_t i = 0; i < count; i++) {
        if (strcmp(out[i].name, p->name) == 0) {
            out[i] = *p;
            return count;
        }
    }
    out[count] = *p;
    return count + 1;
}

/* What the point's reading adds to what is there. */
static size_t put_reading(const struct case_tier *t, struct case_parameter *out, size_t count) {
    const char *name = case_reading(out, count);
    const struct yaml_node *sets =
        name == NULL || t->readings == NULL ? NULL : readings_parameters(t->readings, name);
    for (size_t i = 0; sets != NULL && i < sets->count; i++) {
        const struct yaml_node *n = &sets->child[i];
        if (case_parameter_find(out, count, n->key) == NULL)
            out[count++] = (struct case_parameter){.name = n->key, .value = n, .reading = name};
    }
    return count;
}

size_t case_point(const struct case_tier *t, size_t point, struct case_parameter *out) {
    size_t count = t->parameter_count + t->axis_count, fixed = count;
    if (t->parameter_count > 0)
        memcpy(out, t->parameter, t->parameter_count * sizeof *out);
    for (size_t i = t->axis_count; i > 0; i--) {
        const struct case_axis *axis = &t->axis[i - 1];
        const struct yaml_node *value = &axis->list->child[point % axis->list->count];
        out[t->parameter_count + i - 1] = (struct case_parameter){
            .name = axis->name,
            .value = value,
            .label = axis->labels != NULL || strcmp(axis->name, "reading") == 0,
            .sets = axis->labels == NULL ? NULL : case_label_find(axis->labels, value->text)};
        point /= axis->list->count;
    }
    for (size_t i = 0; i < fixed; i++) {
        const struct yaml_node *sets = out[i].sets;
        for (size_t k = 0; sets != NULL && k < sets->count; k++) {
            const struct yaml_node *n = &sets->child[k];
            struct case_parameter p = {
                .name = n->key, .value = n, .label = strcmp(n->key, "reading") == 0};
            count = put(out, count, &p);
        }
    }
    return put_reading(t, out, count);
}

const struct yaml_node *case_label_find(const struct yaml_node *labels, const char *label) {
    for (size_t i = 0; i < labels->count; i++) {
        if (case_value_equal(labels->child[i].key, label))
            return &labels->child[i];
    }
    return NULL;
}

size_t case_axis_of(const struct case_tier *t, const char *name) {
    size_t i = 0;
    while (i < t->axis_count && strcmp(t->axis[i].name, name) != 0)
        i++;
    if (i < t->axis_count)
        return i;
    for (i = 0; i < t->axis_count; i++) {
        const struct case_axis *a = &t->axis[i];
        bool every = a->labels != NULL;
        for (size_t k = 0; every && k < a->list->count; k++)
            every = yaml_get(case_label_find(a->labels, a->list->child[k].text), name) != NULL;
        if (every)
            return i;
    }
    return t->axis_count;
}

bool case_points_agree(const struct case_tier *t, const struct case_parameter *p,
                       const struct case_parameter *q, size_t but_axis) {
    for (size_t i = 0; i < t->axis_count; i++) {
        if (i != but_axis && p[t->parameter_count + i].value != q[t->parameter_count + i].value)
            return false;
    }
    return true;
}

const char *case_reading(const struct case_parameter *p, size_t count) {
    const struct yaml_node *n = case_parameter_find(p, count, "reading");
    return n != NULL && n->kind == YAML_SCALAR ? n->text : NULL;
}

static const char *join(struct arena *a, const char *text, const char *name, const char *value) {
    if (text == NULL || value == NULL)
        return NULL;
    return arena_text(a, "%s%s%s=%s", text, *text == '\0' ? "" : ",", name, value);
}

const char *case_point_text(struct arena *a, const struct case_tier *t,
                            const struct case_parameter *p, size_t count, size_t but_axis) {
    const char *text = "", *reading = case_reading(p, count);
    bool swept = false;
    for (size_t i = 0; i < t->axis_count; i++)
        swept |= strcmp(t->axis[i].name, "reading") == 0;
    if (reading != NULL && !swept)
        text = join(a, text, "reading", reading);
    for (size_t i = 0; i < t->axis_count && text != NULL; i++) {
        const struct case_parameter *at = &p[t->parameter_count + i];
        if (i != but_axis)
            text = join(a, text, at->name, case_value_text(a, at->value));
    }
    return text != NULL && *text == '\0' ? "single" : text;
}

enum status case_value_real(const struct yaml_node *n, double *out, struct fault *fault) {
    if (n->kind == YAML_LIST && n->count != 1)
        return yaml_fault(n, fault, "%s: a list of %zu, where one number is needed",
                          n->key == NULL ? "value" : n->key, n->count);
    return yaml_real(n->kind == YAML_LIST ? &n->child[0] : n, out, fault);
}

double case_rule_value(const struct case_rules *r, const struct case_parameter *p, size_t count) {
    for (size_t i = 0; i < r->count; i++) {
        if (case_filter_takes(&r->rule[i].points, p, count))
            return r->rule[i].value;
    }
    return 0;
}

double case_rule_largest(const struct case_rules *r) {
    double largest = 0;
    for (size_t i = 0; i < r->count; i++)
        largest = r->rule[i].value > largest ? r->rule[i].value : largest;
    return largest;
}

size_t case_seed_count(const struct case_seeds *s, const struct case_parameter *p, size_t count) {
    return (size_t)case_rule_value(&s->count, p, count);
}

void case_free(struct case_file *c) {
    if (c == NULL)
        return;
    case_free(c->runs);
    readings_free(c->readings);
    yaml_free(c->document);
    arena_free(&c->arena);
    free(c);
}

const struct case_file *case_runs(const struct case_file *c) {
    return c->runs != NULL ? c->runs : c;
}
