/* Numbers of what meets beside couplers and faces: side buffers, superstructures and draw gears. */
#include "model/meeting.h"

#include "base/error.h"

static bool has_side_buffers(const CzSide *side) {
    return side->end->given && side->end->side_buffers.given;
}

static bool has_superstructure(const CzSide *side) {
    return side->is_full && side->end->given && side->end->superstructure.given;
}

static bool has_draw_gear(const CzSide *side) {
    return side->end->given && side->end->draw_gear.given;
}

static double side_buffer_gap(const CzSide *side) {
    return has_side_buffers(side) ? side->end->side_buffers.gap : 0.0;
}

static double superstructure_gap(const CzSide *side) {
    return side->end->superstructure.gap;
}

static double side_buffer_height(const CzSide *side) {
    return has_side_buffers(side) ? side->end->side_buffers.height : NAN;
}

static double superstructure_height(const CzSide *side) {
    return side->end->superstructure.height;
}

static double draw_gear_height(const CzSide *side) {
    return side->end->draw_gear.height;
}

void cz_contacts_find(CzMeeting *pair) {
    const CzSide *a = &pair->side[CZ_SIDE_A], *b = &pair->side[CZ_SIDE_B];
    pair->has_side_buffers = pairs(pair->side, has_side_buffers);
    pair->has_superstructures = has_superstructure(a) && has_superstructure(b);
    pair->has_draw_gears =
        pair->lane != pair->fill->model->colliding && has_draw_gear(a) && has_draw_gear(b);
}

double cz_contacts_gap(const CzMeeting *pair) {
    const CzSide *a = &pair->side[CZ_SIDE_A], *b = &pair->side[CZ_SIDE_B];
    double gap = INFINITY;
    if (pair->has_side_buffers)
        gap = fmin(gap, side_buffer_gap(a) + side_buffer_gap(b));
    if (pair->has_superstructures)
        gap = fmin(gap, superstructure_gap(a) + superstructure_gap(b));
    return gap;
}

/* ---- side buffers ---- */

static CzStatus fill_side_buffer_side(const CzMeeting *pair, int which, double height,
                                      double *compliance) {
    const CzSide *side = &pair->side[which];
    const CzSideBuffers *set = has_side_buffers(side) ? &side->end->side_buffers : NULL;
    const CzCurveId curve = CZ_CURVE(side_buffer[which]);
    const CzCurveId tube_curve = CZ_CURVE(side_tube[which]);
    const CzPartName name = part_name(pair, which, "side buffer");
    const CzPartName tube_name = part_name(pair, which, "side buffer tube");
    const double carrier = side->is_full ? side->end->distance : 0.0;
    put(pair,
        which == CZ_SIDE_A ? CZ_PARAMETER(side_buffers.contact.x[0])
                           : CZ_PARAMETER(side_buffers.contact.x[1]),
        side->sign * (side->plane - side_buffer_gap(side) - carrier));
    put(pair,
        which == CZ_SIDE_A ? CZ_PARAMETER(side_buffers.contact.z[0])
                           : CZ_PARAMETER(side_buffers.contact.z[1]),
        side->is_full ? height - side->end->cg_height : 0.0);
    if (set == NULL) {
        CZ_TRY(cz_fill_buffer(pair->fill, name, NULL, 1, curve));
        return cz_fill_tube(pair->fill, tube_name, NULL, 1, tube_curve);
    }
    const CzBuffer *buffer = &set->buffer;
    CZ_TRY(cz_fill_buffer(pair->fill, name, buffer, set->count, curve));
    CZ_TRY(cz_fill_tube(pair->fill, tube_name, &set->tube, set->count, tube_curve));
    put(pair, CZ_PARAMETER(side_buffers.side[which].buffer.transition),
        buffer->transition_stiffness * set->count);
    put(pair, CZ_PARAMETER(side_buffers.side[which].buffer.share), buffer->unloading_share);
    put(pair, CZ_PARAMETER(side_buffers.side[which].buffer.damping), buffer->damping * set->count);
    put(pair, CZ_PARAMETER(side_buffers.side[which].buffer.quadratic),
        buffer->quadratic_damping * set->count);
    if (set->tube.given) {
        put(pair, CZ_PARAMETER(side_buffers.side[which].tube_rate), set->tube.rate_factor);
        *compliance += 1.0 / (set->tube.stiffness * set->tube.count * set->count);
    }
    return CZ_OK;
}

