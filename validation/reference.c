/* reference.c -- see reference.h: the table read, checked line by line, and written. */
#include "validation/reference.h"

#include "common/date.h"
#include "common/file.h"
#include "validation/table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_BYTES = 1 << 26, HEX_DIGITS = 64, COMMIT_DIGITS = 40, MEANING_DIGITS = 8 };
enum {
    TIER,
    POINT,
    OBSERVABLE,
    ORIGIN,
    VALUE,
    DEVIATION,
    SEEDS,
    MEANING,
    COMMIT,
    KEY,
    DATE,
    WHY,
    COLUMNS
};

static const char *const column_name[COLUMNS] = {"tier",   "point",      "observable", "origin",
                                                 "value",  "deviation",  "seeds",      "meaning",
                                                 "commit", "solver_key", "date",       "reason"};

static const char *const origin_name[ORIGIN_COUNT] = {
    "analytic", "bits", "curve", "ensemble", "independent", "published", "seed"};

_Static_assert((int)COLUMNS <= (int)TABLE_COLUMNS_MAX, "no room for the columns of references");
static const struct table_form form = {
    .what = "references",
    .comment = "# References of one case, sorted with LC_ALL=C sort; see docs/references.md.\n",
    .column = column_name,
    .columns = COLUMNS,
    .max_bytes = MAX_BYTES,
};

const char *reference_origin_name(enum reference_origin o) {
    return origin_name[o];
}

bool reference_origin_find(const char *name, enum reference_origin *out) {
    for (enum reference_origin o = 0; o < ORIGIN_COUNT; o++) {
        if (strcmp(name, origin_name[o]) != 0)
            continue;
        *out = o;
        return true;
    }
    return false;
}

static bool from_outside(enum reference_origin o) {
    return o == ORIGIN_ANALYTIC || o == ORIGIN_INDEPENDENT || o == ORIGIN_PUBLISHED;
}

/* -- one line ------------------------------------------------------------------------- */

/* A finite decimal number, or "-" where the origin has none. */
static bool read_number(const struct table_place *at, int column, const char *text, bool wanted,
                        double *out) {
    char *end;
    *out = NAN;
    if (!wanted)
        return strcmp(text, "-") == 0 ||
               table_refuse(at, column_name[column], text, "must be - for this origin");
    if (*text == '\0' || strspn(text, "0123456789.eE+-") != strlen(text))
        return table_refuse(at, column_name[column], text, "is not a decimal number");
    *out = strtod(text, &end);
    if (*end != '\0' || end == text || !isfinite(*out))
        return table_refuse(at, column_name[column], text, "is not a finite number");
    return true;
}

static bool read_seeds(const struct table_place *at, const char *text, struct reference *out) {
    enum reference_origin o = out->origin;
    size_t length = strspn(text, "0123456789");
    if (length == 0 || length > 9 || text[length] != '\0')
        return table_refuse(at, "seeds", text, "is not a number of seeds");
    out->seeds = strtoul(text, NULL, 10);
    if ((o == ORIGIN_ENSEMBLE || o == ORIGIN_CURVE) && out->seeds < REFERENCE_MIN_SEEDS)
        return table_refuse(at, "seeds", text, "is too few: an ensemble needs 32");
    if ((o == ORIGIN_SEED || o == ORIGIN_BITS) && out->seeds != 1)
        return table_refuse(at, "seeds", text, "must be 1 for this origin");
    return true;
}

/* "CLASS:HEX" of bits, HEX of a curve. */
static bool read_digest(const struct table_place *at, char *text, struct reference *out) {
    char *hex = text;
    if (out->origin == ORIGIN_BITS) {
        hex = strchr(text, ':');
        if (hex == NULL || hex == text)
            return table_refuse(at, "value", text, "must be CLASS:HEX");
        *hex++ = '\0';
        out->build = text;
    }
    out->digest = hex;
    return table_is_hex(hex, HEX_DIGITS) ||
           table_refuse(at, "value", hex, "is not a digest of 64 hex digits");
}

