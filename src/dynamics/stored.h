/* Elastic energy of the elements that store and dissipate, in a lane [J]; side 0 is A, 1 is B; end
 * 0 is the rear one. */
#ifndef CZ_DYNAMICS_STORED_H
#define CZ_DYNAMICS_STORED_H

#include "dynamics/dynamics.h"

#define CZ_PLATE_STIFFNESS 2e7 /* vertical stiffness of buffer plates that stick [N/m] (ours) */

/* A crush zone: stored energy, and received energy, which is the stored part and the loss of
 * loading it to its largest shortening. */
typedef struct CzCrushEnergy {
    double stored, received;    /* [J] */
    double shortening, largest; /* of which they are [m] */
    double lost;                /* loss of loading to the largest [J] */
} CzCrushEnergy;

/* Stored energy of the elements of a lane; 0 where an element is missing. */
typedef struct CzStored {
    /* of the interface */
    double coupler[2]; /* buffers of a side */
    double hinge[2];   /* with the swing stop */
    double side_buffers[2];
    double coupler_tubes, side_tubes;  /* of both sides, in their elasticity */
    double face;                       /* of both sides, along the normal */
    double face_sliding, side_sliding; /* across it: faces, plates of side buffers */
    double superstructure, draw_gear;  /* of both sides */
    CzCrushEnergy massless[2];         /* crush zones of ends without mass */
    /* of the car */
    double secondary, primary, link, axle_guidance; /* springs of the running gear */
    double wheels;        /* contact with a rail that does not deflect, and their weight */
    CzCrushEnergy end[2]; /* crush zones of ends with mass */
    double guide[2];      /* guidance of an end mass across the axis */
    double fold[2];       /* its hinge */
    double slide;         /* end stop of a buffer stop at the end of its travel */
} CzStored;

/* Fills in what a lane stores now. `stored` is zero at first and keeps earlier results. */
void cz_stored_fill(const CzDynamics *dynamics, size_t lane, CzStored *stored);

/* Error of the work in the step in which a stroke first touches the buffer of one side: rise of the
 * force, by preload and transition, times the stroke. */
double cz_coupler_touch(const CzDynamics *dynamics, size_t lane, int side, double stroke);
double cz_side_touch(const CzDynamics *dynamics, size_t lane, int side, double stroke);
/* The same for a superstructure, whose force rises up to its strength, of both sides together. */
double cz_superstructure_touch(const CzDynamics *dynamics, size_t lane, double stroke);

/* Energy that a crush zone without mass has received once shortened by x, and at most by `largest`
 * before. */
double cz_massless_received_at(const CzDynamics *dynamics, size_t lane, int side, double x,
                               double largest);

/* Kinetic and elastic energy of the track under each car of a block above that at t = 0 [J]. */
void cz_track_stored(const CzKernel *kernel, const CzDynamics *dynamics, int block, CzRow stored);

#endif
