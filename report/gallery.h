/* gallery.h -- each figure of the papers beside ours: what theirs shows, in our words, and where
 * ours stands in this report.  Their pictures are not copied.
 */
#ifndef REPORT_GALLERY_H
#define REPORT_GALLERY_H

#include "report/report.h"

enum gallery_kind {
    GALLERY_PLOT,
    GALLERY_PICTURE,
    GALLERY_SEQUENCE,
    GALLERY_ANIMATION,
    GALLERY_KINDS
};

/* What one figure of a case has become: in->figure[begin .. end-1], in->picture[..] and so on. */
struct report_gallery_item {
    const char *case_name;
    const struct report_case *in; /* NULL: not in this report */
    const char *missing;          /* why there is nothing to be seen, or NULL */
    size_t begin[GALLERY_KINDS], end[GALLERY_KINDS];
};

struct report_gallery_entry {
    const char *paper, *figure; /* "MFM", "Fig. 3" */
    const char *shows, *axes;   /* of theirs, in our words */
    const char *note;           /* how ours differs, or NULL */
    const char *none;           /* why there is none of ours, or NULL */
    size_t count;
    const struct report_gallery_item *item;
};

struct report_gallery {
    size_t count;
    const struct report_gallery_entry *entry;
};

#endif
