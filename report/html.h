/* html.h -- the parts of the page; only html*.c include this.
 *
 * One file that needs nothing else: style, figures (SVG) and pictures (PNG)
 * stand in it; no network, and no script but the one of html_script.c, which
 * only folds, filters and copies: a content policy forbids all others.  Every
 * foreign text passes escape_markup.  A verdict is always colour, symbol and
 * word.  Wide tables and figures scroll in boxes of their own, so that the page
 * itself never does.
 */
#ifndef REPORT_HTML_H
#define REPORT_HTML_H

#include "report/report.h"

#include <stdio.h>

struct page {
    FILE *out;
    const struct report *report;
    const char *folder; /* full-size pictures go here */
    size_t figures;     /* drawn so far: numbers their ids */
    size_t gallery;     /* number of the gallery's first figure, 0 before there is one */
};

/* before and after are markup of ours; text is foreign and escaped. */
void html_text(struct page *p, const char *before, const char *text, const char *after);

/* html.c: `<span class="verdict pass">...` */
void html_verdict(struct page *p, enum verdict verdict);
enum verdict html_case_verdict(const struct report_case *c);

/* An attribute's value: "case-NAME", "check-NAME-row". */
void html_case_id(struct page *p, const struct report_case *c);
void html_row_id(struct page *p, const struct report_case *c, size_t row);

/* A command to be copied, or a log: preformatted, scrolls in its box. */
void html_pre(struct page *p, const char *text);

const char *html_style(void);  /* html_style.c */
const char *html_script(void); /* html_script.c: folds, filters, copies; the page reads without */
void html_overview(struct page *p); /* html_overview.c: the first screen */
void html_origin(struct page *p);   /* html_overview.c: what did not fit there */
void html_matrix(struct page *p);   /* html_matrix.c */
enum status html_cover(struct page *p, struct fault *fault);     /* html_cover.c */
enum status html_agreement(struct page *p, struct fault *fault); /* html_agreement.c */

/* html_matrix.c: the model that a case's name begins with; its verdict as a class and as a badge.
 */
void html_model(struct page *p, const struct report_case *c);
const char *html_case_class(const struct report_case *c);
void html_case_badge(struct page *p, const struct report_case *c);

void html_ledger(struct page *p); /* html_ledger.c: what the papers claim; nothing if NULL */
enum status html_case(struct page *p, const struct report_case *c, struct fault *fault);
void html_rows(struct page *p, const struct report_case *c);    /* html_rows.c */
void html_margin(struct page *p, const struct report_row *row); /* html_rows.c */
enum status html_figure(struct page *p, const struct report_figure *f, struct fault *fault);
enum status html_media(struct page *p, const struct report_case *c, struct fault *fault);

#endif
