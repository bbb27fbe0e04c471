#include "validation/papers.h"

enum status papers_open(const char *cases_folder, const char *references_folder, struct papers *out,
                        struct fault *fault) {
    *out = (struct papers){0};
    enum status status = claims_load(cases_folder, &out->claims, fault);
    if (status == STATUS_OK)
        status = claims_stored_load(references_folder, out->claims, &out->stored, fault);
    if (status == STATUS_OK)
        status = gallery_load(cases_folder, &out->gallery, fault);
    if (status != STATUS_OK)
        papers_close(out);
    return status;
}

void papers_close(struct papers *p) {
    gallery_free(p->gallery);
    claims_stored_free(p->stored);
    claims_free(p->claims);
    *p = (struct papers){0};
}
