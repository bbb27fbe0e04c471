/* compare_markdown.c -- a comparison as a comment on a pull request; see compare_write.h. */
#include "validation/compare_words.h"

#include "report/escape.h"
#include "report/sheet.h"

#include <stdlib.h>

/* In bytes, of which there are no fewer than characters. */
enum { CHANGED_LIMIT = 30000, LISTS_LIMIT = 45000, ALL_LIMIT = 64000 };

struct page {
    FILE *out;
    struct fault *fault;
};

static void put_plain(FILE *out, const char *before, const char *text, const char *after) {
    fprintf(out, "%s", before);
    escape_markdown(out, text);
    fprintf(out, "%s", after);
}

/* A line that is left out, and counted, where the page would grow over the limit. */
static enum status put_line(struct page *p, struct sheet *line, long limit, size_t *left_out) {
    enum status status = sheet_close(line, p->fault);
    if (status == STATUS_OK) {
        if (ftell(p->out) + (long)line->length <= limit)
            fwrite(line->text, 1, line->length, p->out);
        else
            ++*left_out;
    }
    sheet_free(line);
    return status;
}

static void say_left_out(struct page *p, size_t count) {
    if (count > 0)
        fprintf(p->out, "\n%zu more do not fit in here: `bedcheck compare` prints all.\n", count);
}

static void put_side(FILE *out, const char *side, const struct results *r) {
    fprintf(out, "- %s: ", side);
    put_plain(out, "", r->folder, ", commit ");
    fprintf(out, "%.12s", r->commit);
    put_plain(out, " (", r->dirty, "), started ");
    escape_markdown(out, r->started);
    if (r->modification != NULL)
        put_plain(out, ", **MODIFIED**: ", r->modification, "");
    fputc('\n', out);
}

static enum status put_row(struct page *p, const struct compare_row *r, long limit,
                           size_t *left_out) {
    const struct results_row *row = compare_words_row(r);
    char *text = NULL;
    size_t length = 0;
    struct sheet line;
    enum status status = sheet_open(&line, p->fault);
    if (status != STATUS_OK)
        return status;
    fprintf(line.out, "| %s%s%s", r->change == CHANGE_SIGNIFICANT ? "**" : "",
            compare_change_name(r->change), r->change == CHANGE_SIGNIFICANT ? "**" : "");
    put_plain(line.out, " | ", row->case_name, "");
    put_plain(line.out, " | ", row->check, "");
    put_plain(line.out, " | ", row->point, " | ");
    FILE *cell = open_memstream(&text, &length);
    if (cell != NULL) {
        compare_words_values(cell, r);
        fprintf(cell, " | %s | %s | ", compare_words_difference(r).text,
                compare_words_share(r).text);
        fclose(cell);
        fputs(text, line.out);
        free(text);
        text = NULL;
    }
    cell = open_memstream(&text, &length);
    if (cell != NULL) {
        compare_words_remarks(cell, r);
        fclose(cell);
        escape_markdown(line.out, text);
        free(text);
    }
    fprintf(line.out, " |\n");
    return put_line(p, &line, limit, left_out);
}

static bool is_changed(const struct compare_row *r) {
    return r->change != CHANGE_UNCHANGED && r->change != CHANGE_SAME;
}

static enum status put_rows(struct page *p, const struct compared *c, bool changed, long limit) {
    size_t left_out = 0, count = 0;
    enum status status = STATUS_OK;
    for (size_t i = 0; i < c->row_count; i++)
        count += is_changed(&c->row[i]) == changed;
    if (count == 0)
        return STATUS_OK;
    fprintf(p->out, changed ? "\n## What has changed, or may have\n\n"
                            : "\n<details><summary>All other checks</summary>\n\n");
    fprintf(p->out, "| | case | check | point | old → new | difference | in tolerances | |\n"
                    "|---|---|---|---|---|---|--:|---|\n");
    for (size_t i = 0; i < c->row_count && status == STATUS_OK; i++) {
        if (is_changed(&c->row[i]) == changed)
            status = put_row(p, &c->row[i], limit, &left_out);
    }
    say_left_out(p, left_out);
    if (!changed)
        fprintf(p->out, "\n</details>\n");
    return status;
}

