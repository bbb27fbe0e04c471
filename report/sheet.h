/* sheet.h -- a text that grows in memory and reaches the disk whole or not at all.
 *
 * Every writer of report/ prints into sheet.out with stdio; running out of
 * memory is noticed once, when the sheet is closed.
 */
#ifndef REPORT_SHEET_H
#define REPORT_SHEET_H

#include "common/fault.h"

#include <stddef.h>
#include <stdio.h>

struct sheet {
    FILE *out;  /* print here; NULL once closed */
    char *text; /* text[0 .. length-1] and a NUL, valid after sheet_close */
    size_t length;
};

enum status sheet_open(struct sheet *s, struct fault *fault);

/* No more printing; text and length become valid.  Closing twice is allowed. */
enum status sheet_close(struct sheet *s, struct fault *fault);

/* Close, then write the text to path. */
enum status sheet_save(struct sheet *s, const char *path, struct fault *fault);

void sheet_free(struct sheet *s); /* a zeroed or closed sheet is allowed */

#endif