static CzStatus fill_side_buffers(const CzMeeting *pair) {
    const CzSide *a = &pair->side[CZ_SIDE_A], *b = &pair->side[CZ_SIDE_B];
    if (!pair->has_side_buffers)
        return CZ_OK;
    const CzHeights heights = heights_of(pair, side_buffer_height);
    double compliance = 0.0;
    CZ_TRY(fill_side_buffer_side(pair, CZ_SIDE_A, heights.side[CZ_SIDE_A], &compliance));
    CZ_TRY(fill_side_buffer_side(pair, CZ_SIDE_B, heights.side[CZ_SIDE_B], &compliance));
    put(pair, CZ_PARAMETER(side_buffers.exists), 1.0);
    put(pair, CZ_PARAMETER(side_buffers.contact.distance),
        pair->distance + side_buffer_gap(a) + side_buffer_gap(b));
    put(pair, CZ_PARAMETER(side_buffers.contact.rise), heights.rise);
    put(pair, CZ_PARAMETER(side_buffers.compliance), compliance);
    if (has_side_buffers(a) && has_side_buffers(b))
        put(pair, CZ_PARAMETER(side_buffers.friction),
            fmin(value_or_zero(a->end->side_buffers.friction),
                 value_or_zero(b->end->side_buffers.friction)));
    pair->fill->lanes->has_side_buffers = 1;
    return CZ_OK;
}

/* ---- superstructures ---- */

static void fill_superstructures(const CzMeeting *pair) {
    static const CzParameter x[] = {CZ_PARAMETER(superstructure.contact.x[0]),
                                    CZ_PARAMETER(superstructure.contact.x[1])};
    static const CzParameter z[] = {CZ_PARAMETER(superstructure.contact.z[0]),
                                    CZ_PARAMETER(superstructure.contact.z[1])};
    const CzSuperstructure *a = &pair->side[CZ_SIDE_A].end->superstructure;
    const CzSuperstructure *b = &pair->side[CZ_SIDE_B].end->superstructure;
    if (!pair->has_superstructures)
        return;
    const CzHeights heights = heights_of(pair, superstructure_height);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const CzSide *side = &pair->side[which];
        const CzEnd *end = side->end;
        put(pair, x[which], side->sign * (side->plane - superstructure_gap(side) - end->distance));
        put(pair, z[which], heights.side[which] - end->cg_height);
    }
    put(pair, CZ_PARAMETER(superstructure.contact.distance), pair->distance + a->gap + b->gap);
    put(pair, CZ_PARAMETER(superstructure.contact.rise), heights.rise);
    put(pair, CZ_PARAMETER(superstructure.stiffness), in_series(a->stiffness, b->stiffness));
    put(pair, CZ_PARAMETER(superstructure.strength), fmin(a->strength, b->strength));
    pair->fill->lanes->has_superstructures = 1;
}

/* ---- draw gears ---- */

/* The hooks meet midway between the foremost planes, without force at t = 0. */
static void fill_draw_gears(const CzMeeting *pair) {
    static const CzParameter x[] = {CZ_PARAMETER(draw_gear.contact.x[0]),
                                    CZ_PARAMETER(draw_gear.contact.x[1])};
    static const CzParameter z[] = {CZ_PARAMETER(draw_gear.contact.z[0]),
                                    CZ_PARAMETER(draw_gear.contact.z[1])};
    const CzDrawGear *a = &pair->side[CZ_SIDE_A].end->draw_gear;
    const CzDrawGear *b = &pair->side[CZ_SIDE_B].end->draw_gear;
    if (!pair->has_draw_gears)
        return;
    const CzHeights heights = heights_of(pair, draw_gear_height);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const CzSide *side = &pair->side[which];
        put(pair, x[which], side->sign * (side->plane + 0.5 * pair->distance));
        put(pair, z[which], side->is_full ? heights.side[which] - side->vehicle->cg_height : 0.0);
    }
    put(pair, CZ_PARAMETER(draw_gear.contact.rise), heights.rise);
    put(pair, CZ_PARAMETER(draw_gear.stiffness), in_series(a->stiffness, b->stiffness));
    put(pair, CZ_PARAMETER(draw_gear.slack), a->slack + b->slack);
    pair->fill->lanes->has_draw_gears = 1;
}

CzStatus cz_fill_contacts(const CzMeeting *pair) {
    fill_superstructures(pair);
    fill_draw_gears(pair);
    return fill_side_buffers(pair);
}
