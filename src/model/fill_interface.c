/* Numbers of one interface: where the two ends are at t = 0, and what they are made of.
 *
 *   distance of a pair of parts = distance of the foremost planes + gap_A + gap_B
 *
 * Inner interfaces: coupled couplers touch face to face; without them the foremost planes touch.
 * Colliding interface: the nearest pair of parts of one kind touches. A fixed partner without a
 * part of its own meets the other's with its foremost plane, at the other's height.
 */
#include "model/meeting.h"

#include "base/error.h"

#define BARE_COMPLIANCE 1e-9 /* of two ends without anti-climbers [m/N] (ours) */
#define SMALLEST_COMPLIANCE                                                                        \
    1e-14                      /* where a crush zone in series deflects instead [m/N] (ours)       \
                                */
#define OVERLAP_TOLERANCE 1e-9 /* of rounding [m] */

static CzSide make_side(const CzFill *fill, int car, int which, const CzStatics *statics) {
    const CzVehicle *vehicle = cz_fill_vehicle(fill, car);
    const CzVehicleModel model = fill->model->car[car].model;
    return (CzSide){.car = car,
                    .which = which,
                    .is_full = model == CZ_MODEL_FULL,
                    .is_fixed = model == CZ_MODEL_FIXED,
                    .vehicle = vehicle,
                    .end = cz_end_of(vehicle, which),
                    .plane = statics->plane[which],
                    .sign = which == CZ_FRONT ? 1.0 : -1.0};
}

static bool has_coupler(const CzSide *side) {
    return side->end->given && side->end->coupler.given;
}

static bool has_anti_climber(const CzSide *side) {
    return side->end->given && side->end->anti_climber.given;
}

/* ---- gaps behind the foremost plane, and heights above rail (NaN: as the other side's) ---- */

static double coupler_gap(const CzSide *side) {
    return has_coupler(side) ? side->end->coupler.gap : 0.0;
}

/* Pivot to face, of a coupler that takes part in a strut; 0 of one that pushes along the track. */
static double strut_length(const CzMeeting *pair, int which) {
    const CzSide *side = &pair->side[which];
    const bool has_pivot = side->is_full || (pair->tilts && !side->is_fixed);
    return has_coupler(side) && has_pivot ? side->end->coupler.length : 0.0;
}

static double face_gap(const CzSide *side) {
    if (!side->end->given)
        return 0.0;
    return has_anti_climber(side) ? side->end->anti_climber.gap : side->end->face_gap;
}

static double coupler_height(const CzSide *side) {
    return has_coupler(side) ? side->end->coupler.height : NAN;
}

static double face_height(const CzSide *side) {
    if (!side->end->given)
        return NAN;
    return has_anti_climber(side) ? side->end->anti_climber.height : side->end->crush_height;
}

/* ---- where the two cars stand ---- */

static CzStatus place_cars(CzMeeting *pair) {
    const CzModel *model = pair->fill->model;
    const CzSide *a = &pair->side[CZ_SIDE_A], *b = &pair->side[CZ_SIDE_B];
    const double couplers = coupler_gap(a) + coupler_gap(b);
    const double faces = face_gap(a) + face_gap(b);
    double nearest = faces;
    if (pair->has_couplers)
        nearest = fmin(nearest, couplers);
    nearest = fmin(nearest, cz_contacts_gap(pair));

    if (pair->lane == model->colliding) {
        pair->distance = -nearest;
        return CZ_OK;
    }
    pair->distance = pair->has_couplers ? -couplers : 0.0;
    if (pair->distance + nearest < -OVERLAP_TOLERANCE)
        return cz_fill_refuse(
            pair->fill, part_name(pair, CZ_SIDE_A, "coupler"), &a->end->coupler.gap,
            "other parts of interface %s overlap by %g mm when its couplers touch",
            model->interface_name[pair->lane], -(pair->distance + nearest) * 1e3);
    return CZ_OK;
}

static void set_offsets(CzMeeting *pair) {
    const CzModel *model = pair->fill->model;
    const CzInput *input = cz_problem_input(model->problem);
    const CzScenario *scenario = model->scenario;
    if (pair->lane == model->colliding) {
        const double behind = input->trains[model->train[0]].height_offset;
        const double ahead = input->trains[model->train[1]].height_offset;
        pair->side[CZ_SIDE_A].offset = behind;
        pair->side[CZ_SIDE_B].offset =
            isnan(scenario->height_offset) ? ahead : scenario->height_offset;
    } else if (pair->lane == model->perturbed)
        pair->side[CZ_SIDE_B].offset = scenario->perturbation;
}

