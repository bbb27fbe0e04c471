/* raster.c -- a panel of a sequence as a palette PNG; see draw.h.
 *
 * Discs: each pixel is asked at 3 x 3 places what covers it, and takes the mixture of the three
 * colours.  Lit spheres: the nearest that covers a pixel's middle, in four tones of its lighting
 * and six of its depth, as in spheres.c; no smoothing, the picture is shown smaller than it is.
 */
#include "report/draw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { FINE = 3, PLACES = FINE * FINE, TONES = 4, DEPTHS = 6, GROUND = 255, COLOURS = 256 };

/* Of the colour, at the back; depth of half the darkening, in R. */
static const double DARKEST = .45, FADE = 14;

struct image {
    size_t width, height;
    unsigned char *pixel; /* pixel[row * width + column], row 0 on top */
    unsigned char palette[COLOURS][3];
};

static void parse_colour(const char *text, double *rgb) {
    long value = strtol(text + 1, NULL, 16);
    for (int c = 0; c < 3; c++)
        rgb[c] = (double)(value >> (16 - 8 * c) & 255);
}

static void set_colour(struct image *image, size_t index, const double *rgb) {
    for (int c = 0; c < 3; c++)
        image->palette[index][c] = (unsigned char)lround(fmin(fmax(rgb[c], 0), 255));
}

static size_t clamp(double x, size_t count) {
    return x <= 0 ? 0 : x >= (double)count ? count : (size_t)x;
}

/* -- discs ------------------------------------------------------------------ */

static void fill_disc(unsigned char *fine, size_t columns, size_t rows, double x, double y,
                      double radius, unsigned char kind) {
    for (size_t row = clamp(y - radius, rows); row < clamp(ceil(y + radius), rows); row++) {
        double dy = (double)row + .5 - y, half = radius * radius - dy * dy;
        if (half <= 0)
            continue;
        half = sqrt(half);
        size_t from = clamp(round(x - half), columns), to = clamp(round(x + half), columns);
        memset(fine + row * columns + from, kind, to - from);
    }
}

/* Of so many dark and light places in a pixel: two numbers from 0 to 9. */
static size_t mixture(size_t dark, size_t light) {
    return dark * (PLACES + 1) + light;
}

static void mix_palette(struct image *image, const struct report_sequence *s) {
    double colour[3][3], mixed[3];
    parse_colour(draw_kind_colour(s, 0), colour[0]);
    parse_colour(draw_kind_colour(s, 1), colour[1]);
    parse_colour(draw_ground_colour(s), colour[2]);
    for (size_t dark = 0; dark <= PLACES; dark++) {
        for (size_t light = 0; dark + light <= PLACES; light++) {
            for (int c = 0; c < 3; c++)
                mixed[c] = ((double)dark * colour[0][c] + (double)light * colour[1][c] +
                            (double)(PLACES - dark - light) * colour[2][c]) /
                           PLACES;
            set_colour(image, mixture(dark, light), mixed);
        }
    }
}

static bool draw_discs(struct image *image, const struct report_sequence *s,
                       const struct report_frame *f, double scale) {
    size_t columns = image->width * FINE, rows = image->height * FINE;
    unsigned char *fine = malloc(columns * rows);
    if (!fine)
        return false;
    memset(fine, GROUND, columns * rows);
    for (size_t i = 0; i < s->count; i++)
        fill_disc(fine, columns, rows, f->position[2 * i] * scale * FINE,
                  (double)rows - f->position[2 * i + 1] * scale * FINE, s->radius[i] * scale * FINE,
                  s->kind[i]);
    for (size_t row = 0; row < image->height; row++) {
        for (size_t column = 0; column < image->width; column++) {
            size_t count[2] = {0, 0};
            for (size_t k = 0; k < PLACES; k++) {
                unsigned char kind =
                    fine[(row * FINE + k / FINE) * columns + column * FINE + k % FINE];
                if (kind < 2)
                    count[kind]++;
            }
            image->pixel[row * image->width + column] = (unsigned char)mixture(count[0], count[1]);
        }
    }
    mix_palette(image, s);
    free(fine);
    return true;
}

/* -- lit spheres ------------------------------------------------------------ */

static unsigned char lit_index(size_t kind, size_t tone, size_t depth) {
    return (unsigned char)((kind * TONES + tone) * DEPTHS + depth);
}

static void lit_palette(struct image *image, const struct report_sequence *s) {
    static const double share[TONES] = {-.42, -.12, .08, .5}; /* darker and lighter than itself */
    double colour[3], shown[3];
    for (size_t kind = 0; kind < REPORT_KINDS; kind++) {
        parse_colour(draw_kind_colour(s, kind), colour);
        for (size_t tone = 0; tone < TONES; tone++) {
            for (size_t depth = 0; depth < DEPTHS; depth++) {
                double dim = 1 - (1 - DARKEST) * ((double)depth + .5) / DEPTHS;
                for (int c = 0; c < 3; c++)
                    shown[c] = dim * (colour[c] + share[tone] * (share[tone] > 0 ? 255 - colour[c]
                                                                                 : colour[c]));
                set_colour(image, lit_index(kind, tone, depth), shown);
            }
        }
    }
    parse_colour(draw_ground_colour(s), colour);
    set_colour(image, GROUND, colour);
}

