#include "validation/claims_stored.h"

#include "common/file.h"
#include "common/schema.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { COLUMNS = 6, MAX_BYTES = 1 << 22, COMMIT_DIGITS = 40 };
enum { ID, TIER, VERDICT, COMMIT, DATE, WHY };

static const char header[] = "id\ttier\tverdict\tcommit\tdate\treason";
static const char comment[] =
    "# Verdicts of the papers' claims, sorted with LC_ALL=C sort; see docs/claims.md.\n";

struct reader {
    const struct claims *claims;
    struct claims_stored *out;
    size_t line;
    struct fault *fault;
};

static bool refuse(struct reader *r, const char *column, const char *text, const char *why) {
    fault_add(r->fault, STATUS_BAD_INPUT, "%s:%zu: %s: \"%s\" %s", r->out->path, r->line, column,
              text, why);
    return false;
}

static bool refuse_name(struct reader *r, const char *column, const char *text,
                        const char *const *names, size_t count) {
    char why[256];
    const char *near = schema_nearest(text, names, count);
    snprintf(why, sizeof why, "is no such %s%s%s%s", column, near == NULL ? "" : "; did you mean '",
             near == NULL ? "" : near, near == NULL ? "" : "'?");
    return refuse(r, column, text, why);
}

/* -- one line ------------------------------------------------------------------------- */

static bool read_id(struct reader *r, const char *text) {
    const char **name = arena_take(&r->out->arena, r->claims->count, sizeof *name);
    for (size_t i = 0; name != NULL && i < r->claims->count; i++) {
        const struct claim *c = &r->claims->claim[i];
        name[i] = c->id;
        if (strcmp(c->id, text) == 0)
            return c->test_count > 0 || refuse(r, "id", text, "has no tests");
    }
    return refuse_name(r, "claim", text, name, name == NULL ? 0 : r->claims->count);
}

static bool read_verdict(struct reader *r, const char *text, enum claim_verdict *out) {
    const char *name[CLAIM_VERDICTS];
    for (enum claim_verdict v = 0; v < CLAIM_VERDICTS; v++)
        name[v] = claim_verdict_name(v);
    if (!claim_verdict_find(text, out))
        return refuse_name(r, "verdict", text, name, CLAIM_VERDICTS);
    return (*out != CLAIM_UNDECIDED && *out != CLAIM_NOT_TESTED) ||
           refuse(r, "verdict", text, "is none to be kept");
}

