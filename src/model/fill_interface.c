/* Parameters of one interface: the parts of its two ends (model/ends.h) as elements.
 *
 * Where a part strikes a bare end, that side of its element is rigid, and on the end mass where
 * there is one.
 */
#include "model/ends.h"

#include "base/error.h"

#define BARE_COMPLIANCE 1e-9      /* of two ends without anti-climbers [m/N] (ours) */
#define SMALLEST_COMPLIANCE 1e-14 /* where a crush zone in series deflects instead [m/N] (ours) */
#define BARE_STIFFNESS 2e7        /* vertical, of bare ends, as of anti-climbers [N/m] (ours) */

/* Contact points of the parts of a kind: on the end masses, or on bodies without them. */
static void fill_contact(const CzEnds *ends, CzEndsKind kind, CzPairRows *contact) {
    const CzEndsHeights heights = cz_ends_heights(ends, kind);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const CzEndsSide *side = &ends->side[which];
        const double carrier = side->is_full ? side->end->distance : 0.0;
        contact->x[which][ends->i] = side->sign * (side->plane - side->part[kind].gap - carrier);
        contact->z[which][ends->i] =
            side->is_full ? heights.side[which] - side->end->cg_height : 0.0;
    }
    contact->distance[ends->i] = cz_ends_distance(ends, kind);
    contact->rise[ends->i] = heights.rise;
}

/* ---- devices of couplers and side buffers ---- */

/* A buffer of a side, `count` of them together; NULL: none. */
static CzStatus fill_buffer(const CzEnds *ends, CzPartName name, const CzBuffer *buffer, int count,
                            CzCurveId curve, CzBufferRows *rows) {
    CZ_TRY(cz_fill_buffer(ends->fill, name, buffer, count, curve));
    if (buffer == NULL)
        return CZ_OK;
    rows->transition[ends->i] = buffer->transition_stiffness * count;
    rows->share[ends->i] = buffer->unloading_share;
    rows->damping[ends->i] = buffer->damping * count;
    rows->quadratic[ends->i] = buffer->quadratic_damping * count;
    return CZ_OK;
}

/* Collapse tubes of a side likewise. */
static CzStatus fill_tube(const CzEnds *ends, CzPartName name, const CzTube *tube, int count,
                          CzCurveId curve, double *rate) {
    if (tube->given)
        rate[ends->i] = tube->rate_factor;
    return cz_fill_tube(ends->fill, name, tube, count, curve);
}

static double tube_compliance(const CzTube *tube, int count) {
    return tube->given ? 1.0 / (tube->stiffness * tube->count * count) : 0.0;
}

/* ---- couplers ---- */

/* Length from pivot to face of a coupler that is part of a strut; 0 where it acts along the track.
 */
static double strut_length(const CzEnds *ends, int which) {
    const CzEndsSide *side = &ends->side[which];
    const bool has_pivot = side->is_full || (ends->tilts && !side->is_fixed);
    return side->part[CZ_ENDS_COUPLER].is_there && has_pivot ? side->end->coupler.length : 0.0;
}

static void fill_pivot(const CzEnds *ends, int which, double height) {
    CzCouplerRows *rows = &ends->rows->coupler;
    const CzEndsSide *side = &ends->side[which];
    const size_t i = ends->i;
    const double length = strut_length(ends, which),
                 behind = side->part[CZ_ENDS_COUPLER].gap + length;
    const bool on_end = side->has_end_mass && (!side->part[CZ_ENDS_COUPLER].is_there ||
                                               side->end->coupler.anchor == CZ_ANCHOR_END);
    const double carrier = on_end ? side->end->cg_height : side->vehicle->cg_height;
    const double arm = side->plane - behind - (on_end && side->is_full ? side->end->distance : 0.0);
    rows->side[which].on_end[i] = on_end;
    rows->pivot.x[which][i] = side->sign * (side->is_full ? arm : 0.0);
    rows->pivot.z[which][i] = side->is_full ? height - carrier : 0.0;
    if (length > 0.0)
        rows->side[which].strut_length[i] = length;
}

