/* escape.h -- foreign text made harmless for the place where it will stand.
 *
 * Names, titles and logs come from case files and from other programs.  Each
 * function reads them as UTF-8: bytes that are none become U+FFFD, control
 * characters (illegal in XML, harmful on a terminal) are left out.  NULL is
 * read as the empty text.
 */
#ifndef REPORT_ESCAPE_H
#define REPORT_ESCAPE_H

#include <stdbool.h>
#include <stdio.h>

/* For HTML and XML, elements and quoted attributes alike. */
void escape_markup(FILE *out, const char *text);

/* For a Markdown paragraph or table cell: one line, no character with a meaning. */
void escape_markdown(FILE *out, const char *text);

/* For an id, a link's target or a file name: letters, digits, '-' and '.' stay,
 * '/' becomes '.', any other byte _XX; different names stay different but for '/' and '.'. */
void escape_name(FILE *out, const char *text);

/* bytes[0 .. length-1] of any kind, for a data: address or a block of data. */
void escape_base64(FILE *out, const char *bytes, size_t length);

/* A text as the content of a data: address: printing characters without a meaning stay. */
void escape_uri(FILE *out, const char *text);

/* UTF-8 without control characters (a newline is one)? */
bool escape_is_plain(const char *text);

#endif
