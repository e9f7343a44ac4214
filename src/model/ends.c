/* The two ends of an interface: their parts, what meets what, their gaps and heights. */
#include "model/ends.h"

#define OVERLAP_TOLERANCE 1e-9 /* of rounding [m] */

/* The bare end structure where there is no part of a kind. */
static CzEndsPart bare_part(const CzEnd *end) {
    return end->given ? (CzEndsPart){false, end->face_gap, end->crush_height}
                      : (CzEndsPart){.height = NAN};
}

static void list_parts(CzEndsSide *side) {
    const CzEnd *end = side->end;
    const double gap[] = {[CZ_ENDS_COUPLER] = end->coupler.gap,
                          [CZ_ENDS_FACE] = end->anti_climber.gap,
                          [CZ_ENDS_SIDE_BUFFERS] = end->side_buffers.gap};
    const double height[] = {[CZ_ENDS_COUPLER] = end->coupler.height,
                             [CZ_ENDS_FACE] = end->anti_climber.height,
                             [CZ_ENDS_SIDE_BUFFERS] = end->side_buffers.height};
    for (int kind = 0; kind < CZ_N_PART; kind++)
        side->part[kind] = cz_end_has(end, (CzPartKind)kind)
                               ? (CzEndsPart){true, gap[kind], height[kind]}
                               : bare_part(end);
    side->part[CZ_ENDS_SUPERSTRUCTURE] = side->part[CZ_ENDS_DRAW_GEAR] =
        (CzEndsPart){.height = NAN};
    if (end->given && end->superstructure.given)
        side->part[CZ_ENDS_SUPERSTRUCTURE] =
            (CzEndsPart){side->is_full, end->superstructure.gap, end->superstructure.height};
    if (end->given && end->draw_gear.given)
        side->part[CZ_ENDS_DRAW_GEAR] = (CzEndsPart){true, 0.0, end->draw_gear.height};
}

static CzEndsSide make_side(const CzFill *fill, int car, int which, const CzStatics *statics) {
    const CzVehicle *vehicle = cz_fill_vehicle(fill, car);
    const CzVehicleModel model = fill->model->car[car].model;
    CzEndsSide side = {.car = car,
                       .which = which,
                       .is_full = model == CZ_MODEL_FULL,
                       .is_fixed = model == CZ_MODEL_FIXED,
                       .has_end_mass = cz_fill_end_mass(fill, car, which) > 0.0,
                       .vehicle = vehicle,
                       .end = cz_end_of(vehicle, which),
                       .plane = statics->plane[which],
                       .sign = which == CZ_FRONT ? 1.0 : -1.0};
    list_parts(&side);
    return side;
}

/* Height of the other end over its own in its file, with the offsets of both; NaN where every force
 * acts along the track. */
static double rise_of_other(const CzEnds *ends, int which) {
    const CzEndsSide *own = &ends->side[which], *other = &ends->side[1 - which];
    return ends->tilts ? other->offset - own->offset : NAN;
}

/* Whether the part of a side acts: on the part of its kind, or on the bare end opposite. */
static bool part_acts(const CzEnds *ends, int which, CzEndsKind kind) {
    const CzEndsSide *own = &ends->side[which], *other = &ends->side[1 - which];
    return own->part[kind].is_there &&
           (other->part[kind].is_there ||
            cz_part_strikes(own->end, (CzPartKind)kind, other->end, rise_of_other(ends, which)));
}

/* An anti-climber in line with the side buffers opposite takes the place of side buffers. */
static void find_plates(CzEnds *ends, int which) {
    CzEndsSide *own = &ends->side[which];
    const CzEndsSide *other = &ends->side[1 - which];
    own->presses_plates = own->part[CZ_ENDS_FACE].is_there &&
                          cz_part_meets(own->end, CZ_PART_FACE, other->end,
                                        rise_of_other(ends, which)) == CZ_MEETS_PLATES;
    if (!own->presses_plates)
        return;
    own->part[CZ_ENDS_SIDE_BUFFERS] = own->part[CZ_ENDS_FACE];
    own->part[CZ_ENDS_FACE] = bare_part(own->end);
}

/* Finds which kinds of parts act. Bare ends meet always, also behind an anti-climber that passes
 * the other end. */
static void find_pairs(CzEnds *ends) {
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++)
        find_plates(ends, which);
    for (int kind = 0; kind < CZ_N_PART; kind++)
        ends->has[kind] = part_acts(ends, CZ_SIDE_A, (CzEndsKind)kind) ||
                          part_acts(ends, CZ_SIDE_B, (CzEndsKind)kind);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++)
        if (!ends->has[CZ_ENDS_FACE])
            ends->side[which].part[CZ_ENDS_FACE] = bare_part(ends->side[which].end);
    ends->has[CZ_ENDS_FACE] = true;
    ends->has[CZ_ENDS_SUPERSTRUCTURE] = cz_ends_both_have(ends, CZ_ENDS_SUPERSTRUCTURE);
    ends->has[CZ_ENDS_DRAW_GEAR] =
        ends->lane != ends->fill->model->colliding && cz_ends_both_have(ends, CZ_ENDS_DRAW_GEAR);
}