/* Light comes from the upper left and the front. */
static size_t tone_of(double x, double up) {
    double light = (-x + up) * .45 + sqrt(fmax(1 - x * x - up * up, 0)) * .77;
    return light > .93 ? 3 : light > .62 ? 2 : light > .3 ? 1 : 0;
}

static void paint_ball(struct image *image, float *nearest, double x, double y, double radius,
                       double depth, unsigned char kind) {
    double fade = depth / (FADE + depth);
    size_t dim = clamp(fade * DEPTHS, DEPTHS - 1);
    for (size_t row = clamp(y - radius, image->height); row < clamp(y + radius + 1, image->height);
         row++) {
        for (size_t column = clamp(x - radius, image->width);
             column < clamp(x + radius + 1, image->width); column++) {
            double dx = ((double)column + .5 - x) / radius, dy = (y - (double)row - .5) / radius;
            size_t at = row * image->width + column;
            if (dx * dx + dy * dy >= 1)
                continue;
            float surface = (float)(depth - sqrt(1 - dx * dx - dy * dy)); /* R */
            if (surface >= nearest[at])
                continue;
            nearest[at] = surface;
            image->pixel[at] = lit_index(kind, tone_of(dx, dy), dim);
        }
    }
}

static bool draw_balls(struct image *image, const struct report_sequence *s,
                       const struct report_frame *f, double scale) {
    float *nearest = malloc(image->width * image->height * sizeof *nearest);
    double front = (double)INFINITY;
    if (!nearest)
        return false;
    memset(image->pixel, GROUND, image->width * image->height);
    for (size_t i = 0; i < image->width * image->height; i++)
        nearest[i] = INFINITY;
    for (size_t i = 0; i < s->count; i++)
        front = fmin(front, f->depth[i]);
    for (size_t i = 0; i < s->count; i++)
        paint_ball(image, nearest, f->position[2 * i] * scale,
                   (double)image->height - f->position[2 * i + 1] * scale, s->radius[i] * scale,
                   (f->depth[i] - front) / s->radius[i], s->kind[i]);
    lit_palette(image, s);
    free(nearest);
    return true;
}

/* -- PNG -------------------------------------------------------------------- */

static void put_number(FILE *out, unsigned long value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        fputc((int)(value >> shift & 255), out);
}

static void put_chunk(FILE *out, const char *name, const unsigned char *bytes, size_t length) {
    unsigned long check = crc32(crc32(0, NULL, 0), (const Bytef *)name, 4);
    put_number(out, length);
    fwrite(name, 1, 4, out);
    if (length > 0) {
        fwrite(bytes, 1, length, out);
        check = crc32(check, bytes, (uInt)length);
    }
    put_number(out, check);
}

static void put_header(FILE *out, const struct image *image) {
    unsigned char head[13] = {0};
    for (int i = 0; i < 4; i++) {
        head[i] = (unsigned char)(image->width >> (24 - 8 * i) & 255);
        head[4 + i] = (unsigned char)(image->height >> (24 - 8 * i) & 255);
    }
    head[8] = 8; /* bits a pixel */
    head[9] = 3; /* of a palette */
    fwrite("\x89PNG\r\n\x1a\n", 1, 8, out);
    put_chunk(out, "IHDR", head, sizeof head);
    put_chunk(out, "PLTE", &image->palette[0][0], sizeof image->palette);
}

static enum status write_png(const struct image *image, struct drawing *out, struct fault *fault) {
    struct sheet png = {0};
    size_t line = image->width + 1; /* the first byte says: no filter */
    uLongf length = compressBound((uLong)(line * image->height));
    unsigned char *lines = calloc(image->height, line), *packed = malloc(length);
    enum status status = STATUS_NO_MEMORY;
    if (lines && packed) {
        for (size_t row = 0; row < image->height; row++)
            memcpy(lines + row * line + 1, image->pixel + row * image->width, image->width);
        if (compress2(packed, &length, lines, (uLong)(line * image->height), 9) == Z_OK)
            status = sheet_open(&png, fault);
    }
    if (status == STATUS_OK) {
        put_header(png.out, image);
        put_chunk(png.out, "IDAT", packed, length);
        put_chunk(png.out, "IEND", NULL, 0);
        status = sheet_close(&png, fault);
    }
    free(lines);
    free(packed);
    if (status)
        return status == STATUS_NO_MEMORY ? fault_set(fault, status, "picture: out of memory")
                                          : status;
    *out = (struct drawing){png.text, png.length, (int)image->width, (int)image->height};
    return STATUS_OK;
}

enum status draw_panel(const struct report_sequence *s, size_t frame, double px_per_l,
                       struct drawing *out, struct fault *fault) {
    double scale = fmin(px_per_l, DRAW_MAX_PX / fmax(s->width, s->height));
    struct image image = {.width = (size_t)fmax(round(s->width * scale), 1),
                          .height = (size_t)fmax(round(s->height * scale), 1)};
    *out = (struct drawing){0};
    image.pixel = malloc(image.width * image.height);
    bool drawn = image.pixel && (s->lit ? draw_balls(&image, s, &s->frame[frame], scale)
                                        : draw_discs(&image, s, &s->frame[frame], scale));
    enum status status =
        drawn ? write_png(&image, out, fault)
              : fault_set(fault, STATUS_NO_MEMORY, "sequence %s: out of memory", s->name);
    free(image.pixel);
    return status;
}
