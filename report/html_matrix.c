/* html_matrix.c -- all cases at a glance, one line each, what needs a look first; and the form that
 * filters them, which html_script.c brings to life. */
#include "report/html.h"

#include <string.h>

enum { MAX_SYMBOLS = 60, RANKS = 5 };

void html_model(struct page *p, const struct report_case *c) {
    size_t length = strcspn(c->name, "/");
    char model[64];
    snprintf(model, sizeof model, "%.*s", (int)length, c->name);
    html_text(p, "", model, "");
}

const char *html_case_class(const struct report_case *c) {
    if (c->row_count == 0)
        return "skipped";
    return verdict_name(html_case_verdict(c));
}

void html_case_badge(struct page *p, const struct report_case *c) {
    if (c->row_count > 0)
        html_verdict(p, html_case_verdict(c));
    else
        fprintf(p->out,
                "<span class=\"verdict skipped\"><span class=\"symbol\" "
                "aria-hidden=\"true\">–</span> %s</span>",
                c->skipped ? "not run" : "no check");
}

static void put_symbols(struct page *p, const struct report_case *c) {
    static const char *const symbol[] = {"✓", "✗", "?", "≠"};
    fprintf(p->out, "<td class=\"symbols\" aria-hidden=\"true\">");
    for (size_t i = 0; i < c->row_count && i < MAX_SYMBOLS; i++)
        fprintf(p->out, "<i class=\"%s\">%s</i>", verdict_name(c->row[i].verdict),
                symbol[c->row[i].verdict]);
    fprintf(p->out, "%s</td>", c->row_count > MAX_SYMBOLS ? "…" : "");
}

static void put_number(struct page *p, const char *class, size_t n, const char *what,
                       bool *is_next) {
    if (n == 0)
        return;
    fprintf(p->out, "%s<span class=\"%s\">%zu %s</span>", *is_next ? ", " : "", class, n, what);
    *is_next = true;
}

/* Only what there is: "2 fail, 10 pass". */
static void put_numbers(struct page *p, const struct report_case *c) {
    struct report one = {.cases = c, .case_count = 1};
    struct report_count n = report_tally(&one);
    bool is_next = false;
    fprintf(p->out, "<td class=\"numbers\">");
    put_number(p, "fail", n.fail, "fail", &is_next);
    put_number(p, "inconclusive", n.inconclusive, "inconclusive", &is_next);
    put_number(p, "known", n.known, "known", &is_next);
    put_number(p, "pass", n.pass, "pass", &is_next);
    fprintf(p->out, "</td>");
}

static void put_matrix_row(struct page *p, const struct report_case *c) {
    struct report one = {.cases = c, .case_count = 1};
    fprintf(p->out, "<tr data-verdict=\"%s\" data-model=\"", html_case_class(c));
    html_model(p, c);
    fprintf(p->out, "\"><td>");
    html_case_badge(p, c);
    fprintf(p->out, "</td><th scope=\"row\"><a href=\"#");
    html_case_id(p, c);
    html_text(p, "\">", c->name, "</a> ");
    html_text(p, "<span class=\"title\">", c->title, "</span></th>");
    put_numbers(p, c);
    put_symbols(p, c);
    fprintf(p->out, "<td>");
    if (report_worst(&one))
        html_margin(p, report_worst(&one));
    fprintf(p->out, "</td></tr>\n");
}

static int rank_of(const struct report_case *c) {
    static const int rank[] = {
        [VERDICT_FAIL] = 0, [VERDICT_INCONCLUSIVE] = 1, [VERDICT_KNOWN] = 2, [VERDICT_PASS] = 3};
    return c->row_count == 0 ? RANKS - 1 : rank[html_case_verdict(c)];
}

static bool is_first_of_model(const struct report *r, size_t index) {
    const char *name = r->cases[index].name;
    size_t length = strcspn(name, "/");
    for (size_t i = 0; i < index; i++) {
        if (strcspn(r->cases[i].name, "/") == length && !strncmp(r->cases[i].name, name, length))
            return false;
    }
    return true;
}

/* Hidden until the script shows it: without one it would do nothing. */
static void put_form(struct page *p) {
    fprintf(p->out, "<form id=\"filter\" class=\"filter\" hidden=\"hidden\" action=\"#cases\">\n"
                    "<label>Verdict <select id=\"filter-verdict\"><option value=\"\">any</option>"
                    "<option value=\"fail\">fail</option>"
                    "<option value=\"inconclusive\">inconclusive</option>"
                    "<option value=\"known\">known</option><option value=\"pass\">pass</option>"
                    "<option value=\"skipped\">not run</option></select></label>\n"
                    "<label>Model <select id=\"filter-model\"><option value=\"\">any</option>");
    for (size_t i = 0; i < p->report->case_count; i++) {
        if (!is_first_of_model(p->report, i))
            continue;
        fprintf(p->out, "<option>");
        html_model(p, &p->report->cases[i]);
        fprintf(p->out, "</option>");
    }
    fprintf(p->out, "</select></label>\n"
                    "<label>Text <input id=\"filter-text\" type=\"search\"></label>\n"
                    "<button type=\"button\" id=\"fold-all\">Fold all cases</button>\n"
                    "<button type=\"button\" id=\"unfold-all\">Unfold all</button>\n"
                    "<output id=\"filter-count\" aria-live=\"polite\"></output>\n</form>\n");
}

void html_matrix(struct page *p) {
    if (p->report->case_count == 0)
        return;
    fprintf(p->out, "<h2>Cases</h2>\n");
    put_form(p);
    fprintf(p->out, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
                    "aria-label=\"Verdict of each case\">\n<table class=\"matrix\">\n<thead><tr>"
                    "<th scope=\"col\">Verdict</th><th scope=\"col\">Case</th>"
                    "<th scope=\"col\">Checks</th>"
                    "<th scope=\"col\" aria-hidden=\"true\">One by one</th>"
                    "<th scope=\"col\">Worst margin used</th></tr></thead>\n<tbody>\n");
    for (int rank = 0; rank < RANKS; rank++) {
        for (size_t i = 0; i < p->report->case_count; i++) {
            if (rank_of(&p->report->cases[i]) == rank)
                put_matrix_row(p, &p->report->cases[i]);
        }
    }
    fprintf(p->out, "</tbody></table></div>\n");
}
