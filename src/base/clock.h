/* Clocks for reported computing times, never for a result. */
#ifndef CZ_BASE_CLOCK_H
#define CZ_BASE_CLOCK_H

#include <time.h>

/* Time of a clock that is never set back [s]. */
static inline double cz_clock(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Processor time of all threads of the process: other work of the machine does not count [s]. */
static inline double cz_processor_clock(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
