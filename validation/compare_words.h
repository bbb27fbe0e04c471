/* compare_words.h -- the phrases that the text and the Markdown of a comparison share. */
#ifndef VALIDATION_COMPARE_WORDS_H
#define VALIDATION_COMPARE_WORDS_H

#include "report/words.h"
#include "validation/compare_write.h"

/* "NOT COMPARABLE", "SIGNIFICANT DIFFERENCE", "TOO LITTLE DATA", "NOTHING SIGNIFICANT" */
const char *compare_words_conclusion(const struct compared *c);

/* One sentence: how many of what, at which level. */
void compare_words_counts(FILE *out, const struct compared *c);

/* "1.0054 ± 0.0071 -> 1.0061 ± 0.0071 l"; one number where nothing changed. */
void compare_words_values(FILE *out, const struct compare_row *r);

/* "+0.0007 ± 0.0003", "" where there is no difference to tell. */
struct words compare_words_difference(const struct compare_row *r);

/* The difference in tolerances: "+0.021", "". */
struct words compare_words_share(const struct compare_row *r);

/* What a reader must know besides: note, verdicts and expectations that changed. */
void compare_words_remarks(FILE *out, const struct compare_row *r);

/* The row of either side, for its names. */
const struct results_row *compare_words_row(const struct compare_row *r);

/* "-5.2 % ± 0.8 %", and "faster", "slower" or "no difference seen". */
struct words compare_words_ratio(const struct compare_cost *c);
const char *compare_words_speed(const struct compare_cost *c);

struct compare_case_bits { /* the runs of one case */
    const char *case_name;
    size_t runs, differ, unknown;
    struct compare_sample first, parted; /* the earliest of its runs */
    const char *why;                     /* of the first unknown one */
};

/* The next case after `index` (0: the first) in the list of runs; false at the end. */
bool compare_words_next_case(const struct compare_runs *c, size_t *index,
                             struct compare_case_bits *out);

/* "2 of 2 runs differ: first at 0.5 (step 50, ...)" */
void compare_words_bits(FILE *out, const struct compare_case_bits *b);

#endif
