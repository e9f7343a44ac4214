/* Parameters of one interface: places of the two ends at t = 0, and their parts.
 *
 *   distance of a pair of parts = distance of the foremost planes + gap_A + gap_B
 *
 * Inner interfaces: coupled couplers touch face to face; without them the foremost planes touch.
 * Colliding interface: the nearest pair of parts touches. A part without a counterpart strikes the
 * bare end structure of the other end, at its own height (problem/meeting.h): that side of its
 * element is rigid, and on the end mass where there is one.
 */
#include "model/fill.h"

#include "base/error.h"
#include "problem/meeting.h"

#define BARE_COMPLIANCE 1e-9      /* of two ends without anti-climbers [m/N] (ours) */
#define SMALLEST_COMPLIANCE 1e-14 /* where a crush zone in series deflects instead [m/N] (ours) */
#define OVERLAP_TOLERANCE 1e-9    /* of rounding [m] */
#define BARE_STIFFNESS                                                                             \
    2e7 /* vertical, of bare ends that stick: that of anti-climbers [N/m] (ours) */

/* Kinds of parts by which two ends meet; draw gears carry tension only and never touch. */
typedef enum Kind {
    COUPLER = CZ_PART_COUPLER,
    FACE = CZ_PART_FACE,
    SIDE_BUFFERS = CZ_PART_SIDE_BUFFERS,
    SUPERSTRUCTURE = CZ_N_PART,
    DRAW_GEAR,
    N_KIND
} Kind;
enum { N_TOUCHING = DRAW_GEAR };

/* A part of an end. */
typedef struct Part {
    bool is_there;
    double gap;    /* behind the foremost plane [m] */
    double height; /* above rail [m]; NaN: as the other side's */
} Part; /* without a part of its kind: the bare end structure, which the other side's strikes */

/* One side of the interface. */
typedef struct Side {
    int car;
    int which; /* end of that car */
    bool is_full, is_fixed;
    const CzVehicle *vehicle;
    const CzEnd *end;
    Part part[N_KIND]; /* the face is an anti-climber's where there is one, else the bare end's */
    double plane;      /* foremost plane from the body's centre of gravity, outwards [m] */
    double sign;       /* direction of outwards along x */
    double offset;     /* height offset of the car [m] */
} Side;

typedef struct Pair {
    const CzFill *fill;
    int lane;           /* car in whose lane the parameters are */
    CzParameters *rows; /* of its block */
    size_t i;           /* its place there */
    Side side[2];
    bool has[N_KIND];
    bool tilts;      /* one car can move vertically, and the other one is not fixed */
    double distance; /* of the foremost planes at t = 0 [m] */
} Pair;

static CzPartName part_name(const Pair *pair, int side, const char *what) {
    return (CzPartName){pair->side[side].car, pair->side[side].which, pair->lane, what};
}

/* The bare end structure where there is no part of a kind. */
static Part bare_part(const CzEnd *end) {
    return end->given ? (Part){false, end->face_gap, end->crush_height} : (Part){.height = NAN};
}

static void list_parts(Side *side) {
    const CzEnd *end = side->end;
    const double gap[] = {[COUPLER] = end->coupler.gap,
                          [FACE] = end->anti_climber.gap,
                          [SIDE_BUFFERS] = end->side_buffers.gap};
    const double height[] = {[COUPLER] = end->coupler.height,
                             [FACE] = end->anti_climber.height,
                             [SIDE_BUFFERS] = end->side_buffers.height};
    for (int kind = 0; kind < CZ_N_PART; kind++)
        side->part[kind] = cz_end_has(end, (CzPartKind)kind) ? (Part){true, gap[kind], height[kind]}
                                                             : bare_part(end);
    side->part[SUPERSTRUCTURE] = side->part[DRAW_GEAR] = (Part){.height = NAN};
    if (end->given && end->superstructure.given)
        side->part[SUPERSTRUCTURE] =
            (Part){side->is_full, end->superstructure.gap, end->superstructure.height};
    if (end->given && end->draw_gear.given)
        side->part[DRAW_GEAR] = (Part){true, 0.0, end->draw_gear.height};
}

static Side make_side(const CzFill *fill, int car, int which, const CzStatics *statics) {
    const CzVehicle *vehicle = cz_fill_vehicle(fill, car);
    const CzVehicleModel model = fill->model->car[car].model;
    Side side = {.car = car,
                 .which = which,
                 .is_full = model == CZ_MODEL_FULL,
                 .is_fixed = model == CZ_MODEL_FIXED,
                 .vehicle = vehicle,
                 .end = cz_end_of(vehicle, which),
                 .plane = statics->plane[which],
                 .sign = which == CZ_FRONT ? 1.0 : -1.0};
    list_parts(&side);
    return side;
}

