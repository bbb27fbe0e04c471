/* compare_text.c -- a comparison for a person at a terminal: every row, then runs and costs. */
#include "validation/compare_words.h"

#include "report/escape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void put_side(FILE *out, const char *side, const struct results *r) {
    if (r->references) {
        fprintf(out, "%s  %s: references, tier %s, of commit %.12s, accepted until %s\n", side,
                r->folder, r->tier, r->commit, r->started);
        return;
    }
    fprintf(out, "%s  %s: tier %s, solver of commit %.12s (%s), started %s%s%s\n", side, r->folder,
            r->tier, r->commit, r->dirty, r->started, r->modification == NULL ? "" : ", MODIFIED: ",
            r->modification == NULL ? "" : r->modification);
}

static void put_row(FILE *out, const struct compare_row *r) {
    const struct results_row *row = compare_words_row(r);
    struct words difference = compare_words_difference(r), share = compare_words_share(r);
    fprintf(out, "  %-11s %s [%s]: ", compare_change_name(r->change), row->check, row->point);
    compare_words_values(out, r);
    if (*difference.text != '\0')
        fprintf(out, "; %s", difference.text);
    if (*share.text != '\0')
        fprintf(out, ", %s tolerances", share.text);
    if (*r->how != '\0')
        fprintf(out, " (%s, resolves %.2g)", r->how, r->half_width);
    char *remarks = NULL;
    size_t length = 0;
    FILE *text = open_memstream(&remarks, &length);
    if (text != NULL) {
        compare_words_remarks(text, r);
        fclose(text);
        fprintf(out, "%s%s", length > 0 ? "; " : "", length > 0 ? remarks : "");
    }
    free(remarks);
    fputc('\n', out);
}

static void put_rows(FILE *out, const struct compared *c) {
    const char *current = "";
    for (size_t i = 0; i < c->row_count; i++) {
        const char *name = compare_words_row(&c->row[i])->case_name;
        if (strcmp(name, current) != 0)
            fprintf(out, "\n%s\n", name);
        current = name;
        put_row(out, &c->row[i]);
    }
}

static void put_list(FILE *out, const char *what, const struct results_row *const *row,
                     size_t count) {
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s%s  %s: %s [%s]\n", i == 0 ? "\n" : "", what, row[i]->case_name,
                row[i]->check, row[i]->point);
}

static void put_skipped(FILE *out, const char *side, const struct results *r) {
    for (size_t i = 0; i < r->skipped_count; i++)
        fprintf(out, "not run in the %s one  %s: %s\n", side, r->skipped[i].case_name,
                r->skipped[i].reason == NULL ? "" : r->skipped[i].reason);
}

static void put_bits(FILE *out, const struct compare_runs *runs) {
    struct compare_case_bits b;
    fprintf(out, "\nbits: %zu runs in both, %zu unchanged, %zu differ, %zu cannot be read\n",
            runs->run_count, runs->count[BITS_EQUAL], runs->count[BITS_DIFFER],
            runs->count[BITS_UNKNOWN]);
    for (size_t i = 0; compare_words_next_case(runs, &i, &b);) {
        fprintf(out, "  %s: ", b.case_name);
        compare_words_bits(out, &b);
        fputc('\n', out);
    }
}

static void put_costs(FILE *out, const struct compare_runs *runs) {
    fprintf(out, "\ncost, run by run, with the standard uncertainty that the runs' own scatter "
                 "gives:\n");
    for (size_t i = 0; i < runs->cost_count; i++) {
        const struct compare_cost *c = &runs->cost[i];
        fprintf(out, "  %-32s %9.3f s -> %9.3f s  %s  %s (%zu runs)\n", c->part, c->old_s, c->new_s,
                compare_words_ratio(c).text, compare_words_speed(c), c->runs);
    }
    if (runs->cost_count == 0)
        fprintf(out, "  no run tells it on both sides\n");
}

void compare_write_text(const struct compare_view *v, FILE *out) {
    const struct compared *c = v->rows;
    put_side(out, "old", c->old);
    put_side(out, "new", c->new);
    put_rows(out, c);
    put_list(out, c->old->references ? "no reference" : "added", c->added, c->added_count);
    put_list(out, "removed", c->removed, c->removed_count);
    put_skipped(out, "old", c->old);
    put_skipped(out, "new", c->new);
    if (v->runs != NULL) {
        put_bits(out, v->runs);
        put_costs(out, v->runs);
    }
    fprintf(out, "\n%s: ", compare_words_conclusion(c));
    compare_words_counts(out, c);
    fputc('\n', out);
}
