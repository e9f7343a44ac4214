/* Activation: how far an idle device is from crushing.
 *
 * Energies of car ends, anti-climbers, tubes and survival space are zero in most designs, and
 * without a slope there. A search is therefore given what is left before the device is activated:
 * the share of its force that is missing, the stroke of the device in front of it, the gap before
 * it touches.
 */
#ifndef CZ_EVALUATE_ACTIVATION_H
#define CZ_EVALUATE_ACTIVATION_H

#include "evaluate/place.h"

typedef struct CzActivation {
    double distance; /* to it, as a share of the stroke or force in front; 0 when crushing */
    double size;     /* energy that corresponds to a share of 1 when crushing [J] */
} CzActivation;

/* Activation at a place: an element of an interface, for the last one a run. False where the energy
 * is not zero in an idle device, such as that of a buffer. */
bool cz_activation_of_element(const CzPlace *place, CzActivation *activation);
bool cz_activation_of_tubes(const CzPlace *place, CzActivation *activation);
bool cz_activation_of_temporary_space(const CzPlace *place, CzActivation *activation);
bool cz_activation_of_survival_space(const CzPlace *place, CzActivation *activation);
bool cz_activation_of_survival_spaces(const CzPlace *place, CzActivation *activation);

#endif
