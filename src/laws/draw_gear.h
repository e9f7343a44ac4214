/* Draw gear with screw coupling: an elastic link that carries tension only.
 *
 *   F = -k [-d - s]+
 *
 * d is the closure, -d the elongation of the link and s the slack. The force is
 * negative in tension.
 */
#ifndef CZ_LAWS_DRAW_GEAR_H
#define CZ_LAWS_DRAW_GEAR_H

#include "laws/law.h"

static inline double cz_draw_gear(double stiffness, double slack, double closure) {
    return -stiffness * cz_positive_part(-closure - slack);
}

#endif
