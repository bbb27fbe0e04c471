#include "validation/earlier.h"

#include "common/file.h"
#include "validation/folder.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_RESULTS_BYTES = 64 << 20 };

static enum status add_case(struct earlier *e, const struct yaml_node *check, struct fault *fault) {
    const struct yaml_node *name = check->kind == YAML_MAP ? yaml_get(check, "case") : NULL;
    const struct yaml_node *verdict = check->kind == YAML_MAP ? yaml_get(check, "verdict") : NULL;
    if (name == NULL || verdict == NULL || name->kind != YAML_SCALAR ||
        verdict->kind != YAML_SCALAR || !case_name_is_safe(name->text))
        return yaml_fault(check, fault, "not a check with case and verdict");
    if (strcmp(verdict->text, "pass") == 0)
        return STATUS_OK;
    for (size_t i = 0; i < e->count; i++) {
        if (strcmp(e->name[i], name->text) == 0)
            return STATUS_OK;
    }
    const char **wider = arena_grow(&e->arena, e->name, e->count, sizeof *wider);
    const char *copy = arena_copy(&e->arena, name->text);
    if (wider == NULL || copy == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "--failed: out of memory");
    e->name = wider;
    e->name[e->count++] = copy;
    return STATUS_OK;
}

static enum status read_results(const char *path, struct earlier *e, struct fault *fault) {
    struct yaml_document *d = NULL;
    enum status status = yaml_load(path, MAX_RESULTS_BYTES, &d, fault); /* JSON is YAML */
    if (status != STATUS_OK)
        return status;
    const struct yaml_node *root = yaml_root(d);
    const struct yaml_node *checks = root->kind == YAML_MAP ? yaml_get(root, "checks") : NULL;
    if (checks == NULL || checks->kind != YAML_LIST)
        status = yaml_fault(root, fault, "checks: missing");
    for (size_t i = 0; status == STATUS_OK && i < checks->count; i++)
        status = add_case(e, &checks->child[i], fault);
    yaml_free(d);
    return status;
}

static enum status read_tier(const struct command_options *o, const struct folder *f,
                             struct earlier *out, struct fault *fault) {
    struct folder_record record;
    enum status status = folder_read_record(f, &record, fault);
    if (status != STATUS_OK)
        return status;
    status = case_tier_find(record.tier, &out->tier, fault);
    if (status == STATUS_OK && o->tier_given && o->tier != out->tier)
        status = fault_set(fault, STATUS_BAD_INPUT, "--failed: %s holds tier %s, not %s", o->out,
                           record.tier, case_tier_name(o->tier));
    folder_record_free(&record);
    return status;
}

enum status earlier_read(const struct command_options *o, struct earlier *out,
                         struct fault *fault) {
    *out = (struct earlier){0};
    struct folder *f = NULL;
    char *path = file_join(o->out, "results.json");
    enum status status = path == NULL
                             ? fault_set(fault, STATUS_NO_MEMORY, "--failed: out of memory")
                             : folder_open(o->out, false, &f, fault);
    if (status == STATUS_OK)
        status = read_tier(o, f, out, fault);
    if (status == STATUS_OK)
        status = read_results(path, out, fault);
    if (status == STATUS_OK && out->count == 0)
        status = fault_set(fault, STATUS_NOT_FOUND, "nothing selected: every check in %s passed",
                           o->out);
    folder_close(f);
    free(path);
    return status;
}

void earlier_free(struct earlier *e) {
    arena_free(&e->arena);
}
