/* When metrics reached their value, for those whose time a run keeps: begin and end [s]. */
#ifndef CZ_EVALUATE_WHEN_H
#define CZ_EVALUATE_WHEN_H

#include "evaluate/metric.h"

/* The functions that results.def names; NO_TIME represents none. */
#define cz_when_NO_TIME NULL
void cz_when_peak_time(const CzPlace *place, double window[2]);
void cz_when_bottomed_time(const CzPlace *place, double window[2]);
void cz_when_overlap_time(const CzPlace *place, double window[2]);
void cz_when_margin_time(const CzPlace *place, double window[2]);
void cz_when_sheared_time(const CzPlace *place, double window[2]);
void cz_when_contact_window(const CzPlace *place, double window[2]);
void cz_when_window_120ms(const CzPlace *place, double window[2]);
void cz_when_mean_window(const CzPlace *place, double window[2]);
void cz_when_wheel_lift_time(const CzPlace *place, double window[2]);
void cz_when_bogie_lift_time(const CzPlace *place, double window[2]);
void cz_when_climb_time(const CzPlace *place, double window[2]);

#endif