/* ---- couplers ---- */

static CzStatus fill_tubes(const CzMeeting *pair, int which, double *compliance) {
    const CzSide *side = &pair->side[which];
    const CzCoupler *coupler = has_coupler(side) ? &side->end->coupler : NULL;
    const CzTube *first = coupler == NULL ? NULL : &coupler->tube;
    const CzTube *second = coupler == NULL ? NULL : &coupler->second_tube;
    CZ_TRY(cz_fill_tube(pair->fill, part_name(pair, which, "coupler tube"), first, 1,
                        CZ_CURVE(tube[which])));
    CZ_TRY(cz_fill_tube(pair->fill, part_name(pair, which, "second coupler tube"), second, 1,
                        CZ_CURVE(second_tube[which])));
    if (first != NULL && first->given) {
        put(pair, CZ_PARAMETER(coupler.side[which].tube_rate), first->rate_factor);
        *compliance += 1.0 / (first->stiffness * first->count);
    }
    if (second != NULL && second->given) {
        put(pair, CZ_PARAMETER(coupler.side[which].second_tube_rate), second->rate_factor);
        *compliance += 1.0 / (second->stiffness * second->count);
    }
    return CZ_OK;
}

static void fill_coupler_pivot(const CzMeeting *pair, int which, double height) {
    const CzSide *side = &pair->side[which];
    const double length = strut_length(pair, which), behind = coupler_gap(side) + length;
    const bool on_end =
        side->is_full && has_coupler(side) && side->end->coupler.anchor == CZ_ANCHOR_END;
    const double carrier = on_end ? side->end->cg_height : side->vehicle->cg_height;
    const double arm = side->plane - behind - (on_end ? side->end->distance : 0.0);
    put(pair, CZ_PARAMETER(coupler.side[which].on_end), on_end);
    put(pair,
        which == CZ_SIDE_A ? CZ_PARAMETER(coupler.pivot.x[0]) : CZ_PARAMETER(coupler.pivot.x[1]),
        side->sign * (side->is_full ? arm : 0.0));
    put(pair,
        which == CZ_SIDE_A ? CZ_PARAMETER(coupler.pivot.z[0]) : CZ_PARAMETER(coupler.pivot.z[1]),
        side->is_full ? height - carrier : 0.0);
    if (length > 0.0)
        put(pair, CZ_PARAMETER(coupler.side[which].strut_length), length);
}

static void fill_shear_off(const CzMeeting *pair, int which, const CzShearOff *shear_off) {
    put(pair, CZ_PARAMETER(coupler.side[which].shear.force), shear_off->force);
    put(pair, CZ_PARAMETER(coupler.side[which].shear.residual), shear_off->residual_force);
    put(pair, CZ_PARAMETER(coupler.side[which].shear.softening), shear_off->softening_length);
    put(pair, CZ_PARAMETER(coupler.side[which].shear.space),
        shear_off->softening_length + shear_off->retraction_space);
    put(pair, CZ_PARAMETER(coupler.side[which].shear.bottom), shear_off->bottom_stiffness);
}

static CzStatus fill_coupler_side(const CzMeeting *pair, int which) {
    const CzSide *side = &pair->side[which];
    const CzCurveId curve = CZ_CURVE(buffer[which]);
    const CzPartName name = part_name(pair, which, "coupler buffer");
    if (!has_coupler(side))
        return cz_fill_buffer(pair->fill, name, NULL, 1, curve);

    const CzCoupler *coupler = &side->end->coupler;
    const CzBuffer *buffer = &coupler->buffer;
    CZ_TRY(cz_fill_buffer(pair->fill, name, buffer, 1, curve));
    put(pair, CZ_PARAMETER(coupler.side[which].buffer.transition), buffer->transition_stiffness);
    put(pair, CZ_PARAMETER(coupler.side[which].buffer.share), buffer->unloading_share);
    put(pair, CZ_PARAMETER(coupler.side[which].buffer.damping), buffer->damping);
    put(pair, CZ_PARAMETER(coupler.side[which].buffer.quadratic), buffer->quadratic_damping);
    put(pair, CZ_PARAMETER(coupler.side[which].buffer.draw_stiffness), buffer->draw_stiffness);
    put(pair, CZ_PARAMETER(coupler.side[which].buffer.draw_slack), buffer->draw_slack);
    if (coupler->shear_off.given)
        fill_shear_off(pair, which, &coupler->shear_off);
    if (coupler->hinge.given) {
        const CzHinge *hinge = &coupler->hinge;
        put(pair, CZ_PARAMETER(coupler.side[which].hinge_vertical.stiffness), hinge->stiffness);
        put(pair, CZ_PARAMETER(coupler.side[which].hinge_vertical.moment), hinge->moment_capacity);
        put(pair, CZ_PARAMETER(coupler.side[which].hinge_vertical.stop), hinge->swing_stop);
        put(pair, CZ_PARAMETER(coupler.side[which].hinge_vertical.stop_stiffness),
            hinge->stop_stiffness);
    }
    return CZ_OK;
}

