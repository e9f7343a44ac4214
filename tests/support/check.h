/* Included by every test program: cmocka and a comparison of doubles. */
#ifndef CZ_TESTS_CHECK_H
#define CZ_TESTS_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Rounding error, as a share of the value, or of the largest term of a sum that is 0.
 * A double has 1.1e-16. */
#define ROUNDING_OF_A_VALUE 1e-15   /* read, converted or copied: a few operations */
#define ROUNDING_OF_A_FORMULA 1e-14 /* some ten operations */
#define ROUNDING_OF_A_SUM 1e-12     /* a hundred terms, or a small difference of large numbers */

/* |a - b| <= absolute + relative * |b|. CZ_TOL_SCALE=0 in the environment prints every residual. */
#define assert_near(a, b, relative, absolute)                                                      \
    check_near((a), (b), (relative), (absolute), #a, __FILE__, __LINE__)

static inline void check_near(double a, double b, double relative, double absolute,
                              const char *what, const char *file, int line) {
    const char *scale = getenv("CZ_TOL_SCALE");
    const double allowed = absolute + relative * fabs(b);
    const double difference = fabs(a - b);
    if (scale != NULL && strcmp(scale, "0") == 0)
        printf("%s:%d: %s = %.17g, expected %.17g, difference %.3g, allowed %.3g\n", file, line,
               what, a, b, difference, allowed);
    if (!(difference <= allowed)) { /* NaN fails too */
        print_error("%s:%d: %s = %.17g, expected %.17g, difference %.3g > %.3g\n", file, line, what,
                    a, b, difference, allowed);
        _fail(file, line);
    }
}

#endif
