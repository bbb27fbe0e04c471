#include "validation/unchanged.h"

#include "validation/bits.h"

#include <string.h>

static bool has_bits(const struct references *r, enum tier tier) {
    for (size_t i = 0; r != NULL && i < r->count; i++) {
        if (r->item[i].origin == ORIGIN_BITS && r->item[i].tier == tier)
            return true;
    }
    return false;
}

enum status unchanged_look(const struct plan_case *c, const struct references *references,
                           const struct folder *results, const struct measured_point *p,
                           const struct measured_run *r, enum unchanged *out, struct fault *fault) {
    const struct case_file *file = case_runs(c->file);
    enum tier tier = (enum tier)(c->tier - c->file->tier);
    struct arena a = {0};
    struct bits_build build;
    struct digest now;
    *out = UNCHANGED_UNKNOWN;
    if (!r->usable || !has_bits(references, tier))
        return STATUS_OK;
    const char *record = folder_run_record(results, &a, r->run);
    enum status status = record == NULL ? fault_set(fault, STATUS_NO_MEMORY, "bits: out of memory")
                                        : bits_read_build(record, &build, fault);
    if (status != STATUS_OK)
        goto done;
    const struct reference *line =
        reference_find_bits(references, tier, p->point, r->run, build.name);
    if (line == NULL || !reference_is_meant(line, reference_run_meaning(r->run)))
        goto done;
    status = bits_of_result(r->result_path, file->dataset, file->dataset_count, &now, fault);
    if (status == STATUS_OK)
        *out = strcmp(now.hex, line->digest) == 0 ? UNCHANGED_SAME : UNCHANGED_OTHER;
done:
    arena_free(&a);
    return status;
}

void unchanged_add(struct unchanged_count *n, enum unchanged u) {
    n->same += u == UNCHANGED_SAME;
    n->other += u == UNCHANGED_OTHER;
    n->unknown += u == UNCHANGED_UNKNOWN;
}

const char *unchanged_text(const struct unchanged_count *n, struct arena *a) {
    size_t all = n->same + n->other + n->unknown;
    if (n->other > 0)
        return arena_text(a, "other bits than the reference in %zu of %zu runs", n->other, all);
    if (n->same == 0)
        return NULL;
    return n->unknown == 0
               ? arena_text(a, "same bits as the reference")
               : arena_text(a, "same bits as the reference in %zu of %zu runs", n->same, all);
}
