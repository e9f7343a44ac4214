/* Which part of an end meets which part of the end that it faces.
 *
 * A part meets the part of its kind. Where the other end has none, an anti-climber in line with
 * side buffers meets their plates; every other part strikes the bare end structure there, unless it
 * passes over it, under it, or through it.
 */
#ifndef CZ_PROBLEM_MEETING_H
#define CZ_PROBLEM_MEETING_H

#include "problem/input.h"

/* Kinds of parts that touch; the face is an anti-climber's where there is one, else the bare
 * end's. */
typedef enum CzPartKind {
    CZ_PART_COUPLER,
    CZ_PART_FACE,
    CZ_PART_SIDE_BUFFERS,
    CZ_N_PART
} CzPartKind;

/* What a part meets. */
typedef enum CzMeets {
    CZ_MEETS_ITS_KIND,
    CZ_MEETS_PLATES, /* of side buffers, which an anti-climber in line with them presses */
    CZ_STRIKES,      /* the bare end structure */
    CZ_PASSES_OVER,
    CZ_PASSES_UNDER,
    CZ_PASSES_THROUGH
} CzMeets;

/* Heights above rail that a part takes up [m]; NaN where they are not given. */
typedef struct CzHeightRange {
    double low, high;
} CzHeightRange;

/* Whether an end has a part of a kind; for the face, an anti-climber. */
bool cz_end_has(const CzEnd *end, CzPartKind kind);

/* Heights of the part of a kind, which the end has, and of the bare end structure. Couplers are
 * taken at their axes, side buffers with their plates. */
CzHeightRange cz_part_heights(const CzEnd *end, CzPartKind kind);
CzHeightRange cz_structure_heights(const CzEnd *end);

/* What the part of a kind, which the end has, meets at the end opposite, which is higher by `rise`
 * than in its file; NaN where heights do not matter: at a wall, and between two rigid vehicles. */
CzMeets cz_part_meets(const CzEnd *end, CzPartKind kind, const CzEnd *opposite, double rise);

/* Whether couplers or side buffers, which the model lets meet their kind at any heights, are so far
 * apart that they may pass each other: beyond 200 mm, and the height of a plate (ours). */
bool cz_parts_may_pass(const CzEnd *end, CzPartKind kind, const CzEnd *opposite, double rise);

/* Mass in front of the crush zone of an end [kg]; 0 where it has none. That of a rigid vehicle
 * counts where a coupler or side buffers strike the end: then all parts act on it. */
static inline double cz_end_mass(const CzVehicle *vehicle, const CzEnd *end) {
    if (!end->given || vehicle->model == CZ_MODEL_FIXED)
        return 0.0;
    const double mass = vehicle->model == CZ_MODEL_FULL ? end->mass : end->face_mass;
    return isnan(mass) ? 0.0 : mass;
}

/* Whether a coupler or side buffers of the end opposite, which is lower by `rise` than in its file,
 * strike an end. */
bool cz_end_is_struck(const CzEnd *end, const CzEnd *opposite, double rise);

/* Whether the part of a kind exists and strikes the bare end structure opposite. */
static inline bool cz_part_strikes(const CzEnd *end, CzPartKind kind, const CzEnd *opposite,
                                   double rise) {
    return cz_end_has(end, kind) && cz_part_meets(end, kind, opposite, rise) == CZ_STRIKES;
}

#endif
