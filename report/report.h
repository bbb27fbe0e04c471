/* report.h -- rows and curves, ready to be shown: no physics, no judging.
 *
 * validation/ fills these structs; report/ turns the same structs into
 * results.json (json_report.c), junit.xml (junit.c), summary.md (markdown.c)
 * and index.html (html.c, with figures drawn by gnuplot: figure.c, grain
 * pictures: picture.c, time sequences: sequence.c, animations: animation.c).  All text is borrowed
 * from the caller and escaped here.
 */
#ifndef REPORT_REPORT_H
#define REPORT_REPORT_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

/* KNOWN: it fails, on evidence that was written down before; it decides nothing. */
enum verdict { VERDICT_PASS, VERDICT_FAIL, VERDICT_INCONCLUSIVE, VERDICT_KNOWN };

/* One check at one point. */
struct report_row {
    const char *case_name, *point, *check, *observable, *unit;
    double measured, uncertainty; /* NaN where it does not exist: see reason */
    double expected, expected_uncertainty;
    double tolerance;       /* half width of what passes, in the unit of measured */
    const char *comparison; /* "within", "outside", "at most", "at least" */
    const char *kind;       /* "round-off", "order", "model", "regression", "run" */
    enum verdict verdict;
    const char *because;     /* why this expectation and tolerance */
    const char *reason;      /* of the verdict, one sentence with numbers */
    const char *repeat;      /* the one command that repeats the run(s) */
    const char *log_end;     /* last lines of a failed run's log, or NULL */
    const char *const *runs; /* run ids, runs[0 .. run_count-1] */
    size_t run_count;
    double seconds; /* wall time of its runs */

    size_t value_count;     /* what each seed gave: 0 where a row has no values of single seeds */
    const double *values;   /* values[0 .. value_count-1], unit of measured; NaN: missing */
    const long long *seeds; /* seeds[i] gave values[i] */
    double freedom;         /* degrees of freedom of the uncertainty; INFINITY: declared */
    const char *key;        /* what references call the observable, or NULL */
    const char *meaning;    /* digest of its runs and observables, or NULL */
    double detectable;      /* smallest change seen with 95 %, unit of measured; NaN: not known */
    bool statistical;       /* does its verdict hang on scatter between seeds */
    double alarm_rate;      /* probability of no pass for unchanged code; NaN: not known */
    const char *since;      /* date since which the disagreement is known, or NULL */
    const char *bits;       /* what the bits of its runs say against the reference, or NULL */
};

enum series_style { SERIES_POINTS, SERIES_DOTS, SERIES_LINE, SERIES_DASHED, SERIES_LINE_POINTS };
/* Dots are small points, for a line to be seen through them. */

struct report_series {
    const char *label;
    enum series_style style;
    int colour; /* 0..5, the six colours of the house; -1: grey */
    size_t count;
    const double *x, *y, *error; /* error may be NULL */
};

struct report_panel {
    const char *y_label;
    bool y_log;
    double y_min, y_max; /* automatic where y_min >= y_max */
    size_t series_count;
    const struct report_series *series;
};

/* One figure: one panel, or two above each other with a common x axis (a residual panel). */
struct report_figure {
    const char *name;                  /* file-name safe: "settling-curve" */
    const char *title, *caption, *alt; /* caption says what is seen and what is expected */
    const char *x_label;
    bool x_log;
    size_t x_name_count; /* not 0: the axis has no scale, but x_name[i] at i */
    const char *const *x_name;
    size_t panel_count; /* 1 to 3 */
    const struct report_panel *panel;
};

/* Grains in a box, coloured by a value or by a class. */
struct report_picture {
    const char *name, *title, *caption, *alt;
    double width, height; /* of the box, l */
    size_t count;
    const double *x, *y, *radius; /* l */
    const double *shade;          /* 0..1 for the colour scale; NULL: plain */
    const char *shade_label;      /* of the colour bar: "solid fraction" */
    double shade_min, shade_max;  /* values at 0 and 1 */
};

struct report_frame {
    double time;
    const double *position; /* position[2*grain + axis], l; y upwards */
    const double *depth;    /* depth[grain], l behind the front; for lit spheres only */
};

enum { REPORT_KINDS = 5 };

/* The same grains at several times: side by side (sequence.c), or moving (animation.c).  They are
 * flat discs of two kinds, dark and light, or lit spheres of five, the nearest in front. */
