/* html_gallery.c -- the papers' figures in words, and ours: plots here, pictures linked to where
 * they stand, for they are large. */
#include "report/html_gallery.h"

static const char *const kind_name[GALLERY_KINDS] = {"plot", "picture", "sequence", "animation"};

void html_gallery_id(struct page *p, const struct report_case *c, enum gallery_kind kind,
                     size_t index) {
    fprintf(p->out, "%s-", kind_name[kind]);
    html_case_id(p, c);
    fprintf(p->out, "-%zu", index + 1);
}

static const char *title_of(const struct report_case *c, enum gallery_kind kind, size_t i) {
    switch (kind) {
    case GALLERY_PICTURE:
        return c->picture[i].title;
    case GALLERY_SEQUENCE:
        return c->sequence[i].title;
    case GALLERY_ANIMATION:
        return c->animation[i].title;
    default:
        return c->figure[i].title;
    }
}

static void put_links(struct page *p, const struct report_gallery_item *item) {
    static const char *const word[GALLERY_KINDS] = {"", "Picture: ", "Sequence: ", "Animation: "};
    for (enum gallery_kind kind = GALLERY_PICTURE; kind < GALLERY_KINDS; kind++) {
        for (size_t i = item->begin[kind]; i < item->end[kind]; i++) {
            fprintf(p->out, "<p>%s<a href=\"#", word[kind]);
            html_gallery_id(p, item->in, kind, i);
            html_text(p, "\">", title_of(item->in, kind, i), "</a>, ");
            html_text(p, "<code>", item->case_name, "</code></p>\n");
        }
    }
}

static enum status put_item(struct page *p, const struct report_gallery_item *item,
                            struct fault *fault) {
    enum status status = STATUS_OK;
    if (item->missing != NULL) {
        html_text(p, "<p>None of ours here: <code>", item->case_name, "</code>, ");
        html_text(p, "", item->missing, "</p>\n");
        return STATUS_OK;
    }
    put_links(p, item);
    for (size_t i = item->begin[GALLERY_PLOT]; !status && i < item->end[GALLERY_PLOT]; i++) {
        fprintf(p->out, "<p><a href=\"#");
        html_gallery_id(p, item->in, GALLERY_PLOT, i);
        html_text(p, "\">In its place in <code>", item->case_name, "</code></a></p>\n");
        status = html_figure(p, &item->in->figure[i], fault);
    }
    return status;
}

size_t html_gallery_figure(const struct page *p, const struct report_figure *f) {
    const struct report_gallery *g = p->report->gallery;
    size_t number = p->gallery;
    for (size_t i = 0; number > 0 && i < g->count; i++) {
        for (size_t k = 0; k < g->entry[i].count; k++) {
            const struct report_gallery_item *item = &g->entry[i].item[k];
            size_t begin = item->begin[GALLERY_PLOT], end = item->end[GALLERY_PLOT];
            for (size_t n = begin; item->missing == NULL && n < end; n++, number++) {
                if (&item->in->figure[n] == f)
                    return number;
            }
        }
    }
    return 0;
}

static enum status put_entry(struct page *p, const struct report_gallery_entry *e,
                             struct fault *fault) {
    enum status status = STATUS_OK;
    html_text(p, "<div class=\"gallery\">\n<h3>", e->paper, ", ");
    html_text(p, "", e->figure, "</h3>\n");
    html_text(p, "<p><b>Theirs:</b> ", e->shows, "</p>\n");
    html_text(p, "<p class=\"caption\">", e->axes, "</p>\n");
    if (e->note != NULL)
        html_text(p, "<p><b>Ours:</b> ", e->note, "</p>\n");
    if (e->none != NULL)
        html_text(p, "<p><b>None of ours:</b> ", e->none, "</p>\n");
    for (size_t i = 0; i < e->count && !status; i++)
        status = put_item(p, &e->item[i], fault);
    fprintf(p->out, "</div>\n");
    return status;
}

enum status html_gallery(struct page *p, struct fault *fault) {
    const struct report_gallery *g = p->report->gallery;
    enum status status = STATUS_OK;
    if (g == NULL || g->count == 0)
        return STATUS_OK;
    p->gallery = p->figures + 1;
    fprintf(p->out, "<section id=\"gallery\">\n<h2>The papers' figures, and ours</h2>\n");
    for (size_t i = 0; i < g->count && !status; i++)
        status = put_entry(p, &g->entry[i], fault);
    fprintf(p->out, "</section>\n");
    return status;
}
