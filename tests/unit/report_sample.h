/* report_sample.h -- a small report with hostile names, for the tests of report/. */
#ifndef REPORT_SAMPLE_H
#define REPORT_SAMPLE_H

#include "report/report.h"

#include <math.h>
#include <string.h>

#define SAMPLE_HOSTILE "<b>x</b>'; rm `id` \"|\" &amp; _a^2 {/*}"

struct sample {
    struct report report;
    struct report_case cases[3];
    struct report_row first[3], second[2];
    struct report_fact fact[2];
    struct report_figure figure[2];
    struct report_panel panel[2];
    struct report_series series[2];
    struct report_picture picture;
    struct report_table table;
    double x[4], y[4], error[4], line[4], radius[4], shade[4];
    const char *heading[2], *cell[2], *runs[2];
    double values[2];
    long long seeds[2];
};

static inline struct report_row sample_row(const char *name, const char *point, const char *check,
                                           double measured) {
    return (struct report_row){.case_name = name,
                               .point = point,
                               .check = check,
                               .observable = "settling.speed",
                               .unit = "U0",
                               .measured = measured,
                               .uncertainty = .0123,
                               .expected = 1.21,
                               .expected_uncertainty = .004,
                               .tolerance = .0363,
                               .comparison = "within",
                               .kind = "model",
                               .verdict = VERDICT_PASS,
                               .because = "four seeds of an independent code",
                               .reason = "1.2 lies within 1.21 ± 0.036",
                               .repeat = "bedsim run 'a b.yaml' --seed 1101",
                               .seconds = 1.37,
                               .freedom = 3,
                               .detectable = (double)NAN,
                               .alarm_rate = (double)NAN};
}

static inline void sample_rows(struct sample *s) {
    const char *name = "graingas/sedimentation";
    s->first[0] = sample_row(name, "height_l=64", "own law", 1.1973);
    s->first[1] = sample_row(name, "height_l=82", "own law", 1.3137);
    s->first[1].verdict = VERDICT_FAIL;
    s->first[1].reason = "1.3137 lies above 1.2463";
    s->first[1].runs = s->runs;
    s->first[1].run_count = 2;
    s->first[1].values = s->values;
    s->first[1].seeds = s->seeds;
    s->first[1].value_count = 2;
    s->first[1].detectable = .0473;
    s->first[2] = sample_row(name, "height_l=82", "own law", 1.2437);
    s->first[2].verdict = VERDICT_INCONCLUSIVE;
    s->first[2].reason = "the interval crosses 1.2463";
    s->second[0] = sample_row(SAMPLE_HOSTILE, SAMPLE_HOSTILE, SAMPLE_HOSTILE, (double)NAN);
    s->second[0].uncertainty = (double)NAN;
    s->second[0].verdict = VERDICT_FAIL;
    s->second[0].kind = "run";
    s->second[0].reason = "ended by signal 11";
    s->second[0].log_end = "step 4011\x1b[31m red\n<script>alert(1)</script> \xff\x01";
    s->second[1] = sample_row(SAMPLE_HOSTILE, "", "round-off", 1.37e-15);
    s->second[1].uncertainty = 0;
    s->second[1].expected = 1e-12;
    s->second[1].expected_uncertainty = s->second[1].tolerance = 0;
    s->second[1].comparison = "at most";
    s->second[1].unit = "1";
}

