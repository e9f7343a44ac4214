/* A train as a chain of bodies on springs and of coupler struts between them: the axial force at
 * which it folds. */
#ifndef CZ_MODEL_STRUT_CHAIN_H
#define CZ_MODEL_STRUT_CHAIN_H

#include "base/arena.h"
#include "crushzone/status.h"

/* A body on two bogies. */
typedef struct CzChainCar {
    double spring;       /* of one bogie against a vertical force [N/m]; 0: the body is held */
    double half_spacing; /* of its bogies [m] */
} CzChainCar;

/* One end of a strut. Distances are outwards, away from the middle of the car. */
typedef struct CzChainPivot {
    double hinge;    /* stiffness of the hinge [N m/rad] */
    double body_arm; /* from the middle of the body to the pivot, or to the end mass that carries it
                        [m] */
    double end_arm;  /* from the end mass to the pivot [m] */
    double end_guide; /* of the end mass across the body; 0 for a pivot on the body [N/m] */
    double end_fold;  /* of the end mass against rotation [N m/rad] */
} CzChainPivot;

/* The couplers between a car and the next one. */
typedef struct CzChainStrut {
    double length;         /* between the pivots [m]; 0 where there are no couplers */
    bool tilts;            /* false against a smooth wall, along which the strut slides */
    CzChainPivot pivot[2]; /* on this car, at its front, and on the next one, at its rear */
} CzChainStrut;

/* Writes the force at which each of the n_car - 1 struts folds [N]: that of the lowest shape of the
 * chain, under one force from end to end, that belongs to the strut. NaN where there is no strut or
 * no movable car at it. Statuses: CZ_OK, CZ_STATUS_NO_MEMORY (without an error text).
 */
CzStatus cz_strut_chain_fold(int n_car, const CzChainCar *car, const CzChainStrut *strut,
                             CzArena *scratch, double *force);

#endif
