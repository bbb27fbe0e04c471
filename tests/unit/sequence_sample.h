/* sequence_sample.h -- a few grains at three times, with hostile names. */
#ifndef SEQUENCE_SAMPLE_H
#define SEQUENCE_SAMPLE_H

#include "tests/unit/report_sample.h"

enum { SEQUENCE_GRAINS = 7, SEQUENCE_FRAMES = 3 };

struct sequence_sample {
    struct report_sequence sequence;
    struct report_frame frame[SEQUENCE_FRAMES];
    double position[SEQUENCE_FRAMES][2 * SEQUENCE_GRAINS], radius[SEQUENCE_GRAINS];
    unsigned char kind[SEQUENCE_GRAINS];
};

static inline void sequence_sample_fill(struct sequence_sample *s) {
    memset(s, 0, sizeof *s);
    for (int i = 0; i < SEQUENCE_GRAINS; i++) {
        s->radius[i] = .175 + .0113 * i;
        s->kind[i] = i % 3 == 1;
        for (int f = 0; f < SEQUENCE_FRAMES; f++) {
            s->position[f][2 * i] = .31 + .913 * ((3 * i + f) % SEQUENCE_GRAINS);
            s->position[f][2 * i + 1] = .27 + 1.173 * i + .37 * f;
        }
    }
    for (int f = 0; f < SEQUENCE_FRAMES; f++)
        s->frame[f] = (struct report_frame){.time = 1.37 * f, .position = s->position[f]};
    s->sequence = (struct report_sequence){.name = "time-sequence-1",
                                           .title = "Bed " SAMPLE_HOSTILE,
                                           .caption = "Caption " SAMPLE_HOSTILE,
                                           .alt = SAMPLE_HOSTILE,
                                           .time_unit = "tau",
                                           .kind_label = {"dark", SAMPLE_HOSTILE},
                                           .ground_label = "gas",
                                           .width = 6.3,
                                           .height = 9.7,
                                           .count = SEQUENCE_GRAINS,
                                           .frame_count = SEQUENCE_FRAMES,
                                           .radius = s->radius,
                                           .kind = s->kind,
                                           .frame = s->frame};
}

#endif
