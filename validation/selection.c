#include "validation/selection.h"

#include "common/schema.h"

#include <dirent.h>
#include <errno.h>
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_DEPTH = 6 };

struct names {
    const char **name;
    size_t count;
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "cases: out of memory");
}

static enum status add_name(struct arena *a, struct names *list, const char *name,
                            struct fault *fault) {
    const char **wider = arena_grow(a, list->name, list->count, sizeof *wider);
    if (wider == NULL || name == NULL)
        return no_memory(fault);
    list->name = wider;
    list->name[list->count++] = name;
    return STATUS_OK;
}

/* Names of all case files below folder/inside. */
static enum status scan(struct arena *a, const char *folder, const char *inside, int depth,
                        struct names *out, struct fault *fault) {
    const char *path = arena_text(a, "%s/%s", folder, inside);
    DIR *d = path == NULL ? NULL : opendir(path);
    if (d == NULL)
        return fault_set(fault, STATUS_IO, "%s: cannot be read: %s", path == NULL ? folder : path,
                         strerror(errno));
    enum status status = STATUS_OK;
    for (struct dirent *e; status == STATUS_OK && (e = readdir(d)) != NULL;) {
        size_t length = strlen(e->d_name);
        bool yaml = length > 5 && strcmp(e->d_name + length - 5, ".yaml") == 0;
        const char *name = arena_text(a, "%s%s%.*s", inside, *inside == '\0' ? "" : "/",
                                      (int)(yaml ? length - 5 : length), e->d_name);
        const char *file = name == NULL ? NULL : arena_text(a, "%s/%s", path, e->d_name);
        struct stat about;
        if (e->d_name[0] == '.' || (depth == 0 && strcmp(e->d_name, "readings") == 0))
            continue; /* readings are no cases: readings.h */
        if (file == NULL)
            status = no_memory(fault);
        else if (stat(file, &about) == 0 && S_ISDIR(about.st_mode) && depth < MAX_DEPTH)
            status = scan(a, folder, name, depth + 1, out, fault);
        else if (yaml && !case_name_is_safe(name))
            status =
                fault_set(fault, STATUS_BAD_INPUT,
                          "%s: not a name of a case: lower-case letters, digits, - and _", file);
        else if (yaml)
            status = add_name(a, out, name, fault);
    }
    closedir(d);
    return status;
}

