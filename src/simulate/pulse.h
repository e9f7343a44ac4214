/* The collision pulse of a vehicle: mean decelerations and the secondary impact of an occupant.
 *
 * Contact windows begin and end with a time step; all other values are those of samples of the
 * speed. None of them is filtered but the peak that is named after its filter.
 */
#ifndef CZ_SIMULATE_PULSE_H
#define CZ_SIMULATE_PULSE_H

#include "base/arena.h"
#include "crushzone/simulate.h"

/* The usual settings, those of the stored results. */
#define CZ_PULSE_WINDOW 0.12 /* of a sliding mean [s] */
#define CZ_PULSE_FLOOR                                                                             \
    0.01                      /* of the largest net force: a smaller force counts as no contact    \
                                 (ours) */
#define CZ_PULSE_SHORTEST 0.0 /* shortest contact window that counts [s] (ours) */

/* The largest |net contact force| [N]. */
double cz_pulse_largest_force(const CzPulse *pulse);

/* Finds the next window in which the net contact force is above `floor` [N]; false when there is
 * none. `next` is the step to go on with, 0 at first. */
bool cz_pulse_next_contact(const CzPulse *pulse, double floor, int *next, CzContactWindow *window);

/* Lists the contact windows with the usual floor and at least half of the largest mean, however
 * short, in memory of the arena; false when there is none left. */
bool cz_pulse_list_windows(CzPulse *pulse, CzArena *arena);

/* Largest mean deceleration over the contact windows that last at least `shortest` [m/s2], and its
 * window, which is unchanged where there is none and may be NULL. `floor` is a share of the largest
 * net force. */
double cz_pulse_contact_mean(const CzPulse *pulse, double floor, double shortest, double window[2]);

/* The same over all windows that last at least `shortest`. */
double cz_pulse_sliding_mean(const CzPulse *pulse, double shortest, double window[2]);

/* Secondary impact velocity: that of a free particle, which keeps the speed of t = 0, against the
 * vehicle when it has travelled a distance in it [m/s], and when [s]. The speed is taken as linear
 * between samples. When the particle does not travel that far in the run, the largest velocity and
 * its time. */
double cz_pulse_secondary_impact(const CzPulse *pulse, double distance, double *time);

/* Largest |deceleration| through a filter of a channel frequency class [m/s2], from the means of
 * the deceleration between samples; NaN where the samples are too sparse for the class. Status:
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_pulse_filtered_peak(const CzPulse *pulse, double class_hz, double *peak);

#endif
