/* case.h -- one case: a question put to a model, its runs, and its checks.
 *
 * A case is one YAML file, data only; docs/cases.md gives the format.  Loading
 * finds every fault in one pass, each with file:line:column: unknown keys and
 * names (with the nearest known one), values out of range, an observable that
 * nothing uses, a check that applies to no point, a table without an entry for
 * some point, a tier without checks.  Each tier is resolved when the case is
 * loaded, so a fault in a tier that is not run today is found today.
 *
 * Values of parameters stay YAML nodes: only the model knows their types, and
 * the node knows the line that a message has to name.
 */
#ifndef VALIDATION_CASE_H
#define VALIDATION_CASE_H

#include "common/yaml.h"
#include "validation/across.h"
#include "validation/arena.h"
#include "validation/ensemble.h"
#include "validation/prediction.h"
#include "validation/readings.h"
#include "validation/recipe.h"

enum tier { TIER_SMOKE, TIER_PAPER, TIER_LARGE, TIER_COUNT };

struct case_parameter {
    const char *name;
    const struct yaml_node *value; /* a scalar or a list of scalars */
    bool label; /* stands for other parameters, and no solver sees it: `reading`, a labelled axis */
    const struct yaml_node *sets; /* what a label stands for; NULL for `reading`, see readings.h */
    const char *reading;          /* the reading that put it there, or NULL */
};

struct case_axis { /* one swept parameter */
    const char *name;
    const struct yaml_node *list;   /* its values: list->child[0 .. count-1] */
    const struct yaml_node *labels; /* map: label to a map of parameters; NULL: plain values */
};

struct case_filter { /* which points: each named parameter has one of its values */
    size_t count;
    const struct yaml_node *map; /* NULL: every point; map->child[i].key names parameter i */
};

struct case_rule {
    struct case_filter points;
    double value;
};

struct case_rules { /* a number by point: that of the first rule that the point matches */
    size_t count;
    const struct case_rule *rule;
};

struct case_seeds {
    long long first;
    struct case_rules count;
};

struct case_start {        /* begin from the result of another case's run with the same seed */
    const char *case_name; /* NULL: none */
    const struct yaml_node *point; /* map of its swept parameters, or NULL */
    const struct yaml_node *node;
};

struct case_samples {
    size_t count;
    const double *time; /* time[0 .. count-1], strictly increasing */
    const struct yaml_node *node;
};

struct case_observable {
    const char *name;
    const struct recipe *recipe;
    double setting[RECIPE_MAX_SETTINGS]; /* in the recipe's order */
    const struct yaml_node *node;
};

/* A number of a run, or of a whole sweep: `settling.speed`, `order.order`. */
struct case_number {
    bool across; /* index into the tier's across list, else into the case's observables */
    size_t index, output;
};

struct case_across {
    const char *name;
    const struct across *fit;        /* over a sweep, or NULL */
    const struct ensemble *ensemble; /* over the seeds of each point (`along: seeds`), or NULL */
    struct case_number of; /* an output of an observable or of an ensemble fit; for the latter
                            * itself an observable, output 0 */
    const char *along;     /* a swept parameter, or one that every label of an axis sets */
    struct case_filter points;
    bool exact; /* `exact: true`: values of single runs carry no scatter */
    const struct yaml_node *node;
};

enum binding_kind { BINDING_NUMBER, BINDING_OBSERVABLE, BINDING_PARAMETER };

struct case_binding { /* where one input of a prediction comes from */
    enum binding_kind kind;
    double number;
    struct case_number observable;
    const char *parameter;
};

struct case_prediction {
    const struct prediction *prediction; /* NULL: none */
    struct case_binding input[PREDICTION_MAX_INPUTS];
};

/* EXPECT_NONE: what is expected is stored with the references of a regression check. */
enum expect_kind {
    EXPECT_NUMBER,
    EXPECT_PREDICTION,
    EXPECT_TABLE,
    EXPECT_CURVE,
    EXPECT_REFERENCE,
    EXPECT_NONE
};

struct case_expect {
    enum expect_kind kind;
    double value, uncertainty;         /* EXPECT_NUMBER */
    struct case_prediction prediction; /* EXPECT_PREDICTION */
    const char *by;                    /* EXPECT_TABLE: a parameter, and one entry a value */
    size_t count;
    const struct case_entry *entry;
    struct case_number along; /* EXPECT_CURVE: y over x, straight between the count points */
    const double *x, *y;      /* x increases */
    const char *reference;    /* EXPECT_REFERENCE: "published", "independent", "analytic" */
    const struct yaml_node *node;
};

struct case_entry {
    const struct yaml_node *node; /* node->key: the parameter's value as written */
    struct case_expect expect;
};

struct case_amount { /* 0.02 or 3 % of |expected| */
    bool given, percent;
    double value; /* percent: 3 for 3 % */
};

enum comparison { COMPARE_WITHIN, COMPARE_OUTSIDE, COMPARE_AT_MOST, COMPARE_AT_LEAST };
enum check_kind { KIND_ROUND_OFF, KIND_ORDER, KIND_MODEL, KIND_REGRESSION };

struct case_check {
    const char *name, *because, *unit;
    const char *observable; /* as written */
    struct case_number number;
    struct case_prediction per;
    struct case_filter points;
    struct case_expect expect;
    enum comparison comparison;
    enum check_kind kind;
    struct case_amount margin, scatter;
    struct case_amount detects; /* regression: the change that it must be able to see */
    bool paired;                /* regression: seed by seed, within `margin` */
    const char *known_because, *known_since; /* a known disagreement and its date, or NULL */
    const struct yaml_node *node, *detects_node;
};

enum { CASE_FIGURE_SETTINGS = 8 };

