/* junit.c -- junit.xml as GitLab, GitHub's actions and Jenkins read it.
 *
 * One testsuite a case, one testcase a row.  GitLab and Jenkins know a test by
 * classname and name, so that pair is unique here: classname is TIER.CASE with
 * '/' as '.', name is "check [point]", numbered where a case repeats it.  An
 * inconclusive row is a failure of type "inconclusive", never a pass; a known disagreement is
 * skipped, with its reason.
 */
#include "report/escape.h"
#include "report/report.h"
#include "report/sheet.h"
#include "report/words.h"

#include <math.h>
#include <string.h>

static void put_attribute(FILE *out, const char *name, const char *text) {
    fprintf(out, " %s=\"", name);
    escape_markup(out, text);
    fputc('"', out);
}

static double seconds_of(const struct report_row *row) {
    return isfinite(row->seconds) && row->seconds > 0 ? row->seconds : 0;
}

static bool same(const char *a, const char *b) {
    return strcmp(a ? a : "", b ? b : "") == 0;
}

/* How many rows before this one have its name. */
static size_t earlier_namesakes(const struct report_case *c, size_t row) {
    size_t count = 0;
    for (size_t i = 0; i < row; i++)
        count +=
            same(c->row[i].check, c->row[row].check) && same(c->row[i].point, c->row[row].point);
    return count;
}

static void put_classname(FILE *out, const struct report *r, const struct report_case *c) {
    fprintf(out, " classname=\"");
    escape_name(out, r->tier);
    fputc('.', out);
    escape_name(out, c->name);
    fputc('"', out);
}

static void put_numbers(FILE *out, const struct report_row *row) {
    struct words unit = words_unit(row->unit);
    fprintf(out, "measured  %s", words_measured(row->measured, row->uncertainty).text);
    escape_markup(out, unit.text);
    fprintf(out, "\nexpected  %s", words_measured(row->expected, row->expected_uncertainty).text);
    escape_markup(out, unit.text);
    fprintf(out, "\naccepted  %s", words_accepted(row).text);
    escape_markup(out, unit.text);
    fprintf(out, "\nmargin used  %s\n", words_margin(report_margin_used(row)).text);
}

static void put_line(FILE *out, const char *name, const char *text) {
    if (!text || !*text)
        return;
    fprintf(out, "%s  ", name);
    escape_markup(out, text);
    fputc('\n', out);
}

static void put_failure(FILE *out, const struct report_row *row) {
    bool failed = row->verdict == VERDICT_FAIL;
    fprintf(out, "      <failure type=\"%s\"", failed ? "fail" : "inconclusive");
    put_attribute(out, "message", row->reason);
    fprintf(out, ">");
    put_line(out, "reason", row->reason);
    put_numbers(out, row);
    put_line(out, "observable", row->observable);
    put_line(out, "because", row->because);
    put_line(out, "repeat", row->repeat);
    if (row->log_end && *row->log_end) {
        fprintf(out, "log ends\n");
        escape_markup(out, row->log_end);
    }
    fprintf(out, "</failure>\n");
}

static void put_known(FILE *out, const struct report_row *row) {
    fprintf(out, "      <skipped");
    put_attribute(out, "message", row->reason);
    fprintf(out, "/>\n");
}

static void put_row(FILE *out, const struct report *r, const struct report_case *c, size_t i) {
    const struct report_row *row = &c->row[i];
    size_t earlier = earlier_namesakes(c, i);
    fprintf(out, "    <testcase");
    put_classname(out, r, c);
    fprintf(out, " name=\"");
    escape_markup(out, row->check);
    if (row->point && *row->point) {
        fprintf(out, " [");
        escape_markup(out, row->point);
        fprintf(out, "]");
    }
    if (earlier > 0)
        fprintf(out, " (%zu)", earlier + 1);
    fprintf(out, "\" time=\"%.3f\"", seconds_of(row));
    if (row->verdict == VERDICT_PASS) {
        fprintf(out, "/>\n");
        return;
    }
    fprintf(out, ">\n");
    if (row->verdict == VERDICT_KNOWN)
        put_known(out, row);
    else
        put_failure(out, row);
    fprintf(out, "    </testcase>\n");
}

static double time_of_case(const struct report_case *c) {
    double sum = 0;
    for (size_t i = 0; i < c->row_count; i++)
        sum += seconds_of(&c->row[i]);
    return sum;
}

static void put_case(FILE *out, const struct report *r, const struct report_case *c) {
    struct report_count n = report_tally(&(struct report){.cases = c, .case_count = 1});
    fprintf(out, "  <testsuite");
    put_attribute(out, "name", c->name);
    fprintf(out, " tests=\"%zu\" failures=\"%zu\" errors=\"0\" skipped=\"%zu\" time=\"%.3f\"",
            c->row_count + c->skipped, n.fail + n.inconclusive, n.known + n.skipped,
            time_of_case(c));
    if (r->started && *r->started)
        put_attribute(out, "timestamp", r->started);
    fprintf(out, ">\n");
    for (size_t i = 0; i < c->row_count; i++)
        put_row(out, r, c, i);
    if (c->skipped) {
        fprintf(out, "    <testcase");
        put_classname(out, r, c);
        fprintf(out, " name=\"whole case\" time=\"0.000\">\n      <skipped");
        put_attribute(out, "message", c->skip_reason);
        fprintf(out, "/>\n    </testcase>\n");
    }
    fprintf(out, "  </testsuite>\n");
}

enum status report_write_junit(const struct report *r, const char *path, struct fault *fault) {
    struct report_count n = report_tally(r);
    struct sheet sheet;
    double seconds = 0;
    enum status status = sheet_open(&sheet, fault);
    if (status)
        return status;
    for (size_t i = 0; i < r->case_count; i++)
        seconds += time_of_case(&r->cases[i]);
    fprintf(sheet.out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites");
    put_attribute(sheet.out, "name", r->suite);
    fprintf(sheet.out,
            " tests=\"%zu\" failures=\"%zu\" errors=\"0\" skipped=\"%zu\" time=\"%.3f\">\n",
            n.pass + n.fail + n.inconclusive + n.known + n.skipped, n.fail + n.inconclusive,
            n.known + n.skipped, seconds);
    for (size_t i = 0; i < r->case_count; i++)
        put_case(sheet.out, r, &r->cases[i]);
    fprintf(sheet.out, "</testsuites>\n");
    status = sheet_save(&sheet, path, fault);
    sheet_free(&sheet);
    return status;
}
