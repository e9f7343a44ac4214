/* Contacts of the colliding ends whose course the model does not follow, so that no statement about
 * override rests on them. */
#ifndef CZ_EVALUATE_UNFOLLOWED_H
#define CZ_EVALUATE_UNFOLLOWED_H

#include "evaluate/place.h"

/* Whether there is one: an anti-climber passes over or under the other end; couplers or side
 * buffers are so far apart in height that they may pass each other, though they carry a force here;
 * or a coupler pushes a bare end at an angle at which it would slide. */
bool cz_contact_is_unfollowed(const CzPlace *place);

#endif
