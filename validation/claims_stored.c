#include "validation/claims_stored.h"

#include "common/date.h"
#include "common/file.h"
#include "validation/table.h"

#include <stdlib.h>
#include <string.h>

enum { ID, TIER, VERDICT, COMMIT, DATE, WHY, COLUMNS };
enum { MAX_BYTES = 1 << 22, COMMIT_DIGITS = 40 };

static const char *const column_name[COLUMNS] = {"id",     "tier", "verdict",
                                                 "commit", "date", "reason"};
_Static_assert((int)COLUMNS <= (int)TABLE_COLUMNS_MAX, "no room for the columns of claims");
static const struct table_form form = {
    .what = "claims",
    .comment = "# Verdicts of the papers' claims, sorted with LC_ALL=C sort; see docs/claims.md.\n",
    .column = column_name,
    .columns = COLUMNS,
    .max_bytes = MAX_BYTES,
};

struct reader {
    const struct claims *claims;
    struct claims_stored *out;
};

/* -- one line ------------------------------------------------------------------------- */

static bool read_id(const struct reader *r, const struct table_place *at, const char *text) {
    const char **name = arena_take(&r->out->arena, r->claims->count, sizeof *name);
    if (name == NULL) {
        fault_set(at->fault, STATUS_NO_MEMORY, "%s: out of memory", at->path);
        return false;
    }
    for (size_t i = 0; i < r->claims->count; i++) {
        const struct claim *c = &r->claims->claim[i];
        name[i] = c->id;
        if (strcmp(c->id, text) == 0)
            return c->test_count > 0 || table_refuse(at, "id", text, "has no tests");
    }
    return table_refuse_name(at, "claim", text, name, r->claims->count);
}

static bool read_verdict(const struct table_place *at, const char *text, enum claim_verdict *out) {
    const char *name[CLAIM_VERDICTS];
    for (enum claim_verdict v = 0; v < CLAIM_VERDICTS; v++)
        name[v] = claim_verdict_name(v);
    if (!claim_verdict_find(text, out))
        return table_refuse_name(at, "verdict", text, name, CLAIM_VERDICTS);
    return (*out != CLAIM_UNDECIDED && *out != CLAIM_NOT_TESTED) ||
           table_refuse(at, "verdict", text, "is none to be kept");
}

static bool read_line(const struct reader *r, const struct table_place *at, char *const *field,
                      struct claim_stored *out) {
    struct fault unknown = FAULT_NONE;
    if (!read_id(r, at, field[ID]))
        return false;
    if (case_tier_find(field[TIER], &out->tier, &unknown) != STATUS_OK)
        return table_refuse(at, "tier", field[TIER], "is no tier");
    if (!read_verdict(at, field[VERDICT], &out->verdict))
        return false;
    if (!table_is_hex(field[COMMIT], COMMIT_DIGITS))
        return table_refuse(at, "commit", field[COMMIT], "is no commit of 40 hex digits");
    if (!date_is_day(field[DATE]))
        return table_refuse(at, "date", field[DATE], "is no day, YYYY-MM-DD");
    if (field[WHY][strspn(field[WHY], " -.")] == '\0')
        return table_refuse(at, "reason", field[WHY], "says nothing");
    out->id = field[ID];
    out->commit = field[COMMIT];
    out->date = field[DATE];
    out->reason = field[WHY];
    return true;
}

static enum status take_line(void *owner, const struct table_place *at, char *const *field,
                             const char *whole) {
    const struct reader *r = owner;
    struct claim_stored one = {0};
    (void)whole;
    if (!read_line(r, at, field, &one))
        return at->fault->status;
    if (claims_stored_find(r->out, one.id, one.tier) != NULL)
        table_refuse(at, "id", one.id, "has a line in this tier already");
    else
        return claims_stored_put(r->out, &one, at->fault);
    return STATUS_OK;
}

/* -- the file ------------------------------------------------------------------------- */

static enum status create(const char *path, struct claims_stored **out, struct fault *fault) {
    struct claims_stored *s = calloc(1, sizeof *s);
    *out = s;
    if (s != NULL && (s->path = arena_copy(&s->arena, path)) != NULL)
        return STATUS_OK;
    claims_stored_free(s);
    *out = NULL;
    return fault_set(fault, STATUS_NO_MEMORY, "%s: out of memory", path);
}

enum status claims_stored_load(const char *folder, const struct claims *claims,
                               struct claims_stored **out, struct fault *fault) {
    char *path = file_join(folder == NULL ? "" : folder, "claims.tsv");
    *out = NULL;
    if (path == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "claims: out of memory");
    enum status status = create(path, out, fault);
    if (status == STATUS_OK && folder != NULL && file_exists(path)) {
        struct reader r = {claims, *out};
        struct table_place from = {(*out)->path, 0, &(*out)->arena, fault};
        status = table_load(&form, &from, take_line, &r);
    }
    if (status != STATUS_OK) {
        claims_stored_free(*out);
        *out = NULL;
    }
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

/* Would reading refuse the text? */
static enum status read_again(const struct claims_stored *s, const struct claims *claims,
                              const char *text, struct fault *fault) {
    struct claims_stored *again = NULL;
    enum status status = create(s->path, &again, fault);
    if (status == STATUS_OK) {
        struct reader r = {claims, again};
        struct table_place from = {again->path, 0, &again->arena, fault};
        status = table_read(&form, &from, text, take_line, &r);
    }
    claims_stored_free(again);
    return status;
}

enum status claims_stored_text(const struct claims_stored *s, const struct claims *claims,
                               char **out, struct fault *fault) {
    struct arena a = {0};
    const char **line = arena_take(&a, s->count, sizeof *line);
    for (size_t i = 0; line != NULL && i < s->count; i++) {
        const struct claim_stored *c = &s->item[i];
        line[i] = arena_text(&a, "%s\t%s\t%s\t%s\t%s\t%s", c->id, case_tier_name(c->tier),
                             claim_verdict_name(c->verdict), c->commit, c->date, c->reason);
    }
    enum status status = table_write(&form, s->path, line, s->count, out, fault);
    if (status == STATUS_OK)
        status = read_again(s, claims, *out, fault);
    arena_free(&a);
    if (status != STATUS_OK) {
        free(*out);
        *out = NULL;
    }
    return status;
}
