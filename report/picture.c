/* picture.c -- grains in their box as a palette PNG; see draw.h. */
#include "report/draw.h"
#include "report/gnuplot.h"

#include <math.h>
#include <stdlib.h>

/* gd fills a polygon with its outline: each disc would come out wider by this much all round
 * (measured on the covered area of 18104 discs at 16 and 24 px per l). */
static const double OUTLINE_PX = .4;

struct frame {
    double scale;                 /* px per l */
    int left, right, top, bottom; /* margins, px */
    int width, height;            /* of the whole picture, px */
    int font;
};

static struct frame frame_of(const struct report_picture *p, double px_per_l) {
    double longest = fmax(p->width, p->height), least = 50 * px_per_l;
    struct frame f = {.scale = fmax(px_per_l, least / longest)};
    f.scale = fmin(f.scale, .9 * DRAW_MAX_PX / longest);
    /* text grows with the picture: both are shown at the same size in the end */
    double em = fmin(2.2 * px_per_l + 4, 60);
    f.font = (int)lround(em * .75);
    f.left = (int)lround(5.2 * em);
    f.right = (int)lround((p->shade ? 8 : 1.5) * em);
    f.top = (int)lround(em);
    f.bottom = (int)lround(4.2 * em);
    f.width = (int)lround(p->width * f.scale) + f.left + f.right;
    f.height = (int)lround(p->height * f.scale) + f.top + f.bottom;
    return f;
}

static void put_head(FILE *out, const struct report_picture *p, const struct frame *f) {
    fprintf(out,
            "set terminal png notruecolor font 'sans,%d' size %d,%d background '#ffffff'\n"
            "set encoding utf8\n",
            f->font, f->width, f->height);
    fprintf(out,
            "set lmargin at screen %.6f\nset rmargin at screen %.6f\n"
            "set tmargin at screen %.6f\nset bmargin at screen %.6f\n",
            (double)f->left / f->width, 1 - (double)f->right / f->width,
            1 - (double)f->top / f->height, (double)f->bottom / f->height);
    fprintf(out,
            "set xrange [0:%.9g]\nset yrange [0:%.9g]\nset xlabel 'x (l)'\nset ylabel 'y (l)'\n"
            "set border lw 2\nset tics out nomirror\nset key off\nset style fill solid noborder\n",
            p->width, p->height);
    if (!p->shade)
        return;
    fprintf(out,
            "set cbrange [%.9g:%.9g]\nset palette maxcolors 64 defined (0 '#440154', "
            "1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#f2c91f')\nset cblabel ",
            p->shade_min, p->shade_max);
    gnuplot_put_text(out, p->shade_label);
    fprintf(out, " noenhanced\n");
}

static void put_grains(FILE *out, const struct report_picture *p, const struct frame *f) {
    fprintf(out, "$grains << EOD\n");
    for (size_t i = 0; i < p->count; i++) {
        double radius = fmax(p->radius[i] - OUTLINE_PX / f->scale, .3 / f->scale);
        fprintf(out, "%.6g %.6g %.6g", p->x[i], p->y[i], radius);
        if (p->shade)
            fprintf(out, " %.6g", p->shade_min + p->shade[i] * (p->shade_max - p->shade_min));
        fprintf(out, "\n");
    }
    fprintf(out, "EOD\n");
    if (p->count == 0)
        fprintf(out, "set label 'no grains' at graph .5,.5 center\nplot NaN notitle\n");
    else
        fprintf(out, "plot $grains using %s notitle\n",
                p->shade ? "1:2:3:4 with circles lc palette"
                         : "1:2:3 with circles lc rgb '#0072B2'");
}

static enum status check(const struct report_picture *p, struct fault *fault) {
    if (!(p->width > 0 && p->height > 0 && isfinite(p->width) && isfinite(p->height)))
        return fault_set(fault, STATUS_BAD_INPUT, "picture %s: no box of %g x %g l can be drawn",
                         p->name, p->width, p->height);
    for (size_t i = 0; i < p->count; i++) {
        if (!isfinite(p->x[i]) || !isfinite(p->y[i]) || !(p->radius[i] > 0) ||
            !isfinite(p->radius[i]) || (p->shade && !isfinite(p->shade[i])))
            return fault_set(fault, STATUS_BAD_INPUT,
                             "picture %s: grain %zu has no finite place, radius and shade", p->name,
                             i);
    }
    if (p->shade && !(p->shade_min < p->shade_max))
        return fault_set(fault, STATUS_BAD_INPUT, "picture %s: shades from %g to %g are no scale",
                         p->name, p->shade_min, p->shade_max);
    if (gnuplot_check_text(p->shade_label, "label of the shade", fault))
        return fault_within(fault, "picture %s", p->name);
    return STATUS_OK;
}

enum status draw_picture(const struct report_picture *p, double px_per_l, struct drawing *out,
                         struct fault *fault) {
    struct sheet script = {0};
    enum status status = check(p, fault);
    *out = (struct drawing){0};
    if (status || (status = sheet_open(&script, fault)))
        return status;
    struct frame frame = frame_of(p, px_per_l);
    put_head(script.out, p, &frame);
    put_grains(script.out, p, &frame);
    if ((status = sheet_close(&script, fault)))
        goto done;
    if ((status = gnuplot_run(&script, &out->bytes, &out->length, fault))) {
        fault_within(fault, "picture %s", p->name);
        goto done;
    }
    out->width_px = frame.width;
    out->height_px = frame.height;
done:
    sheet_free(&script);
    return status;
}
