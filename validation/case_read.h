/* case_read.h -- the parts of the case reader, for case_*.c alone.
 *
 * case_load.c    the file as a whole, what applies to every tier
 * case_parts.c   observables, across, tags
 * case_figures.c figures and their settings
 * case_tier.c    a tier: samples, seeds, start
 * case_parameters.c  parameters and sweep of a tier: values, labels, readings
 * case_checks.c  checks of a tier, overrides applied
 * case_expect.c  expectations, predictions and margins
 * case_points.c  what a tier's points must offer: filters, tables, sweeps of `across`
 *
 * A reader collects findings and goes on, so that a case shows all its faults
 * at once.  Each tier reads the base text again: the same finding is told once.
 */
#ifndef VALIDATION_CASE_READ_H
#define VALIDATION_CASE_READ_H

#include "common/schema.h"
#include "validation/case.h"

struct case_mark { /* a filter's value or a table's entry: used by some point? */
    const struct yaml_node *node;
    bool used;
};

struct case_reader {
    struct case_file *c;
    const struct yaml_node *root;
    const char *folder;           /* of the case files */
    const struct yaml_node *runs; /* where the runs are described: root, or `runs_of`'s root */
    struct fault *fault;
    bool borrowed;                       /* read for the sake of its runs */
    bool *observable_used, *across_used; /* one flag each */
    struct case_mark *mark;
    size_t mark_count;
};

/* Zeroed memory of the case's arena; on failure the fault says so. */
void *case_read_take(struct case_reader *r, size_t count, size_t size);

/* Add the findings of `from` that are not in r->fault yet. */
void case_read_merge(struct case_reader *r, const struct fault *from);

/* schema_check whose findings are told once. */
bool case_read_fields(struct case_reader *r, const struct yaml_node *map, const char *what,
                      const struct schema_field *fields, size_t count);

/* "file:line:column: message", told once. */
void case_read_fault(struct case_reader *r, const struct yaml_node *n, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* "NAME is no such thing; did you mean X?" */
void case_read_unknown(struct case_reader *r, const struct yaml_node *n, const char *what,
                       const char *name, const char *const *names, size_t count);

/* Remember a node that some point of some tier has to use. */
void case_read_mark(struct case_reader *r, const struct yaml_node *n, bool used);

void case_read_parts(struct case_reader *r);
void case_read_figures(struct case_reader *r);
bool case_read_number(struct case_reader *r, const struct yaml_node *n, struct case_number *out);
const char *case_read_unit(const struct case_reader *r, const struct case_number *n);

void case_read_tier(struct case_reader *r, enum tier t, const struct yaml_node *over);
void case_read_parameters(struct case_reader *r, const struct yaml_node *over, struct case_tier *t);
void case_read_checks(struct case_reader *r, enum tier t, const struct yaml_node *over);
void case_read_expect(struct case_reader *r, const struct yaml_node *n, struct case_expect *out);
void case_read_prediction(struct case_reader *r, const struct yaml_node *n,
                          struct case_prediction *out);
void case_read_amount(struct case_reader *r, const struct yaml_node *n, struct case_amount *out);
void case_read_filter(struct case_reader *r, const struct yaml_node *n, struct case_filter *out);
void case_read_points(struct case_reader *r, enum tier t);

/* `tiers:` of a check or a figure: names tiers of this case; is `t` among them? */
void case_read_tiers(struct case_reader *r, const struct yaml_node *list);
bool case_read_in_tier(const struct yaml_node *owner, enum tier t);

#endif
