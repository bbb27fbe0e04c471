/* html_media.c -- pictures, figures and tables of a case. */
#include "report/draw.h"
#include "report/escape.h"
#include "report/html.h"

#include "common/file.h"

#include <stdlib.h>

static void put_base64(FILE *out, const char *bytes, size_t length) {
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *b = (const unsigned char *)bytes;
    for (size_t i = 0; i < length; i += 3) {
        unsigned have = length - i < 3 ? (unsigned)(length - i) : 3;
        unsigned word = (unsigned)b[i] << 16;
        word |= have > 1 ? (unsigned)b[i + 1] << 8 : 0;
        word |= have > 2 ? (unsigned)b[i + 2] : 0;
        fputc(digit[word >> 18], out);
        fputc(digit[word >> 12 & 63], out);
        fputc(have > 1 ? digit[word >> 6 & 63] : '=', out);
        fputc(have > 2 ? digit[word & 63] : '=', out);
    }
}

/* "CASE.NAME.png": pictures of several cases share one folder. */
static enum status name_of_file(const struct report_case *c, const struct report_picture *picture,
                                struct sheet *name, struct fault *fault) {
    enum status status = sheet_open(name, fault);
    if (status)
        return status;
    escape_name(name->out, c->name);
    fputc('.', name->out);
    escape_name(name->out, picture->name);
    fputs(".png", name->out);
    status = sheet_close(name, fault);
    if (status)
        sheet_free(name);
    return status;
}

static enum status save_full_size(struct page *p, const struct report_picture *picture,
                                  const char *name, struct fault *fault) {
    struct drawing full;
    enum status status = draw_picture(picture, DRAW_FULL_PX_PER_L, &full, fault);
    if (status)
        return status;
    char *path = file_join(p->folder, name);
    status = path ? file_write(path, full.bytes, full.length, fault)
                  : fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
    free(path);
    free(full.bytes);
    return status;
}

static void put_picture(struct page *p, const struct report_picture *picture,
                        const struct drawing *drawing, const char *name) {
    fprintf(p->out, "<figure class=\"picture\">\n");
    html_text(p, "<h3>", picture->title, "</h3>\n");
    fprintf(p->out, "<a href=\"%s\"><img width=\"%d\" height=\"%d\" ", name, drawing->width_px / 2,
            drawing->height_px / 2);
    html_text(p, "alt=\"", picture->alt, "\" src=\"data:image/png;base64,");
    put_base64(p->out, drawing->bytes, drawing->length);
    html_text(p, "\"></a>\n<figcaption>", picture->caption, "");
    fprintf(p->out, " <a href=\"%s\">Full size</a></figcaption>\n</figure>\n", name);
}

static enum status picture(struct page *p, const struct report_case *c,
                           const struct report_picture *picture, struct fault *fault) {
    struct sheet name = {0};
    struct drawing small = {0};
    enum status status = name_of_file(c, picture, &name, fault);
    if (status)
        return status;
    if ((status = save_full_size(p, picture, name.text, fault)))
        goto done;
    if ((status = draw_picture(picture, DRAW_INLINE_PX_PER_L, &small, fault)))
        goto done;
    put_picture(p, picture, &small, name.text);
done:
    free(small.bytes);
    sheet_free(&name);
    return status;
}

static enum status figure(struct page *p, const struct report_figure *f, struct fault *fault) {
    char prefix[32];
    struct sheet svg = {0};
    snprintf(prefix, sizeof prefix, "figure%zu-", ++p->figures);
    enum status status = draw_figure(f, prefix, &svg, fault);
    if (status)
        return status;
    fprintf(p->out, "<figure class=\"plot\">\n");
    html_text(p, "<h3>", f->title, "</h3>\n");
    html_text(p, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Figure: ",
              f->title, "\">\n");
    fwrite(svg.text, 1, svg.length, p->out);
    fprintf(p->out, "</div>\n");
    if (f->caption && *f->caption)
        html_text(p, "<figcaption>", f->caption, "</figcaption>\n");
    fprintf(p->out, "</figure>\n");
    sheet_free(&svg);
    return STATUS_OK;
}

static void table(struct page *p, const struct report_table *t) {
    html_text(p, "<h3>", t->title, "</h3>\n");
    html_text(p,
              "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Table: ", t->title,
              "\">\n<table class=\"data\">\n<thead><tr>");
    for (size_t k = 0; k < t->columns; k++)
        html_text(p, "<th scope=\"col\">", t->heading[k], "</th>");
    fprintf(p->out, "</tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < t->rows; i++) {
        fprintf(p->out, "<tr>");
        for (size_t k = 0; k < t->columns; k++)
            html_text(p, "<td>", t->cell[i * t->columns + k], "</td>");
        fprintf(p->out, "</tr>\n");
    }
    fprintf(p->out, "</tbody></table></div>\n");
    if (t->caption && *t->caption)
        html_text(p, "<p class=\"caption\">", t->caption, "</p>\n");
}

enum status html_media(struct page *p, const struct report_case *c, struct fault *fault) {
    enum status status = STATUS_OK;
    if (c->picture_count > 0)
        fprintf(p->out, "<div class=\"pictures\">\n");
    for (size_t i = 0; i < c->picture_count && !status; i++)
        status = picture(p, c, &c->picture[i], fault);
    if (c->picture_count > 0)
        fprintf(p->out, "</div>\n");
    for (size_t i = 0; i < c->figure_count && !status; i++)
        status = figure(p, &c->figure[i], fault);
    for (size_t i = 0; i < c->table_count && !status; i++)
        table(p, &c->table[i]);
    return status ? fault_within(fault, "case %s", c->name) : STATUS_OK;
}
