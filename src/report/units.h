/* Units that results are written in; inside everything is SI. */
#ifndef CZ_REPORT_UNITS_H
#define CZ_REPORT_UNITS_H

#include <math.h>

#define CZ_KILO 1e3           /* units in a kilo-unit */
#define CZ_MILLI_PER_UNIT 1e3 /* milli-units in a unit */
#define CZ_KM_H_PER_M_S 3.6
#define CZ_GRAVITY 9.80665 /* standard gravity [m/s2] */

/* Times are multiples of a step whose decimals are no binary fractions; they are reported to the
 * nanosecond, a thousandth of the shortest step that one would take, so that 46.3 ms reads 46.3. */
static inline double cz_seconds(double time) {
    return round(time * 1e9) / 1e9;
}

static inline double cz_milliseconds(double time) {
    return round(time * 1e9) / 1e6;
}

#endif
