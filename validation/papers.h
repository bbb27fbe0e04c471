/* papers.h -- what the suite knows of the papers: claims, their stored verdicts, the gallery.
 *
 * All three stand beside the folder of cases or among the references, name cases and
 * checks, and are refused whole where they name what does not exist.
 */
#ifndef VALIDATION_PAPERS_H
#define VALIDATION_PAPERS_H

#include "validation/claims_stored.h"
#include "validation/gallery.h"

struct papers {
    struct claims *claims;
    struct claims_stored *stored;
    struct gallery *gallery;
};

/* references_folder may be NULL.  On error *out is empty and fault has every finding. */
enum status papers_open(const char *cases_folder, const char *references_folder, struct papers *out,
                        struct fault *fault);
void papers_close(struct papers *p); /* an empty one is allowed */

#endif
