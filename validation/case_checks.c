/* case_checks.c -- the checks of a tier: the case's list with the tier's overrides. */
#include "common/date.h"
#include "validation/case_read.h"

#include <string.h>

enum { MAX_NAMES = 256 };

static const char *const comparisons[] = {"within", "outside", "at most", "at least", NULL};
static const char *const kinds[] = {"round-off", "order", "model", "regression", NULL};

static const struct schema_field check_fields[] = {
    {"name", SCHEMA_TEXT, true, 0, 0, NULL},
    {"observable", SCHEMA_TEXT, true, 0, 0, NULL},
    {"per", SCHEMA_MAP, false, 0, 0, NULL},
    {"points", SCHEMA_MAP, false, 0, 0, NULL},
    {"expect", SCHEMA_ANY, false, 0, 0, NULL},
    {"comparison", SCHEMA_CHOICE, false, 0, 0, comparisons},
    {"kind", SCHEMA_CHOICE, true, 0, 0, kinds},
    {"margin", SCHEMA_ANY, false, 0, 0, NULL},
    {"scatter", SCHEMA_ANY, false, 0, 0, NULL},
    {"detects", SCHEMA_ANY, false, 0, 0, NULL},
    {"paired", SCHEMA_BOOLEAN, false, 0, 0, NULL},
    {"known", SCHEMA_MAP, false, 0, 0, NULL},
    {"because", SCHEMA_TEXT, true, 0, 0, NULL},
    {"tiers", SCHEMA_LIST, false, 0, 0, NULL},
};

static const struct schema_field known_fields[] = {
    {"because", SCHEMA_TEXT, true, 0, 0, NULL},
    {"since", SCHEMA_TEXT, true, 0, 0, NULL},
};

static const struct schema_field override_fields[] = {
    {"per", SCHEMA_MAP, false, 0, 0, NULL},
    {"points", SCHEMA_MAP, false, 0, 0, NULL},
    {"expect", SCHEMA_ANY, false, 0, 0, NULL},
    {"comparison", SCHEMA_CHOICE, false, 0, 0, comparisons},
    {"margin", SCHEMA_ANY, false, 0, 0, NULL},
    {"scatter", SCHEMA_ANY, false, 0, 0, NULL},
    {"detects", SCHEMA_ANY, false, 0, 0, NULL},
    {"known", SCHEMA_MAP, false, 0, 0, NULL},
    {"because", SCHEMA_TEXT, false, 0, 0, NULL},
};

/* A check as the case has it, and what the tier puts over it (NULL: nothing). */
struct layers {
    const struct yaml_node *base, *over;
};

static const struct yaml_node *get(const struct layers *l, const char *key) {
    const struct yaml_node *n = l->over == NULL ? NULL : yaml_get(l->over, key);
    return n != NULL ? n : yaml_get(l->base, key);
}

static size_t choice_of(const struct yaml_node *n, const char *const *choices, size_t standard) {
    for (size_t i = 0; n != NULL && choices[i] != NULL; i++) {
        if (strcmp(n->text, choices[i]) == 0)
            return i;
    }
    return standard;
}

/* Margins that could never fail, or never pass, are mistakes. */
static void check_amounts(struct case_reader *r, const struct layers *l,
                          const struct case_check *k) {
    const struct yaml_node *where = get(l, "margin") != NULL ? get(l, "margin") : k->node;
    bool one_sided = k->comparison == COMPARE_AT_MOST || k->comparison == COMPARE_AT_LEAST;
    bool zero = !k->margin.given || !(k->margin.value > 0);
    if (!k->margin.given && !one_sided && get(l, "margin") == NULL)
        case_read_fault(r, where, "check %s: a margin is needed", k->name);
    else if (k->margin.given && zero && !one_sided && k->kind != KIND_ROUND_OFF)
        case_read_fault(r, where, "check %s: margin 0 is for round-off checks only", k->name);
    else if (zero && k->comparison == COMPARE_OUTSIDE)
        case_read_fault(r, where, "check %s: outside needs a margin above 0", k->name);
    bool zero_expected = k->expect.kind == EXPECT_NUMBER && k->expect.value == 0;
    if (zero_expected && k->margin.percent)
        case_read_fault(r, where, "check %s: a percentage of 0 is no margin", k->name);
    if (zero_expected && k->scatter.percent)
        case_read_fault(r, get(l, "scatter"), "check %s: a percentage of 0 is no scatter", k->name);
    if (k->kind == KIND_ROUND_OFF && k->scatter.given)
        case_read_fault(r, get(l, "scatter"), "check %s: a round-off check has no scatter",
                        k->name);
}

static bool is_blank(const char *text) {
    return text[strspn(text, " \t\n")] == '\0';
}

/* -- regression, and what is known --------------------------------------------------- */

