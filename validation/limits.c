#include "validation/limits.h"

#include "common/file.h"
#include "common/schema.h"
#include "validation/claims.h"

#include <string.h>

static const struct schema_field file_fields[] = {{"limits", SCHEMA_LIST, true, 0, 0, NULL}};
static const struct schema_field limit_fields[] = {{"model", SCHEMA_TEXT, true, 0, 0, NULL},
                                                   {"what", SCHEMA_TEXT, true, 0, 0, NULL},
                                                   {"because", SCHEMA_TEXT, true, 0, 0, NULL}};

/* Text in the arena without the line's end that a folded scalar has; NULL: blank or no memory. */
static const char *text_of(const struct yaml_node *map, const char *key, struct arena *a,
                           struct fault *fault) {
    const struct yaml_node *n = yaml_get(map, key);
    size_t length = strlen(n->text);
    while (length > 0 && strchr(" \n\t", n->text[length - 1]) != NULL)
        length--;
    if (length == 0) {
        yaml_fault(n, fault, "%s: must not be empty", key);
        return NULL;
    }
    const char *text = arena_text(a, "%.*s", (int)length, n->text);
    if (text == NULL)
        fault_set(fault, STATUS_NO_MEMORY, "limits: out of memory");
    return text;
}

static enum status read_limit(const struct yaml_node *n, struct arena *a, struct report_limit *out,
                              struct fault *fault) {
    if (n->kind != YAML_MAP)
        return yaml_fault(n, fault, "limits: each must be {model: , what: , because: }");
    enum status status = schema_check(n, "limit", limit_fields, 3, fault);
    if (status != STATUS_OK)
        return status;
    out->model = text_of(n, "model", a, fault);
    out->what = text_of(n, "what", a, fault);
    out->because = text_of(n, "because", a, fault);
    return out->model != NULL && out->what != NULL && out->because != NULL ? STATUS_OK
                                                                           : fault->status;
}

static bool has_model(const struct report *r, const char *model) {
    size_t length = strlen(model);
    for (size_t i = 0; i < r->case_count; i++) {
        if (strncmp(r->cases[i].name, model, length) == 0 && r->cases[i].name[length] == '/')
            return true;
    }
    return false;
}

static enum status add_all(const struct yaml_node *list, struct report *r, struct arena *a,
                           struct fault *fault) {
    struct report_limit *limit = arena_take(a, list->count, sizeof *limit), next;
    if (limit == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "limits: out of memory");
    r->limit = limit;
    for (int any = 0; any < 2; any++) {
        for (size_t i = 0; i < list->count; i++) {
            enum status status = read_limit(&list->child[i], a, &next, fault);
            if (status != STATUS_OK)
                return status;
            bool is_any = strcmp(next.model, "any") == 0;
            if (any ? is_any : !is_any && has_model(r, next.model))
                limit[r->limit_count++] = next;
        }
    }
    return STATUS_OK;
}

enum status limits_add(const char *cases_folder, struct report *r, struct arena *a,
                       struct fault *fault) {
    struct yaml_document *d = NULL;
    const char *path = claims_beside(cases_folder, "limits.yaml", a);
    r->limit_count = 0;
    if (path == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "limits: out of memory");
    if (!file_exists(path))
        return STATUS_OK;
    enum status status = yaml_load(path, YAML_CASE_MAX_BYTES, &d, fault);
    if (status == STATUS_OK)
        status = schema_check(yaml_root(d), "file", file_fields, 1, fault);
    if (status == STATUS_OK)
        status = add_all(yaml_get(yaml_root(d), "limits"), r, a, fault);
    yaml_free(d);
    return status;
}
