/* Elastic energy that the elements could still give back. */
#include "dynamics/stored.h"

#include <math.h>

#include "laws/slider.h"
#include "laws/suspension.h"
#include "laws/vehicle_end.h"

#define SMALL_STROKE 1e-7 /* of a buffer, within its first stage [m] */

static double parameter(const CzDynamics *dynamics, int row, size_t lane) {
    return cz_row(dynamics->lanes->parameter, dynamics->lanes->stride, row)[lane];
}

static double memory(const CzDynamics *dynamics, int row, size_t lane) {
    return cz_block_of(dynamics, lane)->memory[row][lane % CZ_LANE_BLOCK];
}

static double scratch(const CzDynamics *dynamics, int row, size_t lane) {
    return cz_block_of(dynamics, lane)->scratch[row][lane % CZ_LANE_BLOCK];
}

double cz_curve_value(const CzCurveLanes *curve, size_t stride, size_t lane, double x) {
    double value = curve->start[lane];
    for (int kink = 0; kink < curve->n_kink; ++kink)
        value += cz_row(curve->slope_change, stride, kink)[lane] *
                 cz_larger(x - cz_row(curve->at, stride, kink)[lane], 0.0);
    return value;
}

double cz_curve_integral(const CzCurveLanes *curve, size_t stride, size_t lane, double x) {
    double integral = curve->start[lane] * x;
    for (int kink = 0; kink < curve->n_kink; ++kink) {
        const double beyond = cz_larger(x - cz_row(curve->at, stride, kink)[lane], 0.0);
        integral += 0.5 * cz_row(curve->slope_change, stride, kink)[lane] * beyond * beyond;
    }
    return integral;
}

/* A buffer of one side of a chain. */
typedef struct BufferPlace {
    int curve, stroke, offset;                         /* CzCurveId and CzMemory of side A */
    int transition, share, draw_stiffness, draw_slack; /* CzParameter of side A; draw -1: none */
} BufferPlace;

static const BufferPlace coupler_buffer = {CZ_CURVE_BUFFER_A,       CZ_M_BUFFER_A,
                                           CZ_M_BUFFER_OFFSET_A,    CZ_P_BUFFER_TRANSITION_A,
                                           CZ_P_BUFFER_SHARE_A,     CZ_P_BUFFER_DRAW_STIFFNESS_A,
                                           CZ_P_BUFFER_DRAW_SLACK_A};
static const BufferPlace side_buffer = {CZ_CURVE_SIDE_BUFFER_A,
                                        CZ_M_SIDE_BUFFER_A,
                                        CZ_M_SIDE_OFFSET_A,
                                        CZ_P_SIDE_TRANSITION_A,
                                        CZ_P_SIDE_SHARE_A,
                                        -1,
                                        -1};

/* Area under the unloading path of a buffer: down the transition to the lower curve, along it to
 * zero, and its stop; or of its draw spring. The lower curve rises nowhere faster than the
 * transition, so the triangle above it is at least h^2 / 2 k_t. */