static enum status put_list(struct page *p, const char *title, const struct results_row *const *row,
                            size_t count) {
    size_t left_out = 0;
    enum status status = STATUS_OK;
    if (count > 0)
        fprintf(p->out, "\n## %s\n\n", title);
    for (size_t i = 0; i < count && status == STATUS_OK; i++) {
        struct sheet line;
        if ((status = sheet_open(&line, p->fault)) != STATUS_OK)
            break;
        put_plain(line.out, "- ", row[i]->case_name, ": ");
        escape_markdown(line.out, row[i]->check);
        put_plain(line.out, ", ", row[i]->point, "\n");
        status = put_line(p, &line, LISTS_LIMIT, &left_out);
    }
    say_left_out(p, left_out);
    return status;
}

static void put_costs(FILE *out, const struct compare_runs *runs) {
    if (runs->cost_count == 0)
        return;
    fprintf(out, "\n## Cost\n\nRun by run; the noise is the runs' own.\n\n"
                 "| part | old | new | change | | runs |\n|---|--:|--:|--:|---|--:|\n");
    for (size_t i = 0; i < runs->cost_count && ftell(out) < LISTS_LIMIT; i++) {
        const struct compare_cost *c = &runs->cost[i];
        put_plain(out, "| ", c->part, " | ");
        fprintf(out, "%.3f s | %.3f s | %s | %s | %zu |\n", c->old_s, c->new_s,
                compare_words_ratio(c).text, compare_words_speed(c), c->runs);
    }
}

static enum status put_bits(struct page *p, const struct compare_runs *runs) {
    struct compare_case_bits b;
    size_t left_out = 0;
    enum status status = STATUS_OK;
    fprintf(p->out, "\n## Bits\n\n%zu of %zu runs unchanged, %zu differ, %zu cannot be read.\n\n",
            runs->count[BITS_EQUAL], runs->run_count, runs->count[BITS_DIFFER],
            runs->count[BITS_UNKNOWN]);
    for (size_t i = 0; status == STATUS_OK && compare_words_next_case(runs, &i, &b);) {
        struct sheet line;
        char *text = NULL;
        size_t length;
        if (b.differ == 0 && b.unknown == 0)
            continue;
        if ((status = sheet_open(&line, p->fault)) != STATUS_OK)
            break;
        FILE *words = open_memstream(&text, &length);
        if (words != NULL) {
            compare_words_bits(words, &b);
            fclose(words);
        }
        put_plain(line.out, "- ", b.case_name, ": ");
        put_plain(line.out, "", text, "\n");
        free(text);
        status = put_line(p, &line, LISTS_LIMIT, &left_out);
    }
    say_left_out(p, left_out);
    return status;
}

static enum status put_page(struct page *p, const struct compare_view *v) {
    const struct compared *c = v->rows;
    fprintf(p->out, "# %s\n\n", compare_words_conclusion(c));
    compare_words_counts(p->out, c);
    fprintf(p->out, ".\n\n");
    put_side(p->out, "old", c->old);
    put_side(p->out, "new", c->new);
    enum status status = put_rows(p, c, true, CHANGED_LIMIT);
    if (status == STATUS_OK && v->runs != NULL) {
        put_costs(p->out, v->runs);
        status = put_bits(p, v->runs);
    }
    if (status == STATUS_OK)
        status = put_list(p, c->old->references ? "Checks without a reference" : "Added checks",
                          c->added, c->added_count);
    if (status == STATUS_OK)
        status = put_list(p, "Removed checks", c->removed, c->removed_count);
    return status == STATUS_OK ? put_rows(p, c, false, ALL_LIMIT) : status;
}

/* Put together in memory: a pipe does not tell how long it is. */
enum status compare_write_markdown(const struct compare_view *v, FILE *out, struct fault *fault) {
    struct sheet sheet;
    enum status status = sheet_open(&sheet, fault);
    if (status != STATUS_OK)
        return status;
    struct page p = {sheet.out, fault};
    status = put_page(&p, v);
    if (status == STATUS_OK && (status = sheet_close(&sheet, fault)) == STATUS_OK)
        fwrite(sheet.text, 1, sheet.length, out);
    sheet_free(&sheet);
    return status;
}
