/* figure_svg.c -- gnuplot's SVG file made an element of a page; see draw.h. */
#include "report/draw.h"
#include "report/escape.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static bool begins(const char *text, const char *start) {
    return strncmp(text, start, strlen(start)) == 0;
}

/* gnuplot's own names of groups repeat from panel to panel and nothing refers to them. */
static bool is_referred_to(const char *id) {
    return begins(id, "gp") || begins(id, "textbox") || begins(id, "greybox");
}

/* s is at ` id=Q`: copy the attribute with the prefix, or leave it out.  Returns what follows. */
static const char *copy_id(FILE *out, const char *s, const char *prefix) {
    char quote = s[4];
    const char *id = s + 5, *end = strchr(id, quote);
    if (!end)
        return s + strlen(s);
    if (is_referred_to(id))
        fprintf(out, " id='%s%.*s'", prefix, (int)(end - id), id);
    return end + 1;
}

static const char *skip_past(const char *s, const char *mark) {
    const char *found = strstr(s, mark);
    return found ? found + strlen(mark) : s + strlen(s);
}

/* Only inside of tags is anything changed: a label that reads " id='x'" stays what it is. */
static void copy_body(FILE *out, const char *s, const char *prefix) {
    bool in_tag = false;
    while (*s) {
        if (begins(s, "<title>")) { /* gnuplot's names again, shown as tool tips */
            s = skip_past(s, "</title>");
            continue;
        }
        if (in_tag && (begins(s, " id='") || begins(s, " id=\""))) {
            s = copy_id(out, s, prefix);
            continue;
        }
        if (in_tag && (begins(s, "href='#") || begins(s, "url(#"))) {
            size_t head = begins(s, "url") ? 5 : 7;
            fprintf(out, "%.*s%s", (int)head, s, prefix);
            s += head;
            continue;
        }
        in_tag = *s == '<' || (in_tag && *s != '>');
        fputc(*s++, out);
    }
}

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
            "<svg xmlns=\"http://www.w3.org/2000/svg\" "
            "xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"%.*s\" role=\"img\" "
            "aria-describedby=\"%sdesc\">\n<title>",
            (int)box_length, box, prefix);
    escape_markup(svg->out, f->title);
    fprintf(svg->out, "</title>\n<desc id=\"%sdesc\">", prefix);
    escape_markup(svg->out, f->alt);
    fprintf(svg->out, "</desc>\n");
    copy_body(svg->out, body + strlen("</desc>"), prefix);
    status = sheet_close(svg, fault);
    if (status)
        sheet_free(svg);
    return status;
}
