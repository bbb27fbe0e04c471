/* runfile.h -- the flat description of one run, as bedcheck writes and a solver reads it.
 *
 *     format: bedcheck-run 1
 *     case: graingas/sedimentation
 *     point: height_l=64,darcy=published,start=random
 *     model: graingas
 *     samples: [0, 10, 20]            # times of fields and observables, in the model's unit
 *     particle_samples: [0, 20]       # times of particles; absent: as samples
 *     datasets: [particles/grains/position, fields/pressure, observables/collisions]
 *     start_file: ../h5/0123456789abcdef-s1101.h5     # relative to this file; may be absent
 *     parameters:
 *       height_l: 64    # validation/cases/graingas/sedimentation.yaml:18
 *
 * Nothing is swept and nothing is inherited here.  Parameters not named keep
 * the model's defaults.  Times increase strictly; the first may be 0.  The
 * start file lies in the folder of the run file, below it, or below its parent.
 *
 * A case file is accepted too, so that a solver can be tried on it by hand:
 * every swept parameter takes its first value (`notice` says which), tiers are
 * ignored, and every dataset of the model is wanted.
 */
#ifndef COMMON_RUNFILE_H
#define COMMON_RUNFILE_H

#include "common/yaml.h"

struct runfile {
    struct yaml_document *document;        /* owned */
    const char *case_name, *point, *model; /* borrowed from the document */
    double *samples;                       /* samples[0 .. sample_count-1] */
    size_t sample_count;
    double *particle_samples; /* particle_samples[0 .. particle_sample_count-1] */
    size_t particle_sample_count;
    const char **datasets;              /* datasets[0 .. dataset_count-1], borrowed texts */
    size_t dataset_count;               /* 0: a case file, every dataset is wanted */
    char *start_file;                   /* owned: path to open, or NULL */
    const struct yaml_node *parameters; /* a map, or NULL when there is none */
    struct yaml_node *merged;           /* owned: parameters of a case with a sweep, else NULL */
    char *notice; /* owned: "height_l = 58 (first of 7)", a line each; NULL if none */
};

enum status runfile_load(const char *path, struct runfile *out, struct fault *fault);
void runfile_free(struct runfile *r); /* frees what it owns; a zeroed struct is allowed */
bool runfile_wants(const struct runfile *r, const char *dataset);

/* Sample times, a list or {from, to, every} (both ends included): (*times)[0 ..
 * *count-1], to be freed; strictly increasing and not negative. */
enum status runfile_times(const struct yaml_node *n, double **times, size_t *count,
                          struct fault *fault);

#endif
