/* Collisions of rigid cars whose outcome is known in closed form, as rows.
 *
 * Tolerances: plateaus within 1e-3 at the default step and within 1e-4 at 0.01 ms, because a
 * plateau that begins at contact loses half a step of its impulse; continuous curves within 1e-5.
 */
#ifndef CZ_TESTS_PHYSICS_CLOSED_FORMS_H
#define CZ_TESTS_PHYSICS_CLOSED_FORMS_H

#include "physics/rows.h"

/* A step and its tolerances. */
typedef struct {
    double length; /* [s] */
    const char *name;
    double tolerance;
    double stiffness; /* of interfaces that close from rest, where their elasticity matters [N/m] */
} Step;

extern const Step default_step, fine_step;
extern const Step stiff_step, stiffer_step; /* for interfaces that close from rest */

void rows_of_plateaus(Rows *rows, const Step *step);
void rows_of_crush_zones_in_series(Rows *rows, const Step *step);
void rows_of_spring_and_plateau(Rows *rows);
void rows_of_four_stages(Rows *rows);
void rows_of_sequence(Rows *rows, const Step *step);
void rows_of_two_into_wall(Rows *rows, const Step *step);
void rows_of_eight_and_eight(Rows *rows, const Step *step);

#endif
