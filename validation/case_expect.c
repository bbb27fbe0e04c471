/* case_expect.c -- what a check expects: numbers, predictions, tables, margins. */
#include "validation/case_read.h"

#include <errno.h>
#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NAMES = 256 };

static bool looks_like_number(const struct yaml_node *n) {
    char *end;
    strtod(n->text, &end);
    return !n->quoted && end != n->text && *end == '\0';
}

static void read_binding(struct case_reader *r, const struct yaml_node *n,
                         struct case_binding *out) {
    if (n->kind != YAML_SCALAR) {
        case_read_fault(r, n, "%s: must be a number, OBSERVABLE.OUTPUT or a parameter", n->key);
    } else if (looks_like_number(n)) {
        struct fault found = FAULT_NONE;
        out->kind = BINDING_NUMBER;
        yaml_real(n, &out->number, &found);
        case_read_merge(r, &found);
    } else if (strchr(n->text, '.') != NULL) {
        out->kind = BINDING_OBSERVABLE;
        if (case_read_number(r, n, &out->observable) && out->observable.across)
            case_read_fault(r, n, "%s: %s belongs to the whole sweep, not to one run", n->key,
                            n->text);
    } else {
        out->kind = BINDING_PARAMETER;
        out->parameter = n->text;
    }
}

static void unknown_prediction(struct case_reader *r, const struct yaml_node *n) {
    size_t count;
    const struct prediction *const *all = prediction_all(&count);
    const char *name[MAX_NAMES];
    for (size_t i = 0; i < count && i < MAX_NAMES; i++)
        name[i] = all[i]->name;
    case_read_unknown(r, n, "prediction", n->text, name, count < MAX_NAMES ? count : MAX_NAMES);
}

void case_read_prediction(struct case_reader *r, const struct yaml_node *n,
                          struct case_prediction *out) {
    struct schema_field field[PREDICTION_MAX_INPUTS + 1] = {
        {"prediction", SCHEMA_TEXT, true, 0, 0, NULL}};
    const struct yaml_node *name = n->kind == YAML_MAP ? yaml_get(n, "prediction") : NULL;
    size_t inputs = 0;
    if (name == NULL || name->kind != YAML_SCALAR) {
        case_read_fault(r, n, "%s: must be {prediction: NAME, INPUT: ...}", n->key);
        return;
    }
    const struct prediction *p = out->prediction = prediction_find(name->text);
    if (p == NULL) {
        unknown_prediction(r, name);
        return;
    }
    for (; inputs < PREDICTION_MAX_INPUTS && p->input[inputs] != NULL; inputs++)
        field[inputs + 1] = (struct schema_field){p->input[inputs], SCHEMA_ANY, false, 0, 0, NULL};
    case_read_fields(r, n, p->name, field, inputs + 1);
    for (size_t i = 0; i < inputs; i++) {
        const struct yaml_node *value = yaml_get(n, p->input[i]);
        out->input[i] = (struct case_binding){.kind = BINDING_PARAMETER, .parameter = p->input[i]};
        if (value != NULL)
            read_binding(r, value, &out->input[i]);
    }
}

static void read_table(struct case_reader *r, const struct yaml_node *n, struct case_expect *out) {
    static const struct schema_field field[] = {{"by", SCHEMA_TEXT, true, 0, 0, NULL},
                                                {"values", SCHEMA_MAP, true, 0, 0, NULL}};
    out->kind = EXPECT_TABLE;
    if (!case_read_fields(r, n, "table of expectations", field, 2))
        return;
    const struct yaml_node *values = yaml_get(n, "values");
    struct case_entry *entry = case_read_take(r, values->count, sizeof *entry);
    if (entry == NULL)
        return;
    out->by = yaml_get(n, "by")->text;
    out->entry = entry;
    out->count = values->count;
    for (size_t i = 0; i < values->count; i++) {
        entry[i].node = &values->child[i];
        for (size_t j = 0; j < i; j++) {
            if (case_value_equal(values->child[i].key, values->child[j].key))
                case_read_fault(r, &values->child[i], "%s: the same value as %s above",
                                values->child[i].key, values->child[j].key);
        }
        case_read_mark(r, &values->child[i], false);
        case_read_expect(r, &values->child[i], &entry[i].expect);
    }
}

static void read_curve(struct case_reader *r, const struct yaml_node *n, struct case_expect *out) {
    static const struct schema_field field[] = {{"along", SCHEMA_TEXT, true, 0, 0, NULL},
                                                {"values", SCHEMA_MAP, true, 0, 0, NULL}};
    out->kind = EXPECT_CURVE;
    if (!case_read_fields(r, n, "curve of expectations", field, 2))
        return;
    const struct yaml_node *values = yaml_get(n, "values"), *along = yaml_get(n, "along");
    double *x = case_read_take(r, 2 * values->count + 1, sizeof *x), *y = x + values->count;
    if (x == NULL)
        return;
    if (case_read_number(r, along, &out->along) && out->along.across)
        case_read_fault(r, along, "along: %s belongs to the whole sweep", along->text);
    if (values->count < 2)
        case_read_fault(r, values, "values: a curve needs two points at the least");
    for (size_t i = 0; i < values->count; i++) {
        struct fault found = FAULT_NONE;
        char *end;
        x[i] = strtod(values->child[i].key, &end);
        if (*end != '\0' || !isfinite(x[i]) || (i > 0 && !(x[i] > x[i - 1])))
            case_read_fault(r, &values->child[i], "%s: must be a number above the one before",
                            values->child[i].key);
        yaml_real(&values->child[i], &y[i], &found);
        case_read_merge(r, &found);
    }
    out->x = x;
    out->y = y;
    out->count = values->count;
}

