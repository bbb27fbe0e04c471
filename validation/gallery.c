#include "validation/gallery.h"

#include "common/file.h"
#include "common/schema.h"
#include "validation/claims.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_NAMES = 64 };

static const struct schema_field file_fields[] = {{"figures", SCHEMA_LIST, true, 0, 0, NULL}};
static const struct schema_field entry_fields[] = {
    {"paper", SCHEMA_TEXT, true, 0, 0, NULL}, {"figure", SCHEMA_TEXT, true, 0, 0, NULL},
    {"shows", SCHEMA_TEXT, true, 0, 0, NULL}, {"axes", SCHEMA_TEXT, true, 0, 0, NULL},
    {"note", SCHEMA_TEXT, false, 0, 0, NULL}, {"none", SCHEMA_TEXT, false, 0, 0, NULL},
    {"ours", SCHEMA_LIST, false, 0, 0, NULL}};
static const struct schema_field source_fields[] = {{"case", SCHEMA_TEXT, true, 0, 0, NULL},
                                                    {"recipe", SCHEMA_TEXT, true, 0, 0, NULL},
                                                    {"title", SCHEMA_TEXT, false, 0, 0, NULL}};

struct reader {
    struct gallery *g;
    const char *folder; /* of cases */
    struct fault *fault;
};

static const char *text_of(struct reader *r, const struct yaml_node *map, const char *key) {
    const struct yaml_node *n = yaml_get(map, key);
    if (n != NULL && n->text[strspn(n->text, " \t\n")] == '\0')
        yaml_fault(n, r->fault, "%s: must not be empty", key);
    return n == NULL ? NULL : n->text;
}

static bool is_meant(const struct gallery_source *s, const struct case_figure *f) {
    return strcmp(f->recipe, s->recipe) == 0 &&
           (s->title == NULL || (f->title != NULL && strcmp(f->title, s->title) == 0));
}

/* The nearest recipe, or title of that recipe's figures. */
static void say_none(struct reader *r, const struct gallery_source *s, const struct case_file *c) {
    const char *name[MAX_NAMES];
    size_t count = 0;
    bool known = false;
    for (size_t i = 0; i < c->figure_count; i++)
        known |= strcmp(c->figure[i].recipe, s->recipe) == 0;
    for (size_t i = 0; i < c->figure_count && count < MAX_NAMES; i++) {
        const struct case_figure *f = &c->figure[i];
        const char *one = !known ? f->recipe : strcmp(f->recipe, s->recipe) == 0 ? f->title : NULL;
        if (one != NULL)
            name[count++] = one;
    }
    const char *near = schema_nearest(known ? s->title : s->recipe, name, count);
    yaml_fault(s->node, r->fault, "%s: no figure %s '%s' there%s%s%s", s->case_name,
               known ? "with the title" : "by", known ? s->title : s->recipe,
               near == NULL ? "" : "; did you mean '", near == NULL ? "" : near,
               near == NULL ? "" : "'?");
}

static void find_figure(struct reader *r, struct gallery_source *s, const struct case_file *c) {
    size_t hits = 0;
    for (size_t i = c->figure_count; i > 0; i--) {
        if (!is_meant(s, &c->figure[i - 1]))
            continue;
        hits++;
        s->figure = i - 1;
    }
    if (hits == 0)
        say_none(r, s, c);
    else if (hits > 1)
        yaml_fault(s->node, r->fault, "%s: %zu figures by %s there: which `title`?", s->case_name,
                   hits, s->recipe);
    for (enum tier t = 0; hits == 1 && t < TIER_COUNT; t++)
        s->in_tier[t] = c->tier[t].present && c->figure[s->figure].in_tier[t];
}

