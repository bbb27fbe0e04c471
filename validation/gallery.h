/* gallery.h -- which figures of which cases stand for the papers' figures.
 *
 * gallery.yaml beside the folder of cases:
 *
 *     figures:
 *       - paper: MFM
 *         figure: Fig. 3
 *         shows: what it shows, in our words
 *         axes: its axes
 *         note: how ours differs           # optional
 *         ours: [{case: graingas/sedimentation, recipe: snapshot}]
 *       - {paper: MFM, figure: Fig. 2, shows: ..., axes: ..., none: why there is none of ours}
 *
 * `ours` names figures of cases by recipe and, where a case has several of one, `title`.
 * Loading refuses what does not exist or is not one figure; a figure that the tier has not,
 * or whose case was not run, is told in the report.
 *
 * Checked by: tests/unit/test_gallery.c.
 */
#ifndef VALIDATION_GALLERY_H
#define VALIDATION_GALLERY_H

#include "report/gallery.h"
#include "validation/case.h"

struct gallery_source {
    const char *case_name, *recipe, *title; /* title may be NULL */
    size_t figure;                          /* index of the case's figures */
    bool in_tier[TIER_COUNT];
    const struct yaml_node *node;
};

struct gallery_entry {
    const char *paper, *figure, *shows, *axes, *note, *none; /* note and none may be NULL */
    size_t count;
    struct gallery_source *source;
    const struct yaml_node *node;
};

struct gallery {
    struct arena arena;
    struct yaml_document *document;
    size_t count;
    struct gallery_entry *entry;
};

/* gallery.yaml beside cases_folder; no file is an empty gallery.  On error *out is NULL and
 * fault has every finding. */
enum status gallery_load(const char *cases_folder, struct gallery **out, struct fault *fault);
void gallery_free(struct gallery *g); /* NULL is allowed */

struct assemble_case;

struct gallery_input {
    enum tier tier;
    const struct assemble_case *cases; /* cases[0 .. case_count-1] */
    const struct report_case *report;  /* report[i] shows cases[i] */
    /* item[i][k]: what figure k of case i has become; item[i] NULL: it was not run */
    const struct report_gallery_item *const *item;
    size_t case_count;
};

/* gallery_hang.c: the report's gallery; texts are g's, arrays the arena's. */
enum status gallery_hang(const struct gallery *g, const struct gallery_input *in, struct arena *a,
                         struct report_gallery *out, struct fault *fault);

#endif
