/* fault.c -- see fault.h. */
#include "common/fault.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

/* Append to f->text; what does not fit is left off. */
static void append(struct fault *f, const char *format, va_list arguments)
    __attribute__((format(printf, 2, 0)));

static void append(struct fault *f, const char *format, va_list arguments) {
    /* A caller may format the text of this very fault: build beside it. */
    char line[FAULT_TEXT_SIZE];
    vsnprintf(line, sizeof line, format, arguments);
    size_t used = strlen(f->text);
    snprintf(f->text + used, sizeof f->text - used, "%s%s", used > 0 ? "\n" : "", line);
}

enum status fault_set(struct fault *f, enum status status, const char *format, ...) {
    assert(status != STATUS_OK);
    char line[FAULT_TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    f->status = status;
    f->findings = 1;
    memcpy(f->text, line, strlen(line) + 1);
    return status;
}

enum status fault_add(struct fault *f, enum status status, const char *format, ...) {
    assert(status != STATUS_OK);
    if (f->status == STATUS_OK) {
        f->status = status;
        f->findings = 0;
        f->text[0] = '\0';
    }
    va_list arguments;
    va_start(arguments, format);
    append(f, format, arguments);
    va_end(arguments);
    f->findings++;
    return f->status;
}

enum status fault_within(struct fault *f, const char *format, ...) {
    char line[1024], rest[FAULT_TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    memcpy(rest, f->text, sizeof rest);
    snprintf(f->text, sizeof f->text, "%s: ", line);
    size_t used = strlen(f->text);
    snprintf(f->text + used, sizeof f->text - used, "%s", rest);
    return f->status;
}

int fault_exit_code(enum status status) {
    switch (status) {
    case STATUS_OK:
        return 0;
    case STATUS_NUMERICAL:
        return 1;
    case STATUS_INTERRUPTED:
        return 130;
    default:
        return 2;
    }
}
