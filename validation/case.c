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
    static const char *const name[] = {"round-off", "order", "model"};
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

void case_point(const struct case_tier *t, size_t point, struct case_parameter *out) {
    memcpy(out, t->parameter, t->parameter_count * sizeof *out);
    for (size_t i = t->axis_count; i > 0; i--) {
        const struct case_axis *axis = &t->axis[i - 1];
        out[t->parameter_count + i - 1] = (struct case_parameter){
            .name = axis->name, .value = &axis->list->child[point % axis->list->count]};
        point /= axis->list->count;
    }
}

size_t case_seed_count(const struct case_seeds *s, const struct case_parameter *p, size_t count) {
    for (size_t i = 0; i < s->rule_count; i++) {
        if (case_filter_takes(&s->rule[i].points, p, count))
            return s->rule[i].count;
    }
    return 0;
}

void case_free(struct case_file *c) {
    if (c == NULL)
        return;
    case_free(c->runs);
    yaml_free(c->document);
    arena_free(&c->arena);
    free(c);
}

const struct case_file *case_runs(const struct case_file *c) {
    return c->runs != NULL ? c->runs : c;
}
