/* figure_svg.c -- gnuplot's SVG file made an element of a page; see draw.h. */
#include "report/draw.h"
#include "report/escape.h"
#include "report/shrink.h"

#include <string.h>

enum status draw_embed_svg(const char *file, const struct report_figure *f, const char *prefix,
                           struct sheet *svg, struct fault *fault) {
    const char *box = strstr(file, "viewBox=\""), *body = strstr(file, "</desc>");
    if (!box || !body)
        return fault_set(fault, STATUS_IO, "figure %s: gnuplot's output is no SVG", f->name);
    box += strlen("viewBox=\"");
    size_t box_length = strcspn(box, "\"");
    enum status status = sheet_open(svg, fault);
    if (status)
        return status;
    fprintf(svg->out,
            "<svg id=\"%ssvg\" xmlns=\"http://www.w3.org/2000/svg\" "
            "xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"%.*s\" "
            "role=\"img\" style=\"" SHRINK_STYLE "\" aria-describedby=\"%sdesc\">\n<title>",
            prefix, (int)box_length, box, prefix);
    escape_markup(svg->out, f->title);
    fprintf(svg->out, "</title>\n<desc id=\"%sdesc\">", prefix);
    escape_markup(svg->out, f->alt);
    fprintf(svg->out, "</desc>\n");
    shrink_svg(svg->out, body + strlen("</desc>"), prefix);
    status = sheet_close(svg, fault);
    if (status)
        sheet_free(svg);
    return status;
}
