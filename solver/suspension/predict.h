/* predict.h -- when two spheres touch, for many partners at once.
 *
 * With r and v the relative place and velocity now, D the diameter and a its rate of
 * growth, |r + v tau| = D + a tau gives, with A = v^2 - a^2, B = r.v - a D and
 * C = r^2 - D^2,
 *     tau = C/(-B + sqrt(B^2 - A C)),
 * a form without cancellation.  They touch if B < 0 and the root is real; when the
 * surfaces grow faster than anything moves (A < 0), always.  A pair that overlaps by
 * round-off and approaches touches now.
 *
 * Checked by: tests/unit/test_engine.c (closed formulas), and the overlap check.
 */
#ifndef SUSPENSION_PREDICT_H
#define SUSPENSION_PREDICT_H

#include "solver/suspension/lanes.h"
#include "solver/suspension/spheres.h"

#include <stdbool.h>

enum { PREDICT_MOST = 256, PREDICT_ROOM = PREDICT_MOST + 16, PREDICT_SHIFTS = 27 };

/* Candidates of one search, and those that will touch. */
struct candidates {
    uint32_t label[PREDICT_ROOM];
    uint8_t shift[PREDICT_ROOM]; /* which of the 27 shifts; only across a boundary */
    uint32_t count;
    double tau[PREDICT_ROOM]; /* (s) tau[0 .. hits-1] */
    uint32_t hit[PREDICT_ROOM];
    uint32_t hits;
};

struct contact {
    double now;      /* (s, common clock) */
    double diameter; /* (m) now */
    double growth;   /* (m/s) */
};

/* Times of touching sphere s, which is at local time c->now, of all candidates.
 * shift[27][4] (m) is added to a partner's place when `shifted`. */
static inline __attribute__((always_inline)) void
predict_candidates(const struct sphere *s, const struct sphere *all, const struct contact *c,
                   bool shifted, bool growing, const double (*shift)[4], struct candidates *k) {
    const lanes now = lanes_all(c->now), d2 = lanes_all(c->diameter * c->diameter);
    const lanes x = lanes_all(s->x[0]), y = lanes_all(s->x[1]), z = lanes_all(s->x[2]);
    const lanes u = lanes_all(s->w[0]), v = lanes_all(s->w[1]), w = lanes_all(s->w[2]);
    const lanes a = lanes_all(c->growth), ad = lanes_all(c->growth * c->diameter);
    uint32_t hits = 0, count = k->count;
    k->label[count] = k->label[count > 0 ? count - 1 : 0]; /* an odd one is looked at twice */
    k->shift[count] = k->shift[count > 0 ? count - 1 : 0];
    for (uint32_t n = 0; n < count; n += 2) {
        const double *p = all[k->label[n]].x, *q = all[k->label[n + 1]].x;
        lanes p0 = lanes_load(p), p2 = lanes_load(p + 2), p4 = lanes_load(p + 4);
        lanes q0 = lanes_load(q), q2 = lanes_load(q + 2), q4 = lanes_load(q + 4);
        lanes wu = lanes_low(p4, q4), wv = lanes_high(p4, q4), ww = (lanes){p[6], q[6]};
        lanes dt = now - lanes_high(p2, q2);
        lanes rx = lanes_low(p0, q0) + wu * dt - x, ry = lanes_high(p0, q0) + wv * dt - y;
        lanes rz = lanes_low(p2, q2) + ww * dt - z;
        if (shifted) {
            const double *f = shift[k->shift[n]], *g = shift[k->shift[n + 1]];
            lanes f0 = lanes_load(f), g0 = lanes_load(g);
            rx += lanes_low(f0, g0);
            ry += lanes_high(f0, g0);
            rz += (lanes){f[2], g[2]};
        }
        lanes du = wu - u, dv = wv - v, dw = ww - w;
        lanes B = rx * du + ry * dv + rz * dw, A = du * du + dv * dv + dw * dw;
        lanes C = rx * rx + ry * ry + rz * rz - d2;
        if (growing) {
            A -= a * a;
            B -= ad;
        }
        lanes root = B * B - A * C;
        lanes_mask touch = (B < 0) & (root > 0);
        if (growing)
            touch |= (A < 0) & (C > 0);
        lanes tau = lanes_positive(C / (lanes_root(root) - B));
        unsigned bits = lanes_bits(touch);
        k->tau[hits] = tau[0];
        k->hit[hits] = k->label[n];
        hits += bits & 1;
        k->tau[hits] = tau[1];
        k->hit[hits] = k->label[n + 1];
        hits += bits >> 1;
    }
    k->hits = hits;
    k->count = 0;
}

#endif
