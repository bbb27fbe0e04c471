/* arena.h -- memory that is freed all at once.
 *
 * Cases, plans and reports are built piece by piece and dropped together: each
 * owns one arena.  Every piece is zeroed and stays where it is until
 * arena_free.  Nothing is ever freed alone.
 */
#ifndef VALIDATION_ARENA_H
#define VALIDATION_ARENA_H

#include <stddef.h>

struct arena {
    struct arena_block *last; /* NULL: empty; a zeroed struct is a valid arena */
};

/* count * size zeroed bytes (count 0 gives a valid pointer); NULL for lack of memory. */
void *arena_take(struct arena *a, size_t count, size_t size);

/* old[0 .. count-1] grown to hold one more element; copies when room runs out
 * (at powers of two), so old pointers into it may go stale.  NULL: no memory. */
void *arena_grow(struct arena *a, void *old, size_t count, size_t size);

/* Text by a printf format; NULL for lack of memory. */
char *arena_text(struct arena *a, const char *format, ...) __attribute__((format(printf, 2, 3)));
char *arena_copy(struct arena *a, const char *text);

void arena_free(struct arena *a);

#endif
