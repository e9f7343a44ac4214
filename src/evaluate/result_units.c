/* Units of results. */
#include "base/gravity.h"
#include "evaluate/results.h"

#include <math.h>

const CzResultUnit cz_result_units[CZ_N_RESULT_UNIT] = {
#define CZ_RESULT_UNIT(unit, text, in_si, rule, factor) {text, in_si, CZ_UNIT_##rule, factor},
#include "evaluate/result_units.def"
#undef CZ_RESULT_UNIT
};

double cz_result_in_unit(const CzResultUnit *unit, double si) {
    switch (unit->rule) {
    case CZ_UNIT_OVER:
        return si / unit->factor;
    case CZ_UNIT_TIMES:
        return si * unit->factor;
    case CZ_UNIT_NANO:
        break;
    }
    return round(si * 1e9) / unit->factor;
}
