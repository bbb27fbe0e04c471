/* command_history.c -- bedcheck history: append a folder's summary, draw the trends. */
#include "validation/command.h"

#include "validation/history.h"

#include <stdlib.h>

static enum status append(const struct command_options *o, const struct console *c,
                          struct fault *fault) {
    struct results *r = NULL;
    bool added = false;
    enum status status = results_load(o->pattern[0], &r, fault);
    if (status == STATUS_OK)
        status = history_append(o->file, r, &added, fault);
    if (status == STATUS_OK)
        fprintf(c->out, "%s: %s: %s of commit %.12s, started %s\n", o->file,
                added ? "added" : "is there already", o->pattern[0], r->commit, r->started);
    results_free(r);
    return status;
}

static enum status plot(const struct command_options *o, const struct console *c,
                        struct fault *fault) {
    struct history *h = NULL;
    enum status status = history_load(o->plot, &h, fault);
    if (status == STATUS_OK && h->count == 0)
        status = fault_set(fault, STATUS_BAD_INPUT, "%s: is empty", o->plot);
    if (status == STATUS_OK)
        status = history_plot(h, o->out, fault);
    if (status == STATUS_OK)
        fprintf(c->out, "%s/index.html: %zu runs\n", o->out, h->count);
    history_free(h);
    return status;
}

int command_history(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    enum status status = STATUS_OK;
    bool appends = o->file != NULL && o->pattern_count == 1;
    if (!appends && (o->file != NULL || o->pattern_count > 0 || o->plot == NULL))
        status = fault_set(&fault, STATUS_BAD_INPUT,
                           "history: DIR --file FILE, --plot FILE [--out FOLDER], or both");
    if (status == STATUS_OK && appends)
        status = append(o, c, &fault);
    if (status == STATUS_OK && o->plot != NULL)
        status = plot(o, c, &fault);
    if (status != STATUS_OK)
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
    return status == STATUS_OK ? 0 : 2;
}
