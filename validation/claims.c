#include "validation/claims.h"

#include "common/file.h"
#include "common/schema.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const struct schema_field file_fields[] = {{"paper", SCHEMA_TEXT, true, 0, 0, NULL},
                                                  {"title", SCHEMA_TEXT, true, 0, 0, NULL},
                                                  {"claims", SCHEMA_LIST, true, 0, 0, NULL}};
static const struct schema_field claim_fields[] = {
    {"id", SCHEMA_TEXT, true, 0, 0, NULL},         {"where", SCHEMA_TEXT, true, 0, 0, NULL},
    {"says", SCHEMA_TEXT, true, 0, 0, NULL},       {"reading", SCHEMA_TEXT, false, 0, 0, NULL},
    {"tests", SCHEMA_LIST, false, 0, 0, NULL},     {"verdict", SCHEMA_TEXT, true, 0, 0, NULL},
    {"otherwise", SCHEMA_TEXT, false, 0, 0, NULL}, {"because", SCHEMA_TEXT, true, 0, 0, NULL},
    {"proof", SCHEMA_TEXT, false, 0, 0, NULL},     {"untested", SCHEMA_TEXT, false, 0, 0, NULL}};
static const char *const result_name[] = {"pass", "fail", NULL};
static const struct schema_field test_fields[] = {
    {"case", SCHEMA_TEXT, true, 0, 0, NULL},
    {"check", SCHEMA_TEXT, true, 0, 0, NULL},
    {"points", SCHEMA_MAP, false, 0, 0, NULL},
    {"result", SCHEMA_CHOICE, false, 0, 0, result_name}};

struct reader {
    struct claims *c;
    const char *paper;
    struct fault *fault;
};

static void no_memory(struct reader *r) {
    fault_set(r->fault, STATUS_NO_MEMORY, "claims: out of memory");
}

/* -- one claim ------------------------------------------------------------------------ */

/* Text of a key, NULL where it is not given; blank text is refused. */
static const char *text_of(struct reader *r, const struct yaml_node *map, const char *key) {
    const struct yaml_node *n = yaml_get(map, key);
    if (n != NULL && n->text[strspn(n->text, " \t\n")] == '\0')
        yaml_fault(n, r->fault, "%s: must not be empty", key);
    return n == NULL ? NULL : n->text;
}

static enum claim_verdict read_verdict(struct reader *r, const struct yaml_node *n) {
    enum claim_verdict v = CLAIM_NOT_TESTED;
    const char *names[CLAIM_VERDICTS];
    if (claim_verdict_find(n->text, &v) && v != CLAIM_UNDECIDED)
        return v;
    for (enum claim_verdict i = 0; i < CLAIM_VERDICTS; i++)
        names[i] = claim_verdict_name(i);
    const char *near = v == CLAIM_UNDECIDED ? NULL : schema_nearest(n->text, names, CLAIM_VERDICTS);
    yaml_fault(n, r->fault, "%s: %s is no verdict of a claim%s%s%s", n->key, n->text,
               near == NULL ? "" : "; did you mean '", near == NULL ? "" : near,
               near == NULL ? "" : "'?");
    return v;
}

static void read_points(struct reader *r, const struct yaml_node *map, struct case_filter *out) {
    for (size_t i = 0; map != NULL && i < map->count; i++) {
        const struct yaml_node *v = &map->child[i];
        bool good = v->kind == YAML_SCALAR || (v->kind == YAML_LIST && v->count > 0);
        for (size_t k = 0; v->kind == YAML_LIST && k < v->count; k++)
            good = good && v->child[k].kind == YAML_SCALAR;
        if (!good)
            yaml_fault(v, r->fault, "%s: must be a value or a list of values", v->key);
    }
    if (map != NULL)
        *out = (struct case_filter){map->count, map};
}

static void read_test(struct reader *r, const struct yaml_node *n, struct claim_test *out) {
    if (n->kind != YAML_MAP) {
        yaml_fault(n, r->fault, "tests: each must be {case: , check: }");
        return;
    }
    if (schema_check(n, "test", test_fields, 4, r->fault) != STATUS_OK)
        return;
    const struct yaml_node *result = yaml_get(n, "result");
    out->case_name = text_of(r, n, "case");
    out->check = text_of(r, n, "check");
    out->wants_pass = result == NULL || strcmp(result->text, "pass") == 0;
    read_points(r, yaml_get(n, "points"), &out->points);
}

