/* Units of written results; values inside are SI. */
#ifndef CZ_REPORT_UNITS_H
#define CZ_REPORT_UNITS_H

#define CZ_KILO 1e3           /* units in a kilo-unit */
#define CZ_MILLI_PER_UNIT 1e3 /* milli-units in a unit */
#define CZ_KM_H_PER_M_S 3.6

#endif
