/* State variables of the laws, by element. All starts at 0. Memory of an interface is in the lane
 * of the rear car: side 0 (A) is its front end, side 1 (B) the rear end of the car ahead. */
#ifndef CZ_DYNAMICS_MEMORY_H
#define CZ_DYNAMICS_MEMORY_H

#include "model/state.h"

typedef struct CzBufferMemory {
    CzRow stroke; /* negative in draw [m] */
    CzRow rate;   /* over the last step [m/s] */
    CzRow offset; /* of the hysteresis [m] */
} CzBufferMemory;

typedef struct CzCouplerMemory {
    CzRow force; /* through the chain [N] */
    struct {
        CzBufferMemory buffer;
        CzRow tube, second_tube; /* plastic strokes [m] */
        CzRow shear;             /* travel of the sheared coupler [m] */
        CzRow hinge_vertical;    /* yielded angle [rad] */
        CzRow energy;            /* work on the members of the side [J] */
        CzRow tube_energy;       /* work on its tubes and shear-off [J] */
    } side[2];
} CzCouplerMemory;

/* Crush zone without an end mass, in series with the anti-climber. */
typedef struct CzMasslessMemory {
    CzRow stroke;  /* [m] */
    CzRow peak;    /* its largest [m] */
    CzRow energy;  /* work [J] */
    CzRow resists; /* force of its damping [N] */
    CzRow damped;  /* part of the work dissipated by the damping [J] */
} CzMasslessMemory;

typedef struct CzFaceMemory {
    CzRow force;   /* through the chain [N] */
    CzRow speed;   /* closing speed at first contact; 0 before [m/s] */
    CzRow lost;    /* share of the faces that has been released since they last touched [-] */
    CzRow slipped; /* travel of engaged faces across each other [m] */
    CzRow sheared; /* part of it against meshed ribs, which it shears off [m] */
    CzRow strain;  /* work on the compliance of the anti-climbers, both sides [J] */
    struct {
        CzMasslessMemory massless;
        CzRow stroke; /* plastic stroke of the anti-climber [m] */
        CzRow energy; /* work on it [J] */
    } side[2];
} CzFaceMemory;

/* Ribs and friction of the faces; apart from the rest, because it also changes while the faces are
 * apart. */
typedef struct CzGripMemory {
    CzRow slip_vertical; /* vertical offset that has slipped [m] */
} CzGripMemory;

typedef struct CzSideBufferMemory {
    CzRow force;         /* through the chain [N] */
    CzRow slip_vertical; /* of the plates [m] */
    CzRow speed;         /* closing speed at first contact; 0 before [m/s] */
    struct {
        CzBufferMemory buffer;
        CzRow tube;        /* plastic stroke of the crash element [m] */
        CzRow energy;      /* work on the members of the side [J] */
        CzRow tube_energy; /* work on its crash element [J] */
    } side[2];
} CzSideBufferMemory;

typedef struct CzEndMemory {
    CzRow peak;       /* largest shortening of the crush zone [m] */
    CzRow fold_pitch; /* folded angle of the end [rad] */
} CzEndMemory;

typedef struct CzWheelMemory {
    CzRow creep; /* tangential deflection of the wheel contact [m] */
    CzRow brake; /* angle that has slipped in the brake [rad] */
} CzWheelMemory;

typedef struct CzMemory {
    CzCouplerMemory coupler;
    CzFaceMemory face;
    CzGripMemory grip;
    CzSideBufferMemory side_buffers;
    struct {
        CzRow set; /* permanent set of the superstructures, both sides together [m] */
    } superstructure;
    CzEndMemory end[2];
    CzWheelMemory wheel[4];
} CzMemory;

/* A memory by its name, such as CZ_MEMORY(coupler.side[0].tube). */
#define CZ_MEMORY(member) CZ_ROW_OF(CzMemory, member)

#endif