struct case_figure_setting { /* of the kind that the figure's recipe declares */
    bool given;              /* false: number is the recipe's standard, the others are empty */
    double number;
    size_t count;
    const double *numbers; /* numbers[0 .. count-1] */
    const char *text;      /* NULL where not given */
};

struct case_figure {
    const char *recipe, *title, *caption; /* title and caption may be NULL */
    size_t observable_count;
    const size_t *observable;  /* indices of the case's observables that it draws */
    struct case_filter points; /* whose runs it shows */
    bool in_tier[TIER_COUNT];
    struct case_figure_setting setting[CASE_FIGURE_SETTINGS]; /* in the recipe's order */
    const struct yaml_node *node;
};

struct case_tier { /* everything of one tier, overrides applied */
    bool present;
    size_t parameter_count, axis_count, check_count, point_count;
    size_t room; /* no point has more parameters */
    const struct case_parameter *parameter;
    const struct case_axis *axis;
    const struct readings *readings;               /* borrowed; NULL: none is used */
    struct case_samples samples, particle_samples; /* the latter may be empty */
    struct case_start start;
    struct case_seeds seeds;
    struct case_rules expect_s; /* of one run */
    double limit_s;
    const struct case_check *check;
    const struct yaml_node *node;
};

struct case_file {
    struct arena arena;
    struct yaml_document *document;
    struct readings *readings; /* of its model; NULL: it uses none */
    struct case_file *runs;    /* `runs_of:` the case whose runs it reads, or NULL */
    const char *path, *name, *title, *source, *question, *model;
    const char *equation;   /* that is tested, with its number; NULL: none */
    const char *large_only; /* why there is no smoke tier, or NULL */
    size_t tag_count, observable_count, across_count, figure_count, dataset_count;
    const char *const *tag;
    const struct case_observable *observable;
    const struct case_across *across;
    const struct case_figure *figure;
    const char *const *dataset; /* union over its observables and `also_write`, sorted */
    struct case_tier tier[TIER_COUNT];
};

/* folder/NAME.yaml must hold case NAME.  On error *out is NULL and fault has
 * every finding. */
enum status case_load(const char *folder, const char *name, struct case_file **out,
                      struct fault *fault);
void case_free(struct case_file *c); /* NULL is allowed */

/* The case that names and describes its runs: itself, or the one it reads them from. */
const struct case_file *case_runs(const struct case_file *c);

const char *case_tier_name(enum tier t);
enum status case_tier_find(const char *name, enum tier *out, struct fault *fault);
const char *case_comparison_name(enum comparison c);
const char *case_kind_name(enum check_kind k);

/* Lower-case letters, digits, '-' and '_', in parts joined by '/'. */
bool case_name_is_safe(const char *name);

/* Letters, digits, - and _; capitals too, as in width_x_R: it names no file. */
bool case_parameter_name_is_good(const char *name);

/* A value that can stand in a run file: one line of text, a number, or a list of such. */
bool case_value_is_good(const struct yaml_node *n);

/* Do two values as written mean the same: equal text or equal numbers. */
bool case_value_equal(const char *a, const char *b);

/* Does a point with these parameters pass the filter? */
bool case_filter_takes(const struct case_filter *f, const struct case_parameter *p, size_t count);

/* Parameter by name, or NULL. */
const struct yaml_node *case_parameter_find(const struct case_parameter *p, size_t count,
                                            const char *name);

/* The point-th combination of a tier, 0 .. point_count-1, the last axis running
 * fastest: the tier's parameters, then one entry an axis, then what labels and the
 * reading add; out[0 .. room-1].  What a label sets takes the place of a parameter of
 * that name; what a reading sets is there only where nothing else sets it.  Returns how many. */
size_t case_point(const struct case_tier *t, size_t point, struct case_parameter *out);

/* A label's map of parameters, or NULL. */
const struct yaml_node *case_label_find(const struct yaml_node *labels, const char *label);

/* The axis of this name, or the labelled one whose every label sets such a parameter;
 * axis_count: none. */
size_t case_axis_of(const struct case_tier *t, const char *name);

/* Do two points of a tier differ in this axis alone, or not at all? */
bool case_points_agree(const struct case_tier *t, const struct case_parameter *p,
                       const struct case_parameter *q, size_t but_axis);

/* "reading=calibrated,height_l=64": the reading, if any, and the swept parameters but
 * for one axis (axis_count: all); "single" where there are none.  NULL: no memory. */
const char *case_point_text(struct arena *a, const struct case_tier *t,
                            const struct case_parameter *p, size_t count, size_t but_axis);

/* The reading that a point is of, or NULL. */
const char *case_reading(const struct case_parameter *p, size_t count);

/* The expectation of a point: tables looked up until a number or a prediction
 * is left; NULL when a table has no entry for it. */
const struct case_expect *case_expect_find(const struct case_expect *e,
                                           const struct case_parameter *p, size_t count);

/* A value of a parameter as text: "64", "published", "[0.1;0.2]". */
const char *case_value_text(struct arena *a, const struct yaml_node *value);

/* Expected value of a curve at x: straight between its points, and beyond its ends by
 * a quarter of the end's interval at the most; NaN farther out. */
double case_curve_at(const struct case_expect *e, double x);

/* A number, or a list of exactly one; else the fault says what it is. */
enum status case_value_real(const struct yaml_node *n, double *out, struct fault *fault);

/* A point's number; 0 when no rule matches it.  The largest of all. */
double case_rule_value(const struct case_rules *r, const struct case_parameter *p, size_t count);
double case_rule_largest(const struct case_rules *r);
/* How many seeds a point gets; 0 when no rule matches it. */
size_t case_seed_count(const struct case_seeds *s, const struct case_parameter *p, size_t count);

#endif
