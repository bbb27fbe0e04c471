#include "validation/arena.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct arena_block {
    struct arena_block *before;
    max_align_t data[];
};

void *arena_take(struct arena *a, size_t count, size_t size) {
    if (size > 0 && count > (SIZE_MAX - sizeof(struct arena_block)) / size)
        return NULL;
    struct arena_block *b = calloc(1, sizeof *b + count * size + 1);
    if (b == NULL)
        return NULL;
    b->before = a->last;
    a->last = b;
    return b->data;
}

void *arena_grow(struct arena *a, void *old, size_t count, size_t size) {
    if (count > 0 && (count & (count - 1)) != 0)
        return old; /* room was made at the last power of two */
    void *wider = arena_take(a, count == 0 ? 1 : 2 * count, size);
    if (wider != NULL && count > 0)
        memcpy(wider, old, count * size);
    return wider;
}

char *arena_text(struct arena *a, const char *format, ...) {
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    int length = vsnprintf(NULL, 0, format, list);
    va_end(list);
    char *text = length < 0 ? NULL : arena_take(a, (size_t)length + 1, 1);
    if (text != NULL)
        vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

char *arena_copy(struct arena *a, const char *text) {
    return arena_text(a, "%s", text);
}

void arena_free(struct arena *a) {
    while (a->last != NULL) {
        struct arena_block *b = a->last;
        a->last = b->before;
        free(b);
    }
}