/* Value, deviation and seeds, as the origin has them. */
static bool read_amounts(const struct table_place *at, char *const *field, struct reference *out) {
    enum reference_origin o = out->origin;
    bool digest = o == ORIGIN_BITS || o == ORIGIN_CURVE;
    out->value = NAN;
    if (digest ? !read_digest(at, field[VALUE], out)
               : !read_number(at, VALUE, field[VALUE], true, &out->value))
        return false;
    if (!read_number(at, DEVIATION, field[DEVIATION], !digest && o != ORIGIN_SEED, &out->deviation))
        return false;
    if (o == ORIGIN_ANALYTIC ? out->deviation < 0 : out->deviation <= 0)
        return table_refuse(at, "deviation", field[DEVIATION], "must be positive");
    return read_seeds(at, field[SEEDS], out);
}

/* Where it comes from; lines from outside were made by no run of ours. */
static bool read_history(const struct table_place *at, char *const *field, struct reference *out) {
    static const size_t digits[] = {MEANING_DIGITS, COMMIT_DIGITS, HEX_DIGITS};
    bool outside = from_outside(out->origin);
    for (int i = 0; i < 3; i++) {
        const char *text = field[MEANING + i];
        if (outside ? strcmp(text, "-") != 0 : !table_is_hex(text, digits[i]))
            return table_refuse(at, column_name[MEANING + i], text,
                                outside ? "must be - for what no run gave"
                                        : "is not as many hex digits");
    }
    if (!date_is_day(field[DATE]))
        return table_refuse(at, "date", field[DATE], "is no day, YYYY-MM-DD");
    if (field[WHY][strspn(field[WHY], " -")] == '\0')
        return table_refuse(at, "reason", field[WHY], "says nothing");
    out->meaning = field[MEANING];
    out->commit = field[COMMIT];
    out->solver_key = field[KEY];
    out->date = field[DATE];
    out->reason = field[WHY];
    return true;
}

static bool read_names(const struct table_place *at, char *const *field, struct reference *out) {
    struct fault unknown = FAULT_NONE;
    if (case_tier_find(field[TIER], &out->tier, &unknown) != STATUS_OK)
        return table_refuse(at, "tier", field[TIER], "is no tier");
    if (!reference_origin_find(field[ORIGIN], &out->origin))
        return table_refuse_name(at, "origin", field[ORIGIN], origin_name, ORIGIN_COUNT);
    out->point = field[POINT];
    out->observable = field[OBSERVABLE];
    if (*out->point == '\0')
        return table_refuse(at, "point", "", "is empty");
    const char *mark = strrchr(out->observable, '@');
    bool seeded = out->origin == ORIGIN_SEED || out->origin == ORIGIN_BITS;
    if (seeded && (mark == NULL || mark == out->observable || mark[1] == '\0' ||
                   mark[1 + strspn(mark + 1, "0123456789")] != '\0'))
        return table_refuse(at, "observable", out->observable, "must end in @SEED");
    if (out->origin == ORIGIN_BITS && strncmp(out->observable, "bits@", 5) != 0)
        return table_refuse(at, "observable", out->observable, "must be bits@SEED for this origin");
    return true;
}

/* -- the file ------------------------------------------------------------------------- */

static bool same_key(const struct reference *a, const struct reference *b) {
    return a->tier == b->tier && a->origin == b->origin && strcmp(a->point, b->point) == 0 &&
           strcmp(a->observable, b->observable) == 0 &&
           (a->origin != ORIGIN_BITS || strcmp(a->build, b->build) == 0);
}

