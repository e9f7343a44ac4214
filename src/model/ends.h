/* The two ends of an interface: their parts, what meets what, their gaps and heights.
 *
 *   distance of a pair of parts = distance of the foremost planes + gap_A + gap_B
 *
 * Inner interfaces: coupled couplers touch face to face; without them the foremost planes touch.
 * Colliding interface: the nearest pair of parts touches. A part without a counterpart strikes the
 * bare end structure of the other end, at its own height (problem/meeting.h).
 */
#ifndef CZ_MODEL_ENDS_H
#define CZ_MODEL_ENDS_H

#include "model/fill.h"

/* Kinds of parts by which two ends meet; draw gears carry tension only and never touch. */
typedef enum CzEndsKind {
    CZ_ENDS_COUPLER = CZ_PART_COUPLER,
    CZ_ENDS_FACE = CZ_PART_FACE,
    CZ_ENDS_SIDE_BUFFERS = CZ_PART_SIDE_BUFFERS,
    CZ_ENDS_SUPERSTRUCTURE = CZ_N_PART,
    CZ_ENDS_DRAW_GEAR,
    CZ_N_ENDS_KIND
} CzEndsKind;
enum { CZ_N_ENDS_TOUCHING = CZ_ENDS_DRAW_GEAR };

/* A part of an end. */
typedef struct CzEndsPart {
    bool is_there;
    double gap;    /* behind the foremost plane [m] */
    double height; /* above rail [m]; NaN: as the other side's */
} CzEndsPart; /* without a part of its kind: the bare end structure, which the other side's strikes
               */

/* One side of the interface. */
typedef struct CzEndsSide {
    int car;
    int which; /* end of that car */
    bool is_full, is_fixed;
    bool has_end_mass; /* on which its parts act */
    const CzVehicle *vehicle;
    const CzEnd *end;
    CzEndsPart part[CZ_N_ENDS_KIND]; /* the face is an anti-climber's where there is one, else the
                                        bare end's */
    bool presses_plates; /* its anti-climber acts on side buffers, in the place of its own */
    double plane;        /* foremost plane from the body's centre of gravity, outwards [m] */
    double sign;         /* direction of outwards along x */
    double offset;       /* height offset of the car [m] */
} CzEndsSide;

typedef struct CzEnds {
    const CzFill *fill;
    int lane;           /* car in whose lane the parameters are */
    CzParameters *rows; /* of its block */
    size_t i;           /* its place there */
    CzEndsSide side[2];
    bool has[CZ_N_ENDS_KIND];
    bool tilts;      /* one car can move vertically, and the other one is not fixed */
    double distance; /* of the foremost planes at t = 0 [m] */
} CzEnds;

/* CzEndsHeights of both sides as built, and the height of B's part over A's with the offsets. */
typedef struct CzEndsHeights {
    double side[2]; /* above rail [m] */
    double rise;    /* [m] */
} CzEndsHeights;

/* The ends of an interface, and its two cars placed at t = 0. Fails with CZ_STATUS_INPUT when parts
 * overlap. */
CZ_MUST_CHECK CzStatus cz_ends_find(const CzFill *fill, int interface, const CzStatics *behind,
                                    const CzStatics *ahead, CzEnds *ends);

/* Whether both sides have a part of a kind. */
static inline bool cz_ends_both_have(const CzEnds *ends, CzEndsKind kind) {
    return ends->side[CZ_SIDE_A].part[kind].is_there && ends->side[CZ_SIDE_B].part[kind].is_there;
}

/* Distance of the parts of a kind along the track at t = 0 [m]. */
double cz_ends_distance(const CzEnds *ends, CzEndsKind kind);

/* The side whose part strikes the bare end of the other one, where heights matter; -1: none. */
int cz_ends_striker(const CzEnds *ends, CzEndsKind kind);

CzEndsHeights cz_ends_heights(const CzEnds *ends, CzEndsKind kind);

static inline CzPartName cz_ends_part_name(const CzEnds *ends, int side, const char *what) {
    return (CzPartName){ends->side[side].car, ends->side[side].which, ends->lane, what};
}

#endif
