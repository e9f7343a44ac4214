/* Which part of an end meets which part of the end that it faces. */
#include "problem/meeting.h"

#include <math.h>

#define PLATE_HEIGHT 0.34 /* of a side buffer [m] (ours) */

bool cz_end_has(const CzEnd *end, CzPartKind kind) {
    const bool has[CZ_N_PART] = {[CZ_PART_COUPLER] = end->coupler.given,
                                 [CZ_PART_FACE] = end->anti_climber.given,
                                 [CZ_PART_SIDE_BUFFERS] = end->side_buffers.given};
    return end->given && has[kind];
}

/* Heights around a middle; NaN where one of them is not given. */
static CzHeightRange heights_about(double middle, double height) {
    return (CzHeightRange){middle - height / 2.0, middle + height / 2.0};
}

CzHeightRange cz_part_heights(const CzEnd *end, CzPartKind kind) {
    const CzAntiClimber *device = &end->anti_climber;
    if (kind == CZ_PART_COUPLER)
        return heights_about(end->coupler.height, 0.0);
    if (kind == CZ_PART_SIDE_BUFFERS)
        return heights_about(end->side_buffers.height, PLATE_HEIGHT);
    return heights_about(device->height, isnan(device->face_height) ? 0.0 : device->face_height);
}

CzHeightRange cz_structure_heights(const CzEnd *end) {
    return end->given ? heights_about(end->crush_height, end->face_height)
                      : (CzHeightRange){NAN, NAN};
}

/* Whether an anti-climber presses the plates of side buffers opposite. */
static bool meets_plates(const CzEnd *end, const CzEnd *opposite, double rise) {
    if (!end->anti_climber.in_line_with_buffers || cz_end_has(end, CZ_PART_SIDE_BUFFERS) ||
        !cz_end_has(opposite, CZ_PART_SIDE_BUFFERS))
        return false;
    const CzHeightRange device = cz_part_heights(end, CZ_PART_FACE);
    const CzHeightRange plate = cz_part_heights(opposite, CZ_PART_SIDE_BUFFERS);
    return !(device.low > plate.high + rise || device.high < plate.low + rise);
}

CzMeets cz_part_meets(const CzEnd *end, CzPartKind kind, const CzEnd *opposite, double rise) {
    if (cz_end_has(opposite, kind))
        return CZ_MEETS_ITS_KIND;
    if (kind == CZ_PART_FACE && meets_plates(end, opposite, rise))
        return CZ_MEETS_PLATES;
    if (opposite->given && opposite->struck_by == CZ_STRUCK_BY_NO_COUPLERS &&
        kind == CZ_PART_COUPLER)
        return CZ_PASSES_THROUGH;
    const CzHeightRange part = cz_part_heights(end, kind),
                        structure = cz_structure_heights(opposite);
    if (part.low > structure.high + rise)
        return CZ_PASSES_OVER;
    return part.high < structure.low + rise ? CZ_PASSES_UNDER : CZ_STRIKES;
}

bool cz_parts_may_pass(const CzEnd *end, CzPartKind kind, const CzEnd *opposite, double rise) {
    static const double most[CZ_N_PART] = {
        [CZ_PART_COUPLER] = 0.2, [CZ_PART_SIDE_BUFFERS] = PLATE_HEIGHT};
    return most[kind] > 0.0 && cz_end_has(end, kind) && cz_end_has(opposite, kind) &&
           fabs(cz_part_heights(opposite, kind).low + rise - cz_part_heights(end, kind).low) >
               most[kind]; /* not for NaN: heights do not matter */
}

bool cz_end_is_struck(const CzEnd *end, const CzEnd *opposite, double rise) {
    return cz_part_strikes(opposite, CZ_PART_COUPLER, end, rise) ||
           cz_part_strikes(opposite, CZ_PART_SIDE_BUFFERS, end, rise);
}
