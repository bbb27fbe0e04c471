/* html.c -- index.html as a whole; see html.h. */
#include "report/html_gallery.h"

#include "report/escape.h"
#include "report/sheet.h"
#include "report/words.h"

#include "common/digest.h"
#include "common/file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void html_text(struct page *p, const char *before, const char *text, const char *after) {
    fputs(before, p->out);
    escape_markup(p->out, text);
    fputs(after, p->out);
}

void html_verdict(struct page *p, enum verdict verdict) {
    static const char *const symbol[] = {"✓", "✗", "?", "≠"};
    fprintf(p->out,
            "<span class=\"verdict %s\"><span class=\"symbol\" aria-hidden=\"true\">%s</span> "
            "%s</span>",
            verdict_name(verdict), symbol[verdict], verdict_name(verdict));
}

enum verdict html_case_verdict(const struct report_case *c) {
    struct report one = {.cases = c, .case_count = 1};
    return report_verdict(&one);
}

void html_case_id(struct page *p, const struct report_case *c) {
    fputs("case-", p->out);
    escape_name(p->out, c->name);
}

void html_row_id(struct page *p, const struct report_case *c, size_t row) {
    fputs("check-", p->out);
    escape_name(p->out, c->name);
    fprintf(p->out, "-%zu", row + 1);
}

void html_pre(struct page *p, const char *text) {
    fputs("<pre tabindex=\"0\"><code>", p->out);
    escape_markup(p->out, text);
    fputs("</code></pre>\n", p->out);
}

/* A PDF that ci/pdf has made of an earlier page must not stand beside this one. */
static enum status remove_pdf(const char *folder, struct fault *fault) {
    enum status status = STATUS_OK;
    char *path = file_join(folder, "report.pdf");
    if (!path)
        return fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
    if (unlink(path) != 0 && errno != ENOENT)
        status = fault_set(fault, STATUS_IO, "%s: cannot be removed: %s", path, strerror(errno));
    free(path);
    return status;
}

/* Only this script may run: the policy names its digest. */
static void put_script_source(struct page *p) {
    struct digest d;
    char bytes[(DIGEST_SIZE - 1) / 2];
    digest_bytes(html_script(), strlen(html_script()), &d);
    for (size_t i = 0; i < sizeof bytes; i++) {
        const char pair[] = {d.hex[2 * i], d.hex[2 * i + 1], '\0'};
        bytes[i] = (char)strtol(pair, NULL, 16);
    }
    fputs("'sha256-", p->out);
    escape_base64(p->out, bytes, sizeof bytes);
    fputc('\'', p->out);
}

static void put_head(struct page *p) {
    fprintf(p->out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
                    "style-src 'unsafe-inline'; img-src data:; script-src ");
    put_script_source(p);
    fprintf(p->out, "\">\n"
                    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                    "<meta name=\"color-scheme\" content=\"light dark\">\n<title>");
    fprintf(p->out, "%s%s: ", p->report->modified ? "MODIFIED, " : "", words_headline(p->report));
    html_text(p, "", p->report->suite, ", tier ");
    html_text(p, "", p->report->tier, "</title>\n<style>\n");
    fprintf(p->out, "%s</style>\n</head>\n", html_style());
}

static enum status put_page(struct page *p, struct fault *fault) {
    enum status status = STATUS_OK;
    put_head(p);
    fprintf(p->out, "<body id=\"top\">\n<a class=\"skip\" href=\"#cases\">Skip to the cases</a>\n");
    html_overview(p);
    fprintf(p->out, "<main id=\"cases\">\n");
    html_matrix(p);
    if ((status = html_cover(p, fault)) || (status = html_agreement(p, fault)))
        return status;
    html_ledger(p);
    status = html_gallery(p, fault);
    for (size_t i = 0; i < p->report->case_count && !status; i++)
        status = html_case(p, &p->report->cases[i], fault);
    html_origin(p);
    fprintf(p->out, "</main>\n<footer><p>Written by ");
    html_text(p, "", p->report->suite,
              ". The same rows are in results.json, junit.xml and summary.md.</p></footer>\n");
    fprintf(p->out, "<script>%s</script>\n</body>\n</html>\n", html_script());
    return status;
}

enum status report_write_html(const struct report *r, const char *folder, struct fault *fault) {
    struct sheet sheet = {0};
    char *path = NULL;
    enum status status = file_make_folder(folder, fault);
    if (status || (status = remove_pdf(folder, fault)) || (status = sheet_open(&sheet, fault)))
        return status;
    struct page page = {.out = sheet.out, .report = r, .folder = folder};
    status = put_page(&page, fault);
    if (status)
        goto done;
    path = file_join(folder, "index.html");
    status = path ? sheet_save(&sheet, path, fault)
                  : fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
done:
    free(path);
    sheet_free(&sheet);
    return status;
}
