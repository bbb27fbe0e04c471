/* html_case.c -- one case's section: what is tested and why, pictures and figures, tables, checks
 * with their seeds and tolerances, and the command that runs it again. */
#include "report/html.h"

static void put_head(struct page *p, const struct report_case *c) {
    fprintf(p->out, "<section class=\"case\" id=\"");
    html_case_id(p, c);
    fprintf(p->out, "\" data-verdict=\"%s\" data-model=\"", html_case_class(c));
    html_model(p, c);
    fprintf(p->out, "\">\n<h2>");
    html_text(p, "", c->title && *c->title ? c->title : c->name, " ");
    html_case_badge(p, c);
    html_text(p, "</h2>\n<div class=\"body\">\n<p class=\"origin\"><code>", c->name, "</code>");
    if (c->source && *c->source)
        html_text(p, " · ", c->source, "");
    fprintf(p->out, "</p>\n");
    if (c->question && *c->question)
        html_text(p, "<p class=\"question\">", c->question, "</p>\n");
    if (c->equation && *c->equation)
        html_text(p, "<p class=\"equation\">", c->equation, "</p>\n");
    if (c->skipped)
        html_text(p, "<p>This case was not run: ", c->skip_reason, "</p>\n");
}

static void put_command(struct page *p, const struct report_case *c) {
    if (!c->command || !*c->command)
        return;
    fprintf(p->out, "<div class=\"command\"><p>To run just this case again:</p>\n");
    html_pre(p, c->command);
    fprintf(p->out, "</div>\n");
}

enum status html_case(struct page *p, const struct report_case *c, struct fault *fault) {
    put_head(p, c);
    enum status status = html_media(p, c, fault);
    if (status)
        return status;
    html_rows(p, c);
    put_command(p, c);
    fprintf(p->out, "<p class=\"back\"><a href=\"#top\">Back to the overview</a></p>\n"
                    "</div>\n</section>\n");
    return STATUS_OK;
}
