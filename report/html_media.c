/* html_media.c -- sequences, animations, pictures, figures and tables of a case. */
#include "report/draw.h"
#include "report/escape.h"
#include "report/html_gallery.h"

#include "common/file.h"

#include <stdlib.h>
#include <string.h>

/* "CASE.NAME.png": pictures of several cases share one folder. */
static enum status name_of_file(const struct report_case *c, const char *what, const char *ending,
                                struct sheet *name, struct fault *fault) {
    enum status status = sheet_open(name, fault);
    if (status)
        return status;
    escape_name(name->out, c->name);
    fputc('.', name->out);
    escape_name(name->out, what);
    fputs(ending, name->out);
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

static void put_figure(struct page *p, const char *class, const struct report_case *c,
                       enum gallery_kind kind, size_t index) {
    fprintf(p->out, "<figure class=\"%s\" id=\"", class);
    html_gallery_id(p, c, kind, index);
    fprintf(p->out, "\">\n");
}

static void put_picture(struct page *p, const struct report_case *c,
                        const struct report_picture *picture, const struct drawing *drawing,
                        const char *name) {
    put_figure(p, "picture", c, GALLERY_PICTURE, (size_t)(picture - c->picture));
    html_text(p, "<h3>", picture->title, "</h3>\n");
    fprintf(p->out, "<a href=\"%s\"><img width=\"%d\" height=\"%d\" ", name, drawing->width_px / 2,
            drawing->height_px / 2);
    html_text(p, "alt=\"", picture->alt, "\" src=\"data:image/png;base64,");
    escape_base64(p->out, drawing->bytes, drawing->length);
    html_text(p, "\"></a>\n<figcaption>", picture->caption, "");
    fprintf(p->out, " <a href=\"%s\">Full size</a></figcaption>\n</figure>\n", name);
}

static enum status picture(struct page *p, const struct report_case *c,
                           const struct report_picture *picture, struct fault *fault) {
    struct sheet name = {0};
    struct drawing small = {0};
    enum status status = name_of_file(c, picture->name, ".png", &name, fault);
    if (status)
        return status;
    if ((status = save_full_size(p, picture, name.text, fault)))
        goto done;
    if ((status = draw_picture(picture, DRAW_INLINE_PX_PER_L, &small, fault)))
        goto done;
    put_picture(p, c, picture, &small, name.text);
done:
    free(small.bytes);
    sheet_free(&name);
    return status;
}

static enum status save(struct page *p, const char *name, struct sheet *s, struct fault *fault) {
    char *path = file_join(p->folder, name);
    enum status status = path ? sheet_save(s, path, fault)
                              : fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
    free(path);
    return status;
}

/* An SVG file as an image: of no cost to the page's tree, and as sharp as an element of it. */
static void put_image(struct page *p, const char *alt, const struct sheet *svg) {
    html_text(p, "<img alt=\"", alt, "\" src=\"data:image/svg+xml,");
    escape_uri(p->out, svg->text);
    fputs("\">", p->out);
}

static enum status sequence(struct page *p, const struct report_case *c,
                            const struct report_sequence *s, struct fault *fault) {
    struct sheet name = {0}, svg = {0};
    enum status status = name_of_file(c, s->name, ".svg", &name, fault);
    if (status)
        return status;
    if ((status = draw_sequence(s, &svg, fault)) || (status = save(p, name.text, &svg, fault)))
        goto done;
    sheet_free(&svg);
    if ((status = draw_sequence_small(s, &svg, fault)))
        goto done;
    put_figure(p, "sequence", c, GALLERY_SEQUENCE, (size_t)(s - c->sequence));
    html_text(p, "<h3>", s->title, "</h3>\n");
    html_text(p, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Figure: ",
              s->title, "\">\n");
    fprintf(p->out, "<a href=\"%s\">", name.text);
    put_image(p, s->alt, &svg);
    html_text(p, "</a></div>\n<figcaption>", s->caption, "");
    fprintf(p->out, " <a href=\"%s\">As a file to zoom into</a></figcaption>\n</figure>\n",
            name.text);
done:
    sheet_free(&svg);
    sheet_free(&name);
    return status;
}

/* The page with the player lies beside this one, which shows its middle frame. */
static enum status animation(struct page *p, const struct report_case *c,
                             const struct report_sequence *s, struct fault *fault) {
    struct sheet name = {0}, player = {0}, poster = {0};
    enum status status = name_of_file(c, s->name, ".html", &name, fault);
    if (status)
        return status;
    if ((status = draw_animation(s, &player, fault)))
        goto done;
    if ((status = save(p, name.text, &player, fault)))
        goto done;
    if ((status = draw_poster(s, &poster, fault)))
        goto done;
    put_figure(p, "picture", c, GALLERY_ANIMATION, (size_t)(s - c->animation));
    html_text(p, "<h3>", s->title, "</h3>\n");
    fprintf(p->out, "<a href=\"%s\">", name.text);
    put_image(p, s->alt, &poster);
    html_text(p, "</a>\n<figcaption>", s->caption, "");
    fprintf(p->out, " <a href=\"%s\">Play (%.1f MB)</a></figcaption>\n</figure>\n", name.text,
            (double)player.length / 1e6);
done:
    sheet_free(&poster);
    sheet_free(&player);
    sheet_free(&name);
    return status;
}

/* A figure that the gallery has drawn is shown from there: the page has it once. */
static void put_drawing(struct page *p, const struct report_figure *f, const struct sheet *svg) {
    size_t drawn = html_gallery_figure(p, f);
    const char *body = strstr(svg->text, "</desc>");
    if (drawn == 0 || drawn >= p->figures || body == NULL) {
        fwrite(svg->text, 1, svg->length, p->out);
        return;
    }
    fwrite(svg->text, 1, (size_t)(body - svg->text), p->out);
    fprintf(p->out,
            "</desc>\n<use xlink:href=\"#figure%zu-svg\"/></svg>\n"
            "<p><a href=\"#figure%zu-svg\">As in the gallery</a></p>\n",
            drawn, drawn);
}

/* Of a case, with its id, or of none (c NULL). */
static enum status plot(struct page *p, const struct report_case *c, const struct report_figure *f,
                        struct fault *fault) {
    char prefix[32];
    struct sheet svg = {0};
    snprintf(prefix, sizeof prefix, "figure%zu-", ++p->figures);
    enum status status = draw_figure(f, prefix, &svg, fault);
    if (status)
        return status;
    if (c != NULL)
        put_figure(p, "plot", c, GALLERY_PLOT, (size_t)(f - c->figure));
    else
        fprintf(p->out, "<figure class=\"plot\">\n");
    html_text(p, "<h3>", f->title, "</h3>\n");
    html_text(p, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Figure: ",
              f->title, "\">\n");
    put_drawing(p, f, &svg);
    fprintf(p->out, "</div>\n");
    if (f->caption && *f->caption)
        html_text(p, "<figcaption>", f->caption, "</figcaption>\n");
    fprintf(p->out, "</figure>\n");
    sheet_free(&svg);
    return STATUS_OK;
}

enum status html_figure(struct page *p, const struct report_figure *f, struct fault *fault) {
    return plot(p, NULL, f, fault);
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
    bool has_pictures = c->picture_count + c->animation_count > 0;
    for (size_t i = 0; i < c->sequence_count && !status; i++)
        status = sequence(p, c, &c->sequence[i], fault);
    if (has_pictures)
        fprintf(p->out, "<div class=\"pictures\">\n");
    for (size_t i = 0; i < c->animation_count && !status; i++)
        status = animation(p, c, &c->animation[i], fault);
    for (size_t i = 0; i < c->picture_count && !status; i++)
        status = picture(p, c, &c->picture[i], fault);
    if (has_pictures)
        fprintf(p->out, "</div>\n");
    for (size_t i = 0; i < c->figure_count && !status; i++)
        status = plot(p, c, &c->figure[i], fault);
    for (size_t i = 0; i < c->table_count && !status; i++)
        table(p, &c->table[i]);
    return status ? fault_within(fault, "case %s", c->name) : STATUS_OK;
}