static bool both_have(const Pair *pair, Kind kind) {
    return pair->side[CZ_SIDE_A].part[kind].is_there && pair->side[CZ_SIDE_B].part[kind].is_there;
}

/* Height of the other end over its own in its file, with the offsets of both; NaN where every force
 * acts along the track. */
static double rise_of_other(const Pair *pair, int which) {
    const Side *own = &pair->side[which], *other = &pair->side[1 - which];
    return pair->tilts ? other->offset - own->offset : NAN;
}

/* Whether the part of a side acts: on the part of its kind, or on the bare end opposite. */
static bool part_acts(const Pair *pair, int which, Kind kind) {
    const Side *own = &pair->side[which], *other = &pair->side[1 - which];
    return own->part[kind].is_there &&
           (other->part[kind].is_there ||
            cz_part_strikes(own->end, (CzPartKind)kind, other->end, rise_of_other(pair, which)));
}

/* Finds which kinds of parts act. Bare ends meet always, also behind an anti-climber that passes
 * the other end. */
static void find_pairs(Pair *pair) {
    for (int kind = 0; kind < CZ_N_PART; kind++)
        pair->has[kind] =
            part_acts(pair, CZ_SIDE_A, (Kind)kind) || part_acts(pair, CZ_SIDE_B, (Kind)kind);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++)
        if (!pair->has[FACE])
            pair->side[which].part[FACE] = bare_part(pair->side[which].end);
    pair->has[FACE] = true;
    pair->has[SUPERSTRUCTURE] = both_have(pair, SUPERSTRUCTURE);
    pair->has[DRAW_GEAR] = pair->lane != pair->fill->model->colliding && both_have(pair, DRAW_GEAR);
}

static double gaps_of(const Pair *pair, Kind kind) {
    return pair->side[CZ_SIDE_A].part[kind].gap + pair->side[CZ_SIDE_B].part[kind].gap;
}

/* Distance of the parts of a kind along the track at t = 0 [m]. */
static double distance_of(const Pair *pair, Kind kind) {
    return pair->distance + pair->side[CZ_SIDE_A].part[kind].gap +
           pair->side[CZ_SIDE_B].part[kind].gap;
}

/* Heights of both sides as built, and the height of B's part over A's with the offsets. */
typedef struct Heights {
    double side[2]; /* above rail [m] */
    double rise;    /* [m] */
} Heights;

/* The side whose part strikes the bare end of the other one; -1: none. */
static int striker_of(const Pair *pair, Kind kind) {
    const bool of_a = pair->side[CZ_SIDE_A].part[kind].is_there;
    const bool of_b = pair->side[CZ_SIDE_B].part[kind].is_there;
    return !pair->tilts || of_a == of_b ? -1 : of_a ? CZ_SIDE_A : CZ_SIDE_B;
}

/* Height at which a part strikes the bare end of the other side, with the offsets: the middle of
 * the heights that they share [m]. */
static double struck_height(const Pair *pair, Kind kind, int striker) {
    const Side *own = &pair->side[striker], *other = &pair->side[1 - striker];
    const CzHeightRange part = cz_part_heights(own->end, (CzPartKind)kind);
    const CzHeightRange structure = cz_structure_heights(other->end);
    const double low = fmax(part.low + own->offset, structure.low + other->offset);
    const double high = fmin(part.high + own->offset, structure.high + other->offset);
    const double middle = (low + high) / 2.0; /* a height that is not given counts for none */
    return isnan(middle) ? other->part[kind].height + other->offset : middle;
}

static Heights heights_of(const Pair *pair, Kind kind) {
    const Side *a = &pair->side[CZ_SIDE_A], *b = &pair->side[CZ_SIDE_B];
    const int striker = (int)kind < CZ_N_PART ? striker_of(pair, kind) : -1;
    if (striker >= 0) {
        const double height = struck_height(pair, kind, striker);
        return (Heights){{height - a->offset, height - b->offset}, 0.0};
    }
    Heights heights = {.side = {a->part[kind].height, b->part[kind].height}};
    if (isnan(heights.side[0]))
        heights.side[0] = isnan(heights.side[1]) ? 0.0 : heights.side[1];
    if (isnan(heights.side[1]))
        heights.side[1] = heights.side[0];
    heights.rise = heights.side[1] + b->offset - heights.side[0] - a->offset;
    return heights;
}