static CzStatus fill_couplers(const CzMeeting *pair) {
    const CzSide *a = &pair->side[CZ_SIDE_A], *b = &pair->side[CZ_SIDE_B];
    if (!pair->has_couplers)
        return CZ_OK;
    const CzHeights heights = heights_of(pair, coupler_height);
    const double rise = pair->tilts ? heights.rise : 0.0;
    const double length = strut_length(pair, CZ_SIDE_A) + strut_length(pair, CZ_SIDE_B);
    double compliance = 0.0;
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        fill_coupler_pivot(pair, which, heights.side[which]);
        CZ_TRY(fill_coupler_side(pair, which));
        CZ_TRY(fill_tubes(pair, which, &compliance));
    }
    const bool is_inner = pair->lane != pair->fill->model->colliding;
    put(pair, CZ_PARAMETER(coupler.exists), 1.0);
    put(pair, CZ_PARAMETER(coupler.coupled), is_inner && has_coupler(a) && has_coupler(b));
    put(pair, CZ_PARAMETER(coupler.pivot.distance),
        pair->distance + coupler_gap(a) + coupler_gap(b) + length);
    put(pair, CZ_PARAMETER(coupler.pivot.rise), rise);
    put(pair, CZ_PARAMETER(coupler.length), sqrt(length * length + rise * rise));
    put(pair, CZ_PARAMETER(coupler.along), length);
    put(pair, CZ_PARAMETER(coupler.compliance), compliance);
    pair->fill->lanes->has_couplers = 1;
    return CZ_OK;
}

/* ---- anti-climbers and crush zones without end mass ---- */

static CzStatus fill_massless_end(const CzMeeting *pair, int which) {
    const CzSide *side = &pair->side[which];
    const CzEnd *end = side->end;
    if (side->is_full || !cz_end_crushes(end))
        return CZ_OK;
    CZ_TRY(cz_fill_end(pair->fill, part_name(pair, which, "end"), end, CZ_CURVE(massless[which])));
    put(pair, CZ_PARAMETER(face.side[which].has_massless), 1.0);
    put(pair, CZ_PARAMETER(face.side[which].massless.unloading), end->unloading_stiffness);
    put(pair, CZ_PARAMETER(face.side[which].massless.share), end->unloading_share);
    put(pair, CZ_PARAMETER(face.side[which].massless.damping), end->damping);
    put(pair, CZ_PARAMETER(face.side[which].massless.second_unloading), cz_second_unloading(end));
    return CZ_OK;
}

static CzStatus fill_face_side(const CzMeeting *pair, int which, double height,
                               double *compliance) {
    const CzSide *side = &pair->side[which];
    const double carrier = side->is_full ? side->end->distance : 0.0;
    const double arm = side->plane - face_gap(side) - carrier;
    put(pair,
        which == CZ_SIDE_A ? CZ_PARAMETER(face.contact.x[0]) : CZ_PARAMETER(face.contact.x[1]),
        side->sign * arm);
    put(pair,
        which == CZ_SIDE_A ? CZ_PARAMETER(face.contact.z[0]) : CZ_PARAMETER(face.contact.z[1]),
        side->is_full ? height - side->end->cg_height : 0.0);
    const CzAntiClimber *anti_climber = has_anti_climber(side) ? &side->end->anti_climber : NULL;
    CZ_TRY(cz_fill_anti_climber(pair->fill, part_name(pair, which, "anti-climber"), anti_climber,
                                CZ_CURVE(face[which])));
    CZ_TRY(fill_massless_end(pair, which));
    if (anti_climber == NULL)
        return CZ_OK;
    put(pair, CZ_PARAMETER(face.side[which].rate), anti_climber->rate_factor);
    put(pair, CZ_PARAMETER(face.side[which].speed_factor),
        anti_climber->speed_factor / anti_climber->speed_reference);
    *compliance += 1.0 / (anti_climber->stiffness * anti_climber->count);
    return CZ_OK;
}

