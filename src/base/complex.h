/* Complex numbers, exponentials and rotations with the same bits on every machine: products and
 * sums, and of the C mathematics library only sqrt, fabs and ldexp, which are exact.
 */
#ifndef CZ_BASE_COMPLEX_H
#define CZ_BASE_COMPLEX_H

#include <math.h>

#define CZ_PI 3.14159265358979323846

typedef struct CzComplex {
    double re, im;
} CzComplex;

static inline CzComplex cz_complex_sum(CzComplex a, CzComplex b) {
    return (CzComplex){a.re + b.re, a.im + b.im};
}

static inline CzComplex cz_complex_scaled(double factor, CzComplex a) {
    return (CzComplex){factor * a.re, factor * a.im};
}

static inline CzComplex cz_complex_difference(CzComplex a, CzComplex b) {
    return (CzComplex){a.re - b.re, a.im - b.im};
}

static inline CzComplex cz_complex_product(CzComplex a, CzComplex b) {
    return (CzComplex){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static inline double cz_complex_square_size(CzComplex a) {
    return a.re * a.re + a.im * a.im;
}

static inline double cz_complex_size(CzComplex a) {
    return sqrt(cz_complex_square_size(a));
}

/* 1 / a, for |a| whose square neither overflows nor underflows. */
static inline CzComplex cz_complex_inverse(CzComplex a) {
    const double square = cz_complex_square_size(a);
    return (CzComplex){a.re / square, -a.im / square};
}

static inline CzComplex cz_complex_ratio(CzComplex a, CzComplex b) {
    return cz_complex_product(a, cz_complex_inverse(b));
}

/* The root with a real part that is not negative. */
static inline CzComplex cz_complex_root(CzComplex a) {
    const double size = cz_complex_size(a);
    if (size == 0.0)
        return (CzComplex){0.0, 0.0};
    const double large = sqrt(0.5 * (size + fabs(a.re))), small = 0.5 * a.im / large;
    if (a.re >= 0.0)
        return (CzComplex){large, small};
    return (CzComplex){fabs(small), a.im < 0.0 ? -large : large};
}

/* Cosine and sine of a number of turns of 2 pi, less than 2^50 in magnitude: the fraction of a
 * turn, a quarter of it by Taylor's series up to pi / 4, and doubled twice. No branch: it may be in
 * a loop over lanes. Accurate to 1e-15. */
static inline CzComplex cz_turned(double turns) {
    const double whole = (turns + 6755399441055744.0) - 6755399441055744.0; /* 1.5 * 2^52 */
    const double x = (turns - whole) * (0.5 * CZ_PI), y = x * x;
    const double c =
        1.0 - y * (1.0 / 2 -
                   y * (1.0 / 24 -
                        y * (1.0 / 720 -
                             y * (1.0 / 40320 - y * (1.0 / 3628800 -
                                                     y * (1.0 / 479001600 -
                                                          y * (1.0 / 87178291200.0 -
                                                               y * (1.0 / 20922789888000.0))))))));
    const double s =
        x * (1.0 - y * (1.0 / 6 -
                        y * (1.0 / 120 -
                             y * (1.0 / 5040 -
                                  y * (1.0 / 362880 - y * (1.0 / 39916800 -
                                                           y * (1.0 / 6227020800.0 -
                                                                y * (1.0 / 1307674368000.0))))))));
    const double c2 = c * c - s * s, s2 = 2.0 * c * s;
    return (CzComplex){c2 * c2 - s2 * s2, 2.0 * c2 * s2};
}

/* exp of a real number: Taylor's series about the nearest multiple of log 2. */
static inline double cz_exponential(double x) {
    if (x < -700.0)
        return 0.0;
    const double n = floor(x * 1.44269504088896340736 + 0.5);
    const double r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
    double sum = 1.0;
    for (int k = 16; k > 0; --k)
        sum = 1.0 + r / k * sum;
    return ldexp(sum, (int)n);
}

/* exp of a complex number. */
static inline CzComplex cz_complex_exponential(CzComplex a) {
    return cz_complex_scaled(cz_exponential(a.re), cz_turned(a.im / (2.0 * CZ_PI)));
}

#endif