/* Contact points of the parts of a kind: on the end masses, or on bodies without them. */
static void fill_contact(const Pair *pair, Kind kind, CzPairRows *contact) {
    const Heights heights = heights_of(pair, kind);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const Side *side = &pair->side[which];
        const double carrier = side->is_full ? side->end->distance : 0.0;
        contact->x[which][pair->i] = side->sign * (side->plane - side->part[kind].gap - carrier);
        contact->z[which][pair->i] =
            side->is_full ? heights.side[which] - side->end->cg_height : 0.0;
    }
    contact->distance[pair->i] = distance_of(pair, kind);
    contact->rise[pair->i] = heights.rise;
}

/* ---- places of the two cars ---- */

static CzStatus place_cars(Pair *pair) {
    const CzModel *model = pair->fill->model;
    double nearest = gaps_of(pair, FACE);
    for (int kind = 0; kind < N_TOUCHING; kind++)
        if (pair->has[kind])
            nearest = fmin(nearest, gaps_of(pair, (Kind)kind));
    if (pair->lane == model->colliding) {
        pair->distance = -nearest;
        return CZ_OK;
    }
    pair->distance = both_have(pair, COUPLER) ? -gaps_of(pair, COUPLER) : 0.0;
    if (pair->distance + nearest < -OVERLAP_TOLERANCE)
        return cz_fill_refuse(
            pair->fill, part_name(pair, CZ_SIDE_A, "coupler"),
            &pair->side[CZ_SIDE_A].end->coupler.gap,
            "other parts of interface %s overlap by %g mm when its couplers touch",
            model->interface_name[pair->lane], -(pair->distance + nearest) * 1e3);
    return CZ_OK;
}

static void set_offsets(Pair *pair) {
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

/* ---- devices of couplers and side buffers ---- */

/* A buffer of a side, `count` of them together; NULL: none. */
static CzStatus fill_buffer(const Pair *pair, CzPartName name, const CzBuffer *buffer, int count,
                            CzCurveId curve, CzBufferRows *rows) {
    CZ_TRY(cz_fill_buffer(pair->fill, name, buffer, count, curve));
    if (buffer == NULL)
        return CZ_OK;
    rows->transition[pair->i] = buffer->transition_stiffness * count;
    rows->share[pair->i] = buffer->unloading_share;
    rows->damping[pair->i] = buffer->damping * count;
    rows->quadratic[pair->i] = buffer->quadratic_damping * count;
    return CZ_OK;
}

/* Collapse tubes of a side likewise. */
static CzStatus fill_tube(const Pair *pair, CzPartName name, const CzTube *tube, int count,
                          CzCurveId curve, double *rate) {
    if (tube->given)
        rate[pair->i] = tube->rate_factor;
    return cz_fill_tube(pair->fill, name, tube, count, curve);
}

static double tube_compliance(const CzTube *tube, int count) {
    return tube->given ? 1.0 / (tube->stiffness * tube->count * count) : 0.0;
}

/* ---- couplers ---- */

/* Length from pivot to face of a coupler that is part of a strut; 0 where it acts along the track.
 */
static double strut_length(const Pair *pair, int which) {
    const Side *side = &pair->side[which];
    const bool has_pivot = side->is_full || (pair->tilts && !side->is_fixed);
    return side->part[COUPLER].is_there && has_pivot ? side->end->coupler.length : 0.0;
}

static void fill_pivot(const Pair *pair, int which, double height) {
    CzCouplerRows *rows = &pair->rows->coupler;
    const Side *side = &pair->side[which];
    const size_t i = pair->i;
    const double length = strut_length(pair, which), behind = side->part[COUPLER].gap + length;
    const bool on_end = side->is_full && (!side->part[COUPLER].is_there ||
                                          side->end->coupler.anchor == CZ_ANCHOR_END);
    const double carrier = on_end ? side->end->cg_height : side->vehicle->cg_height;
    const double arm = side->plane - behind - (on_end ? side->end->distance : 0.0);
    rows->side[which].on_end[i] = on_end;
    rows->pivot.x[which][i] = side->sign * (side->is_full ? arm : 0.0);
    rows->pivot.z[which][i] = side->is_full ? height - carrier : 0.0;
    if (length > 0.0)
        rows->side[which].strut_length[i] = length;
}

/* Heights of underframes are compared at the pivots of the couplers at rest, else at the bare end
 * structures. */
static void fill_underframes(const Pair *pair) {
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const Side *side = &pair->side[which];
        const double bare = side->end->given ? side->end->face_gap : 0.0;
        const double behind = side->part[COUPLER].is_there
                                  ? side->part[COUPLER].gap + strut_length(pair, which)
                                  : bare;
        pair->rows->underframe_x[which][pair->i] =
            side->is_full ? side->sign * (side->plane - behind) : 0.0;
    }
}

