/* gnuplot.h -- one script in, one picture out.
 *
 * gnuplot is started without a shell and without its start-up files.  Script
 * and output are files in memory: nothing can block on a full pipe, no signal
 * can come of it, and no state of this process is changed.  Text of foreign
 * origin goes into the script only through gnuplot_put_text, numbers only
 * through "%.9g" and data blocks.
 */
#ifndef REPORT_GNUPLOT_H
#define REPORT_GNUPLOT_H

#include "report/sheet.h"

/* Of one picture. They take seconds; a machine that is busy with runs has been seen to need a
 * minute. The limit only ends what would never end. */
enum { GNUPLOT_LIMIT_S = 600 };

/* Run a closed sheet as a script; *out[0 .. *length-1] and a NUL is what it
 * printed; free() it.  STATUS_NOT_FOUND when gnuplot is not installed,
 * STATUS_IO with its own words when it fails or takes over GNUPLOT_LIMIT_S. */
enum status gnuplot_run(const struct sheet *script, char **out, size_t *length,
                        struct fault *fault);

/* STATUS_BAD_INPUT for control characters and bytes that are not UTF-8;
 * `what` names the text in the message.  NULL is allowed: the empty text. */
enum status gnuplot_check_text(const char *text, const char *what, struct fault *fault);

/* A checked text in single quotes, where gnuplot expands nothing. */
void gnuplot_put_text(FILE *script, const char *text);

#endif
