/* words.h -- numbers and verdicts as a reader wants them, the same in every output.
 *
 * A measured value has its uncertainty with two significant digits and is
 * itself cut at the same place: 1.234 ± 0.012.  Very large and small numbers
 * are written as 1.2·10⁻⁵.  NaN is a dash.
 */
#ifndef REPORT_WORDS_H
#define REPORT_WORDS_H

#include "report/report.h"

#include <stdio.h>

struct words {
    char text[160];
};

/* Four significant digits; six with words_exact. */
struct words words_number(double value);
struct words words_exact(double value);

/* value ± uncertainty; without the latter (0 or NaN) as words_exact. */
struct words words_measured(double value, double uncertainty);

/* "± 0.036", "at most + 0.1": the row's tolerance as its comparison reads it. */
struct words words_tolerance(const struct report_row *row);

/* "1.164 to 1.236", "≤ 1.1": the values that pass. */
struct words words_accepted(const struct report_row *row);

/* Margin used: "63 %", "over 1000 %", "–". */
struct words words_margin(double used);

struct words words_seconds(double seconds); /* "0.42 s", "3 min 20 s" */

/* " l/tau" for a unit, "" for none ("1", "" or NULL). */
struct words words_unit(const char *unit);

/* One sentence with the verdict and its counts. */
void words_sentence(FILE *out, const struct report *r);

/* What the comparisons with stored references say. */
void words_changes(FILE *out, const struct report *r);

/* Two sentences each: the false alarms that unchanged code may raise, and whose bits are those of
 * their references.  Nothing where nothing is known. */
void words_budget(FILE *out, const struct report *r);
void words_bits(FILE *out, const struct report *r);
bool words_has_bits(const struct report *r); /* is there anything to say? */

/* "PASS", "FAIL", "INCONCLUSIVE", "ONLY KNOWN DISAGREEMENTS", "NOTHING JUDGED" */
const char *words_headline(const struct report *r);

#endif