static void read_tests(struct reader *r, const struct yaml_node *list, struct claim *out) {
    out->test = arena_take(&r->c->arena, list == NULL ? 0 : list->count, sizeof *out->test);
    if (out->test == NULL) {
        no_memory(r);
        return;
    }
    out->test_count = list == NULL ? 0 : list->count;
    for (size_t i = 0; i < out->test_count; i++) {
        out->test[i].node = &list->child[i];
        read_test(r, &list->child[i], &out->test[i]);
    }
}

/* "3" or "S2": a section of docs/theory.md. */
static bool is_section(const char *text) {
    text += *text == 'S';
    return *text != '\0' && text[strspn(text, "0123456789")] == '\0';
}

/* What verdict, tests and reasons owe to each other. */
static void check_claim(struct reader *r, const struct claim *c) {
    const struct yaml_node *n = c->node, *otherwise = yaml_get(n, "otherwise");
    bool wrong = c->verdict == CLAIM_WRONG || c->otherwise == CLAIM_WRONG;
    if (c->test_count == 0 && c->untested == NULL)
        yaml_fault(n, r->fault, "%s: no tests; say why with `untested`", c->id);
    if (c->test_count > 0 && c->untested != NULL)
        yaml_fault(n, r->fault, "%s: `untested`, but there are tests", c->id);
    if ((c->test_count > 0) != (otherwise != NULL))
        yaml_fault(n, r->fault, "%s: `otherwise` is for claims with tests, and needed there",
                   c->id);
    if (c->test_count > 0 && c->verdict == c->otherwise)
        yaml_fault(n, r->fault, "%s: %s whatever its tests say", c->id,
                   claim_verdict_name(c->verdict));
    if (c->test_count == 0 &&
        (c->verdict == CLAIM_REPRODUCED || c->verdict == CLAIM_NOT_REPRODUCED))
        yaml_fault(n, r->fault, "%s: %s without a test", c->id, claim_verdict_name(c->verdict));
    if (c->test_count > 0 && (c->verdict == CLAIM_NOT_TESTED || c->otherwise == CLAIM_NOT_TESTED))
        yaml_fault(n, r->fault, "%s: not tested, but there are tests", c->id);
    if (wrong && c->proof == NULL)
        yaml_fault(n, r->fault, "%s: wrong in the paper needs `proof`, a section of docs/theory.md",
                   c->id);
    if (c->proof != NULL && !is_section(c->proof))
        yaml_fault(yaml_get(n, "proof"), r->fault,
                   "proof: %s is no section of docs/theory.md, such as 3 or S2", c->proof);
}

static void check_id(struct reader *r, const struct claim *c) {
    if (strchr(c->id, '/') != NULL || !case_name_is_safe(c->id))
        yaml_fault(yaml_get(c->node, "id"), r->fault,
                   "id: %s: must have lower-case letters, digits, - and _", c->id);
    for (size_t i = 0; i < r->c->count; i++) {
        const struct claim *other = &r->c->claim[i];
        if (strcmp(other->id, c->id) == 0)
            yaml_fault(yaml_get(c->node, "id"), r->fault, "id: %s is that of %s:%zu, too", c->id,
                       other->node->file, other->node->line);
    }
}

static void read_claim(struct reader *r, const struct yaml_node *n) {
    struct claim c = {.paper = r->paper, .node = n};
    struct fault *f = r->fault;
    if (n->kind != YAML_MAP) {
        yaml_fault(n, f, "claims: each must be a map");
        return;
    }
    if (schema_check(n, "claim", claim_fields, sizeof claim_fields / sizeof *claim_fields, f) !=
        STATUS_OK)
        return;
    c.id = text_of(r, n, "id");
    c.where = text_of(r, n, "where");
    c.says = text_of(r, n, "says");
    c.because = text_of(r, n, "because");
    c.reading = text_of(r, n, "reading");
    c.proof = text_of(r, n, "proof");
    c.untested = text_of(r, n, "untested");
    c.verdict = c.otherwise = read_verdict(r, yaml_get(n, "verdict"));
    if (yaml_get(n, "otherwise") != NULL)
        c.otherwise = read_verdict(r, yaml_get(n, "otherwise"));
    read_tests(r, yaml_get(n, "tests"), &c);
    check_id(r, &c);
    check_claim(r, &c);
    struct claim *wider = arena_grow(&r->c->arena, r->c->claim, r->c->count, sizeof *wider);
    if (wider == NULL) {
        no_memory(r);
        return;
    }
    r->c->claim = wider;
    r->c->claim[r->c->count++] = c;
}