/* Heights of underframes are compared at the pivots of the couplers at rest, else at the bare end
 * structures. */
static void fill_underframes(const CzEnds *ends) {
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const CzEndsSide *side = &ends->side[which];
        const double bare = side->end->given ? side->end->face_gap : 0.0;
        const double behind = side->part[CZ_ENDS_COUPLER].is_there
                                  ? side->part[CZ_ENDS_COUPLER].gap + strut_length(ends, which)
                                  : bare;
        ends->rows->underframe_x[which][ends->i] =
            side->is_full ? side->sign * (side->plane - behind) : 0.0;
    }
}

static void fill_overload_devices(const CzEnds *ends, int which, const CzCoupler *coupler) {
    CzShearOffRows *shear = &ends->rows->coupler.side[which].shear;
    CzHingeRows *turns = &ends->rows->coupler.side[which].hinge_vertical;
    const CzShearOff *shear_off = &coupler->shear_off;
    const CzHinge *hinge = &coupler->hinge;
    const size_t i = ends->i;
    if (shear_off->given) {
        shear->force[i] = shear_off->force;
        shear->residual[i] = shear_off->residual_force;
        shear->softening[i] = shear_off->softening_length;
        shear->space[i] = shear_off->softening_length + shear_off->retraction_space;
        shear->bottom[i] = shear_off->bottom_stiffness;
    }
    if (hinge->given) {
        turns->stiffness[i] = hinge->stiffness;
        turns->moment[i] = hinge->moment_capacity;
        turns->stop[i] = hinge->swing_stop;
        turns->stop_stiffness[i] = hinge->stop_stiffness;
    }
}

static CzStatus fill_coupler_side(const CzEnds *ends, int which, double *compliance) {
    const CzEndsSide *side = &ends->side[which];
    const CzCoupler none = {.given = false};
    const CzCoupler *coupler = side->part[CZ_ENDS_COUPLER].is_there ? &side->end->coupler : &none;
    const CzBuffer *given = coupler->given ? &coupler->buffer : NULL;
    CzCouplerRows *rows = &ends->rows->coupler;
    CzBufferRows *buffer = &rows->side[which].buffer;
    CZ_TRY(fill_buffer(ends, cz_ends_part_name(ends, which, "coupler buffer"), given, 1,
                       CZ_CURVE(buffer[which]), buffer));
    if (given != NULL) {
        buffer->draw_stiffness[ends->i] = given->draw_stiffness;
        buffer->draw_slack[ends->i] = given->draw_slack;
        fill_overload_devices(ends, which, coupler);
    }
    *compliance += tube_compliance(&coupler->tube, 1);
    *compliance += tube_compliance(&coupler->second_tube, 1);
    CZ_TRY(fill_tube(ends, cz_ends_part_name(ends, which, "coupler tube"), &coupler->tube, 1,
                     CZ_CURVE(tube[which]), rows->side[which].tube_rate));
    return fill_tube(ends, cz_ends_part_name(ends, which, "second coupler tube"),
                     &coupler->second_tube, 1, CZ_CURVE(second_tube[which]),
                     rows->side[which].second_tube_rate);
}

static CzStatus fill_couplers(const CzEnds *ends) {
    CzCouplerRows *rows = &ends->rows->coupler;
    const size_t i = ends->i;
    if (!ends->has[CZ_ENDS_COUPLER])
        return CZ_OK;
    const CzEndsHeights heights = cz_ends_heights(ends, CZ_ENDS_COUPLER);
    const double rise = ends->tilts ? heights.rise : 0.0;
    const double length = strut_length(ends, CZ_SIDE_A) + strut_length(ends, CZ_SIDE_B);
    double compliance = 0.0;
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        fill_pivot(ends, which, heights.side[which]);
        CZ_TRY(fill_coupler_side(ends, which, &compliance));
    }
    rows->exists[i] = 1.0;
    rows->coupled[i] =
        ends->lane != ends->fill->model->colliding && cz_ends_both_have(ends, CZ_ENDS_COUPLER);
    rows->pivot.distance[i] = cz_ends_distance(ends, CZ_ENDS_COUPLER) + length;
    rows->pivot.rise[i] = rise;
    rows->length[i] = sqrt(length * length + rise * rise);
    rows->along[i] = length;
    rows->compliance[i] = compliance;
    ends->fill->lanes->has.couplers = 1;
    return CZ_OK;
}

