/* folder.h -- the folder of results: its paths, its record, its lock.
 *
 *     DIR/bedcheck.yaml           what was asked: cases, tier, options, solver
 *     DIR/runs/ID.yaml            run files
 *     DIR/h5/NAME.{h5,run.json,key}
 *     DIR/logs/NAME.log           output of the solver
 *     DIR/results.json, junit.xml, summary.md, report/
 *
 * A folder that holds something else and no record of ours is left alone.  One
 * bedcheck at a time works in a folder.
 */
#ifndef VALIDATION_FOLDER_H
#define VALIDATION_FOLDER_H

#include "common/digest.h"
#include "validation/plan.h"

struct folder; /* opaque */

/* An existing folder of ours; with `make`, also one that is empty or not there
 * yet.  STATUS_BAD_INPUT for a folder of others' or one in use. */
enum status folder_open(const char *path, bool make, struct folder **out, struct fault *fault);
void folder_close(struct folder *f); /* NULL is allowed */

/* Would folder_open with `make` find a folder that it may use?  Changes nothing. */
enum status folder_check(const char *path, struct fault *fault);

/* Remove the reports of an earlier judging, which new runs make untrue. */
enum status folder_drop_reports(const struct folder *f, struct fault *fault);
const char *folder_path(const struct folder *f);

/* DIR/bedcheck.yaml: enough to judge the folder again. */
struct folder_record {
    struct arena arena; /* of a record that was read */
    const char *cases_folder, *tier, *started;
    const char *references_folder; /* NULL: none, or a record of an earlier version */
    const char *solver;            /* path, as it was resolved */
    const char *solver_key;        /* digest of its bytes */
    long long seed_offset;
    size_t seed_count; /* --seeds; 0: as the cases say */
    size_t case_count, setting_count;
    const char *const *case_name;   /* selected cases */
    const char *const *skip_reason; /* skip_reason[0 .. case_count-1]: "" where it is run */
    const char *const *setting;     /* --set, "name=value" */
};

enum status folder_write_record(const struct folder *f, const struct folder_record *r,
                                struct fault *fault);
enum status folder_read_record(const struct folder *f, struct folder_record *out,
                               struct fault *fault);
void folder_record_free(struct folder_record *r);

/* Paths, in the arena; NULL for lack of memory. */
const char *folder_run_file(const struct folder *f, struct arena *a, const struct plan_run *run);
const char *folder_result(const struct folder *f, struct arena *a, const struct plan_run *run);
const char *folder_key(const struct folder *f, struct arena *a, const struct plan_run *run);
const char *folder_run_record(const struct folder *f, struct arena *a, const struct plan_run *run);
const char *folder_log(const struct folder *f, struct arena *a, const struct plan_run *run);

/* Remove what a run has left: result, key, record, unfinished files. */
enum status folder_drop_result(const struct folder *f, const char *run_name, struct fault *fault);

/* Solver keys of all results in the folder, each once; *count of them. */
enum status folder_solver_keys(const struct folder *f, struct arena *a, const char ***out,
                               size_t *count, struct fault *fault);

/* Remove what bedcheck writes, by name, and the folders that are empty then.
 * *left says how many foreign files stay. */
enum status folder_clean(struct folder *f, size_t *removed, size_t *left, struct fault *fault);

/* Remove the results that another solver build made than the record's. */
enum status folder_clean_stale(const struct folder *f, size_t *removed, struct fault *fault);

#endif
