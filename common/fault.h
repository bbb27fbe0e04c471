/* fault.h -- what went wrong, told once and in full.
 *
 * Every function that can fail returns an enum status and takes, as its last
 * argument, a struct fault in which it says what failed: the file, the line,
 * the key, the number.  Libraries never print: a program prints the fault and
 * turns its status into an exit code.  A fault may hold several lines, one a
 * finding, so that a reader of a case file sees all its mistakes at once.
 */
#ifndef COMMON_FAULT_H
#define COMMON_FAULT_H

#include <stdarg.h>

enum status {
    STATUS_OK = 0,
    STATUS_BAD_INPUT, /* a file, key, value or option that cannot be accepted */
    STATUS_NOT_FOUND, /* a name or file that does not exist */
    STATUS_IO,        /* disk, permissions, HDF5 */
    STATUS_NO_MEMORY,
    STATUS_NUMERICAL,  /* not converged, NaN, too many sweeps: the solver's own failure */
    STATUS_INTERRUPTED /* SIGINT or SIGTERM */
};

enum { FAULT_TEXT_SIZE = 8192 };

struct fault {
    enum status status;         /* of the first finding; STATUS_OK when there is none */
    int findings;               /* lines said, those past the text's room included */
    char text[FAULT_TEXT_SIZE]; /* one finding a line, no final newline */
};

#define FAULT_NONE ((struct fault){.status = STATUS_OK})

/* Replace what is there by one finding; returns status, so that a caller can
 * write `return fault_set(fault, STATUS_IO, ...)`. */
enum status fault_set(struct fault *f, enum status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Add one more finding; the status stays that of the first. */
enum status fault_add(struct fault *f, enum status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Put "context: " before the text: the file or the run that it happened in. */
enum status fault_within(struct fault *f, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Exit code of a program that stops with this status: 0 for STATUS_OK, 1 for
 * STATUS_NUMERICAL, 130 for STATUS_INTERRUPTED, 2 for everything else. */
int fault_exit_code(enum status status);

#endif
