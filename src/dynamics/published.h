/* Results of an evaluation for its users, by element: forces, strokes, contacts. */
#ifndef CZ_DYNAMICS_PUBLISHED_H
#define CZ_DYNAMICS_PUBLISHED_H

#include "model/state.h"

typedef struct CzPublished {
    struct {
        CzRow force; /* total longitudinal force [N] */
        CzRow drop;  /* drop of the force along the track in this step, by a shear-off or a falling
                        strength [N] */
    } interface;
    CzRow section[2]; /* force through the section behind the rear and front end, all load paths [N]
                       */
    CzRow adhesion;   /* external force along the track, wheels and brakes [N] */
    struct {
        CzRow residual; /* closure that the chains left unbalanced [m] */
        CzRow distance; /* largest deviation of a member of a chain from its law [N] */
        CzRow searched; /* chains that needed a search */
    } chain;
    struct {
        CzRow force;             /* of the chain [N] */
        CzRow closure;           /* as it was last evaluated [m] */
        CzRow top;               /* largest force of a step in which it fell; 0 in others [N] */
        CzRow engaged;           /* how far the faces are engaged against swinging, 0 to 1 */
        CzRow swing_vertical[2]; /* angle of the engaged coupler against its car, less that at rest
                                    [rad] */
    } coupler;
    struct {
        CzRow force;           /* normal force [N] */
        CzRow closure;         /* as it was last evaluated [m] */
        CzRow top;             /* largest force of a step in which it fell; 0 in others [N] */
        CzRow demand_vertical; /* vertical force between the faces [N] */
        CzRow ready;           /* capacity in full engagement [N] */
        CzRow remaining;       /* overlap [m] */
        CzRow ramp;            /* slope of the faces [-] */
    } face;
    struct {
        CzRow force;            /* of the chain [N] */
        CzRow closure;          /* as it was last evaluated [m] */
        CzRow top;              /* largest force of a step in which it fell; 0 in others [N] */
        CzRow sliding_vertical; /* friction between the plates [N] */
    } side_buffers;
    struct {
        CzRow force; /* [N] */
    } superstructure;
    struct {
        CzRow force; /* negative in tension [N] */
    } draw_gear;
    struct {
        CzRow force;         /* of the crush zone [N] */
        CzRow stroke;        /* its shortening [m] */
        CzRow slip_vertical; /* of the end mass across the axis, in its guidance [m] */
    } end[2];
    struct {
        CzRow compression;   /* [m] */
        CzRow force;         /* of springs, stops and dampers, beyond that at rest [N] */
        CzRow stop_vertical; /* part of it that bump and lift stop carry [N] */
    } secondary[2];
    struct {
        CzRow compression; /* [m] */
    } primary[4];
    struct {
        CzRow force;  /* forward on the bogie [N] */
        CzRow travel; /* of the bogie against the body at its link [m] */
    } link[2];
    struct {
        CzRow travel; /* of the axle against the bogie [m] */
    } axle_guidance[4];
    struct {
        CzRow approach; /* of wheel and rail: the indentation and the immediate deflection of the
                           rail; negative: height of the wheel over the rail [m] */
        CzRow force;    /* normal force of the wheelset [N] */
    } wheel[4];
    CzRow slide_force; /* of the friction jaws and the end stop of a buffer stop [N] */
} CzPublished;

/* A row by its name, such as CZ_PUBLISHED(end[0].stroke). */
#define CZ_PUBLISHED(member) CZ_ROW_OF(CzPublished, member)

#endif
