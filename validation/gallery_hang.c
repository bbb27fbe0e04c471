/* gallery_hang.c -- the gallery of a report: what became of the figures that gallery.yaml names. */
#include "validation/assemble.h"
#include "validation/gallery.h"

#include <string.h>

static const char *why_missing(const struct gallery_source *s, const struct assemble_case *c,
                               enum tier tier, const struct report_gallery_item *item) {
    bool empty = true;
    if (c == NULL)
        return s->in_tier[tier] ? "case not selected" : "not in this tier";
    if (c->rows == NULL)
        return c->plan->skip_reason != NULL ? c->plan->skip_reason : c->not_run;
    for (int kind = 0; kind < GALLERY_KINDS; kind++)
        empty = empty && item->begin[kind] == item->end[kind];
    if (!empty)
        return NULL;
    return s->in_tier[tier] ? "its data do not suit: see there" : "not in this tier";
}

static void hang(const struct gallery_source *s, const struct gallery_input *in,
                 struct report_gallery_item *out) {
    const struct assemble_case *c = NULL;
    *out = (struct report_gallery_item){.case_name = s->case_name};
    for (size_t i = 0; c == NULL && i < in->case_count; i++) {
        if (strcmp(in->cases[i].plan->file->name, s->case_name) != 0)
            continue;
        c = &in->cases[i];
        if (in->item[i] != NULL)
            *out = in->item[i][s->figure];
        out->case_name = s->case_name;
        out->in = &in->report[i];
    }
    out->missing = why_missing(s, c, in->tier, out);
}

enum status gallery_hang(const struct gallery *g, const struct gallery_input *in, struct arena *a,
                         struct report_gallery *out, struct fault *fault) {
    struct report_gallery_entry *entry = arena_take(a, g->count, sizeof *entry);
    *out = (struct report_gallery){0};
    for (size_t i = 0; entry != NULL && i < g->count; i++) {
        const struct gallery_entry *e = &g->entry[i];
        struct report_gallery_item *item = arena_take(a, e->count, sizeof *item);
        if (item == NULL)
            return fault_set(fault, STATUS_NO_MEMORY, "gallery: out of memory");
        for (size_t k = 0; k < e->count; k++)
            hang(&e->source[k], in, &item[k]);
        entry[i] = (struct report_gallery_entry){e->paper, e->figure, e->shows, e->axes,
                                                 e->note,  e->none,   e->count, item};
    }
    if (entry == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "gallery: out of memory");
    *out = (struct report_gallery){g->count, entry};
    return STATUS_OK;
}
