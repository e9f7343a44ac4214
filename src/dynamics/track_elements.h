/* The track as finite elements: a slow and simple independent check of the modal track.
 *
 * Under each car lies a piece of rail of Timoshenko elements, pinned at its ends, with lumped
 * masses, and under every seat pad, sleeper and ballast block. Stiffness is exact for loads at the
 * nodes; a wheel between two nodes loads them by the element's shape functions, and the deflection
 * of the element between its nodes is a flexibility under the wheel. When the car has moved by a
 * bay, the piece moves with it: the last bay is removed, an unloaded one is added in front.
 *
 * A step is a kick by the forces of the wheels and a flight by the trapezoidal rule, stable for any
 * step:
 *
 *   v+ = v- + h P / M     (M + h/2 C + h^2/4 K) s = 2 M v+ - h K u     u' = u + h/2 s     v-' = s -
 * v+
 *
 * Eigenfrequencies are those of lumped masses: too low by the square of the nodes' distance.
 */
#ifndef CZ_DYNAMICS_TRACK_ELEMENTS_H
#define CZ_DYNAMICS_TRACK_ELEMENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "dynamics/rail_point.h"
#include "model/lanes.h"
#include "model/rail.h"

typedef double CzElementsRow[CZ_LANE_BLOCK]; /* the same unknown under neighbouring cars */

/* Constant for a step size, shared by all cars. */
typedef struct CzElements {
    CzSeats seats;
    double step;         /* h [s] */
    int nodes;           /* nodes per bay */
    int n_bay;           /* bays of the piece */
    size_t per_bay;      /* unknowns of a bay: sleeper, ballast, and two per node */
    size_t n;            /* unknowns */
    size_t band;         /* of the matrices: their rows hold [i - band ... i] */
    size_t *first;       /* of a row's columns that are not zero (n) */
    double *stiffness;   /* K (n x (band + 1)) */
    double *damping;     /* C */
    double *mass;        /* diagonal of M (n) */
    double *flight;      /* L D L^T of M + h/2 C + h^2/4 K */
    double *rest;        /* L D L^T of K */
    CzElementsRow *work; /* (2 n) */
    size_t n_lane;
    struct CzElementsUnder *under; /* (n_lane) */
    struct CzElementsBlock *block; /* CZ_LANE_BLOCK lanes each */
} CzElements;

/* Track under the cars of a block; NULL where none has wheels. */
typedef struct CzElementsBlock {
    CzElementsRow *u, *before, *v; /* deflections now and a step ago, rates before the kick (n) */
} CzElementsBlock;

/* Track under one car. */
typedef struct CzElementsUnder {
    bool is_laid;
    double from;     /* place of the first node [m] */
    double middle;   /* of the wheels at t = 0 [m] */
    double place[4]; /* of the last look [m] */
    double force[4]; /* on the rail, upwards [N] */
} CzElementsUnder;

/* Matrices for steps of h seconds under cars with `span` from first to last wheel; NULL when there
 * is no memory. */
CzElements *cz_elements_create(const CzSeats *seats, int nodes, double span, double step,
                               size_t n_lane, CzArena *arena);

/* Lays the piece of one car, at rest under its loads; false when there is no memory. */
bool cz_elements_lay(CzElements *elements, size_t lane, const double place[4], const double load[4],
                     CzArena *arena);

/* The rail under each wheel: deflection now and half a step ago, slope, additional flexibility
 * between the nodes and its change along the track. Moves the piece when the car has left its
 * middle. */
void cz_elements_deflection(CzElements *elements, size_t lane, const double place[4],
                            CzRailPoint point[4]);

/* Deflection half a step ago at the places of the last look. */
double cz_elements_past(const CzElements *elements, size_t lane, int wheel);

/* Advances the track of all cars of a block by one step under the forces recorded at the places of
 * the last look.
 */
void cz_elements_step(CzElements *elements, size_t block);

/* Kinetic and elastic energy half a step ago [J]. */
double cz_elements_energy(const CzElements *elements, size_t lane);

#endif
