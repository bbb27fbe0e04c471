/* reference.c -- see reference.h: the table read, checked line by line, and written. */
#include "validation/reference.h"

#include "common/file.h"
#include "common/schema.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { COLUMNS = 12, MAX_BYTES = 1 << 26, HEX_DIGITS = 64, COMMIT_DIGITS = 40, MEANING_DIGITS = 8 };
enum { TIER, POINT, OBSERVABLE, ORIGIN, VALUE, DEVIATION, SEEDS, MEANING, COMMIT, KEY, DATE, WHY };

static const char *const column_name[COLUMNS] = {"tier",   "point",      "observable", "origin",
                                                 "value",  "deviation",  "seeds",      "meaning",
                                                 "commit", "solver_key", "date",       "reason"};

static const char *const origin_name[ORIGIN_COUNT] = {
    "analytic", "bits", "curve", "ensemble", "independent", "published", "seed"};

static const char comment[] =
    "# References of one case, sorted with LC_ALL=C sort; see docs/references.md.\n";

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

struct reader {
    const char *path;
    struct references *out;
    struct fault *fault;
    size_t line;
};

static bool refuse(struct reader *r, const char *column, const char *text, const char *why) {
    fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu: %s: \"%s\": %s", r->path, r->line, column, text,
              why);
    return false;
}

static bool is_hex(const char *text, size_t length) {
    return strlen(text) == length && strspn(text, "0123456789abcdef") == length;
}

/* A finite decimal number, or "-" where the origin has none. */
static bool read_number(struct reader *r, int column, const char *text, bool wanted, double *out) {
    char *end;
    *out = NAN;
    if (!wanted)
        return strcmp(text, "-") == 0 ||
               refuse(r, column_name[column], text, "must be - for this origin");
    if (*text == '\0' || strspn(text, "0123456789.eE+-") != strlen(text))
        return refuse(r, column_name[column], text, "is not a decimal number");
    *out = strtod(text, &end);
    if (*end != '\0' || end == text || !isfinite(*out))
        return refuse(r, column_name[column], text, "is not a finite number");
    return true;
}

static bool read_seeds(struct reader *r, const char *text, struct reference *out) {
    enum reference_origin o = out->origin;
    size_t length = strspn(text, "0123456789");
    if (length == 0 || length > 9 || text[length] != '\0')
        return refuse(r, "seeds", text, "is not a number of seeds");
    out->seeds = strtoul(text, NULL, 10);
    if ((o == ORIGIN_ENSEMBLE || o == ORIGIN_CURVE) && out->seeds < REFERENCE_MIN_SEEDS)
        return refuse(r, "seeds", text, "an ensemble needs 32 of them");
    if ((o == ORIGIN_SEED || o == ORIGIN_BITS) && out->seeds != 1)
        return refuse(r, "seeds", text, "must be 1 for this origin");
    return true;
}

/* "CLASS:HEX" of bits, HEX of a curve. */
static bool read_digest(struct reader *r, char *text, struct reference *out) {
    char *hex = text;
    if (out->origin == ORIGIN_BITS) {
        hex = strchr(text, ':');
        if (hex == NULL || hex == text)
            return refuse(r, "value", text, "must be CLASS:HEX");
        *hex++ = '\0';
        out->build = text;
    }
    out->digest = hex;
    return is_hex(hex, HEX_DIGITS) || refuse(r, "value", hex, "is not a digest of 64 hex digits");
}

/* Value, deviation and seeds, as the origin has them. */
static bool read_amounts(struct reader *r, char *const *field, struct reference *out) {
    enum reference_origin o = out->origin;
    bool digest = o == ORIGIN_BITS || o == ORIGIN_CURVE;
    out->value = NAN;
    if (digest ? !read_digest(r, field[VALUE], out)
               : !read_number(r, VALUE, field[VALUE], true, &out->value))
        return false;
    if (!read_number(r, DEVIATION, field[DEVIATION], !digest && o != ORIGIN_SEED, &out->deviation))
        return false;
    if (o == ORIGIN_ANALYTIC ? out->deviation < 0 : out->deviation <= 0)
        return refuse(r, "deviation", field[DEVIATION], "must be positive");
    return read_seeds(r, field[SEEDS], out);
}

static bool is_date(const char *text) {
    struct tm day = {0};
    char again[16];
    const char *end = strptime(text, "%Y-%m-%d", &day);
    if (end == NULL || *end != '\0')
        return false;
    timegm(&day); /* 31 February becomes a day of March */
    return strftime(again, sizeof again, "%Y-%m-%d", &day) == 10 && strcmp(again, text) == 0;
}