static bool is_commit(const char *text) {
    return strlen(text) == COMMIT_DIGITS && strspn(text, "0123456789abcdef") == COMMIT_DIGITS;
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

static bool read_line(struct reader *r, char *const *field, struct claim_stored *out) {
    struct fault unknown = FAULT_NONE;
    if (!read_id(r, field[ID]))
        return false;
    if (case_tier_find(field[TIER], &out->tier, &unknown) != STATUS_OK)
        return refuse(r, "tier", field[TIER], "is no tier");
    if (!read_verdict(r, field[VERDICT], &out->verdict))
        return false;
    if (!is_commit(field[COMMIT]))
        return refuse(r, "commit", field[COMMIT], "is no commit of 40 hex digits");
    if (!is_date(field[DATE]))
        return refuse(r, "date", field[DATE], "is no day, YYYY-MM-DD");
    if (field[WHY][strspn(field[WHY], " -.")] == '\0')
        return refuse(r, "reason", field[WHY], "says nothing");
    out->id = field[ID];
    out->commit = field[COMMIT];
    out->date = field[DATE];
    out->reason = field[WHY];
    return true;
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

static void take_line(struct reader *r, char *line) {
    char *field[COLUMNS];
    struct claim_stored one = {0};
    if (strncmp(line, "<<<<<<<", 7) == 0 || strncmp(line, ">>>>>>>", 7) == 0 ||
        strcmp(line, "=======") == 0) {
        refuse(r, "line", line, "is of a merge that is not finished");
        return;
    }
    if (!is_clean(line)) {
        refuse(r, "line", "", "has a control character");
        return;
    }
    if (split(line, field) != COLUMNS) {
        refuse(r, "line", field[ID], "must have 6 columns");
        return;
    }
    if (!read_line(r, field, &one))
        return;
    if (claims_stored_find(r->out, one.id, one.tier) != NULL)
        refuse(r, "id", one.id, "has a line in this tier already");
    else
        claims_stored_put(r->out, &one, r->fault);
}

/* -- the file ------------------------------------------------------------------------- */

/* text is cut up and must stay: the lines point into it. */
static void read_text(struct reader *r, char *text) {
    const char *path = r->out->path, *before = NULL;
    bool headed = false;
    if (*text == '\0' || text[strlen(text) - 1] != '\n') {
        fault_add(r->fault, STATUS_BAD_INPUT, "%s: does not end in a whole line", path);
        return;
    }
    for (char *line = text, *next; *line != '\0'; line = next) {
        next = strchr(line, '\n');
        *next++ = '\0';
        r->line++;
        if (!headed && *line == '#')
            continue;
        if (!headed && strcmp(line, header) != 0) {
            refuse(r, "line", line, "is not the header of the table of claims");
            return;
        }
        if (headed) {
            const char *copy = arena_copy(&r->out->arena, line);
            if (copy == NULL) {
                fault_set(r->fault, STATUS_NO_MEMORY, "%s: out of memory", path);
                return;
            }
            if (before != NULL && strcmp(before, copy) >= 0)
                refuse(r, "line", copy, "is out of order: sort with LC_ALL=C");
            before = copy;
            take_line(r, line);
        }
        headed = true;
    }
    if (!headed)
        fault_add(r->fault, STATUS_BAD_INPUT, "%s: no header", path);
}

static enum status parse(const char *path, const char *text, const struct claims *claims,
                         struct claims_stored **out, struct fault *fault) {
    struct fault found = FAULT_NONE;
    struct claims_stored *s = calloc(1, sizeof *s);
    char *own = s == NULL || text == NULL ? NULL : arena_copy(&s->arena, text);
    *out = NULL;
    if (s == NULL || (s->path = arena_copy(&s->arena, path)) == NULL ||
        (own == NULL && text != NULL)) {
        claims_stored_free(s);
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
    }
    struct reader r = {claims, s, 0, &found};
    if (own != NULL)
        read_text(&r, own);
    if (found.status != STATUS_OK) {
        *fault = found;
        claims_stored_free(s);
        return found.status;
    }
    *out = s;
    return STATUS_OK;
}

enum status claims_stored_load(const char *folder, const struct claims *claims,
                               struct claims_stored **out, struct fault *fault) {
    char *text = NULL, *path = file_join(folder == NULL ? "" : folder, "claims.tsv");
    size_t length = 0;
    enum status status = STATUS_OK;
    *out = NULL;
    if (path == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "claims: out of memory");
    if (folder != NULL && file_exists(path)) {
        status = file_read(path, MAX_BYTES, &text, &length, fault);
        if (status == STATUS_OK && strlen(text) != length)
            status = fault_set(fault, STATUS_BAD_INPUT, "%s: is not a text", path);
    }
    if (status == STATUS_OK)
        status = parse(path, text, claims, out, fault);
    free(text);
    free(path);
    return status;
}

void claims_stored_free(struct claims_stored *s) {
    if (s == NULL)
        return;
    arena_free(&s->arena);
    free(s);
}

const struct claim_stored *claims_stored_find(const struct claims_stored *s, const char *id,
                                              enum tier tier) {
    for (size_t i = 0; s != NULL && i < s->count; i++) {
        if (s->item[i].tier == tier && strcmp(s->item[i].id, id) == 0)
            return &s->item[i];
    }
    return NULL;
}

enum status claims_stored_put(struct claims_stored *s, const struct claim_stored *item,
                              struct fault *fault) {
    for (size_t i = 0; i < s->count; i++) {
        if (s->item[i].tier != item->tier || strcmp(s->item[i].id, item->id) != 0)
            continue;
        s->item[i] = *item;
        return STATUS_OK;
    }
    struct claim_stored *wider = arena_grow(&s->arena, s->item, s->count, sizeof *wider);
    if (wider == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", s->path);
    s->item = wider;
    s->item[s->count++] = *item;
    return STATUS_OK;
}

void claims_stored_remove(struct claims_stored *s, const char *id, enum tier tier) {
    size_t kept = 0;
    for (size_t i = 0; i < s->count; i++) {
        if (s->item[i].tier != tier || strcmp(s->item[i].id, id) != 0)
            s->item[kept++] = s->item[i];
    }
    s->count = kept;
}

/* -- writing -------------------------------------------------------------------------- */

static int by_text(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static char *text_of(const struct claims_stored *s) {
    struct arena a = {0};
    char *text = NULL;
    size_t length = 0;
    const char **line = arena_take(&a, s->count, sizeof *line);
    FILE *out = line == NULL ? NULL : open_memstream(&text, &length);
    bool good = out != NULL;
    for (size_t i = 0; good && i < s->count; i++) {
        const struct claim_stored *c = &s->item[i];
        line[i] = arena_text(&a, "%s\t%s\t%s\t%s\t%s\t%s", c->id, case_tier_name(c->tier),
                             claim_verdict_name(c->verdict), c->commit, c->date, c->reason);
        good = line[i] != NULL;
    }
    if (good && s->count > 0)
        qsort(line, s->count, sizeof *line, by_text);
    if (good)
        fprintf(out, "%s%s\n", comment, header);
    for (size_t i = 0; good && i < s->count; i++)
        fprintf(out, "%s\n", line[i]);
    if (out != NULL)
        good = fclose(out) == 0 && good;
    arena_free(&a);
    if (!good) {
        free(text);
        text = NULL;
    }
    return text;
}

enum status claims_stored_text(const struct claims_stored *s, const struct claims *claims,
                               char **out, struct fault *fault) {
    struct claims_stored *again = NULL;
    *out = NULL;
    char *text = text_of(s);
    if (text == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", s->path);
    enum status status = parse(s->path, text, claims, &again, fault);
    claims_stored_free(again);
    if (status == STATUS_OK)
        *out = text;
    else
        free(text);
    return status;
}
