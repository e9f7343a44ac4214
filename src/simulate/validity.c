/* Totals of a run that went beyond the model's validity. */
#include "crushzone/simulate.h"

#include <math.h>

double cz_run_total(const CzRunSummary *run, double total) {
    return run->beyond_validity ? NAN : total;
}
