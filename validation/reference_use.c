/* reference_use.c -- see reference.h: lines, tables and curves that nobody uses. */
#include "validation/reference.h"

#include "common/schema.h"
#include "validation/reference_curve.h"
#include "validation/scatter.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* -- lines -------------------------------------------------------------------------------- */

struct use { /* one row of a check */
    struct reference_key key;
    const struct case_check *check;
    const struct case_expect *expect; /* at its point */
};

struct user {
    const struct references *r;
    const struct plan_case *c;
    struct arena arena;
    struct use *use;
    size_t count;
    struct fault *fault;
};

static enum status list_uses(struct user *u) {
    for (size_t k = 0; k < u->c->tier->check_count; k++) {
        for (size_t p = 0; p < u->c->point_count; p++) {
            if (!reference_has_row(u->c, k, p))
                continue;
            struct use *wider = arena_grow(&u->arena, u->use, u->count, sizeof *wider);
            if (wider == NULL)
                return fault_set(u->fault, STATUS_NO_MEMORY, "references: out of memory");
            u->use = wider;
            const struct case_check *check = &u->c->tier->check[k];
            const struct plan_point *point = &u->c->point[p];
            u->use[u->count].check = check;
            u->use[u->count].expect =
                case_expect_find(&check->expect, point->parameter, point->parameter_count);
            enum status status =
                reference_key_make(u->c, k, p, &u->arena, &u->use[u->count].key, u->fault);
            if (status != STATUS_OK)
                return status;
            u->count++;
        }
    }
    return STATUS_OK;
}

static void refuse(struct user *u, const struct reference *line, const char *what, const char *text,
                   const char *near) {
    fault_add(u->fault, STATUS_BAD_INPUT, "%s:%zu: %s: %s%s%s%s", u->r->path, line->line, text,
              what, near == NULL ? "" : "; did you mean ", near == NULL ? "" : near,
              near == NULL ? "" : "?");
}

static bool is_point(const char *name, const char *line_point) {
    return strcmp(strcmp(name, "single") == 0 ? "-" : name, line_point) == 0;
}

static bool has_point(const struct user *u, const char *point) {
    for (size_t p = 0; p < u->c->point_count; p++) {
        if (is_point(u->c->point[p].name, point))
            return true;
    }
    for (size_t i = 0; i < u->count; i++) {
        if (strcmp(u->use[i].key.point, point) == 0)
            return true;
    }
    return false;
}

static const char *nearest_point(struct user *u, const char *point) {
    const char **name = arena_take(&u->arena, u->c->point_count + u->count, sizeof *name);
    size_t count = 0;
    for (size_t p = 0; name != NULL && p < u->c->point_count; p++)
        name[count++] = u->c->point[p].name;
    for (size_t i = 0; name != NULL && i < u->count; i++)
        name[count++] = u->use[i].key.point;
    return schema_nearest(point, name, count);
}

static const char *nearest_observable(struct user *u, const struct reference *line) {
    const char **name = arena_take(&u->arena, u->count, sizeof *name);
    size_t count = 0;
    for (size_t i = 0; name != NULL && i < u->count; i++) {
        if (strcmp(u->use[i].key.point, line->point) == 0)
            name[count++] = u->use[i].key.observable;
    }
    return schema_nearest(line->observable, name, count);
}

/* Does a row with that observable ask for such a line? */
static bool asks_for(const struct user *u, const struct use *use, enum reference_origin origin) {
    const struct case_expect *e = use->expect;
    switch (origin) {
    case ORIGIN_ENSEMBLE:
        return scatter_is_statistical(u->c->file, use->check);
    case ORIGIN_SEED:
        return use->check->paired;
    case ORIGIN_ANALYTIC:
    case ORIGIN_INDEPENDENT:
    case ORIGIN_PUBLISHED:
        return e != NULL && e->kind == EXPECT_REFERENCE &&
               strcmp(e->reference, reference_origin_name(origin)) == 0;
    default: /* no check judges by a curve */
        return false;
    }
}

static void check_bits(struct user *u, const struct reference *line) {
    long long seed = strtoll(strrchr(line->observable, '@') + 1, NULL, 10);
    const struct case_seeds *seeds = &u->c->tier->seeds;
    if (line->tier != TIER_SMOKE)
        refuse(u, line, "bits are of the smoke tier alone", line->observable, NULL);
    for (size_t p = 0; p < u->c->point_count; p++) {
        const struct plan_point *point = &u->c->point[p];
        long long count =
            (long long)case_seed_count(seeds, point->parameter, point->parameter_count);
        if (is_point(point->name, line->point) &&
            (seed < seeds->first || seed >= seeds->first + count))
            refuse(u, line, "the case has no such seed", line->observable, NULL);
    }
}

static void check_line(struct user *u, const struct reference *line) {
    size_t length = strlen(line->observable);
    bool found = false, used = false;
    if (!has_point(u, line->point)) {
        refuse(u, line, "the case has no such point in this tier", line->point,
               nearest_point(u, line->point));
        return;
    }
    if (line->origin == ORIGIN_BITS) {
        check_bits(u, line);
        return;
    }
    if (line->origin == ORIGIN_SEED)
        length = (size_t)(strrchr(line->observable, '@') - line->observable);
    for (size_t i = 0; i < u->count; i++) {
        const struct use *use = &u->use[i];
        if (strcmp(use->key.point, line->point) != 0 || strlen(use->key.observable) != length ||
            strncmp(use->key.observable, line->observable, length) != 0)
            continue;
        found = true;
        used |= asks_for(u, use, line->origin);
    }
    if (!found)
        refuse(u, line, "no check of this point has such an observable", line->observable,
               nearest_observable(u, line));
    else if (!used)
        refuse(u, line, "no check uses a reference of this origin", line->observable, NULL);
}

