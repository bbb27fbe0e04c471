/* html_gallery.h -- the gallery of the page, and the ids it links to; only html*.c include this. */
#ifndef REPORT_HTML_GALLERY_H
#define REPORT_HTML_GALLERY_H

#include "report/gallery.h"
#include "report/html.h"

/* What the papers' figures show, and ours; nothing if the report has no gallery. */
enum status html_gallery(struct page *p, struct fault *fault);

/* "plot-case-NAME-2": an attribute's value. */
void html_gallery_id(struct page *p, const struct report_case *c, enum gallery_kind kind,
                     size_t index);

/* The number under which the gallery draws f ("figure3-svg"); 0: it does not, or not yet. */
size_t html_gallery_figure(const struct page *p, const struct report_figure *f);

#endif
