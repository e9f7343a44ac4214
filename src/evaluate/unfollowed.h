/* Contacts of the colliding ends whose course the model does not follow, so that no statement about
 * override rests on them. */
#ifndef CZ_EVALUATE_UNFOLLOWED_H
#define CZ_EVALUATE_UNFOLLOWED_H

#include "evaluate/place.h"

/* What it is: an anti-climber passes over or under the other end; couplers or side buffers are so
 * far apart in height that they may pass each other, though they carry a force here; or a coupler
 * pushes a bare end at an angle at which it would slide. NULL where there is none. */
const char *cz_contact_unfollowed(const CzPlace *place);

/* Whether a run of the scene, with its vehicles as written, may have one. */
bool cz_contact_may_be_unfollowed(const CzScene *scene);

#endif