static inline void sample_drawings(struct sample *s) {
    for (int i = 0; i < 4; i++) {
        s->x[i] = .37 + 1.31 * i;
        s->y[i] = 1.173 - .11 * i;
        s->error[i] = .0137;
        s->line[i] = 1.2 - .1 * i;
        s->radius[i] = .2 + .01 * i;
        s->shade[i] = .3 * i;
    }
    s->series[0] =
        (struct report_series){SAMPLE_HOSTILE, SERIES_POINTS, 0, 4, s->x, s->y, s->error};
    s->series[1] = (struct report_series){"law", SERIES_LINE, 1, 4, s->x, s->line, NULL};
    s->panel[0] = (struct report_panel){"speed (U₀)", false, 0, 0, 2, s->series};
    s->panel[1] = (struct report_panel){"ratio (1)", false, 0, 0, 1, s->series};
    for (int i = 0; i < 2; i++)
        s->figure[i] = (struct report_figure){"curve",
                                              "Curve " SAMPLE_HOSTILE,
                                              "Caption.",
                                              "Alternative text.",
                                              "height (l)",
                                              false,
                                              0,
                                              NULL,
                                              2,
                                              s->panel};
    s->picture = (struct report_picture){
        "snapshot", "Grains",  "Caption.", "Four grains.",   5.3, 2.1, 4, s->x,
        s->y,       s->radius, s->shade,   "solid fraction", .2,  .6};
    s->heading[0] = "H (l)";
    s->heading[1] = SAMPLE_HOSTILE;
    s->cell[0] = "64";
    s->cell[1] = "1.197 ± 0.012";
    s->table = (struct report_table){"Speeds", "Means.", 2, 1, s->heading, s->cell};
}

/* The failed row of the first case is one that was known to disagree. */
static inline void sample_know(struct sample *s) {
    s->first[1].verdict = VERDICT_KNOWN;
    s->first[1].since = "2026-11-20";
    s->first[1].reason = "known since 2026-11-20: 1.3137 lies above 1.2463";
}

/* Three statistical rows, one of unknown rate; three of four runs with the reference's bits. */
static inline void sample_budget(struct sample *s) {
    s->report.budget = (struct report_budget){.allowed = 1e-3, .share = 2.5e-6, .statistical = 400};
    s->report.bits = (struct report_bits){.same = 3, .other = 1, .unknown = 2};
    for (int i = 0; i < 3; i++)
        s->first[i].statistical = true;
    s->first[0].alarm_rate = 2.5e-6;
    s->first[1].alarm_rate = 1.2e-5;
}

/* Two cases of five rows (2 pass, 2 fail, 1 inconclusive) and one that was skipped. */
static inline void sample_fill(struct sample *s) {
    memset(s, 0, sizeof *s);
    s->runs[0] = "graingas.sedimentation.1a2b3c4d-s1101";
    s->runs[1] = "graingas.sedimentation.1a2b3c4d-s1102";
    s->values[0] = 1.3057;
    s->values[1] = 1.3217;
    s->seeds[0] = 1101;
    s->seeds[1] = 1102;
    sample_rows(s);
    sample_drawings(s);
    s->cases[0] = (struct report_case){.name = "graingas/sedimentation",
                                       .title = "Sedimentation",
                                       .source = "MFM, Section III",
                                       .question = "Does it settle?",
                                       .command = "bedcheck run graingas/sedimentation",
                                       .row_count = 3,
                                       .row = s->first,
                                       .figure_count = 2,
                                       .figure = s->figure,
                                       .picture_count = 1,
                                       .picture = &s->picture,
                                       .table_count = 1,
                                       .table = &s->table};
    s->cases[1] = (struct report_case){.name = SAMPLE_HOSTILE,
                                       .title = SAMPLE_HOSTILE,
                                       .source = SAMPLE_HOSTILE,
                                       .question = SAMPLE_HOSTILE,
                                       .command = SAMPLE_HOSTILE,
                                       .row_count = 2,
                                       .row = s->second};
    s->cases[2] = (struct report_case){.name = "graingas/fluidization",
                                       .title = "Fluidization",
                                       .skipped = true,
                                       .skip_reason = "no time | today"};
    s->fact[0] = (struct report_fact){"commit", "0123abcd " SAMPLE_HOSTILE};
    s->fact[1] = (struct report_fact){"solver: dirty", "dirty"};
    s->report = (struct report){.suite = "bedcheck 0.1.0",
                                .tier = "smoke",
                                .solver = "build/bin/bedsim",
                                .solver_key = "3fe91a0c",
                                .started = "2026-11-22T01:30:00Z",
                                .case_count = 3,
                                .cases = s->cases,
                                .fact_count = 2,
                                .fact = s->fact};
}

#endif
