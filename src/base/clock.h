/* Time for what is reported of the computer, never for a result. */
#ifndef CZ_BASE_CLOCK_H
#define CZ_BASE_CLOCK_H

#include <time.h>

/* A clock that only goes forwards [s]. */
static inline double cz_clock(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
