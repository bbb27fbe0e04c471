/* command_compare.c -- bedcheck compare: what a change has changed. */
#include "validation/command.h"

#include "validation/compare_write.h"

#include <string.h>

struct work {
    struct results *old, *new;
    struct compared *rows;
    struct compare_runs *runs;
};

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
    const struct compare_view view = {w->rows, w->runs};
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
    struct work w = {NULL, NULL, NULL, NULL};
    enum status status = compare_folders(o, &w, &fault);
    if (status == STATUS_OK)
        status = tell(o, &w, c->out, &fault);
    int code = status == STATUS_OK ? compare_exit_code(w.rows) : 2;
    if (status != STATUS_OK)
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
    compare_runs_free(w.runs);
    compare_free(w.rows);
    results_free(w.new);
    results_free(w.old);
    return code;
}