static double buffer_stored(const CzDynamics *dynamics, size_t lane, const BufferPlace *place,
                            int side) {
    const double stroke = memory(dynamics, place->stroke + side, lane);
    if (stroke < 0.0) {
        if (place->draw_stiffness < 0)
            return 0.0;
        const double slack = parameter(dynamics, place->draw_slack + side, lane);
        const double drawn = cz_larger(-stroke - slack, 0.0);
        return 0.5 * parameter(dynamics, place->draw_stiffness + side, lane) * drawn * drawn;
    }
    const CzCurveLanes *curve = &dynamics->lanes->curve[place->curve + side];
    const size_t stride = dynamics->lanes->stride;
    const double share = parameter(dynamics, place->share + side, lane);
    const double transition = cz_larger(parameter(dynamics, place->transition + side, lane), 1.0);
    const double usable = curve->usable[lane], inside = cz_smaller(stroke, usable);
    const double beyond = stroke - inside;
    const double upper_curve = beyond > 0.0 ? cz_curve_value(curve, stride, lane, usable)
                                            : cz_curve_value(curve, stride, lane, stroke);
    const double line = transition * stroke;
    const double upper = cz_smaller(upper_curve, line);
    const double lower = cz_smaller(share * upper_curve, line);
    const double force = cz_clamp(
        transition * (stroke - memory(dynamics, place->offset + side, lane)), lower, upper);
    const double over = force - lower;
    /* Close to zero the lower curve is the transition itself: less the triangle above that. */
    const double first = share * cz_curve_value(curve, stride, lane, 0.0);
    const double rise =
        (share * cz_curve_value(curve, stride, lane, SMALL_STROKE) - first) / SMALL_STROKE;
    const double triangle = 0.5 * first * first / cz_larger(transition - rise, 1.0);
    const double along = share * cz_curve_integral(curve, stride, lane, inside) - triangle;
    const double below =
        share * upper_curve > line ? 0.5 * line * stroke : along + share * upper_curve * beyond;
    const double stop =
        beyond > 0.0 ? 0.5 * beyond * (cz_curve_value(curve, stride, lane, stroke) - upper_curve)
                     : 0.0;
    return below + 0.5 * over * over / transition + stop;
}

double cz_coupler_stored(const CzDynamics *dynamics, size_t lane, int side) {
    if (parameter(dynamics, CZ_P_COUPLER, lane) < 0.5)
        return 0.0;
    return buffer_stored(dynamics, lane, &coupler_buffer, side);
}

double cz_side_stored(const CzDynamics *dynamics, size_t lane, int side) {
    if (parameter(dynamics, CZ_P_SIDE_BUFFERS, lane) < 0.5)
        return 0.0;
    return buffer_stored(dynamics, lane, &side_buffer, side);
}

static double squared(double force, double stiffness) {
    return stiffness > 0.0 ? 0.5 * force * force / stiffness : 0.0;
}

double cz_hinge_stored(const CzDynamics *dynamics, size_t lane, int side) {
    const double engaged = scratch(dynamics, CZ_S_ENGAGED, lane);
    if (parameter(dynamics, CZ_P_COUPLER, lane) < 0.5 || !(engaged > 0.0))
        return 0.0;
    const double swing = scratch(dynamics, CZ_S_SWING_A + side, lane) / engaged;
    const double stiffness = parameter(dynamics, CZ_P_HINGE_STIFFNESS_A + side, lane);
    const double capacity = parameter(dynamics, CZ_P_HINGE_MOMENT_A + side, lane);
    const double moment = cz_clamp(
        stiffness * (swing - memory(dynamics, CZ_M_HINGE_A + side, lane)), -capacity, capacity);
    const double stop = parameter(dynamics, CZ_P_SWING_STIFFNESS_A + side, lane);
    const double range = parameter(dynamics, CZ_P_SWING_STOP_A + side, lane);
    return engaged * (squared(moment, stiffness) + squared(cz_stop(stop, range, swing), stop));
}

double cz_face_stored(const CzDynamics *dynamics, size_t lane) {
    const double held = 1.0 - memory(dynamics, CZ_M_FACE_LOST, lane);
    const double force = memory(dynamics, CZ_M_FACE_FORCE, lane);
    return held * 0.5 * parameter(dynamics, CZ_P_FACE_COMPLIANCE, lane) * force * force;
}

double cz_face_sliding_stored(const CzDynamics *dynamics, size_t lane) {
    return squared(scratch(dynamics, CZ_S_FACE_DEMAND, lane),
                   parameter(dynamics, CZ_P_FACE_VERTICAL_STIFFNESS, lane));
}

double cz_side_sliding_stored(const CzDynamics *dynamics, size_t lane) {
    return squared(scratch(dynamics, CZ_S_SIDE_SLIDING, lane), CZ_PLATE_STIFFNESS);
}