static double gaps_of(const CzEnds *ends, CzEndsKind kind) {
    return ends->side[CZ_SIDE_A].part[kind].gap + ends->side[CZ_SIDE_B].part[kind].gap;
}

double cz_ends_distance(const CzEnds *ends, CzEndsKind kind) {
    return ends->distance + ends->side[CZ_SIDE_A].part[kind].gap +
           ends->side[CZ_SIDE_B].part[kind].gap;
}

int cz_ends_striker(const CzEnds *ends, CzEndsKind kind) {
    const bool of_a = ends->side[CZ_SIDE_A].part[kind].is_there;
    const bool of_b = ends->side[CZ_SIDE_B].part[kind].is_there;
    return !ends->tilts || of_a == of_b ? -1 : of_a ? CZ_SIDE_A : CZ_SIDE_B;
}

/* Height at which a part strikes the bare end of the other side, with the offsets: the middle of
 * the heights that they share [m]. */
static double struck_height(const CzEnds *ends, CzEndsKind kind, int striker) {
    const CzEndsSide *own = &ends->side[striker], *other = &ends->side[1 - striker];
    const CzHeightRange part = cz_part_heights(own->end, (CzPartKind)kind);
    const CzHeightRange structure = cz_structure_heights(other->end);
    const double low = fmax(part.low + own->offset, structure.low + other->offset);
    const double high = fmin(part.high + own->offset, structure.high + other->offset);
    const double middle = (low + high) / 2.0; /* a height that is not given counts for none */
    return isnan(middle) ? other->part[kind].height + other->offset : middle;
}

CzEndsHeights cz_ends_heights(const CzEnds *ends, CzEndsKind kind) {
    const CzEndsSide *a = &ends->side[CZ_SIDE_A], *b = &ends->side[CZ_SIDE_B];
    const int striker = (int)kind < CZ_N_PART ? cz_ends_striker(ends, kind) : -1;
    if (striker >= 0) {
        const double height = struck_height(ends, kind, striker);
        return (CzEndsHeights){{height - a->offset, height - b->offset}, 0.0};
    }
    CzEndsHeights heights = {.side = {a->part[kind].height, b->part[kind].height}};
    if (isnan(heights.side[0]))
        heights.side[0] = isnan(heights.side[1]) ? 0.0 : heights.side[1];
    if (isnan(heights.side[1]))
        heights.side[1] = heights.side[0];
    heights.rise = heights.side[1] + b->offset - heights.side[0] - a->offset;
    return heights;
}

/* ---- places of the two cars ---- */

static CzStatus place_cars(CzEnds *ends) {
    const CzModel *model = ends->fill->model;
    double nearest = gaps_of(ends, CZ_ENDS_FACE);
    for (int kind = 0; kind < CZ_N_ENDS_TOUCHING; kind++)
        if (ends->has[kind])
            nearest = fmin(nearest, gaps_of(ends, (CzEndsKind)kind));
    if (ends->lane == model->colliding) {
        ends->distance = -nearest;
        return CZ_OK;
    }
    ends->distance =
        cz_ends_both_have(ends, CZ_ENDS_COUPLER) ? -gaps_of(ends, CZ_ENDS_COUPLER) : 0.0;
    if (ends->distance + nearest < -OVERLAP_TOLERANCE)
        return cz_fill_refuse(
            ends->fill, cz_ends_part_name(ends, CZ_SIDE_A, "coupler"),
            &ends->side[CZ_SIDE_A].end->coupler.gap,
            "other parts of interface %s overlap by %g mm when its couplers touch",
            model->interface_name[ends->lane], -(ends->distance + nearest) * 1e3);
    return CZ_OK;
}

static void set_offsets(CzEnds *ends) {
    const CzOffsets offset = cz_fill_offsets(ends->fill->model, ends->lane);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++)
        ends->side[which].offset = offset.side[which];
}

CzStatus cz_ends_find(const CzFill *fill, int interface, const CzStatics *behind,
                      const CzStatics *ahead, CzEnds *ends) {
    const size_t lane = cz_fill_lane(fill, interface);
    *ends = (CzEnds){.fill = fill,
                     .lane = interface,
                     .rows = &cz_lane_block(fill->lanes, lane)->parameter,
                     .i = lane % CZ_LANE_BLOCK,
                     .side = {make_side(fill, interface, CZ_FRONT, behind),
                              make_side(fill, interface + 1, CZ_REAR, ahead)}};
    const CzEndsSide *a = &ends->side[CZ_SIDE_A], *b = &ends->side[CZ_SIDE_B];
    ends->tilts = (a->is_full || b->is_full) && !a->is_fixed && !b->is_fixed;
    set_offsets(ends);
    find_pairs(ends);
    return place_cars(ends);
}