/* ---- anti-climbers and crush zones without end mass ---- */

/* Stiffness of both sides in series; a side without the part is rigid. */
static double in_series(double a, double b) {
    const double sum = a + b;
    return sum > 0.0 ? a * b / sum : 0.0;
}

static double value_or_zero(double value) {
    return isnan(value) ? 0.0 : value;
}

static bool is_massless(const CzEndsSide *side) {
    return !side->has_end_mass && cz_end_crushes(side->end);
}

static CzStatus fill_face_side(const CzEnds *ends, int which, double *compliance) {
    const CzEndsSide *side = &ends->side[which];
    const CzEnd *end = side->end;
    const CzAntiClimber *device = side->part[CZ_ENDS_FACE].is_there ? &end->anti_climber : NULL;
    CzFaceRows *rows = &ends->rows->face;
    CZ_TRY(cz_fill_anti_climber(ends->fill, cz_ends_part_name(ends, which, "anti-climber"), device,
                                CZ_CURVE(face[which])));
    if (is_massless(side)) {
        CZ_TRY(cz_fill_end(ends->fill, cz_ends_part_name(ends, which, "end"), end,
                           CZ_CURVE(massless[which])));
        rows->side[which].has_massless[ends->i] = 1.0;
        cz_fill_crush(&rows->side[which].massless, ends->i, end);
    }
    if (device != NULL) {
        rows->side[which].rate[ends->i] = device->rate_factor;
        rows->side[which].speed_factor[ends->i] = device->speed_factor / device->speed_reference;
        *compliance += 1.0 / (device->stiffness * device->count);
    }
    return CZ_OK;
}

/* Ribs and friction of two anti-climbers. */
static void fill_ribs(const CzEnds *ends) {
    CzFaceRows *rows = &ends->rows->face;
    const size_t i = ends->i;
    const CzAntiClimber *a = &ends->side[CZ_SIDE_A].end->anti_climber;
    const CzAntiClimber *b = &ends->side[CZ_SIDE_B].end->anti_climber;
    const double capacity = fmin(a->rib_count * a->count * value_or_zero(a->rib_strength),
                                 b->rib_count * b->count * value_or_zero(b->rib_strength));
    rows->friction[i] = fmin(value_or_zero(a->friction), value_or_zero(b->friction));
    rows->stiffness_vertical[i] = in_series(a->vertical_stiffness, b->vertical_stiffness);
    rows->rib_capacity[i] = capacity;
    if (capacity > 0.0)
        rows->rib_depth[i] = fmax(a->rib_depth, b->rib_depth);
    if (!ends->side[CZ_SIDE_A].is_full || !ends->side[CZ_SIDE_B].is_full)
        return;
    /* The faces lose contact over one rib pitch of remaining overlap, whatever the ribs carry. */
    rows->rib_pitch[i] = fmax(a->face_height / a->rib_count, b->face_height / b->rib_count);
    rows->overlap[i] = (a->face_height + b->face_height) / 2.0;
}

/* The smaller of the coefficients that are given; 0 for none. */
static double friction_of(const CzEnds *ends, const double friction[2]) {
    return ends->tilts ? value_or_zero(fmin(friction[0], friction[1])) : 0.0;
}