static enum status take_line(void *owner, const struct table_place *at, char *const *field,
                             const char *whole) {
    struct references *out = owner;
    struct reference one = {.line = at->line, .text = whole};
    if (!read_names(at, field, &one) || !read_amounts(at, field, &one) ||
        !read_history(at, field, &one))
        return at->fault->status;
    for (size_t i = out->count; i > 0 && out->item[i - 1].tier == one.tier; i--) {
        if (same_key(&out->item[i - 1], &one))
            return fault_add(at->fault, STATUS_BAD_INPUT, "%s:%zu: the same key as in line %zu",
                             at->path, at->line, out->item[i - 1].line);
        if (strcmp(out->item[i - 1].point, one.point) != 0)
            break; /* the file is sorted: no such key farther up, else it is refused for that */
    }
    struct reference *wider = arena_grow(&out->arena, out->item, out->count, sizeof *wider);
    if (wider == NULL)
        return fault_set(at->fault, STATUS_NO_MEMORY, "%s: out of memory", at->path);
    out->item = wider;
    out->item[out->count++] = one;
    return STATUS_OK;
}

static enum status create(const char *path, struct references **out, struct fault *fault) {
    struct references *r = calloc(1, sizeof *r);
    *out = r;
    if (r != NULL && (r->path = arena_copy(&r->arena, path)) != NULL)
        return STATUS_OK;
    reference_free(r);
    *out = NULL;
    return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
}

enum status reference_load(const char *folder, const char *case_name, struct references **out,
                           struct fault *fault) {
    char *path = NULL;
    *out = NULL;
    if (asprintf(&path, "%s/%s.tsv", folder == NULL ? "" : folder, case_name) < 0)
        return fault_set(fault, STATUS_NO_MEMORY, "references: out of memory");
    enum status status = create(path, out, fault);
    if (status == STATUS_OK && folder != NULL && file_exists(path)) {
        struct table_place from = {(*out)->path, 0, &(*out)->arena, fault};
        status = table_load(&form, &from, take_line, *out);
    }
    if (status != STATUS_OK) {
        reference_free(*out);
        *out = NULL;
    }
    free(path);
    return status;
}

void reference_free(struct references *r) {
    if (r == NULL)
        return;
    arena_free(&r->arena);
    free(r);
}

/* -- writing ------------------------------------------------------------------------------ */

static const char *line_of(struct arena *a, const struct reference *r) {
    if (r->text != NULL)
        return r->text;
    bool digest = r->origin == ORIGIN_BITS || r->origin == ORIGIN_CURVE;
    const char *value = r->origin == ORIGIN_BITS    ? arena_text(a, "%s:%s", r->build, r->digest)
                        : r->origin == ORIGIN_CURVE ? r->digest
                                                    : arena_text(a, "%.17g", r->value);
    const char *deviation =
        digest || r->origin == ORIGIN_SEED ? "-" : arena_text(a, "%.17g", r->deviation);
    if (value == NULL || deviation == NULL)
        return NULL;
    return arena_text(a, "%s\t%s\t%s\t%s\t%s\t%s\t%zu\t%s\t%s\t%s\t%s\t%s", case_tier_name(r->tier),
                      r->point, r->observable, origin_name[r->origin], value, deviation, r->seeds,
                      r->meaning, r->commit, r->solver_key, r->date, r->reason);
}

/* Would reading refuse the text? */
static enum status read_again(const char *path, const char *text, struct fault *fault) {
    struct references *again = NULL;
    enum status status = create(path, &again, fault);
    if (status == STATUS_OK) {
        struct table_place from = {again->path, 0, &again->arena, fault};
        status = table_read(&form, &from, text, take_line, again);
    }
    reference_free(again);
    return status;
}

enum status reference_text(const char *path, const struct reference *item, size_t count, char **out,
                           struct fault *fault) {
    struct arena a = {0};
    const char **line = arena_take(&a, count, sizeof *line);
    for (size_t i = 0; line != NULL && i < count; i++)
        line[i] = line_of(&a, &item[i]);
    enum status status = table_write(&form, path, line, count, out, fault);
    if (status == STATUS_OK)
        status = read_again(path, *out, fault);
    arena_free(&a);
    if (status != STATUS_OK) {
        free(*out);
        *out = NULL;
    }
    return status;
}