static void fill_overload_devices(const Pair *pair, int which, const CzCoupler *coupler) {
    CzShearOffRows *shear = &pair->rows->coupler.side[which].shear;
    CzHingeRows *turns = &pair->rows->coupler.side[which].hinge_vertical;
    const CzShearOff *shear_off = &coupler->shear_off;
    const CzHinge *hinge = &coupler->hinge;
    const size_t i = pair->i;
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

static CzStatus fill_coupler_side(const Pair *pair, int which, double *compliance) {
    const Side *side = &pair->side[which];
    const CzCoupler none = {.given = false};
    const CzCoupler *coupler = side->part[COUPLER].is_there ? &side->end->coupler : &none;
    const CzBuffer *given = coupler->given ? &coupler->buffer : NULL;
    CzCouplerRows *rows = &pair->rows->coupler;
    CzBufferRows *buffer = &rows->side[which].buffer;
    CZ_TRY(fill_buffer(pair, part_name(pair, which, "coupler buffer"), given, 1,
                       CZ_CURVE(buffer[which]), buffer));
    if (given != NULL) {
        buffer->draw_stiffness[pair->i] = given->draw_stiffness;
        buffer->draw_slack[pair->i] = given->draw_slack;
        fill_overload_devices(pair, which, coupler);
    }
    *compliance += tube_compliance(&coupler->tube, 1);
    *compliance += tube_compliance(&coupler->second_tube, 1);
    CZ_TRY(fill_tube(pair, part_name(pair, which, "coupler tube"), &coupler->tube, 1,
                     CZ_CURVE(tube[which]), rows->side[which].tube_rate));
    return fill_tube(pair, part_name(pair, which, "second coupler tube"), &coupler->second_tube, 1,
                     CZ_CURVE(second_tube[which]), rows->side[which].second_tube_rate);
}

static CzStatus fill_couplers(const Pair *pair) {
    CzCouplerRows *rows = &pair->rows->coupler;
    const size_t i = pair->i;
    if (!pair->has[COUPLER])
        return CZ_OK;
    const Heights heights = heights_of(pair, COUPLER);
    const double rise = pair->tilts ? heights.rise : 0.0;
    const double length = strut_length(pair, CZ_SIDE_A) + strut_length(pair, CZ_SIDE_B);
    double compliance = 0.0;
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        fill_pivot(pair, which, heights.side[which]);
        CZ_TRY(fill_coupler_side(pair, which, &compliance));
    }
    rows->exists[i] = 1.0;
    rows->coupled[i] = pair->lane != pair->fill->model->colliding && both_have(pair, COUPLER);
    rows->pivot.distance[i] = distance_of(pair, COUPLER) + length;
    rows->pivot.rise[i] = rise;
    rows->length[i] = sqrt(length * length + rise * rise);
    rows->along[i] = length;
    rows->compliance[i] = compliance;
    pair->fill->lanes->has.couplers = 1;
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

static bool is_massless(const Side *side) {
    return !side->is_full && cz_end_crushes(side->end);
}

static CzStatus fill_face_side(const Pair *pair, int which, double *compliance) {
    const Side *side = &pair->side[which];
    const CzEnd *end = side->end;
    const CzAntiClimber *device = side->part[FACE].is_there ? &end->anti_climber : NULL;
    CzFaceRows *rows = &pair->rows->face;
    CZ_TRY(cz_fill_anti_climber(pair->fill, part_name(pair, which, "anti-climber"), device,
                                CZ_CURVE(face[which])));
    if (is_massless(side)) {
        CZ_TRY(
            cz_fill_end(pair->fill, part_name(pair, which, "end"), end, CZ_CURVE(massless[which])));
        rows->side[which].has_massless[pair->i] = 1.0;
        cz_fill_crush(&rows->side[which].massless, pair->i, end);
    }
    if (device != NULL) {
        rows->side[which].rate[pair->i] = device->rate_factor;
        rows->side[which].speed_factor[pair->i] = device->speed_factor / device->speed_reference;
        *compliance += 1.0 / (device->stiffness * device->count);
    }
    return CZ_OK;
}

/* Ribs and friction of two anti-climbers. */
static void fill_ribs(const Pair *pair) {
    CzFaceRows *rows = &pair->rows->face;
    const size_t i = pair->i;
    const CzAntiClimber *a = &pair->side[CZ_SIDE_A].end->anti_climber;
    const CzAntiClimber *b = &pair->side[CZ_SIDE_B].end->anti_climber;
    const double capacity = fmin(a->rib_count * a->count * value_or_zero(a->rib_strength),
                                 b->rib_count * b->count * value_or_zero(b->rib_strength));
    rows->friction[i] = fmin(value_or_zero(a->friction), value_or_zero(b->friction));
    rows->stiffness_vertical[i] = in_series(a->vertical_stiffness, b->vertical_stiffness);
    rows->rib_capacity[i] = capacity;
    if (capacity > 0.0)
        rows->rib_depth[i] = fmax(a->rib_depth, b->rib_depth);
    if (!pair->side[CZ_SIDE_A].is_full || !pair->side[CZ_SIDE_B].is_full)
        return;
    /* The faces lose contact over one rib pitch of remaining overlap, whatever the ribs carry. */
    rows->rib_pitch[i] = fmax(a->face_height / a->rib_count, b->face_height / b->rib_count);
    rows->overlap[i] = (a->face_height + b->face_height) / 2.0;
}

/* The smaller of the coefficients that are given; 0 for none. */
static double friction_of(const Pair *pair, const double friction[2]) {
    return pair->tilts ? value_or_zero(fmin(friction[0], friction[1])) : 0.0;
}

/* Friction of an anti-climber on a bare end, or of two bare ends, and the overlap of the first. */
static void fill_rub(const Pair *pair) {
    CzFaceRows *rows = &pair->rows->face;
    const size_t i = pair->i;
    const int striker = striker_of(pair, FACE);
    double friction[2], centre[2];
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const Side *side = &pair->side[which];
        friction[which] = which == striker   ? side->end->anti_climber.friction
                          : side->end->given ? side->end->face_friction
                                             : NAN;
        centre[which] = side->part[FACE].height + side->offset;
    }
    rows->friction[i] = friction_of(pair, friction);
    if (rows->friction[i] > 0.0)
        rows->stiffness_vertical[i] = striker >= 0
                                          ? pair->side[striker].end->anti_climber.vertical_stiffness
                                          : BARE_STIFFNESS;
    if (striker < 0)
        return;
    const CzAntiClimber *device = &pair->side[striker].end->anti_climber;
    const CzHeightRange structure = cz_structure_heights(pair->side[1 - striker].end);
    const double overlap = (device->face_height + structure.high - structure.low) / 2.0;
    if (isnan(overlap))
        return;
    rows->overlap[i] = overlap;
    rows->eccentricity[i] = centre[CZ_SIDE_A] - centre[CZ_SIDE_B];
    rows->rib_pitch[i] = device->face_height / fmax(device->rib_count, 1.0);
}

