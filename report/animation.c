/* animation.c -- the same grains at many times as a page with a player; see draw.h.
 *
 * The page needs nothing else and may load nothing (a content policy forbids it).  Data stand in
 * it as base64: radii in parts of the largest, 16 bit, low byte first; one byte a grain for its
 * kind; and places by animation_data.c.  PAGE#t=12.5 begins, and stays, at 12.5.
 */
#include "report/animation.h"
#include "report/draw.h"
#include "report/escape.h"

#include <math.h>
#include <stdlib.h>

static void put_text(FILE *out, const char *before, const char *text, const char *after) {
    fputs(before, out);
    escape_markup(out, text);
    fputs(after, out);
}

/* -- data ------------------------------------------------------------------- */

static void put_word(unsigned char *at, double share) {
    unsigned word = (unsigned)lround(65535 * fmin(fmax(share, 0), 1));
    at[0] = (unsigned char)(word & 255);
    at[1] = (unsigned char)(word >> 8);
}

static double largest_radius(const struct report_sequence *s) {
    double most = 0;
    for (size_t i = 0; i < s->count; i++)
        most = fmax(most, s->radius[i]);
    return most;
}

static void put_block(FILE *out, const char *id, const unsigned char *bytes, size_t length) {
    fprintf(out, "<script type=\"text/plain\" id=\"%s\">", id);
    escape_base64(out, (const char *)bytes, length);
    fputs("</script>\n", out);
}

/* room[0 .. 2*count-1] */
static void put_data(FILE *out, const struct report_sequence *s, const struct animation_data *d,
                     unsigned char *room) {
    double most = largest_radius(s);
    put_block(out, "kinds", s->kind, s->count);
    for (size_t i = 0; i < s->count; i++)
        put_word(&room[2 * i], s->radius[i] / most);
    put_block(out, "radii", room, 2 * s->count);
    put_block(out, "frames", d->bytes, d->length);
}

static void put_facts(FILE *out, const struct report_sequence *s, const struct animation_data *d) {
    fprintf(out,
            "<script type=\"application/json\" id=\"facts\">{\"width\":%.9g,\"height\":%.9g,"
            "\"radius\":%.9g,\"unit\":%.9g,\"lit\":%s,\"ground\":\"%s\",\"colours\":[",
            s->width, s->height, largest_radius(s), d->unit, s->lit ? "true" : "false",
            draw_ground_colour(s));
    for (size_t k = 0; draw_kind_colour(s, k); k++)
        fprintf(out, "%s\"%s\"", k == 0 ? "" : ",", draw_kind_colour(s, k));
    fputs("],\"times\":[", out);
    for (size_t f = 0; f < s->frame_count; f += d->stride)
        fprintf(out, "%s%.9g", f == 0 ? "" : ",", s->frame[f].time);
    fputs("]}</script>\n", out);
}

/* -- page ------------------------------------------------------------------- */

static void put_head(FILE *out, const struct report_sequence *s) {
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
          "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<meta name=\"color-scheme\" content=\"light dark\">\n",
          out);
    put_text(out, "<title>", s->title, "</title>\n<style>\n");
    fprintf(out, "%s</style>\n</head>\n", animation_style());
}

static void put_swatch(FILE *out, const char *colour, const char *label) {
    if (!label || !*label)
        return;
    fprintf(out, "<li class=\"colour\" style=\"--colour:%s\">", colour);
    put_text(out, "", label, "</li>\n");
}

static void put_controls(FILE *out, const struct report_sequence *s,
                         const struct animation_data *d) {
    double from = s->frame[0].time;
    double to = s->frame[(s->frame_count - 1) / d->stride * d->stride].time;
    fprintf(out,
            "<div class=\"bar\">\n<button type=\"button\" id=\"play\">Play</button>\n"
            "<button type=\"button\" id=\"back\" aria-label=\"Frame before\">‹</button>\n"
            "<button type=\"button\" id=\"on\" aria-label=\"Next frame\">›</button>\n"
            "<input type=\"range\" id=\"slider\" aria-label=\"Time\" min=\"%.9g\" max=\"%.9g\" "
            "step=\"any\" value=\"%.9g\">\n",
            from, to, from);
    put_text(out, "<span class=\"clock\"><span id=\"time\">–</span> ", s->time_unit, "</span>\n");
    put_text(out, "<label><select id=\"speed\" aria-label=\"Speed\"></select> ", s->time_unit,
             "/s</label>\n");
    fputs("<button type=\"button\" id=\"out\" aria-label=\"Smaller\">−</button>\n"
          "<button type=\"button\" id=\"in\" aria-label=\"Larger\">+</button>\n"
          "<button type=\"button\" id=\"whole\">Whole box</button>\n</div>\n",
          out);
}

static void put_body(FILE *out, const struct report_sequence *s, const struct animation_data *d) {
    put_text(out, "<body>\n<main>\n<h1>", s->title, "</h1>\n");
    fprintf(out, "<div class=\"frame\" style=\"--ratio:%.6g\">", s->width / s->height);
    put_text(out, "<canvas id=\"box\" role=\"img\" aria-label=\"", s->alt, "\"></canvas></div>\n");
    fputs("<noscript><p>This page needs scripts to draw; it loads nothing.</p></noscript>\n", out);
    put_controls(out, s, d);
    fputs("<ul class=\"key\">\n", out);
    for (size_t k = 0; draw_kind_colour(s, k); k++)
        put_swatch(out, draw_kind_colour(s, k), s->kind_label[k]);
    put_swatch(out, draw_ground_colour(s), s->ground_label);
    fprintf(out, "<li>box %g × %g %s</li>\n</ul>\n", s->width, s->height, draw_length_unit(s));
    if (s->caption && *s->caption)
        put_text(out, "<p>", s->caption, "</p>\n");
    fprintf(out,
            "<p>%zu stored frames; between them all are moved straight. Space: play or pause. "
            "Arrow keys: frame by frame. Wheel, pinch, + and −: zoom; drag to move; 0: the whole "
            "box.</p>\n</main>\n",
            (s->frame_count - 1) / d->stride + 1);
}

enum status draw_animation(const struct report_sequence *s, struct sheet *page,
                           struct fault *fault) {
    enum status status = draw_check_sequence(s, fault);
    if (status)
        return status;
    struct animation_data data = {0};
    unsigned char *room = calloc(s->count, 2);
    if (!room)
        return fault_set(fault, STATUS_NO_MEMORY, "animation %s: out of memory", s->name);
    if ((status = animation_pack(s, &data, fault)) || (status = sheet_open(page, fault)))
        goto done;
    put_head(page->out, s);
    put_body(page->out, s, &data);
    put_facts(page->out, s, &data);
    put_data(page->out, s, &data, room);
    fprintf(page->out, "<script>\n%s</script>\n</body>\n</html>\n", animation_script());
    status = sheet_close(page, fault);
    if (status)
        sheet_free(page);
done:
    free(data.bytes);
    free(room);
    return status;
}
