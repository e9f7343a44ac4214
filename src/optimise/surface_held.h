/* The next margins: where the smallest margin is capped, the next one is maximised, and so on.
 *
 * A detail is capped when every variable that would lower it is at its bound. It is then held:
 * those variables stay as they are, and the largest of the other details counts.
 */
#ifndef CZ_OPTIMISE_SURFACE_HELD_H
#define CZ_OPTIMISE_SURFACE_HELD_H

#include "optimise/surface.h"

/* Whether the largest detail that counts is capped at the base, and one of the design alone, whose
 * planes hold at any distance. False where the base is not as good as the best design. */
bool cz_surface_is_capped(const CzSurface *surface);

/* Holds the largest detail that counts, and the next ones, as long as they are capped at the base.
 * Returns whether any is, while other details count and other variables are free. */
bool cz_surface_hold_capped(CzSurface *surface);

#endif