/* Friction of an anti-climber on a bare end, or of two bare ends, and the overlap of the first. */
static void fill_rub(const CzEnds *ends) {
    CzFaceRows *rows = &ends->rows->face;
    const size_t i = ends->i;
    const int striker = cz_ends_striker(ends, CZ_ENDS_FACE);
    double friction[2], centre[2];
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const CzEndsSide *side = &ends->side[which];
        friction[which] = which == striker   ? side->end->anti_climber.friction
                          : side->end->given ? side->end->face_friction
                                             : NAN;
        centre[which] = side->part[CZ_ENDS_FACE].height + side->offset;
    }
    rows->friction[i] = friction_of(ends, friction);
    if (rows->friction[i] > 0.0)
        rows->stiffness_vertical[i] = striker >= 0
                                          ? ends->side[striker].end->anti_climber.vertical_stiffness
                                          : BARE_STIFFNESS;
    if (striker < 0)
        return;
    const CzAntiClimber *device = &ends->side[striker].end->anti_climber;
    const CzHeightRange structure = cz_structure_heights(ends->side[1 - striker].end);
    const double overlap = (device->face_height + structure.high - structure.low) / 2.0;
    if (isnan(overlap))
        return;
    rows->overlap[i] = overlap;
    rows->eccentricity[i] = centre[CZ_SIDE_A] - centre[CZ_SIDE_B];
    rows->rib_pitch[i] = device->face_height / fmax(device->rib_count, 1.0);
}

static CzStatus fill_faces(const CzEnds *ends) {
    CzFaceRows *rows = &ends->rows->face;
    const CzEndsSide *side = ends->side;
    double compliance = 0.0, damping[2] = {0.0, 0.0};
    fill_contact(ends, CZ_ENDS_FACE, &rows->contact);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        CZ_TRY(fill_face_side(ends, which, &compliance));
        if (side[which].part[CZ_ENDS_FACE].is_there)
            damping[which] =
                side[which].end->anti_climber.damping * side[which].end->anti_climber.count;
    }
    const bool has_massless = is_massless(&side[CZ_SIDE_A]) || is_massless(&side[CZ_SIDE_B]);
    if (compliance == 0.0)
        compliance = has_massless ? SMALLEST_COMPLIANCE : BARE_COMPLIANCE;
    rows->compliance[ends->i] = compliance;
    rows->damping[ends->i] = cz_ends_both_have(ends, CZ_ENDS_FACE)
                                 ? in_series(damping[0], damping[1])
                                 : damping[0] + damping[1];
    if (cz_ends_both_have(ends, CZ_ENDS_FACE))
        fill_ribs(ends);
    else
        fill_rub(ends);
    return CZ_OK;
}

/* ---- side buffers ---- */

/* Friction of two plates, of one on a bare end, or of an anti-climber on plates. */
static double plate_friction(const CzEnds *ends) {
    double friction[2];
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const CzEndsSide *side = &ends->side[which];
        friction[which] = side->presses_plates ? side->end->anti_climber.friction
                          : side->part[CZ_ENDS_SIDE_BUFFERS].is_there
                              ? side->end->side_buffers.friction
                          : side->end->given ? side->end->face_friction
                                             : NAN;
    }
    if (cz_ends_both_have(ends, CZ_ENDS_SIDE_BUFFERS))
        return fmin(value_or_zero(friction[0]), value_or_zero(friction[1]));
    return friction_of(ends, friction);
}

/* An anti-climber in the place of side buffers: a plastic member without a buffer. */
static CzStatus fill_device_on_plates(const CzEnds *ends, int which, double *compliance) {
    const CzAntiClimber *device = &ends->side[which].end->anti_climber;
    CzSideBufferRows *rows = &ends->rows->side_buffers;
    CZ_TRY(cz_fill_anti_climber(ends->fill, cz_ends_part_name(ends, which, "anti-climber"), device,
                                CZ_CURVE(side_tube[which])));
    rows->side[which].tube_rate[ends->i] = device->rate_factor;
    rows->side[which].speed_factor[ends->i] = device->speed_factor / device->speed_reference;
    *compliance += 1.0 / (device->stiffness * device->count);
    return fill_buffer(ends, cz_ends_part_name(ends, which, "side buffer"), NULL, 1,
                       CZ_CURVE(side_buffer[which]), &rows->side[which].buffer);
}

