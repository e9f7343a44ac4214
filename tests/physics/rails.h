/* Statics and waves of the elastic track with known numbers, and how its modes converge, as rows.
 *
 * Zhai's set per rail, CHN60 on sleepers 0.6 m apart, shear coefficient 0.40.
 */
#ifndef CZ_TESTS_PHYSICS_RAILS_H
#define CZ_TESTS_PHYSICS_RAILS_H

#include "physics/rows.h"

/* Continuous support: Winkler's foundation in closed form. */
void rows_of_winkler(Rows *rows);

/* Discrete seats, from an independent solution with 80 spans, with all of its digits.
 */
void rows_of_discrete_seats(Rows *rows);

/* Free waves of Timoshenko's and of Euler's beam. */
void rows_of_rail_waves(Rows *rows);

/* The wave with its nodes at the sleepers is a mode of the track. */
void rows_of_pinned_mode(Rows *rows);

/* Modes up to a cut and their residual flexibility, against the exact statics. */
void rows_of_mode_convergence(Rows *rows);

/* A car at rest, solved from the laws, on the rigid and on the elastic track. */
void rows_of_rest(Rows *rows);

/* Finite elements against the exact frequency and statics. */
void rows_of_element_frequencies(Rows *rows);
void rows_of_element_statics(Rows *rows);

/* The same statics by the models of a run, the production run's modes and finite elements. */
void rows_of_running_tracks(Rows *rows);

/* The rail under a harmonic force, against continuous layers. */
void rows_of_receptance(Rows *rows);

/* The rail under a short impact: modes up to a cut, and elements, against the finest elements. */
void rows_of_impact(Rows *rows);

/* Shipped problems on the elastic track: step, and the other elastic tracks. */
void rows_of_runs_on_rails(Rows *rows);

#endif
