/* lanes.h -- two doubles at a time, and four labels at a time.
 *
 * GCC's vector types, with SSE2 (which every x86-64 has) where the language has
 * no operator; elsewhere plain C.  Both give the same bits: every operation is
 * IEEE's, none is fused.
 */
#ifndef SUSPENSION_LANES_H
#define SUSPENSION_LANES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

typedef double lanes __attribute__((vector_size(16)));
typedef int64_t lanes_mask __attribute__((vector_size(16)));

static inline lanes lanes_load(const double *p) {
    lanes v;
    memcpy(&v, __builtin_assume_aligned(p, 16), sizeof v);
    return v;
}

static inline lanes lanes_all(double a) {
    return (lanes){a, a};
}

static inline lanes lanes_low(lanes a, lanes b) {
    return (lanes){a[0], b[0]};
}

static inline lanes lanes_high(lanes a, lanes b) {
    return (lanes){a[1], b[1]};
}

/* sqrt of max(a, 0) */
static inline lanes lanes_root(lanes a) {
#ifdef __SSE2__
    return (lanes)_mm_sqrt_pd(_mm_max_pd((__m128d)a, _mm_setzero_pd()));
#else
    return (lanes){sqrt(a[0] > 0 ? a[0] : 0), sqrt(a[1] > 0 ? a[1] : 0)};
#endif
}

/* max(a, 0), 0 where a is NaN */
static inline lanes lanes_positive(lanes a) {
#ifdef __SSE2__
    return (lanes)_mm_max_pd((__m128d)a, _mm_setzero_pd());
#else
    return (lanes){a[0] > 0 ? a[0] : 0, a[1] > 0 ? a[1] : 0};
#endif
}

/* Bit k: lane k is true. */
static inline unsigned lanes_bits(lanes_mask m) {
#ifdef __SSE2__
    return (unsigned)_mm_movemask_pd((__m128d)m);
#else
    return (unsigned)(m[0] < 0) | (unsigned)(m[1] < 0) << 1;
#endif
}

/* Copy four labels; bit k of the result: label k has its highest bit set. */
static inline unsigned lanes_copy4(uint32_t *to, const uint32_t *from) {
#ifdef __SSE2__
    __m128i v = _mm_load_si128((const __m128i *)(const void *)from);
    _mm_storeu_si128((__m128i *)(void *)to, v);
    return (unsigned)_mm_movemask_ps(_mm_castsi128_ps(v));
#else
    unsigned bits = 0;
    for (unsigned k = 0; k < 4; k++) {
        to[k] = from[k];
        bits |= (from[k] >> 31) << k;
    }
    return bits;
#endif
}

/* The same for 16 labels of one cache line, without the copy. */
static inline unsigned lanes_signs16(const uint32_t *from) {
#ifdef __SSE2__
    const __m128i *v = (const __m128i *)(const void *)from;
    __m128i a = _mm_packs_epi32(_mm_load_si128(v), _mm_load_si128(v + 1));
    __m128i b = _mm_packs_epi32(_mm_load_si128(v + 2), _mm_load_si128(v + 3));
    return (unsigned)_mm_movemask_epi8(_mm_packs_epi16(a, b));
#else
    unsigned bits = 0;
    for (unsigned k = 0; k < 16; k++)
        bits |= (from[k] >> 31) << k;
    return bits;
#endif
}

#endif