static CzStatus fill_buffer_side(const CzEnds *ends, int which, double *compliance) {
    const CzEndsSide *side = &ends->side[which];
    const CzSideBuffers none = {.count = 1};
    const CzSideBuffers *set =
        side->part[CZ_ENDS_SIDE_BUFFERS].is_there ? &side->end->side_buffers : &none;
    CzSideBufferRows *rows = &ends->rows->side_buffers;
    if (side->presses_plates)
        return fill_device_on_plates(ends, which, compliance);
    CZ_TRY(fill_buffer(ends, cz_ends_part_name(ends, which, "side buffer"),
                       set->given ? &set->buffer : NULL, set->count, CZ_CURVE(side_buffer[which]),
                       &rows->side[which].buffer));
    *compliance += tube_compliance(&set->tube, set->count);
    return fill_tube(ends, cz_ends_part_name(ends, which, "side buffer tube"), &set->tube,
                     set->count, CZ_CURVE(side_tube[which]), rows->side[which].tube_rate);
}

static CzStatus fill_side_buffers(const CzEnds *ends) {
    CzSideBufferRows *rows = &ends->rows->side_buffers;
    double compliance = 0.0;
    if (!ends->has[CZ_ENDS_SIDE_BUFFERS])
        return CZ_OK;
    fill_contact(ends, CZ_ENDS_SIDE_BUFFERS, &rows->contact);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++)
        CZ_TRY(fill_buffer_side(ends, which, &compliance));
    rows->exists[ends->i] = 1.0;
    rows->compliance[ends->i] = compliance;
    rows->friction[ends->i] = plate_friction(ends);
    ends->fill->lanes->has.side_buffers = 1;
    return CZ_OK;
}

/* ---- superstructures ---- */

static void fill_superstructures(const CzEnds *ends) {
    CzSuperstructureRows *rows = &ends->rows->superstructure;
    const CzSuperstructure *a = &ends->side[CZ_SIDE_A].end->superstructure;
    const CzSuperstructure *b = &ends->side[CZ_SIDE_B].end->superstructure;
    if (!ends->has[CZ_ENDS_SUPERSTRUCTURE])
        return;
    fill_contact(ends, CZ_ENDS_SUPERSTRUCTURE, &rows->contact);
    rows->stiffness[ends->i] = in_series(a->stiffness, b->stiffness);
    rows->strength[ends->i] = fmin(a->strength, b->strength);
    ends->fill->lanes->has.superstructures = 1;
}

/* ---- draw gears ---- */

/* The hooks meet midway between the foremost planes, without force at t = 0. */
static void fill_draw_gears(const CzEnds *ends) {
    CzDrawGearRows *rows = &ends->rows->draw_gear;
    const CzDrawGear *a = &ends->side[CZ_SIDE_A].end->draw_gear;
    const CzDrawGear *b = &ends->side[CZ_SIDE_B].end->draw_gear;
    const size_t i = ends->i;
    if (!ends->has[CZ_ENDS_DRAW_GEAR])
        return;
    const CzEndsHeights heights = cz_ends_heights(ends, CZ_ENDS_DRAW_GEAR);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const CzEndsSide *side = &ends->side[which];
        rows->contact.x[which][i] = side->sign * (side->plane + 0.5 * ends->distance);
        rows->contact.z[which][i] =
            side->is_full ? heights.side[which] - side->vehicle->cg_height : 0.0;
    }
    rows->contact.rise[i] = heights.rise;
    rows->stiffness[i] = in_series(a->stiffness, b->stiffness);
    rows->slack[i] = a->slack + b->slack;
    ends->fill->lanes->has.draw_gears = 1;
}

CzStatus cz_fill_interface(const CzFill *fill, int interface, const CzStatics *behind,
                           const CzStatics *ahead) {
    CzEnds ends;
    CZ_TRY(cz_ends_find(fill, interface, behind, ahead, &ends));
    ends.rows->tilts[ends.i] = ends.tilts;
    fill_underframes(&ends);
    CZ_TRY(fill_couplers(&ends));
    CZ_TRY(fill_faces(&ends));
    fill_superstructures(&ends);
    fill_draw_gears(&ends);
    return fill_side_buffers(&ends);
}