/* Where it comes from; lines from outside were made by no run of ours. */
static bool read_history(struct reader *r, char *const *field, struct reference *out) {
    static const size_t digits[] = {MEANING_DIGITS, COMMIT_DIGITS, HEX_DIGITS};
    bool outside = from_outside(out->origin);
    for (int i = 0; i < 3; i++) {
        const char *text = field[MEANING + i];
        if (outside ? strcmp(text, "-") != 0 : !is_hex(text, digits[i]))
            return refuse(r, column_name[MEANING + i], text,
                          outside ? "must be - for what no run gave" : "is not as many hex digits");
    }
    if (!is_date(field[DATE]))
        return refuse(r, "date", field[DATE], "is no day, YYYY-MM-DD");
    if (field[WHY][strspn(field[WHY], " -")] == '\0')
        return refuse(r, "reason", field[WHY], "says nothing");
    out->meaning = field[MEANING];
    out->commit = field[COMMIT];
    out->solver_key = field[KEY];
    out->date = field[DATE];
    out->reason = field[WHY];
    return true;
}

static bool read_names(struct reader *r, char *const *field, struct reference *out) {
    struct fault unknown = FAULT_NONE;
    if (case_tier_find(field[TIER], &out->tier, &unknown) != STATUS_OK)
        return refuse(r, "tier", field[TIER], "is no tier");
    if (!reference_origin_find(field[ORIGIN], &out->origin)) {
        const char *near = schema_nearest(field[ORIGIN], origin_name, ORIGIN_COUNT);
        return refuse(r, "origin", field[ORIGIN], near == NULL ? "is no origin" : near);
    }
    out->point = field[POINT];
    out->observable = field[OBSERVABLE];
    if (*out->point == '\0')
        return refuse(r, "point", "", "is empty");
    const char *at = strrchr(out->observable, '@');
    bool seeded = out->origin == ORIGIN_SEED || out->origin == ORIGIN_BITS;
    if (seeded && (at == NULL || at == out->observable || at[1] == '\0' ||
                   at[1 + strspn(at + 1, "0123456789")] != '\0'))
        return refuse(r, "observable", out->observable, "must end in @SEED");
    if (out->origin == ORIGIN_BITS && strncmp(out->observable, "bits@", 5) != 0)
        return refuse(r, "observable", out->observable, "must be bits@SEED for this origin");
    return true;
}

/* -- the file ------------------------------------------------------------------------- */

static bool same_key(const struct reference *a, const struct reference *b) {
    return a->tier == b->tier && a->origin == b->origin && strcmp(a->point, b->point) == 0 &&
           strcmp(a->observable, b->observable) == 0 &&
           (a->origin != ORIGIN_BITS || strcmp(a->build, b->build) == 0);
}

/* Cut at tabs; how many fields there are, at most COLUMNS of them in field[]. */
static size_t split(char *line, char **field) {
    size_t count = 0;
    for (char *next = line; next != NULL; count++) {
        char *here = next;
        next = strchr(here, '\t');
        if (next != NULL)
            *next++ = '\0';
        if (count < COLUMNS)
            field[count] = here;
    }
    return count;
}

static bool is_clean(const char *line) {
    for (const char *p = line; *p != '\0'; p++) {
        if (((unsigned char)*p < ' ' && *p != '\t') || *p == 127)
            return false;
    }
    return true;
}

/* The line is cut up; `whole` is the same and stays. */
static enum status take_line(struct reader *r, char *line, const char *whole) {
    struct references *out = r->out;
    char *field[COLUMNS];
    struct reference one = {.line = r->line, .text = whole};
    if (strncmp(line, "<<<<<<<", 7) == 0 || strncmp(line, ">>>>>>>", 7) == 0 ||
        strcmp(line, "=======") == 0)
        return fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu: a merge conflict is not solved",
                         r->path, r->line);
    if (!is_clean(line))
        return fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu: a control character", r->path,
                         r->line);
    size_t columns = split(line, field);
    if (columns != COLUMNS)
        return fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu: %zu columns, must be %d", r->path,
                         r->line, columns, (int)COLUMNS);
    if (!read_names(r, field, &one) || !read_amounts(r, field, &one) ||
        !read_history(r, field, &one))
        return r->fault->status;
    for (size_t i = out->count; i > 0 && out->item[i - 1].tier == one.tier; i--) {
        if (same_key(&out->item[i - 1], &one))
            return fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu: the same key as in line %zu",
                             r->path, r->line, out->item[i - 1].line);
        if (strcmp(out->item[i - 1].point, one.point) != 0)
            break; /* the file is sorted: no such key farther up, else it is refused for that */
    }
    struct reference *wider = arena_grow(&out->arena, out->item, out->count, sizeof *wider);
    if (wider == NULL)
        return fault_set(r->fault, STATUS_NO_MEMORY, "%s: out of memory", r->path);
    out->item = wider;
    out->item[out->count++] = one;
    return STATUS_OK;
}

static void write_header(FILE *out) {
    for (int i = 0; i < COLUMNS; i++)
        fprintf(out, "%s%c", column_name[i], i == COLUMNS - 1 ? '\n' : '\t');
}

