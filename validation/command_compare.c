/* command_compare.c -- bedcheck compare: what a change has changed. */
#include "validation/command.h"

#include "validation/compare_references.h"
#include "validation/compare_write.h"
#include "validation/folder.h"

#include <string.h>

struct work {
    struct results *old, *new;
    struct compared *rows;
    struct compare_runs *runs;
    struct compare_references stored; /* in the place of `old` and `runs` */
};

/* --references, else those that the folder was judged with. */
static enum status find_references(const struct command_options *o, struct arena *a,
                                   const char **out, struct fault *fault) {
    struct folder *folder = NULL;
    struct folder_record record = {0};
    *out = o->references_folder;
    if (*out != NULL)
        return STATUS_OK;
    enum status status = folder_open(o->out, false, &folder, fault);
    if (status == STATUS_OK)
        status = folder_read_record(folder, &record, fault);
    if (status == STATUS_OK && record.references_folder == NULL)
        status = fault_set(fault, STATUS_NOT_FOUND,
                           "%s: judged without references: use --references", o->out);
    if (status == STATUS_OK && (*out = arena_copy(a, record.references_folder)) == NULL)
        status = fault_set(fault, STATUS_NO_MEMORY, "compare: out of memory");
    folder_record_free(&record);
    folder_close(folder);
    return status;
}

static enum status compare_stored(const struct command_options *o, struct work *w,
                                  struct fault *fault) {
    const char *folder = NULL;
    struct arena arena = {NULL};
    if (results_load(o->out, &w->new, fault) == STATUS_OK &&
        find_references(o, &arena, &folder, fault) == STATUS_OK &&
        compare_references_load(w->new, folder, &w->stored, fault) == STATUS_OK)
        compare_results(w->stored.old, w->stored.new, o->level, &w->rows, fault);
    arena_free(&arena);
    return fault->status;
}

static enum status compare_folders(const struct command_options *o, struct work *w,
                                   struct fault *fault) {
    if (results_load(o->out, &w->old, fault) != STATUS_OK ||
        results_load(o->other, &w->new, fault) != STATUS_OK ||
        compare_results(w->old, w->new, o->level, &w->rows, fault) != STATUS_OK)
        return fault->status;
    return w->rows->refusal != NULL ? STATUS_OK
                                    : compare_runs_read(w->old, w->new, o->level, &w->runs, fault);
}

static enum status tell(const struct command_options *o, const struct work *w, FILE *out,
                        struct fault *fault) {
    const struct compare_view view = {w->rows, w->stored.runs != NULL ? w->stored.runs : w->runs};
    switch (o->format) {
    case FORMAT_JSON:
        compare_write_json(&view, out);
        return STATUS_OK;
    case FORMAT_MARKDOWN:
        return compare_write_markdown(&view, out, fault);
    default:
        compare_write_text(&view, out);
        return STATUS_OK;
    }
}

int command_compare(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct work w = {0};
    enum status status =
        o->other == NULL ? compare_stored(o, &w, &fault) : compare_folders(o, &w, &fault);
    if (status == STATUS_OK)
        status = tell(o, &w, c->out, &fault);
    int code = status == STATUS_OK ? compare_exit_code(w.rows) : 2;
    if (status != STATUS_OK)
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
    compare_runs_free(w.runs);
    compare_free(w.rows);
    compare_references_free(&w.stored);
    results_free(w.new);
    results_free(w.old);
    return code;
}