/* Keys that say nothing about a change, or that only a change has. */
static void check_keys(struct case_reader *r, const struct layers *l, const struct case_check *k) {
    static const char *const of_others[] = {"expect", "comparison", "scatter", "margin"};
    static const char *const of_regression[] = {"detects", "paired"};
    bool regression = k->kind == KIND_REGRESSION;
    for (size_t i = 0; regression && i < (k->paired ? 3 : 4); i++) {
        if (get(l, of_others[i]) != NULL)
            case_read_fault(r, get(l, of_others[i]),
                            "check %s: %s: a regression check takes it from its reference%s",
                            k->name, of_others[i], i == 3 ? " unless it is `paired`" : "");
    }
    for (size_t i = 0; !regression && i < 2; i++) {
        if (get(l, of_regression[i]) != NULL)
            case_read_fault(r, get(l, of_regression[i]),
                            "check %s: %s: belongs to regression checks", k->name,
                            of_regression[i]);
    }
    if (!regression && get(l, "expect") == NULL)
        case_read_fault(r, l->base, "check %s: expect: is missing", k->name);
}

static void read_regression(struct case_reader *r, const struct layers *l, struct case_check *k) {
    const struct yaml_node *at = k->detects_node = get(l, "detects");
    case_read_amount(r, at, &k->detects);
    if (at == NULL)
        case_read_fault(r, k->node, "check %s: detects: is missing, the change it must see",
                        k->name);
    else if (k->detects.given && !(k->detects.value > 0))
        case_read_fault(r, at, "check %s: detects: must be above 0", k->name);
    const struct case_across *a = k->number.across ? &r->c->across[k->number.index] : NULL;
    if (a != NULL && a->exact)
        case_read_fault(r, yaml_get(l->base, "observable"),
                        "check %s: %s is exact: there is no ensemble that it could be compared "
                        "with",
                        k->name, k->observable);
    if (!k->paired)
        return;
    if (a != NULL)
        case_read_fault(r, get(l, "paired"), "check %s: %s is no number of single runs", k->name,
                        k->observable);
    if (!k->margin.given || !(k->margin.value > 0))
        case_read_fault(r, k->node, "check %s: a paired check needs a margin above 0", k->name);
    else if (k->detects.given && k->detects.percent == k->margin.percent &&
             2 * k->margin.value > k->detects.value)
        case_read_fault(r, at,
                        "check %s: detects: %g%s, but with this margin only %g%s is surely seen",
                        k->name, k->detects.value, k->detects.percent ? " %" : "",
                        2 * k->margin.value, k->detects.percent ? " %" : "");
}

static void read_known(struct case_reader *r, const struct yaml_node *n, struct case_check *k) {
    if (n == NULL || !case_read_fields(r, n, "known", known_fields, 2))
        return;
    k->known_because = yaml_get(n, "because")->text;
    k->known_since = yaml_get(n, "since")->text;
    if (is_blank(k->known_because))
        case_read_fault(r, yaml_get(n, "because"), "must not be empty");
    if (!date_is_day(k->known_since))
        case_read_fault(r, yaml_get(n, "since"), "since: must be a date, as 2026-11-22");
}

static void read_check(struct case_reader *r, const struct layers *l, struct case_check *k) {
    const struct yaml_node *per = get(l, "per"), *expect = get(l, "expect");
    k->node = l->base;
    k->name = yaml_get(l->base, "name")->text;
    k->observable = yaml_get(l->base, "observable")->text;
    k->because = get(l, "because")->text;
    k->comparison = (enum comparison)choice_of(get(l, "comparison"), comparisons, COMPARE_WITHIN);
    k->kind = (enum check_kind)choice_of(get(l, "kind"), kinds, KIND_MODEL);
    k->unit = "1";
    if (is_blank(k->name) || is_blank(k->because))
        case_read_fault(r, get(l, is_blank(k->name) ? "name" : "because"), "must not be empty");
    bool known = case_read_number(r, yaml_get(l->base, "observable"), &k->number);
    if (known)
        k->unit = case_read_unit(r, &k->number);
    if (known && k->kind == KIND_ORDER && !k->number.across)
        case_read_fault(r, yaml_get(l->base, "kind"),
                        "check %s: an order is fitted by `across`; "
                        "%s belongs to one run",
                        k->name, k->observable);
    if (known && per != NULL && k->number.across)
        case_read_fault(r, per, "check %s: %s belongs to the whole sweep and takes no `per`",
                        k->name, k->observable);
    if (per != NULL) {
        case_read_prediction(r, per, &k->per);
        const struct prediction *p = k->per.prediction;
        if (p != NULL && strcmp(p->unit, k->unit) == 0)
            k->unit = "1";
        else if (p != NULL)
            k->unit = arena_text(&r->c->arena, "%s/(%s)", k->unit, p->unit);
    }
    case_read_filter(r, get(l, "points"), &k->points);
    k->expect = (struct case_expect){.kind = EXPECT_NONE, .node = k->node};
    if (expect != NULL)
        case_read_expect(r, expect, &k->expect);
    case_read_amount(r, get(l, "margin"), &k->margin);
    case_read_amount(r, get(l, "scatter"), &k->scatter);
    if (get(l, "paired") != NULL)
        yaml_boolean(get(l, "paired"), &k->paired, r->fault);
    check_keys(r, l, k);
    if (k->kind == KIND_REGRESSION)
        read_regression(r, l, k);
    else
        check_amounts(r, l, k);
    read_known(r, get(l, "known"), k);
}