struct report_sequence {
    const char *name, *title, *caption, *alt;
    const char *time_unit;                /* "tau" */
    const char *length_unit;              /* "R"; NULL: l, as all lengths below are called */
    bool lit;                             /* spheres, of the depths that all frames then have */
    const char *kind_label[REPORT_KINDS]; /* NULL where there is none */
    const char *ground_label;             /* of what is between them: "gas" */
    double width, height;                 /* of the box, l */
    size_t count, frame_count;
    const double *radius;             /* radius[0 .. count-1], l */
    const unsigned char *kind;        /* kind[0 .. count-1]: 0 dark, 1 light; lit: 0 to 4 */
    const struct report_frame *frame; /* frame[0 .. frame_count-1]; times increase */
};

struct report_table {
    const char *title, *caption;
    size_t columns, rows;
    const char *const *heading; /* heading[0 .. columns-1] */
    const char *const *cell;    /* cell[row*columns + column] */
};

struct report_case {
    const char *name, *title, *source, *question, *command;
    const char *equation; /* that is tested, or NULL */
    bool skipped;
    const char *skip_reason;
    size_t row_count, figure_count, picture_count, table_count, sequence_count, animation_count;
    const struct report_row *row;
    const struct report_figure *figure;
    const struct report_picture *picture;
    const struct report_table *table;
    const struct report_sequence *sequence, *animation;
};

struct report_fact {
    const char *name, *value;
};

/* What unchanged code may do to a run of the suite. */
struct report_budget {
    double allowed,
        share;          /* false alarms of the whole tier, and of each statistical row; 0: none */
    size_t statistical; /* rows of the tier, judged here or not */
};

struct report_bits { /* runs with and without the bits of their reference */
    size_t same, other, unknown;
};

/* What the suite cannot see, whatever its verdicts. */
struct report_limit {
    const char *model, *what, *because;
};

/* Rows of a group taken together: ln(measured/expected) has a mean, shown as the ratio `bias`, and
 * a standard deviation `scatter`; low and high are their 95 % interval, NaN for fewer than three
 * cases.  `noise` is the part of the scatter that the rows' own uncertainties explain. */
struct report_group {
    const char *name;
    size_t rows, cases;
    double bias, bias_low, bias_high, scatter, scatter_low, scatter_high, noise;
};

struct report_agreement {
    size_t group_count, round_off, one_sided, other; /* the last three: rows without a ratio */
    const struct report_group *group;
    struct report_figure figure;
};

struct report {
    const char *suite; /* "bedcheck 0.1.0" */
    const char *tier, *solver, *solver_key, *started;
    bool modified;            /* --set was used: the report says MODIFIED */
    const char *modification; /* "restitution=0.5" */
    struct report_budget budget;
    struct report_bits bits;
    size_t case_count, fact_count;
    const struct report_case *cases;
    const struct report_fact *fact; /* provenance: commit, machine, versions, times */
    size_t limit_count, unselected_count;
    const struct report_limit *limit;         /* of the models in this report */
    const char *const *unselected;            /* cases of this tier that nobody asked for */
    const struct report_agreement *agreement; /* or NULL */
    const struct report_ledger *ledger;       /* the papers' claims (ledger.h), or NULL */
    const struct report_gallery *gallery;     /* and their figures (gallery.h), or NULL */
};

struct report_count {
    size_t pass, fail, inconclusive, known, skipped;
};
struct report_count report_tally(const struct report *r);
struct report_alarms {    /* of the statistical rows that were judged */
    size_t rows, unknown; /* unknown: rows without an ensemble to compute their rate from */
    double sum;           /* of the known rates */
};
struct report_alarms report_alarms(const struct report *r);
/* Fail before inconclusive before pass; known where there is nothing else. */
enum verdict report_verdict(const struct report *r);
/* Share of the tolerance that a row uses up; 1 is the limit, NaN where nothing was measured.
 * |measured-expected|/tolerance for "within" and its inverse for "outside".  One-sided with a
 * tolerance: what lies beyond expected, of it.  Without one, the way from the best value to the
 * limit: from 0 for "at most", from above for "at least" (limit/measured), from 1 for a share that
 * must be at least a half or more. */
double report_margin_used(const struct report_row *row);
/* The worst failed row, else the tightest other one: largest margin used; NULL if none. */
const struct report_row *report_worst(const struct report *r);
const char *verdict_name(enum verdict v); /* "pass", "fail", "inconclusive", "known" */

/* Each writes its file whole or not at all. */
enum status report_write_json(const struct report *r, const char *path, struct fault *fault);
enum status report_write_junit(const struct report *r, const char *path, struct fault *fault);
enum status report_write_markdown(const struct report *r, const char *path, struct fault *fault);
/* folder/index.html, self-contained, and beside it pictures in full size, CASE.NAME.png, sequences,
 * CASE.NAME.svg, and animations, CASE.NAME.html ('/' in the case's name becomes '.'). */
enum status report_write_html(const struct report *r, const char *folder, struct fault *fault);

#endif
