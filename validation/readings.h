/* readings.h -- named ways to read what a source leaves open, each a set of parameters.
 *
 * A paper may not give all that a model needs, or give numbers that do not go
 * together.  FOLDER/readings/MODEL.yaml names the ways to fill the gaps, each once:
 *
 *     model: suspension
 *     readings:
 *       literal: {title: ..., because: ..., parameters: {drive_scale: 1}}
 *
 * A case says `reading: literal`, fixed or swept; see case_point for what comes first
 * where more than one place sets a parameter.  Which names and values are good is for
 * the solver to say.
 *
 * Checked by: tests/unit/test_readings.c.
 */
#ifndef VALIDATION_READINGS_H
#define VALIDATION_READINGS_H

#include "common/yaml.h"

struct readings; /* opaque: owns the file's tree */

/* folder/readings/MODEL.yaml; STATUS_NOT_FOUND where there is none, else
 * STATUS_BAD_INPUT with every finding.  On error *out is NULL. */
enum status readings_load(const char *folder, const char *model, struct readings **out,
                          struct fault *fault);
void readings_free(struct readings *r); /* NULL is allowed */

/* Every file of folder/readings is whole, also those that no case uses; no such folder is good. */
enum status readings_check_folder(const char *folder, struct fault *fault);

/* name[0 .. count-1].key: all readings, each a map of title, because and parameters. */
const struct yaml_node *readings_all(const struct readings *r);
/* The parameters that a reading sets, or NULL where there is no such reading. */
const struct yaml_node *readings_parameters(const struct readings *r, const char *name);

#endif
