/* Multiples of a step. */
#include "base/increment.h"

#include <math.h>

/* Allowed difference of a quotient from a whole number. */
static double slack_of(double quotient) {
    return 1e-12 * fmax(fabs(quotient), 1);
}

double cz_increment_not_above(double step, double value) {
    const double quotient = value / step;
    return floor(quotient + slack_of(quotient)) * step;
}

double cz_increment_not_below(double step, double value) {
    const double quotient = value / step;
    return ceil(quotient - slack_of(quotient)) * step;
}

int cz_increment_count(double step, double min, double max) {
    const double first = cz_increment_not_below(step, min);
    const double last = cz_increment_not_above(step, max);
    if (last < first)
        return 0;
    return last - first < 0.5 * step ? 1 : 2;
}
