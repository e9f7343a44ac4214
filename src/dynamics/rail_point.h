/* The rail under a wheelset, and the place of a wheelset on its car. */
#ifndef CZ_DYNAMICS_RAIL_POINT_H
#define CZ_DYNAMICS_RAIL_POINT_H

typedef struct CzRailPoint {
    double z;                 /* deflection of the track's own parts, upwards [m] */
    double past;              /* the same half a step ago at the same place [m] */
    double slope;             /* change of the deflection along the track [-] */
    double flexibility;       /* immediate deflection per force [m/N] */
    double flexibility_slope; /* its change along the track [1/N] */
} CzRailPoint;

/* Place of a wheelset from the middle of its car, counted from the rear: half the spacing of the
 * bogies and of the axles [m]. */
static inline double cz_wheel_place(double bogie, double axle, int index) {
    return (index / 2 == 0 ? -bogie : bogie) + (index % 2 == 0 ? -axle : axle);
}

#endif
