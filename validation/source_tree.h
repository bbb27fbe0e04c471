/* source_tree.h -- the git checkout that cases and references stand in.
 *
 * A stored number is worth what its history is worth: the commit that gave it must be
 * one that can be checked out again.  Stored references themselves do not count, for
 * accepting some leaves the code as it was.
 *
 * Asked of the program git, as a person would ask it.  Nothing is changed.
 */
#ifndef VALIDATION_SOURCE_TREE_H
#define VALIDATION_SOURCE_TREE_H

#include "validation/arena.h"

#include "common/fault.h"

#include <stdbool.h>

struct source_tree {
    struct arena arena;
    const char *git, *top;    /* the program; the checkout's folder */
    const char *leave_out;    /* pathspec of the references, or NULL: they lie outside */
    const char *head;         /* 40 hex digits */
    const char *first_change; /* a file that differs from HEAD or is new, or NULL: clean */
    bool is_ours;             /* it is bedcheck's own: bedcheck has to be of this commit, too */
    char *const *environment; /* borrowed */
};

/* The checkout around the folder of cases.  STATUS_BAD_INPUT when it is in none. */
enum status source_tree_look(const char *cases_folder, const char *references_folder,
                             const char *path_list, char *const *environment,
                             struct source_tree *out, struct fault *fault);
void source_tree_free(struct source_tree *t);

/* Is the tree of that commit HEAD's, references aside?  *known: does the checkout have it? */
enum status source_tree_is_head(struct source_tree *t, const char *commit, bool *is_head,
                                bool *known, struct fault *fault);

#endif