double cz_secondary_stored(const CzDynamics *dynamics, size_t lane) {
    double stored = 0.0;
    for (int bogie = 0; bogie < 2; ++bogie) {
        const CzSuspensionLaw law = {
            .stiffness = parameter(dynamics, CZ_P_SECONDARY_STIFFNESS, lane),
            .preload = parameter(dynamics, CZ_P_SECONDARY_PRELOAD_REAR + bogie, lane),
            .bump_gap = parameter(dynamics, CZ_P_SECONDARY_BUMP_GAP, lane),
            .bump_stiffness = parameter(dynamics, CZ_P_SECONDARY_BUMP_STIFFNESS, lane),
            .lift_gap = parameter(dynamics, CZ_P_SECONDARY_LIFT_GAP, lane),
            .lift_stiffness = parameter(dynamics, CZ_P_SECONDARY_LIFT_STIFFNESS, lane)};
        stored += cz_suspension_stored(&law, scratch(dynamics, CZ_S_SECONDARY_REAR + bogie, lane));
    }
    return stored;
}

double cz_primary_stored(const CzDynamics *dynamics, size_t lane) {
    double stored = 0.0;
    for (int axle = 0; axle < 4; ++axle) {
        const CzSuspensionLaw law = {
            .stiffness = parameter(dynamics, CZ_P_PRIMARY_STIFFNESS, lane),
            .preload = parameter(dynamics, CZ_P_PRIMARY_PRELOAD_0 + axle, lane),
            .bump_gap = parameter(dynamics, CZ_P_PRIMARY_BUMP_GAP, lane),
            .bump_stiffness = parameter(dynamics, CZ_P_PRIMARY_BUMP_STIFFNESS, lane),
            .lift_gap = parameter(dynamics, CZ_P_PRIMARY_LIFT_GAP, lane),
            .lift_stiffness = parameter(dynamics, CZ_P_PRIMARY_LIFT_STIFFNESS, lane)};
        stored += cz_suspension_stored(&law, scratch(dynamics, CZ_S_PRIMARY_0 + axle, lane));
    }
    return stored;
}

double cz_link_stored(const CzDynamics *dynamics, size_t lane) {
    double stored = 0.0;
    for (int bogie = 0; bogie < 2; ++bogie) {
        const double stretch = scratch(dynamics, CZ_S_LINK_TRAVEL_REAR + bogie, lane);
        stored += 0.5 * parameter(dynamics, CZ_P_LINK_STIFFNESS, lane) * stretch * stretch;
    }
    return stored;
}

double cz_axle_guidance_stored(const CzDynamics *dynamics, size_t lane) {
    double stored = 0.0;
    for (int axle = 0; axle < 4; ++axle) {
        const double stretch = scratch(dynamics, CZ_S_AXLE_GUIDANCE_0 + axle, lane);
        stored += 0.5 * parameter(dynamics, CZ_P_AXLE_GUIDANCE_STIFFNESS, lane) * stretch * stretch;
    }
    return stored;
}

/* Integral of K d^1.5 - N_0 over the approach d, from that at rest on. */
double cz_wheels_stored(const CzDynamics *dynamics, size_t lane) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    const double hertz = parameter(dynamics, CZ_P_HERTZ, lane);
    double stored = 0.0;
    for (int axle = 0; axle < 4 && hertz > 0.0; ++axle) {
        const double rest = parameter(dynamics, CZ_P_INDENTATION_0 + axle, lane);
        const double approach = rest - block->position[CZ_DOF_WHEEL_Z_0 + 3 * axle][i];
        const double pressed = cz_larger(approach, 0.0);
        const double load = block->constant[CZ_C_STATIC_LOAD_0 + axle][i];
        stored += 0.4 * hertz * (pressed * pressed * sqrt(pressed) - rest * rest * sqrt(rest)) -
                  load * (approach - rest);
    }
    return stored;
}

double cz_guide_stored(const CzDynamics *dynamics, size_t lane, int end) {
    const double across = scratch(dynamics, CZ_S_END_ACROSS_REAR + end, lane);
    return 0.5 * parameter(dynamics, CZ_P_GUIDE_STIFFNESS_REAR + end, lane) * across * across;
}

