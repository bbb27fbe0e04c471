/* reference.h -- stored references of a case: one sorted text table, lines of known origin.
 *
 *     reference/CASE.tsv          CASE with its '/': reference/graingas/sedimentation.tsv
 *     reference/curves/HEX.h5     curves, named by the SHA-256 of their bytes (reference_curve.h)
 *
 * A table.h with one line a reference:
 *
 *     tier point observable origin value deviation seeds meaning commit solver_key date reason
 *
 * Key of a line: tier, point (as the plan names it, readings included; "-" for a case of one
 * point), observable (what a row judges, see reference_key), origin; of bits also the class of
 * build.  By origin:
 *
 *     analytic     value, deviation >= 0 its standard uncertainty         from outside:
 *     published    value, deviation >  0 its reading error                meaning, commit and
 *     independent  value, deviation >  0 of another program's result      solver_key are "-"
 *     ensemble     mean and standard deviation from seed to seed, seeds >= 32
 *     seed         OBSERVABLE@SEED: the value of that seed, deviation "-"
 *     curve        value: HEX of the file; seeds >= 32, deviation "-"
 *     bits         bits@SEED: value CLASS:HEX, class of build and digest of what it wrote
 *
 * `meaning` is the digest of the runs and of the observable as the case's text has them: a
 * reference of another text is none.  Nothing stands in a line and in a curve as well.
 *
 * Reading refuses, besides what table.h refuses, unknown tiers and origins, keys that stand twice,
 * numbers that are none or not finite, and too few seeds.  reference_check_tier refuses what the
 * case does not have or does not use.
 *
 * Leaves out: judging (judge.h), and how lines come about (accept.h).
 * Checked by: tests/unit/test_reference.c.
 */
#ifndef VALIDATION_REFERENCE_H
#define VALIDATION_REFERENCE_H

#include "validation/plan.h"

enum { REFERENCE_MIN_SEEDS = 32 }; /* of an ensemble */

enum reference_origin {
    ORIGIN_ANALYTIC,
    ORIGIN_BITS,
    ORIGIN_CURVE,
    ORIGIN_ENSEMBLE,
    ORIGIN_INDEPENDENT,
    ORIGIN_PUBLISHED,
    ORIGIN_SEED,
    ORIGIN_COUNT
};

struct reference {
    enum tier tier;
    enum reference_origin origin;
    const char *point, *observable;  /* as in the file: "-" for a single point */
    double value, deviation;         /* NaN where the origin has none */
    const char *digest;              /* 64 hex digits of bits and curves, else NULL */
    const char *build;               /* class of build of bits, else NULL */
    size_t seeds;                    /* 0: not known */
    const char *meaning;             /* 8 hex digits, or "-" */
    const char *commit, *solver_key; /* 40 and 64 hex digits, or "-" */
    const char *date, *reason;       /* YYYY-MM-DD; one line */
    size_t line;                     /* in the file, from 1 */
    const char *text;                /* the line as it was read; NULL: to be written anew */
};

struct references { /* of one case */
    struct arena arena;
    const char *path;
    size_t count; /* 0 where there is no file */
    struct reference *item;
};

/* folder/CASE.tsv; no file is no reference and no fault.  On error *out is NULL and fault has
 * every finding. */
enum status reference_load(const char *folder, const char *case_name, struct references **out,
                           struct fault *fault);
void reference_free(struct references *r); /* NULL is allowed */

const char *reference_origin_name(enum reference_origin o);
bool reference_origin_find(const char *name, enum reference_origin *out);

/* What the rows of a check are kept under.
 *   point       the plan's point, of a fit over a sweep the group's name; "-" for "single"
 *   observable  "settling.speed"; "X / law(input=...)" where `per` divides run by run, and
 *               "X - law(input=...)" where the expectation differs from run to run: then an
 *               ensemble is one of differences
 *   meaning     digest of the runs' meanings and of the observables that go into it */
struct reference_key {
    enum tier tier;
    const char *point, *observable, *meaning;
    bool difference; /* "X - law": the ensemble is one of measured - expected */
};

/* Of check `check` (index in the tier) at a point of the plan; for a fit, the first point of its
 * group.  Texts are the arena's. */
enum status reference_key_make(const struct plan_case *c, size_t check, size_t point,
                               struct arena *a, struct reference_key *out, struct fault *fault);
/* Is `point` one that the check has a row for: it takes it, and it is the first of its group? */
bool reference_has_row(const struct plan_case *c, size_t check, size_t point);

/* The line of that key, or NULL.  Its meaning may differ: see reference_is_meant. */
const struct reference *reference_find(const struct references *r, const struct reference_key *key,
                                       enum reference_origin origin);
const struct reference *reference_find_seed(const struct references *r,
                                            const struct reference_key *key, long long seed);
/* Bits of a run of that point; `meaning` of run->id is what counts. */
const struct reference *reference_find_bits(const struct references *r, enum tier tier,
                                            const struct plan_point *point,
                                            const struct plan_run *run, const char *build);

/* Is the line one of the present case text?  True for lines from outside. */
bool reference_is_meant(const struct reference *line, const char *meaning);
/* The last 8 hex digits of a run's id: the meaning of its bits. */
const char *reference_run_meaning(const struct plan_run *run);

/* Every line of c's tier has a point and an observable of the case and is used by some check.
 * Lines of tiers that the case has not are found in any tier.  Adds all findings. */
enum status reference_check_tier(const struct references *r, const struct plan_case *c,
                                 struct fault *fault);

/* Every table of the folder is one of the cases name[0 .. count-1], every curve that a table
 * names is there, and every file below curves/ is named by one.  Adds all findings. */
enum status reference_check_folder(const char *folder, const char *const *name, size_t count,
                                   struct fault *fault);

/* The file's text, lines sorted; STATUS_BAD_INPUT where reading it would refuse it.  free() it. */
enum status reference_text(const char *path, const struct reference *item, size_t count, char **out,
                           struct fault *fault);

#endif
