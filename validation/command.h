/* command.h -- what bedcheck does, given its parsed options.
 *
 * Each command writes to the streams it is given and returns an exit code:
 * 0 all checks pass, 1 a check failed, 3 a check is inconclusive, 2 trouble of
 * bedcheck's own (2 before 1 before 3), 130 interrupted.
 */
#ifndef VALIDATION_COMMAND_H
#define VALIDATION_COMMAND_H

#include "validation/case.h"

#include <stdio.h>

struct console {
    FILE *out, *errors;
    bool live;           /* a terminal: show progress */
    const char *program; /* path of this program, to be called again; NULL: not known */
};

enum command_format { FORMAT_TEXT, FORMAT_JSON, FORMAT_MARKDOWN };

struct command_options {
    const char *cases_folder;      /* NULL: what the folder's record says (check, report) */
    const char *references_folder; /* NULL: what the folder's record says */
    const char *out;               /* folder of results */
    const char *solver;            /* a program's name or path */
    const char *path_list;         /* value of PATH, or NULL */
    char *const *environment;      /* for the solver */
    const char *const *pattern, *const *tag, *const *skip, *const *setting;
    size_t pattern_count, tag_count, skip_count, setting_count;
    enum tier tier;
    const char *const *chosen; /* accept: --case, patterns of names */
    size_t chosen_count;
    const char *reason;      /* accept: --reason */
    bool in_ci, all_changed; /* CI is set in the environment; accept: --all-changed */
    bool claims;             /* accept: --claims */
    bool tier_given, dry_run, failed, stop_at_failure, stale;
    size_t jobs;
    size_t seed_count;       /* --seeds; 0: as the cases say */
    const char *other;       /* compare: the second folder */
    const char *file, *plot; /* history: --file, --plot */
    double level;            /* compare: of false alarms, for the whole comparison */
    enum command_format format;
    double limit_s; /* --timeout; 0: as the cases say */
    long long seed_offset;
};

/* command_list.c */
int command_list(const struct command_options *o, const struct console *c);
int command_show(const struct command_options *o, const struct console *c);
int command_recipes(const struct console *c);

/* command_claims.c: the claims of the papers and the checks that decide them. */
int command_claims(const struct command_options *o, const struct console *c);

/* command_run.c */
int command_run(const struct command_options *o, const struct console *c);

/* command_accept.c: make results references. */
int command_accept(const struct command_options *o, const struct console *c);

/* command_calibrate.c: run with many seeds, and say what they tell of tolerances. */
int command_calibrate(const struct command_options *o, const struct console *c);

/* command_check.c: judge again what is there; with `page`, write report/index.html too. */
int command_check(const struct command_options *o, bool page, const struct console *c);
int command_clean(const struct command_options *o, const struct console *c);

/* command_compare.c: 0 nothing significant, 1 a significant difference, 2 not comparable or
 * trouble, 3 too little data. */
int command_compare(const struct command_options *o, const struct console *c);

/* command_history.c */
int command_history(const struct command_options *o, const struct console *c);

#endif