static CzStatus fill_faces(const Pair *pair) {
    CzFaceRows *rows = &pair->rows->face;
    const Side *side = pair->side;
    double compliance = 0.0, damping[2] = {0.0, 0.0};
    fill_contact(pair, FACE, &rows->contact);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        CZ_TRY(fill_face_side(pair, which, &compliance));
        if (side[which].part[FACE].is_there)
            damping[which] =
                side[which].end->anti_climber.damping * side[which].end->anti_climber.count;
    }
    const bool has_massless = is_massless(&side[CZ_SIDE_A]) || is_massless(&side[CZ_SIDE_B]);
    if (compliance == 0.0)
        compliance = has_massless ? SMALLEST_COMPLIANCE : BARE_COMPLIANCE;
    rows->compliance[pair->i] = compliance;
    rows->damping[pair->i] =
        both_have(pair, FACE) ? in_series(damping[0], damping[1]) : damping[0] + damping[1];
    if (both_have(pair, FACE))
        fill_ribs(pair);
    else
        fill_rub(pair);
    return CZ_OK;
}

/* ---- side buffers ---- */

/* Friction of two plates, or of one on a bare end. */
static double plate_friction(const Pair *pair) {
    double friction[2];
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const CzEnd *end = pair->side[which].end;
        const bool has_plates = pair->side[which].part[SIDE_BUFFERS].is_there;
        friction[which] = has_plates   ? end->side_buffers.friction
                          : end->given ? end->face_friction
                                       : NAN;
    }
    if (both_have(pair, SIDE_BUFFERS))
        return fmin(value_or_zero(friction[0]), value_or_zero(friction[1]));
    return friction_of(pair, friction);
}

