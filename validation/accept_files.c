#include "validation/accept_files.h"

#include "common/file.h"
#include "validation/arena.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct place { /* one file, old and new */
    const char *path, *staged, *before;
    bool replaced, existed;
};

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "accept: out of memory");
}

static enum status stage(const struct accept_file *f, struct arena *a, struct place *p,
                         struct fault *fault) {
    p->path = f->path;
    p->staged = arena_text(a, "%s.accept.%ld", f->path, (long)getpid());
    p->before = arena_text(a, "%s.before.%ld", f->path, (long)getpid());
    char *parent = arena_copy(a, f->path);
    if (p->staged == NULL || p->before == NULL || parent == NULL)
        return no_memory(fault);
    *strrchr(parent, '/') = '\0';
    enum status status = file_make_folder(parent, fault);
    if (status == STATUS_OK)
        status = file_write(p->staged, f->text, strlen(f->text), fault);
    struct stat about;
    p->existed = lstat(p->path, &about) == 0 && S_ISREG(about.st_mode);
    if (status == STATUS_OK && p->existed && link(p->path, p->before) != 0)
        status = fault_set(fault, STATUS_IO, "%s: cannot be kept aside", p->path);
    return status;
}

/* Leave what is there, or what was there before. */
static void tidy(struct place *p, bool restore) {
    if (restore && p->replaced && p->existed)
        rename(p->before, p->path);
    else if (restore && p->replaced)
        unlink(p->path);
    if (p->before != NULL)
        unlink(p->before);
    if (p->staged != NULL)
        unlink(p->staged);
}

enum status accept_files_write(const struct accept_file *file, size_t count, struct fault *fault) {
    struct arena a = {0};
    struct place *place = arena_take(&a, count, sizeof *place);
    enum status status = place == NULL ? no_memory(fault) : STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && i < count; i++)
        status = stage(&file[i], &a, &place[i], fault);
    for (size_t i = 0; status == STATUS_OK && i < count; i++) {
        status = file_replace(place[i].staged, place[i].path, fault);
        place[i].replaced = status == STATUS_OK;
    }
    for (size_t i = 0; place != NULL && i < count; i++)
        tidy(&place[i], status != STATUS_OK);
    arena_free(&a);
    return status;
}