static void read_source(struct reader *r, const struct yaml_node *n, struct gallery_source *out) {
    struct case_file *c = NULL;
    struct fault why = FAULT_NONE;
    out->node = n;
    if (n->kind != YAML_MAP) {
        yaml_fault(n, r->fault, "ours: each must be {case: , recipe: }");
        return;
    }
    if (schema_check(n, "figure of ours", source_fields, 3, r->fault) != STATUS_OK)
        return;
    out->case_name = text_of(r, n, "case");
    out->recipe = text_of(r, n, "recipe");
    out->title = text_of(r, n, "title");
    if (!case_name_is_safe(out->case_name))
        yaml_fault(yaml_get(n, "case"), r->fault, "%s: no name of a case", out->case_name);
    else if (case_load(r->folder, out->case_name, &c, &why) != STATUS_OK)
        yaml_fault(yaml_get(n, "case"), r->fault, "%s", why.text);
    else
        find_figure(r, out, c);
    case_free(c);
}

static void read_entry(struct reader *r, const struct yaml_node *n, struct gallery_entry *out) {
    const struct yaml_node *ours = n->kind == YAML_MAP ? yaml_get(n, "ours") : NULL;
    out->node = n;
    if (n->kind != YAML_MAP) {
        yaml_fault(n, r->fault, "figures: each must be a map");
        return;
    }
    if (schema_check(n, "figure", entry_fields, 7, r->fault) != STATUS_OK)
        return;
    out->paper = text_of(r, n, "paper");
    out->figure = text_of(r, n, "figure");
    out->shows = text_of(r, n, "shows");
    out->axes = text_of(r, n, "axes");
    out->note = text_of(r, n, "note");
    out->none = text_of(r, n, "none");
    size_t count = ours == NULL ? 0 : ours->count;
    if ((count == 0) != (out->none != NULL))
        yaml_fault(n, r->fault, "%s, %s: either `ours` or `none`, why there is none", out->paper,
                   out->figure);
    for (const struct gallery_entry *e = r->g->entry; e < out; e++) {
        if (e->paper != NULL && strcmp(e->paper, out->paper) == 0 &&
            strcmp(e->figure, out->figure) == 0)
            yaml_fault(n, r->fault, "%s, %s stands in line %zu, too", out->paper, out->figure,
                       e->node->line);
    }
    out->source = arena_take(&r->g->arena, count, sizeof *out->source);
    if (out->source == NULL) {
        fault_set(r->fault, STATUS_NO_MEMORY, "gallery: out of memory");
        return;
    }
    out->count = count;
    for (size_t i = 0; i < count; i++)
        read_source(r, &ours->child[i], &out->source[i]);
}

static void read_file(struct reader *r, const char *path) {
    struct gallery *g = r->g;
    if (yaml_load(path, YAML_CASE_MAX_BYTES, &g->document, r->fault) != STATUS_OK)
        return;
    const struct yaml_node *root = yaml_root(g->document);
    if (root->kind != YAML_MAP) {
        yaml_fault(root, r->fault, "gallery: must be {figures: [...]}");
        return;
    }
    if (schema_check(root, "gallery", file_fields, 1, r->fault) != STATUS_OK)
        return;
    const struct yaml_node *list = yaml_get(root, "figures");
    g->entry = arena_take(&g->arena, list->count, sizeof *g->entry);
    if (g->entry == NULL) {
        fault_set(r->fault, STATUS_NO_MEMORY, "gallery: out of memory");
        return;
    }
    g->count = list->count;
    for (size_t i = 0; i < list->count; i++)
        read_entry(r, &list->child[i], &g->entry[i]);
}

enum status gallery_load(const char *cases_folder, struct gallery **out, struct fault *fault) {
    struct fault found = FAULT_NONE;
    struct gallery *g = calloc(1, sizeof *g);
    struct reader r = {g, cases_folder, &found};
    *out = NULL;
    const char *path = g == NULL ? NULL : claims_beside(cases_folder, "gallery.yaml", &g->arena);
    if (path == NULL) {
        gallery_free(g);
        return fault_set(fault, STATUS_NO_MEMORY, "gallery: out of memory");
    }
    if (file_exists(path))
        read_file(&r, path);
    if (found.status != STATUS_OK) {
        gallery_free(g);
        *fault = found;
        return found.status;
    }
    *out = g;
    return STATUS_OK;
}

void gallery_free(struct gallery *g) {
    if (g == NULL)
        return;
    yaml_free(g->document);
    arena_free(&g->arena);
    free(g);
}