bool case_read_in_tier(const struct yaml_node *owner, enum tier t) {
    const struct yaml_node *list = yaml_get(owner, "tiers");
    for (size_t i = 0; list != NULL && i < list->count; i++) {
        if (list->child[i].kind == YAML_SCALAR &&
            strcmp(list->child[i].text, case_tier_name(t)) == 0)
            return true;
    }
    return list == NULL;
}

void case_read_tiers(struct case_reader *r, const struct yaml_node *list) {
    for (size_t i = 0; list != NULL && i < list->count; i++) {
        const struct yaml_node *n = &list->child[i];
        struct fault unknown = FAULT_NONE;
        enum tier t;
        if (n->kind != YAML_SCALAR || case_tier_find(n->text, &t, &unknown) != STATUS_OK)
            case_read_fault(r, n, "tiers: a list of smoke, paper, large");
        else if (yaml_get(yaml_get(r->root, "tiers"), n->text) == NULL)
            case_read_fault(r, n, "tiers: the case has no tier %s", n->text);
    }
}

/* The list itself, once for all tiers: fields and names. */
static bool check_list(struct case_reader *r, const struct yaml_node *list) {
    bool good = true;
    for (size_t i = 0; i < list->count; i++) {
        const struct yaml_node *n = &list->child[i];
        if (!case_read_fields(r, n, "check", check_fields,
                              sizeof check_fields / sizeof *check_fields)) {
            good = false;
            continue;
        }
        case_read_tiers(r, yaml_get(n, "tiers"));
        for (size_t j = 0; j < i; j++) {
            const struct yaml_node *other =
                list->child[j].kind == YAML_MAP ? yaml_get(&list->child[j], "name") : NULL;
            if (other != NULL && other->kind == YAML_SCALAR &&
                strcmp(other->text, yaml_get(n, "name")->text) == 0)
                case_read_fault(r, n, "check %s: stands twice", other->text);
        }
    }
    return good;
}

static bool is_off(const struct yaml_node *over) {
    return over->kind == YAML_SCALAR && !over->quoted && strcmp(over->text, "off") == 0;
}

static bool override_is_good(const struct yaml_node *over) {
    struct fault told = FAULT_NONE; /* by check_overrides */
    return over == NULL ||
           schema_check(over, "override of a check", override_fields,
                        sizeof override_fields / sizeof *override_fields, &told) == STATUS_OK;
}

static void check_overrides(struct case_reader *r, const struct yaml_node *list,
                            const struct yaml_node *over, enum tier t) {
    for (size_t i = 0; over != NULL && i < over->count; i++) {
        const struct yaml_node *n = &over->child[i];
        const char *names[MAX_NAMES];
        size_t count = list->count < MAX_NAMES ? list->count : MAX_NAMES, k = 0;
        for (size_t j = 0; j < count; j++)
            names[j] = yaml_get(&list->child[j], "name")->text;
        while (k < count && strcmp(names[k], n->key) != 0)
            k++;
        if (k == count)
            case_read_unknown(r, n, "check", n->key, names, count);
        else if (!case_read_in_tier(&list->child[k], t))
            case_read_fault(r, n, "check %s: is not in tier %s", n->key, case_tier_name(t));
        if (!is_off(n))
            case_read_fields(r, n, "override of a check", override_fields,
                             sizeof override_fields / sizeof *override_fields);
    }
}

void case_read_checks(struct case_reader *r, enum tier tier, const struct yaml_node *over) {
    struct case_tier *t = &r->c->tier[tier];
    const struct yaml_node *list = yaml_get(r->root, "checks"), *tuned = yaml_get(over, "checks");
    if (list == NULL || list->kind != YAML_LIST || !check_list(r, list))
        return;
    if (tuned != NULL && tuned->kind != YAML_MAP)
        tuned = NULL;
    check_overrides(r, list, tuned, tier);
    struct case_check *check = case_read_take(r, list->count, sizeof *check);
    if (check == NULL)
        return;
    for (size_t i = 0; i < list->count; i++) {
        struct layers l = {.base = &list->child[i]};
        l.over = tuned == NULL ? NULL : yaml_get(tuned, yaml_get(l.base, "name")->text);
        if (!case_read_in_tier(l.base, tier) || (l.over != NULL && is_off(l.over)))
            continue;
        if (override_is_good(l.over))
            read_check(r, &l, &check[t->check_count++]);
    }
    t->check = check;
    if (t->check_count == 0)
        case_read_fault(r, over, "tier %s: has no check", case_tier_name(tier));
}