static CzStatus fill_side_buffers(const Pair *pair) {
    CzSideBufferRows *rows = &pair->rows->side_buffers;
    double compliance = 0.0;
    if (!pair->has[SIDE_BUFFERS])
        return CZ_OK;
    fill_contact(pair, SIDE_BUFFERS, &rows->contact);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const Side *side = &pair->side[which];
        const CzSideBuffers none = {.count = 1};
        const CzSideBuffers *set =
            side->part[SIDE_BUFFERS].is_there ? &side->end->side_buffers : &none;
        CZ_TRY(fill_buffer(pair, part_name(pair, which, "side buffer"),
                           set->given ? &set->buffer : NULL, set->count,
                           CZ_CURVE(side_buffer[which]), &rows->side[which].buffer));
        CZ_TRY(fill_tube(pair, part_name(pair, which, "side buffer tube"), &set->tube, set->count,
                         CZ_CURVE(side_tube[which]), rows->side[which].tube_rate));
        compliance += tube_compliance(&set->tube, set->count);
    }
    rows->exists[pair->i] = 1.0;
    rows->compliance[pair->i] = compliance;
    rows->friction[pair->i] = plate_friction(pair);
    pair->fill->lanes->has.side_buffers = 1;
    return CZ_OK;
}

/* ---- superstructures ---- */

static void fill_superstructures(const Pair *pair) {
    CzSuperstructureRows *rows = &pair->rows->superstructure;
    const CzSuperstructure *a = &pair->side[CZ_SIDE_A].end->superstructure;
    const CzSuperstructure *b = &pair->side[CZ_SIDE_B].end->superstructure;
    if (!pair->has[SUPERSTRUCTURE])
        return;
    fill_contact(pair, SUPERSTRUCTURE, &rows->contact);
    rows->stiffness[pair->i] = in_series(a->stiffness, b->stiffness);
    rows->strength[pair->i] = fmin(a->strength, b->strength);
    pair->fill->lanes->has.superstructures = 1;
}

/* ---- draw gears ---- */

/* The hooks meet midway between the foremost planes, without force at t = 0. */
static void fill_draw_gears(const Pair *pair) {
    CzDrawGearRows *rows = &pair->rows->draw_gear;
    const CzDrawGear *a = &pair->side[CZ_SIDE_A].end->draw_gear;
    const CzDrawGear *b = &pair->side[CZ_SIDE_B].end->draw_gear;
    const size_t i = pair->i;
    if (!pair->has[DRAW_GEAR])
        return;
    const Heights heights = heights_of(pair, DRAW_GEAR);
    for (int which = CZ_SIDE_A; which <= CZ_SIDE_B; which++) {
        const Side *side = &pair->side[which];
        rows->contact.x[which][i] = side->sign * (side->plane + 0.5 * pair->distance);
        rows->contact.z[which][i] =
            side->is_full ? heights.side[which] - side->vehicle->cg_height : 0.0;
    }
    rows->contact.rise[i] = heights.rise;
    rows->stiffness[i] = in_series(a->stiffness, b->stiffness);
    rows->slack[i] = a->slack + b->slack;
    pair->fill->lanes->has.draw_gears = 1;
}

CzStatus cz_fill_interface(const CzFill *fill, int interface, const CzStatics *behind,
                           const CzStatics *ahead) {
    const size_t lane = cz_fill_lane(fill, interface);
    Pair pair = {.fill = fill,
                 .lane = interface,
                 .rows = &cz_lane_block(fill->lanes, lane)->parameter,
                 .i = lane % CZ_LANE_BLOCK,
                 .side = {make_side(fill, interface, CZ_FRONT, behind),
                          make_side(fill, interface + 1, CZ_REAR, ahead)}};
    const Side *a = &pair.side[CZ_SIDE_A], *b = &pair.side[CZ_SIDE_B];
    pair.tilts = (a->is_full || b->is_full) && !a->is_fixed && !b->is_fixed;
    pair.rows->tilts[pair.i] = pair.tilts;
    set_offsets(&pair);
    find_pairs(&pair);
    CZ_TRY(place_cars(&pair));
    fill_underframes(&pair);
    CZ_TRY(fill_couplers(&pair));
    CZ_TRY(fill_faces(&pair));
    fill_superstructures(&pair);
    fill_draw_gears(&pair);
    return fill_side_buffers(&pair);
}
