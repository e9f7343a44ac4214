/* Units of results, and prefixes of the names of metrics. */
#ifndef CZ_EVALUATE_RESULTS_H
#define CZ_EVALUATE_RESULTS_H

/* Conversion of a number to a unit (result_units.def). */
typedef enum CzUnitRule { CZ_UNIT_OVER, CZ_UNIT_TIMES, CZ_UNIT_NANO } CzUnitRule;

typedef struct CzResultUnit {
    const char *text;
    double in_si; /* SI value of one unit */
    CzUnitRule rule;
    double factor;
} CzResultUnit;

enum {
#define CZ_RESULT_UNIT(unit, text, in_si, rule, factor) CZ_UNIT_OF_##unit,
#include "evaluate/result_units.def"
#undef CZ_RESULT_UNIT
    CZ_N_RESULT_UNIT
};
extern const CzResultUnit cz_result_units[CZ_N_RESULT_UNIT];

/* An SI value in a unit, as documents and tables print it. */
double cz_result_in_unit(const CzResultUnit *unit, double si);

/* The name of a metric is the prefix of its record in results.def and its key. */
#define CZ_METRIC_PREFIX_RUN ""
#define CZ_METRIC_PREFIX_ENERGY "energy."
#define CZ_METRIC_PREFIX_INTERFACE "interfaces."
#define CZ_METRIC_PREFIX_ELEMENT "elements."
#define CZ_METRIC_PREFIX_VEHICLE "vehicles."
#define CZ_METRIC_PREFIX_SECTION "sections."
#define CZ_METRIC_PREFIX_END "ends."
#define CZ_METRIC_PREFIX_DESIGN "design."

#endif
