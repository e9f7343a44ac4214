/* Numbers of one sample. */
#ifndef CZ_REPORT_SAMPLE_VALUES_H
#define CZ_REPORT_SAMPLE_VALUES_H

#include "crushzone/sample.h"

/* Margin of a check: NaN for none, -infinity for a run that failed. */
static inline double cz_sample_margin(const CzSampling *sampling, int sample, int check) {
    return sampling->margin[(size_t)sample * (size_t)sampling->n_check + (size_t)check];
}

static inline CzVerdict cz_sample_verdict(const CzSampling *sampling, int sample, int check) {
    return sampling->verdict[(size_t)sample * (size_t)sampling->n_check + (size_t)check];
}

/* Value of a draw. */
static inline double cz_sample_value(const CzSampling *sampling, int sample, int draw) {
    return sampling->value[(size_t)sample * (size_t)sampling->n_draw + (size_t)draw];
}

#endif