enum status reference_check_tier(const struct references *r, const struct plan_case *c,
                                 struct fault *fault) {
    struct fault found = FAULT_NONE;
    struct user u = {.r = r, .c = c, .fault = &found};
    enum tier tier = (enum tier)(c->tier - c->file->tier);
    enum status status = list_uses(&u);
    for (size_t i = 0; status == STATUS_OK && i < r->count; i++) {
        const struct reference *line = &r->item[i];
        if (!c->file->tier[line->tier].present)
            refuse(&u, line, "the case has no such tier", case_tier_name(line->tier), NULL);
        else if (line->tier == tier)
            check_line(&u, line);
    }
    arena_free(&u.arena);
    if (found.status != STATUS_OK)
        fault_add(fault, found.status, "%s", found.text);
    return found.status;
}

/* -- tables and curves -------------------------------------------------------------------- */

enum { MAX_DEPTH = 6 };

struct shelf {
    struct arena arena;
    const char *folder;
    const char *const *name; /* of cases */
    size_t name_count;
    const char **curve; /* digests that tables name */
    size_t curve_count;
    struct fault *fault;
};

static void no_memory(struct shelf *s) {
    fault_set(s->fault, STATUS_NO_MEMORY, "references: out of memory");
}

static bool ends_with(const char *text, const char *end) {
    size_t a = strlen(text), b = strlen(end);
    return a > b && strcmp(text + a - b, end) == 0;
}

static void check_table(struct shelf *s, const char *name) {
    struct references *r = NULL;
    struct fault found = FAULT_NONE;
    bool known = false;
    for (size_t i = 0; i < s->name_count; i++)
        known |= strcmp(s->name[i], name) == 0;
    if (!known) {
        const char *near = schema_nearest(name, s->name, s->name_count);
        fault_add(s->fault, STATUS_BAD_INPUT, "%s/%s.tsv: there is no such case%s%s%s", s->folder,
                  name, near == NULL ? "" : "; did you mean ", near == NULL ? "" : near,
                  near == NULL ? "" : "?");
    }
    if (reference_load(s->folder, name, &r, &found) != STATUS_OK) {
        fault_add(s->fault, found.status, "%s", found.text);
        return;
    }
    for (size_t i = 0; i < r->count; i++) {
        if (r->item[i].origin != ORIGIN_CURVE)
            continue;
        const char **wider = arena_grow(&s->arena, s->curve, s->curve_count, sizeof *wider);
        const char *hex = arena_copy(&s->arena, r->item[i].digest);
        struct reference_curve c;
        if (wider == NULL || hex == NULL) {
            no_memory(s);
            break;
        }
        s->curve = wider;
        s->curve[s->curve_count++] = hex;
        struct fault bad = FAULT_NONE;
        if (reference_curve_read(s->folder, hex, &s->arena, &c, &bad) != STATUS_OK)
            fault_add(s->fault, bad.status, "%s:%zu: %s", r->path, r->item[i].line, bad.text);
    }
    reference_free(r);
}

/* What lies below folder/inside, each file told to `take`. */
static void walk(struct shelf *s, const char *inside, int depth,
                 void (*take)(struct shelf *s, const char *inside)) {
    const char *path = arena_text(&s->arena, "%s/%s", s->folder, inside);
    DIR *d = path == NULL ? NULL : opendir(path);
    if (d == NULL) {
        if (path == NULL)
            no_memory(s);
        else if (errno != ENOENT)
            fault_add(s->fault, STATUS_IO, "%s: cannot be read: %s", path, strerror(errno));
        return;
    }
    for (struct dirent *e; (e = readdir(d)) != NULL;) {
        struct stat about;
        const char *name =
            arena_text(&s->arena, "%s%s%s", inside, *inside == '\0' ? "" : "/", e->d_name);
        const char *file = name == NULL ? NULL : arena_text(&s->arena, "%s/%s", path, e->d_name);
        if (file == NULL)
            no_memory(s);
        else if (e->d_name[0] == '.')
            continue;
        else if (lstat(file, &about) == 0 && S_ISDIR(about.st_mode) && depth < MAX_DEPTH)
            walk(s, name, depth + 1, take);
        else
            take(s, name);
    }
    closedir(d);
}

static void take_table(struct shelf *s, const char *inside) {
    if (!ends_with(inside, ".tsv") || strcmp(inside, "claims.tsv") == 0)
        return; /* verdicts of claims are no case's: claims_stored.h */
    const char *name = arena_text(&s->arena, "%.*s", (int)strlen(inside) - 4, inside);
    if (name == NULL)
        no_memory(s);
    else
        check_table(s, name);
}

static void take_curve(struct shelf *s, const char *inside) {
    for (size_t i = 0; i < s->curve_count; i++) {
        if (strncmp(inside, "curves/", 7) == 0 && strncmp(inside + 7, s->curve[i], 64) == 0 &&
            strcmp(inside + 71, ".h5") == 0)
            return;
    }
    fault_add(s->fault, STATUS_BAD_INPUT, "%s/%s: no table names this file", s->folder, inside);
}

enum status reference_check_folder(const char *folder, const char *const *name, size_t count,
                                   struct fault *fault) {
    struct fault found = FAULT_NONE;
    struct shelf s = {.folder = folder, .name = name, .name_count = count, .fault = &found};
    walk(&s, "", 0, take_table);
    walk(&s, "curves", 1, take_curve);
    arena_free(&s.arena);
    if (found.status != STATUS_OK)
        fault_add(fault, found.status, "%s", found.text);
    return found.status;
}
