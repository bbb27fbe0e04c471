/* sheet.c -- see sheet.h. */
#include "report/sheet.h"

#include "common/file.h"

#include <stdlib.h>

enum status sheet_open(struct sheet *s, struct fault *fault) {
    *s = (struct sheet){0};
    s->out = open_memstream(&s->text, &s->length);
    return s->out ? STATUS_OK : fault_set(fault, STATUS_NO_MEMORY, "report: out of memory");
}

enum status sheet_close(struct sheet *s, struct fault *fault) {
    if (!s->out)
        return STATUS_OK;
    int failed = ferror(s->out);
    failed |= fclose(s->out);
    s->out = NULL;
    return failed ? fault_set(fault, STATUS_NO_MEMORY, "report: out of memory") : STATUS_OK;
}

enum status sheet_save(struct sheet *s, const char *path, struct fault *fault) {
    enum status status = sheet_close(s, fault);
    return status ? status : file_write(path, s->text, s->length, fault);
}

void sheet_free(struct sheet *s) {
    if (s->out)
        fclose(s->out);
    free(s->text);
    *s = (struct sheet){0};
}
