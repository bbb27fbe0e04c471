/* animation.h -- the parts of an animation's page; only animation*.c include this. */
#ifndef REPORT_ANIMATION_H
#define REPORT_ANIMATION_H

#include "report/report.h"

/* A page with all that it needs stays below 2 MB: base64 makes four bytes of three, and some
 * room is for the rest. */
enum { ANIMATION_MAX_BYTES = 1450 * 1000 };

/* The places of all grains, packed: every stride-th frame, in whole units; see animation_data.c. */
struct animation_data {
    unsigned char *bytes; /* bytes[0 .. length-1], to be freed */
    size_t length, stride;
    double unit; /* l */
};

/* Units of a sixteenth to a quarter of the largest radius and every frame; where that is over
 * ANIMATION_MAX_BYTES only every second, third, ... */
enum status animation_pack(const struct report_sequence *s, struct animation_data *out,
                           struct fault *fault);

const char *animation_script(void); /* the player, JavaScript without libraries */
const char *animation_style(void);  /* of its page, CSS */

#endif
