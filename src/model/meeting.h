/* Two vehicle ends that meet at an interface, while their numbers are put into the lanes. */
#ifndef CZ_MODEL_MEETING_H
#define CZ_MODEL_MEETING_H

#include <math.h>

#include "model/fill.h"

/* One side of the interface. */
typedef struct CzSide {
    int car;
    int which; /* end of that car */
    bool is_full, is_fixed;
    const CzVehicle *vehicle;
    const CzEnd *end;
    double plane;  /* foremost plane from the body's centre of gravity, outwards [m] */
    double sign;   /* of outwards along x */
    double offset; /* height above its drawn position [m] */
} CzSide;

typedef struct CzMeeting {
    const CzFill *fill;
    int lane; /* car whose lane has the numbers */
    CzSide side[2];
    bool has_couplers, has_side_buffers, has_superstructures, has_draw_gears;
    bool tilts;      /* a car that moves up and down meets one that can move */
    double distance; /* of the foremost planes at t = 0 [m] */
} CzMeeting;

static inline void put(const CzMeeting *pair, CzParameter parameter, double value) {
    cz_put(pair->fill, pair->lane, parameter, value);
}

static inline CzPartName part_name(const CzMeeting *pair, int side, const char *what) {
    return (CzPartName){pair->side[side].car, pair->side[side].which, pair->lane, what};
}

/* Heights of both sides as drawn, and of B's part above A's with the offsets. */
typedef struct CzHeights {
    double side[2]; /* above rail [m] */
    double rise;    /* [m] */
} CzHeights;

static inline CzHeights heights_of(const CzMeeting *pair, double (*height)(const CzSide *)) {
    const CzSide *a = &pair->side[CZ_SIDE_A], *b = &pair->side[CZ_SIDE_B];
    CzHeights heights = {.side = {height(a), height(b)}};
    if (isnan(heights.side[0]))
        heights.side[0] = isnan(heights.side[1]) ? 0.0 : heights.side[1];
    if (isnan(heights.side[1]))
        heights.side[1] = heights.side[0];
    heights.rise = heights.side[1] + b->offset - heights.side[0] - a->offset;
    return heights;
}

/* Both sides in series; a side without the part is rigid. */
static inline double in_series(double a, double b) {
    const double sum = a + b;
    return sum > 0.0 ? a * b / sum : 0.0;
}

static inline double value_or_zero(double value) {
    return isnan(value) ? 0.0 : value;
}

/* Parts pair when both sides have them, or one has and the other is fixed. */
static inline bool pairs(const CzSide *side, bool (*has)(const CzSide *)) {
    const bool a = has(&side[CZ_SIDE_A]), b = has(&side[CZ_SIDE_B]);
    return (a && b) || (a && side[CZ_SIDE_B].is_fixed) || (b && side[CZ_SIDE_A].is_fixed);
}

/* Side buffers, superstructures and draw gears: whether a meeting has them, and the gap between
 * those that may touch first; infinite without [m]. */
void cz_contacts_find(CzMeeting *pair);
double cz_contacts_gap(const CzMeeting *pair);

/* Puts their numbers into the lane. */
CZ_MUST_CHECK CzStatus cz_fill_contacts(const CzMeeting *pair);

#endif