double cz_fold_stored(const CzDynamics *dynamics, size_t lane, int end) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    const double angle = block->position[CZ_DOF_END_PITCH_REAR + 3 * end][i] -
                         block->position[CZ_DOF_BODY_PITCH][i] -
                         memory(dynamics, CZ_M_FOLD_REAR + end, lane);
    return 0.5 * parameter(dynamics, CZ_P_FOLD_STIFFNESS_REAR + end, lane) * angle * angle;
}

/* Area under the smaller of two straight lines that go from a to b over a length. */
static double area_below(double length, double from_a, double to_a, double from_b, double to_b) {
    const double before = from_a - from_b, after = to_a - to_b;
    const double lower_from = cz_smaller(from_a, from_b), lower_to = cz_smaller(to_a, to_b);
    if (before * after >= 0.0)
        return 0.5 * length * (lower_from + lower_to);
    const double share = before / (before - after);
    const double crossing = from_a + share * (to_a - from_a);
    return 0.5 * length * (share * (lower_from + crossing) + (1.0 - share) * (crossing + lower_to));
}

/* Area under a line from `from` to `to`, whose value at `to` is `end`, and under the backbone. */
static double area_of_path(const CzCurveLanes *curve, size_t stride, size_t lane, double from,
                           double to, double slope, double end) {
    double area = 0.0, begin = from, backbone_slope = 0.0;
    double value = from < to ? cz_curve_value(curve, stride, lane, from) : 0.0;
    for (int kink = 0; kink <= curve->n_kink && begin < to; ++kink) {
        const bool is_last = kink == curve->n_kink;
        const double at = is_last ? to : cz_row(curve->at, stride, kink)[lane];
        const double stop = cz_smaller(at, to);
        if (stop > begin) {
            const double next = value + backbone_slope * (stop - begin);
            area += area_below(stop - begin, cz_larger(end - slope * (to - begin), 0.0),
                               cz_larger(end - slope * (to - stop), 0.0), cz_larger(value, 0.0),
                               cz_larger(next, 0.0));
            begin = stop;
            value = next;
        }
        if (!is_last)
            backbone_slope += cz_row(curve->slope_change, stride, kink)[lane];
    }
    return area;
}

/* Energy that a crush zone gives back from shortening x, its largest being `largest`: along the
 * unloading path, which is never above the backbone, and on the stop beyond the last stage. */
static double crush_stored(const CzCurveLanes *curve, size_t stride, size_t lane,
                           const CzVehicleEndLaw *law, double x, double largest) {
    const double whole = curve->usable[lane];
    const double held = cz_smaller(largest, whole), inside = cz_smaller(x, whole);
    const double peak = cz_curve_value(curve, stride, lane, held);
    const double turn = held - (1.0 - law->share) * peak / law->unloading;
    const double residual = cz_positive_part(turn - law->share * peak / law->second_unloading);
    if (inside < residual) {
        const double pulled = law->tension * (residual - inside);
        return 0.5 * pulled * pulled / cz_larger(law->tension, 1.0);
    }
    const double low = cz_larger(cz_smaller(inside, turn), residual);
    const double high = cz_larger(turn, residual);
    const double below = area_of_path(curve, stride, lane, residual, low, law->second_unloading,
                                      law->share * peak - law->second_unloading * (turn - low));
    const double above = area_of_path(curve, stride, lane, high, inside, law->unloading,
                                      peak - law->unloading * (held - inside));
    const double stop = x > whole ? cz_curve_integral(curve, stride, lane, x) -
                                        cz_curve_integral(curve, stride, lane, whole)
                                  : 0.0;
    return below + above + stop;
}

/* Work of loading to the largest shortening less what unloading from there gives back, and what is
 * stored: a function of the state alone, so that nothing adds up on the way. */
static double crush_received(const CzCurveLanes *curve, size_t stride, size_t lane,
                             const CzVehicleEndLaw *law, double x, double largest) {
    const double held = cz_smaller(largest, curve->usable[lane]);
    const double loading = cz_curve_integral(curve, stride, lane, held);
    const double given_back = crush_stored(curve, stride, lane, law, held, held);
    return loading - given_back + crush_stored(curve, stride, lane, law, x, largest);
}