double case_curve_at(const struct case_expect *e, double x) {
    size_t n = e->count, k = gsl_interp_bsearch(e->x, x, 0, n - 1);
    double low = e->x[0] - 0.25 * (e->x[1] - e->x[0]);
    double high = e->x[n - 1] + 0.25 * (e->x[n - 1] - e->x[n - 2]);
    if (!(x >= low && x <= high))
        return NAN;
    return e->y[k] + (x - e->x[k]) * (e->y[k + 1] - e->y[k]) / (e->x[k + 1] - e->x[k]);
}

static void read_reference(struct case_reader *r, const struct yaml_node *n,
                           struct case_expect *out) {
    static const char *const origins[] = {"published", "independent", "analytic", NULL};
    static const struct schema_field field[] = {{"reference", SCHEMA_CHOICE, true, 0, 0, origins}};
    out->kind = EXPECT_REFERENCE;
    if (case_read_fields(r, n, "expected reference", field, 1))
        out->reference = yaml_get(n, "reference")->text;
}

static void read_uncertain(struct case_reader *r, const struct yaml_node *n,
                           struct case_expect *out) {
    static const struct schema_field field[] = {{"value", SCHEMA_REAL, true, 0, 0, NULL},
                                                {"uncertainty", SCHEMA_REAL, true, 0, 1e300, NULL}};
    struct fault ignored = FAULT_NONE; /* the schema has told it */
    if (!case_read_fields(r, n, "expected value", field, 2))
        return;
    yaml_real(yaml_get(n, "value"), &out->value, &ignored);
    yaml_real(yaml_get(n, "uncertainty"), &out->uncertainty, &ignored);
}

void case_read_expect(struct case_reader *r, const struct yaml_node *n, struct case_expect *out) {
    *out = (struct case_expect){.kind = EXPECT_NUMBER, .node = n};
    if (n->kind == YAML_MAP && yaml_get(n, "prediction") != NULL) {
        out->kind = EXPECT_PREDICTION;
        case_read_prediction(r, n, &out->prediction);
    } else if (n->kind == YAML_MAP && yaml_get(n, "by") != NULL) {
        read_table(r, n, out);
    } else if (n->kind == YAML_MAP && yaml_get(n, "along") != NULL) {
        read_curve(r, n, out);
    } else if (n->kind == YAML_MAP && yaml_get(n, "reference") != NULL) {
        read_reference(r, n, out);
    } else if (n->kind == YAML_MAP && yaml_get(n, "value") != NULL) {
        read_uncertain(r, n, out);
    } else if (n->kind == YAML_SCALAR) {
        struct fault found = FAULT_NONE;
        yaml_real(n, &out->value, &found);
        case_read_merge(r, &found);
    } else {
        case_read_fault(r, n,
                        "%s: must be a number, {value: , uncertainty: }, {prediction: , ...}, "
                        "{by: , values: }, {along: , values: } or {reference: }",
                        n->key);
    }
}

/* "0.02", "3 %", "3%": not negative. */
void case_read_amount(struct case_reader *r, const struct yaml_node *n, struct case_amount *out) {
    *out = (struct case_amount){0};
    if (n == NULL)
        return;
    char *end = NULL;
    errno = 0;
    double value = n->kind == YAML_SCALAR && !n->quoted ? strtod(n->text, &end) : NAN;
    bool number = end != NULL && end != n->text && errno == 0 && isfinite(value) && value >= 0 &&
                  strspn(n->text, "0123456789.eE+-") == (size_t)(end - n->text);
    if (number) {
        end += strspn(end, " ");
        out->percent = *end == '%';
        end += out->percent;
    }
    if (!number || *end != '\0') {
        case_read_fault(r, n, "%s: must be a number >= 0 or a percentage, as 0.02 or 3 %%", n->key);
        return;
    }
    out->given = true;
    out->value = value;
}

void case_read_filter(struct case_reader *r, const struct yaml_node *n, struct case_filter *out) {
    *out = (struct case_filter){0};
    if (n == NULL || n->kind != YAML_MAP)
        return;
    for (size_t i = 0; i < n->count; i++) {
        const struct yaml_node *v = &n->child[i];
        bool good = v->kind == YAML_SCALAR || (v->kind == YAML_LIST && v->count > 0);
        for (size_t k = 0; v->kind == YAML_LIST && k < v->count; k++) {
            good = good && v->child[k].kind == YAML_SCALAR;
            case_read_mark(r, &v->child[k], false);
        }
        if (v->kind == YAML_SCALAR)
            case_read_mark(r, v, false);
        if (!good)
            case_read_fault(r, v, "%s: must be a value or a list of values", v->key);
    }
    out->map = n;
    out->count = n->count;
}