static bool is_header(const char *line) {
    for (int i = 0; i < COLUMNS; i++) {
        size_t length = strlen(column_name[i]);
        if (strncmp(line, column_name[i], length) != 0 ||
            line[length] != (i == COLUMNS - 1 ? '\0' : '\t'))
            return false;
        line += length + 1;
    }
    return true;
}

/* text is cut up and must stay: the lines point into it. */
static enum status read_text(struct reader *r, char *text) {
    const char *before = NULL;
    bool header = false;
    if (*text == '\0' || text[strlen(text) - 1] != '\n')
        return fault_set(r->fault, STATUS_BAD_INPUT, "%s: does not end in a whole line", r->path);
    for (char *line = text, *next; *line != '\0'; line = next) {
        next = strchr(line, '\n');
        *next++ = '\0';
        r->line++;
        if (!header && *line == '#')
            continue;
        if (!header) {
            header = is_header(line);
            if (!header)
                return fault_set(r->fault, STATUS_BAD_INPUT,
                                 "%s:%zu: not the header of a table of references", r->path,
                                 r->line);
            continue;
        }
        const char *copy = arena_copy(&r->out->arena, line);
        if (copy == NULL)
            return fault_set(r->fault, STATUS_NO_MEMORY, "%s: out of memory", r->path);
        if (before != NULL && strcmp(before, copy) >= 0)
            fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu: %s line %zu: sort with LC_ALL=C",
                      r->path, r->line,
                      strcmp(before, copy) == 0 ? "the same as" : "belongs before", r->line - 1);
        before = copy;
        if (take_line(r, line, copy) == STATUS_NO_MEMORY)
            return r->fault->status;
    }
    if (!header)
        fault_add(r->fault, STATUS_BAD_INPUT, "%s: no header", r->path);
    return r->fault->status;
}

static enum status parse(const char *path, const char *text, struct references **out,
                         struct fault *fault) {
    *out = NULL;
    struct references *r = calloc(1, sizeof *r);
    char *own = r == NULL ? NULL : arena_copy(&r->arena, text);
    if (own == NULL || (r->path = arena_copy(&r->arena, path)) == NULL) {
        reference_free(r);
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
    }
    struct fault found = FAULT_NONE;
    struct reader reader = {r->path, r, &found, 0};
    if (read_text(&reader, own) != STATUS_OK) {
        *fault = found;
        reference_free(r);
        return found.status;
    }
    *out = r;
    return STATUS_OK;
}

enum status reference_load(const char *folder, const char *case_name, struct references **out,
                           struct fault *fault) {
    char *text = NULL, *path = NULL;
    size_t length = 0;
    *out = NULL;
    if (asprintf(&path, "%s/%s.tsv", folder == NULL ? "" : folder, case_name) < 0)
        return fault_set(fault, STATUS_NO_MEMORY, "references: out of memory");
    enum status status = STATUS_OK;
    if (folder == NULL || !file_exists(path)) {
        *out = calloc(1, sizeof **out);
        if (*out == NULL || ((*out)->path = arena_copy(&(*out)->arena, path)) == NULL)
            status = fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
    } else {
        status = file_read(path, MAX_BYTES, &text, &length, fault);
        if (status == STATUS_OK && strlen(text) != length)
            status = fault_set(fault, STATUS_BAD_INPUT, "%s: is not a text", path);
        if (status == STATUS_OK)
            status = parse(path, text, out, fault);
    }
    if (status != STATUS_OK) {
        reference_free(*out);
        *out = NULL;
    }
    free(text);
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

static int by_text(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static enum status write_lines(const char *path, const struct reference *item, size_t count,
                               struct arena *a, FILE *out, struct fault *fault) {
    const char **line = arena_take(a, count, sizeof *line);
    for (size_t i = 0; line != NULL && i < count; i++) {
        line[i] = line_of(a, &item[i]);
        if (line[i] == NULL)
            line = NULL;
    }
    if (line == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
    if (count > 0)
        qsort(line, count, sizeof *line, by_text);
    fputs(comment, out);
    write_header(out);
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s\n", line[i]);
    return STATUS_OK;
}

enum status reference_text(const char *path, const struct reference *item, size_t count, char **out,
                           struct fault *fault) {
    struct arena a = {0};
    struct references *again = NULL;
    size_t length = 0;
    *out = NULL;
    FILE *stream = open_memstream(out, &length);
    enum status status = stream == NULL
                             ? fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path)
                             : write_lines(path, item, count, &a, stream, fault);
    if (stream != NULL && fclose(stream) != 0 && status == STATUS_OK)
        status = fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
    if (status == STATUS_OK)
        status = parse(path, *out, &again, fault); /* nothing is written that reading refuses */
    reference_free(again);
    arena_free(&a);
    if (status != STATUS_OK) {
        free(*out);
        *out = NULL;
    }
    return status;
}
