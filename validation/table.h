/* table.h -- a text table that people merge: comments, a header, sorted lines of columns.
 *
 *     # What this is.
 *     tier<tab>point<tab> ... <tab>reason
 *     paper<tab> ...
 *
 * Columns are separated by tabs and lines sorted as `LC_ALL=C sort` sorts, each of them once, so
 * that a merge conflict is solved in text and two branches that add lines seldom meet.  Reading
 * refuses, with file:line, another header, another number of columns, lines out of order or twice,
 * control characters, markers of a merge that is not finished, and a file cut off in a line.  What
 * the columns mean is their owner's to read: he is handed one line after the other, and refuses
 * with table_refuse.  All that is wrong is told, not the first of it.
 *
 * Used by:    reference.c (references of a case), claims_stored.c (verdicts of claims).
 * Checked by: tests/unit/test_table.c.
 */
#ifndef VALIDATION_TABLE_H
#define VALIDATION_TABLE_H

#include "validation/arena.h"

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

enum { TABLE_COLUMNS_MAX = 12 };

struct table_form {
    const char *what;          /* "references": of faults */
    const char *comment;       /* the first line, "# ..." with its end */
    const char *const *column; /* names: column[0 .. columns-1] */
    size_t columns;
    size_t max_bytes; /* of a file */
};

/* Where reading is. */
struct table_place {
    const char *path;
    size_t line; /* from 1 */
    struct arena *arena;
    struct fault *fault;
};

/* One line: field[0 .. columns-1], which may be cut up, and the line as it stands, which may not;
 * both stay with the arena.  What it refuses it has said; STATUS_NO_MEMORY ends the reading. */
typedef enum status table_take(void *owner, const struct table_place *at, char *const *field,
                               const char *whole);

/* Adds 'PATH:LINE: COLUMN: "TEXT" WHY' to the faults. */
bool table_refuse(const struct table_place *at, const char *column, const char *text,
                  const char *why); /* false */
/* "is no such COLUMN; did you mean 'name'?" with the nearest of name[0 .. count-1]. */
bool table_refuse_name(const struct table_place *at, const char *column, const char *text,
                       const char *const *name, size_t count); /* false */

bool table_is_hex(const char *text, size_t digits);

/* Reads a text, or the file from->path.  On error the fault has every finding. */
enum status table_read(const struct table_form *form, const struct table_place *from,
                       const char *text, table_take *take, void *owner);
enum status table_load(const struct table_form *form, const struct table_place *from,
                       table_take *take, void *owner);

/* The table of line[0 .. count-1], which are sorted on the way, NULL among them: no memory.  Free
 * *out. */
enum status table_write(const struct table_form *form, const char *path, const char **line,
                        size_t count, char **out, struct fault *fault);

#endif