/* What keeps two anti-climbers from sliding over each other. */
static void fill_ribs(const CzMeeting *pair) {
    const CzAntiClimber *a = &pair->side[CZ_SIDE_A].end->anti_climber;
    const CzAntiClimber *b = &pair->side[CZ_SIDE_B].end->anti_climber;
    const double capacity_a = a->rib_count * a->count * value_or_zero(a->rib_strength);
    const double capacity_b = b->rib_count * b->count * value_or_zero(b->rib_strength);
    const double capacity = fmin(capacity_a, capacity_b);
    put(pair, CZ_PARAMETER(face.friction),
        fmin(value_or_zero(a->friction), value_or_zero(b->friction)));
    put(pair, CZ_PARAMETER(face.stiffness_vertical),
        in_series(a->vertical_stiffness, b->vertical_stiffness));
    put(pair, CZ_PARAMETER(face.rib_capacity), capacity);
    if (capacity > 0.0)
        put(pair, CZ_PARAMETER(face.rib_depth), fmax(a->rib_depth, b->rib_depth));
    if (!pair->side[CZ_SIDE_A].is_full || !pair->side[CZ_SIDE_B].is_full)
        return;
    /* The faces released over one pitch as their overlap runs out, whatever their ribs carry. */
    put(pair, CZ_PARAMETER(face.rib_pitch),
        fmax(a->face_height / a->rib_count, b->face_height / b->rib_count));
    put(pair, CZ_PARAMETER(face.overlap), (a->face_height + b->face_height) / 2.0);
}

static CzStatus fill_faces(const CzMeeting *pair) {
    const CzSide *a = &pair->side[CZ_SIDE_A], *b = &pair->side[CZ_SIDE_B];
    const CzHeights heights = heights_of(pair, face_height);
    double compliance = 0.0;
    CZ_TRY(fill_face_side(pair, CZ_SIDE_A, heights.side[CZ_SIDE_A], &compliance));
    CZ_TRY(fill_face_side(pair, CZ_SIDE_B, heights.side[CZ_SIDE_B], &compliance));
    const bool a_is_massless = !a->is_full && cz_end_crushes(a->end);
    const bool b_is_massless = !b->is_full && cz_end_crushes(b->end);
    if (compliance == 0.0)
        compliance = a_is_massless || b_is_massless ? SMALLEST_COMPLIANCE : BARE_COMPLIANCE;
    put(pair, CZ_PARAMETER(face.contact.distance), pair->distance + face_gap(a) + face_gap(b));
    put(pair, CZ_PARAMETER(face.contact.rise), heights.rise);
    put(pair, CZ_PARAMETER(face.compliance), compliance);

    const bool a_has = has_anti_climber(a), b_has = has_anti_climber(b);
    const double damping_a =
        a_has ? a->end->anti_climber.damping * a->end->anti_climber.count : 0.0;
    const double damping_b =
        b_has ? b->end->anti_climber.damping * b->end->anti_climber.count : 0.0;
    put(pair, CZ_PARAMETER(face.damping),
        a_has && b_has ? in_series(damping_a, damping_b) : damping_a + damping_b);
    if (a_has && b_has)
        fill_ribs(pair);
    return CZ_OK;
}

CzStatus cz_fill_interface(const CzFill *fill, int interface, const CzStatics *behind,
                           const CzStatics *ahead) {
    CzMeeting pair = {.fill = fill,
                      .lane = interface,
                      .side = {make_side(fill, interface, CZ_FRONT, behind),
                               make_side(fill, interface + 1, CZ_REAR, ahead)}};
    const CzSide *a = &pair.side[CZ_SIDE_A], *b = &pair.side[CZ_SIDE_B];
    pair.tilts = (a->is_full || b->is_full) && !a->is_fixed && !b->is_fixed;
    put(&pair, CZ_PARAMETER(tilts), pair.tilts);
    pair.has_couplers = pairs(pair.side, has_coupler);
    cz_contacts_find(&pair);
    set_offsets(&pair);
    CZ_TRY(place_cars(&pair));
    CZ_TRY(fill_couplers(&pair));
    CZ_TRY(fill_faces(&pair));
    return cz_fill_contacts(&pair);
}