static int by_text(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool matches(const char *pattern, const char *name) {
    return fnmatch(pattern, name, 0) == 0;
}

/* Keep the names that some pattern matches; a pattern without a match is a fault. */
static void choose(const struct selection_request *r, struct names *list, struct fault *fault) {
    for (size_t p = 0; p < r->pattern_count; p++) {
        size_t hits = 0;
        for (size_t i = 0; i < list->count; i++)
            hits += matches(r->pattern[p], list->name[i]);
        if (hits > 0)
            continue;
        const char *near = schema_nearest(r->pattern[p], list->name, list->count);
        fault_add(fault, STATUS_NOT_FOUND, "%s: no such case in %s%s%s%s", r->pattern[p], r->folder,
                  near == NULL ? "" : "; did you mean ", near == NULL ? "" : near,
                  near == NULL ? "" : "?");
    }
    size_t kept = 0;
    for (size_t i = 0; i < list->count; i++) {
        bool hit = r->pattern_count == 0;
        for (size_t p = 0; p < r->pattern_count; p++)
            hit |= matches(r->pattern[p], list->name[i]);
        if (hit)
            list->name[kept++] = list->name[i];
    }
    list->count = kept;
}

static bool has_tag(const struct selection_request *r, const struct case_file *c) {
    for (size_t i = 0; i < r->tag_count; i++) {
        for (size_t k = 0; k < c->tag_count; k++) {
            if (strcmp(r->tag[i], c->tag[k]) == 0)
                return true;
        }
    }
    return r->tag_count == 0;
}

static bool named_in_full(const struct selection_request *r, const char *name) {
    for (size_t i = 0; i < r->pattern_count; i++) {
        if (strcmp(r->pattern[i], name) == 0)
            return true;
    }
    return false;
}

static struct case_file *find_loaded(const struct selection *s, const char *name) {
    for (size_t i = 0; i < s->all_count; i++) {
        if (strcmp(s->all[i]->name, name) == 0)
            return s->all[i];
    }
    return NULL;
}

/* Load a case once; findings are added to fault. */
static struct case_file *load(struct selection *s, const char *folder, const char *name,
                              struct fault *fault) {
    struct case_file *c = find_loaded(s, name);
    if (c != NULL)
        return c;
    struct fault found = FAULT_NONE;
    struct case_file **wider = arena_grow(&s->arena, s->all, s->all_count, sizeof *wider);
    if (wider == NULL) {
        no_memory(fault);
        return NULL;
    }
    s->all = wider;
    if (case_load(folder, name, &c, &found) != STATUS_OK) {
        for (const char *line = found.text; *line != '\0';) {
            size_t length = strcspn(line, "\n");
            fault_add(fault, found.status, "%.*s", (int)length, line);
            line += length + (line[length] == '\n');
        }
        return NULL;
    }
    s->all[s->all_count++] = c;
    return c;
}

static enum status load_chosen(struct selection *s, const struct selection_request *r,
                               const struct names *list, struct fault *fault) {
    s->order = arena_take(&s->arena, list->count, sizeof *s->order);
    if (s->order == NULL)
        return no_memory(fault);
    for (size_t i = 0; i < list->count; i++) {
        struct case_file *c = load(s, r->folder, list->name[i], fault);
        if (c == NULL && r->lenient && fault->status != STATUS_NO_MEMORY)
            *fault = FAULT_NONE;
        if (c == NULL || !has_tag(r, c))
            continue;
        if (!r->any_tier && !c->tier[r->tier].present) {
            if (named_in_full(r, c->name))
                fault_add(fault, STATUS_BAD_INPUT, "%s: case %s has no tier %s", c->path, c->name,
                          case_tier_name(r->tier));
            continue;
        }
        s->order[s->count++] = (struct plan_order){.file = c};
    }
    return fault->status;
}

/* Leave out the cases that start, directly or not, from this one. */
static void leave_out(struct selection *s, const char *name, enum tier tier) {
    size_t kept = 0;
    for (size_t i = 0; i < s->count; i++) {
        const char *start = s->order[i].file->tier[tier].start.case_name;
        for (int depth = 0; start != NULL && strcmp(start, name) != 0 && depth < MAX_DEPTH;
             depth++) {
            const struct case_file *from = find_loaded(s, start);
            start = from == NULL ? NULL : from->tier[tier].start.case_name;
        }
        if (start == NULL)
            s->order[kept++] = s->order[i];
    }
    s->count = kept;
}

/* Cases that others start from: the list grows while it is gone through. */
static enum status load_starts(struct selection *s, const struct selection_request *r,
                               struct fault *fault) {
    for (size_t i = 0; i < s->all_count; i++) {
        for (enum tier t = 0; t < TIER_COUNT; t++) {
            const struct case_start *start = &s->all[i]->tier[t].start;
            if (start->case_name == NULL || find_loaded(s, start->case_name) != NULL)
                continue;
            if (load(s, r->folder, start->case_name, fault) != NULL)
                continue;
            if (r->lenient && fault->status != STATUS_NO_MEMORY) {
                *fault = FAULT_NONE;
                leave_out(s, start->case_name, r->tier);
            } else {
                yaml_fault(start->node, fault, "start: case %s cannot be loaded", start->case_name);
                return fault->status;
            }
        }
    }
    return fault->status;
}

static enum status apply_skip(struct selection *s, const char *skip, struct fault *fault) {
    const char *equals = strchr(skip, '=');
    size_t hits = 0;
    if (equals == NULL || equals == skip || equals[1 + strspn(equals + 1, " ")] == '\0')
        return fault_add(fault, STATUS_BAD_INPUT, "--skip %s: must be CASE=reason", skip);
    const char *pattern = arena_text(&s->arena, "%.*s", (int)(equals - skip), skip);
    const char *reason = arena_copy(&s->arena, equals + 1);
    if (pattern == NULL || reason == NULL)
        return no_memory(fault);
    for (size_t i = 0; i < s->count; i++) {
        if (!matches(pattern, s->order[i].file->name))
            continue;
        s->order[i].skip_reason = reason;
        hits++;
    }
    if (hits == 0)
        fault_add(fault, STATUS_NOT_FOUND, "--skip %s: no selected case has this name", skip);
    return fault->status;
}

static enum status select_cases(struct selection *s, const struct selection_request *r,
                                struct fault *fault) {
    struct names list = {0};
    enum status status = scan(&s->arena, r->folder, "", 0, &list, fault);
    if (status != STATUS_OK)
        return status;
    if (r->any_tier && readings_check_folder(r->folder, fault) != STATUS_OK)
        return fault->status;
    if (list.count > 0)
        qsort(list.name, list.count, sizeof *list.name, by_text);
    choose(r, &list, fault);
    if (fault->status == STATUS_OK)
        load_chosen(s, r, &list, fault);
    if (fault->status == STATUS_OK)
        load_starts(s, r, fault);
    size_t skipped = 0;
    for (size_t i = 0; fault->status == STATUS_OK && i < r->skip_count; i++)
        apply_skip(s, r->skip[i], fault);
    for (size_t i = 0; i < s->count; i++)
        skipped += s->order[i].skip_reason != NULL;
    if (fault->status == STATUS_OK && skipped == s->count)
        fault_set(fault, STATUS_NOT_FOUND, "nothing selected: %s",
                  skipped > 0 ? "every case is skipped" : "no case fits what was asked for");
    return fault->status;
}

enum status selection_make(const struct selection_request *r, struct selection **out,
                           struct fault *fault) {
    *out = NULL;
    struct selection *s = calloc(1, sizeof *s);
    if (s == NULL)
        return no_memory(fault);
    struct fault found = FAULT_NONE;
    enum status status = select_cases(s, r, &found);
    if (status != STATUS_OK) {
        *fault = found;
        selection_free(s);
        return status;
    }
    *out = s;
    return STATUS_OK;
}

void selection_free(struct selection *s) {
    if (s == NULL)
        return;
    for (size_t i = 0; i < s->all_count; i++)
        case_free(s->all[i]);
    arena_free(&s->arena);
    free(s);
}
