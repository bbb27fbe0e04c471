/* spheres.c -- memory of the size and alignment that the hot path wants. */
#include "solver/suspension/spheres.h"

#include <stdlib.h>
#include <sys/mman.h>

enum { LINE = 64, HUGE_PAGE = 2 << 20 };

void *spheres_memory(size_t bytes) {
    size_t alignment = bytes >= 2 * (size_t)HUGE_PAGE ? HUGE_PAGE : LINE;
    void *memory = NULL;
    if (bytes > SIZE_MAX / 2 || posix_memalign(&memory, alignment, bytes + LINE) != 0)
        return NULL;
#ifdef MADV_HUGEPAGE
    if (alignment == HUGE_PAGE)
        (void)madvise(memory, bytes, MADV_HUGEPAGE); /* a wish: nothing depends on it */
#endif
    return memory;
}
