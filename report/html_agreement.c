/* html_agreement.c -- all checks on one plot: measured over expected, bias and scatter. */
#include "report/html.h"

#include "report/words.h"

#include <math.h>

static void put_interval(struct page *p, double value, double low, double high) {
    fprintf(p->out, "<td class=\"num\">%s</td>", words_number(value).text);
    if (isnan(low))
        fprintf(p->out, "<td class=\"num\">too few cases</td>");
    else
        fprintf(p->out, "<td class=\"num\">%s to %s</td>", words_number(low).text,
                words_number(high).text);
}

static void put_group(struct page *p, const struct report_group *g) {
    html_text(p, "<tr><th scope=\"row\">", g->name, "</th>");
    fprintf(p->out, "<td class=\"num\">%zu</td><td class=\"num\">%zu</td>", g->rows, g->cases);
    put_interval(p, g->bias, g->bias_low, g->bias_high);
    put_interval(p, g->scatter, g->scatter_low, g->scatter_high);
    fprintf(p->out, "<td class=\"num\">%s</td></tr>\n", words_number(g->noise).text);
}

static void put_table(struct page *p, const struct report_agreement *a) {
    static const char *const heading[] = {
        "Rows", "Cases", "Bias", "95 % interval", "Scatter", "95 % interval", "of it uncertainty"};
    fprintf(p->out, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
                    "aria-label=\"Bias and scatter\">\n<table class=\"data\">\n<thead><tr>"
                    "<th scope=\"col\">Group</th>");
    for (size_t i = 0; i < sizeof heading / sizeof *heading; i++)
        fprintf(p->out, "<th scope=\"col\" class=\"num\">%s</th>", heading[i]);
    fprintf(p->out, "</tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < a->group_count; i++)
        put_group(p, &a->group[i]);
    fprintf(p->out, "</tbody></table></div>\n");
}

enum status html_agreement(struct page *p, struct fault *fault) {
    const struct report_agreement *a = p->report->agreement;
    if (!a || a->group_count == 0)
        return STATUS_OK;
    fprintf(p->out,
            "<section id=\"agreement\">\n<h2>All checks together</h2>\n"
            "<p>Bias is the geometric mean of measured over expected, scatter the standard "
            "deviation of its logarithm (.05 is about 5 %%). Rows of one case share runs, so "
            "the intervals come from leaving out one case after the other.</p>\n");
    put_table(p, a);
    enum status status = html_figure(p, &a->figure, fault);
    fprintf(p->out,
            "<p class=\"caption\">Not on the plot: %zu rows of round-off, %zu one-sided ones, %zu "
            "others without a ratio that means something (nothing measured, an expectation of 0 or "
            "not beyond twice its tolerance, a comparison with a reference).</p>\n</section>\n",
            a->round_off, a->one_sided, a->other);
    return status;
}