static CzVehicleEndLaw end_law(const CzDynamics *dynamics, size_t lane, int end) {
    return (CzVehicleEndLaw){
        cz_larger(parameter(dynamics, CZ_P_END_UNLOADING_REAR + end, lane), 1.0),
        parameter(dynamics, CZ_P_END_SHARE_REAR + end, lane),
        cz_larger(parameter(dynamics, CZ_P_END_SECOND_UNLOADING_REAR + end, lane), 1.0),
        parameter(dynamics, CZ_P_END_TENSION_REAR + end, lane)};
}

static CzVehicleEndLaw limp_law(const CzDynamics *dynamics, size_t lane, int side) {
    return (CzVehicleEndLaw){
        cz_larger(parameter(dynamics, CZ_P_LIMP_UNLOADING_A + side, lane), 1.0),
        parameter(dynamics, CZ_P_LIMP_SHARE_A + side, lane),
        cz_larger(parameter(dynamics, CZ_P_LIMP_SECOND_UNLOADING_A + side, lane), 1.0), 0.0};
}

typedef double OfCrush(const CzCurveLanes *curve, size_t stride, size_t lane,
                       const CzVehicleEndLaw *law, double x, double largest);

static double of_end(const CzDynamics *dynamics, size_t lane, int end, OfCrush *function) {
    if (parameter(dynamics, CZ_P_SLAVED_ENDS, lane) > 0.5)
        return 0.0;
    const CzVehicleEndLaw law = end_law(dynamics, lane, end);
    return function(&dynamics->lanes->curve[CZ_CURVE_END_REAR + end], dynamics->lanes->stride, lane,
                    &law, scratch(dynamics, CZ_S_END_STROKE_REAR + end, lane),
                    memory(dynamics, CZ_M_END_PEAK_REAR + end, lane));
}

static double of_limp_at(const CzDynamics *dynamics, size_t lane, int side, OfCrush *function,
                         double x, double largest) {
    if (parameter(dynamics, CZ_P_LIMP_END_A + side, lane) < 0.5)
        return 0.0;
    const CzVehicleEndLaw law = limp_law(dynamics, lane, side);
    return function(&dynamics->lanes->curve[CZ_CURVE_LIMP_END_A + side], dynamics->lanes->stride,
                    lane, &law, x, largest);
}

static double of_limp(const CzDynamics *dynamics, size_t lane, int side, OfCrush *function) {
    return of_limp_at(dynamics, lane, side, function, memory(dynamics, CZ_M_LIMP_A + side, lane),
                      memory(dynamics, CZ_M_LIMP_PEAK_A + side, lane));
}

double cz_end_stored(const CzDynamics *dynamics, size_t lane, int end) {
    return of_end(dynamics, lane, end, crush_stored);
}

double cz_end_received(const CzDynamics *dynamics, size_t lane, int end) {
    return of_end(dynamics, lane, end, crush_received);
}

double cz_limp_stored(const CzDynamics *dynamics, size_t lane, int side) {
    return of_limp(dynamics, lane, side, crush_stored);
}

double cz_limp_received(const CzDynamics *dynamics, size_t lane, int side) {
    return of_limp(dynamics, lane, side, crush_received);
}

double cz_limp_received_at(const CzDynamics *dynamics, size_t lane, int side, double x,
                           double largest) {
    return of_limp_at(dynamics, lane, side, crush_received, x, largest);
}

double cz_slide_stored(const CzDynamics *dynamics, size_t lane) {
    const double x = cz_block_of(dynamics, lane)->position[CZ_DOF_BODY_X][lane % CZ_LANE_BLOCK];
    const double over = cz_larger(fabs(x) - parameter(dynamics, CZ_P_SLIDE_LENGTH, lane), 0.0);
    return 0.5 * parameter(dynamics, CZ_P_SLIDE_STIFFNESS, lane) * over * over;
}

double cz_track_stored(const CzDynamics *dynamics, size_t lane) {
    return cz_dynamics_track_energy(dynamics, lane) -
           cz_block_of(dynamics, lane)->rail_rest_energy[lane % CZ_LANE_BLOCK];
}