/* -- the files ---------------------------------------------------------------------------- */

static void read_file(struct reader *r, const char *path) {
    struct claims *c = r->c;
    struct yaml_document *d = NULL;
    struct yaml_document **wider =
        arena_grow(&c->arena, c->document, c->document_count, sizeof *wider);
    if (wider == NULL) {
        no_memory(r);
        return;
    }
    c->document = wider;
    struct fault found = FAULT_NONE;
    if (yaml_load(path, YAML_CASE_MAX_BYTES, &d, &found) != STATUS_OK) {
        fault_add(r->fault, found.status, "%s", found.text);
        return;
    }
    c->document[c->document_count++] = d;
    const struct yaml_node *root = yaml_root(d);
    if (root->kind != YAML_MAP) {
        yaml_fault(root, r->fault, "claims: must be {paper: , title: , claims: [...]}");
        return;
    }
    if (schema_check(root, "file of claims", file_fields, 3, r->fault) != STATUS_OK)
        return;
    r->paper = text_of(r, root, "paper");
    text_of(r, root, "title");
    const struct yaml_node *list = yaml_get(root, "claims");
    for (size_t i = 0; i < list->count; i++)
        read_claim(r, &list->child[i]);
}

static int by_text(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Paths of all files of the folder, sorted; what is no .yaml is refused. */
static const char **list_files(struct reader *r, const char *folder, size_t *count) {
    const char **path = NULL;
    DIR *d = opendir(folder);
    *count = 0;
    if (d == NULL && errno != ENOENT)
        fault_add(r->fault, STATUS_IO, "%s: cannot be read: %s", folder, strerror(errno));
    for (struct dirent *e; d != NULL && (e = readdir(d)) != NULL;) {
        size_t length = strlen(e->d_name);
        if (e->d_name[0] == '.')
            continue;
        const char **wider = arena_grow(&r->c->arena, path, *count, sizeof *wider);
        const char *one = arena_text(&r->c->arena, "%s/%s", folder, e->d_name);
        if (wider == NULL || one == NULL) {
            no_memory(r);
            break;
        }
        path = wider;
        if (length <= 5 || strcmp(e->d_name + length - 5, ".yaml") != 0)
            fault_add(r->fault, STATUS_BAD_INPUT, "%s: this folder is for claims alone, PAPER.yaml",
                      one);
        else
            path[(*count)++] = one;
    }
    if (d != NULL)
        closedir(d);
    if (*count > 0)
        qsort(path, *count, sizeof *path, by_text);
    return path;
}

const char *claims_beside(const char *cases_folder, const char *name, struct arena *a) {
    size_t length = strlen(cases_folder);
    while (length > 1 && cases_folder[length - 1] == '/')
        length--;
    size_t stem = length;
    while (stem > 0 && cases_folder[stem - 1] != '/')
        stem--;
    const char *last = cases_folder + stem;
    if (length - stem <= 2 && strspn(last, ".") >= length - stem) /* "..", "." or "/" */
        return arena_text(a, "%.*s/../%s", (int)length, cases_folder, name);
    return arena_text(a, "%.*s%s", (int)stem, cases_folder, name);
}

enum status claims_load(const char *cases_folder, struct claims **out, struct fault *fault) {
    struct fault found = FAULT_NONE;
    struct claims *c = calloc(1, sizeof *c);
    struct reader r = {c, NULL, &found};
    size_t count = 0;
    *out = NULL;
    const char *folder = c == NULL ? NULL : claims_beside(cases_folder, "claims", &c->arena);
    if (folder == NULL) {
        claims_free(c);
        return fault_set(fault, STATUS_NO_MEMORY, "claims: out of memory");
    }
    const char **path = list_files(&r, folder, &count);
    for (size_t i = 0; i < count; i++)
        read_file(&r, path[i]);
    if (found.status == STATUS_OK)
        claims_use(c, cases_folder, &found);
    if (found.status != STATUS_OK) {
        claims_free(c);
        *fault = found;
        return found.status;
    }
    *out = c;
    return STATUS_OK;
}

void claims_free(struct claims *c) {
    if (c == NULL)
        return;
    for (size_t i = 0; i < c->document_count; i++)
        yaml_free(c->document[i]);
    arena_free(&c->arena);
    free(c);
}
