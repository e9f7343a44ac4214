/* State of a car in the plane, and the lanes: rows of one quantity side by side. */
#ifndef CZ_MODEL_STATE_H
#define CZ_MODEL_STATE_H

#include <stddef.h>

enum { CZ_LANE_BLOCK = 8 };

/* One quantity of all lanes of a block. */
typedef double CzRow[CZ_LANE_BLOCK];

/* Values for a part that does not exist. */
#define CZ_NEVER 1e30   /* a force, gap or stiffness that nothing reaches */
#define CZ_MISSING 1e29 /* strengths, strokes and gaps from this value on are never reached */

/* A number for each direction in which a body moves in the plane: displacement [m, rad], velocity,
 * force or mass. Pitch is positive nose-up. */
typedef struct CzPlane {
    CzRow x, z, pitch;
} CzPlane;

/* The same for a wheelset, whose spin is positive when it rolls forward. */
typedef struct CzWheelset {
    CzRow x, z, spin;
} CzWheelset;

/* The same for all bodies of a car: ends and bogies rear first, wheelsets from the rear. */
typedef struct CzState {
    CzPlane body, end[2], bogie[2];
    CzWheelset wheelset[4];
} CzState;

/* Number of a row in a struct of rows, and number of its rows: for tables and loops over all. */
#define CZ_ROW_OF(type, member) ((int)(offsetof(type, member) / sizeof(CzRow)))
#define CZ_ROWS_IN(type) ((int)(sizeof(type) / sizeof(CzRow)))

/* Degrees of freedom by name, such as CZ_DOF(end[1].pitch). */
#define CZ_DOF(member) CZ_ROW_OF(CzState, member)
enum { CZ_N_DOF = CZ_ROWS_IN(CzState) };

/* Direction of a degree of freedom. */
typedef enum CzAxis { CZ_AXIS_ALONG, CZ_AXIS_UP, CZ_AXIS_TURN } CzAxis;

static inline CzAxis cz_axis_of(int dof) {
    static const CzAxis axes[CZ_N_DOF] = {
#define CZ_DOF_ENTRY(row, axis, dimension, what) [CZ_DOF(row)] = CZ_AXIS_##axis,
#include "model/dof.def"
#undef CZ_DOF_ENTRY
    };
    return axes[dof];
}

/* A row of a struct of rows by its number. */
static inline double *cz_row_of(void *rows, int row) {
    return (double *)rows + (size_t)row * CZ_LANE_BLOCK;
}
static inline const double *cz_const_row_of(const void *rows, int row) {
    return (const double *)rows + (size_t)row * CZ_LANE_BLOCK;
}

/* Copies a lane of a struct of rows, of `size` bytes, to a lane of another one. */
static inline void cz_copy_lane(void *to, size_t lane, const void *from, size_t from_lane,
                                size_t size) {
    for (int row = 0; row < (int)(size / sizeof(CzRow)); row++)
        cz_row_of(to, row)[lane] = cz_const_row_of(from, row)[from_lane];
}

#endif
