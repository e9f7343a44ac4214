/* Elastic energy that the elements could still give back. */
#include "dynamics/stored.h"

#include <math.h>

#include "laws/vehicle_end.h"

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

/* Area under the unloading curve of a buffer, or of its draw spring. */
static double buffer_stored(const CzDynamics *dynamics, size_t lane, int curve, double stroke,
                            double share, double draw, double slack) {
    if (stroke < 0.0) {
        const double drawn = cz_larger(-stroke - slack, 0.0);
        return 0.5 * draw * drawn * drawn;
    }
    return share *
           cz_curve_integral(&dynamics->lanes->curve[curve], dynamics->lanes->stride, lane, stroke);
}

static double half_elastic(const CzDynamics *dynamics, size_t lane, int compliance, int row) {
    const double force = memory(dynamics, row, lane);
    return 0.25 * parameter(dynamics, compliance, lane) * force * force;
}

double cz_coupler_elastic(const CzDynamics *dynamics, size_t lane) {
    return half_elastic(dynamics, lane, CZ_P_COUPLER_COMPLIANCE, CZ_M_COUPLER_FORCE);
}

double cz_side_elastic(const CzDynamics *dynamics, size_t lane) {
    return half_elastic(dynamics, lane, CZ_P_SIDE_COMPLIANCE, CZ_M_SIDE_FORCE);
}

double cz_coupler_stored(const CzDynamics *dynamics, size_t lane, int side) {
    if (parameter(dynamics, CZ_P_COUPLER, lane) < 0.5)
        return 0.0;
    return cz_coupler_elastic(dynamics, lane) +
           buffer_stored(dynamics, lane, CZ_CURVE_BUFFER_A + side,
                         memory(dynamics, CZ_M_BUFFER_A + side, lane),
                         parameter(dynamics, CZ_P_BUFFER_SHARE_A + side, lane),
                         parameter(dynamics, CZ_P_BUFFER_DRAW_STIFFNESS_A + side, lane),
                         parameter(dynamics, CZ_P_BUFFER_DRAW_SLACK_A + side, lane));
}

double cz_face_stored(const CzDynamics *dynamics, size_t lane, int side) {
    (void)side; /* the elasticity of both sides is one compliance */
    const double held = 1.0 - memory(dynamics, CZ_M_FACE_LOST, lane);
    return held * half_elastic(dynamics, lane, CZ_P_FACE_COMPLIANCE, CZ_M_FACE_FORCE);
}

double cz_side_stored(const CzDynamics *dynamics, size_t lane, int side) {
    if (parameter(dynamics, CZ_P_SIDE_BUFFERS, lane) < 0.5)
        return 0.0;
    return cz_side_elastic(dynamics, lane) +
           buffer_stored(dynamics, lane, CZ_CURVE_SIDE_BUFFER_A + side,
                         memory(dynamics, CZ_M_SIDE_BUFFER_A + side, lane),
                         parameter(dynamics, CZ_P_SIDE_SHARE_A + side, lane), 0.0, 0.0);
}

/* Energy that a crush zone gives back from shortening x, its largest being `largest`: along the
 * unloading path, and on the stop beyond the last stage. */
static double crush_stored(const CzCurveLanes *curve, size_t stride, size_t lane,
                           const CzVehicleEndLaw *law, double x, double largest) {
    const double whole = curve->usable[lane];
    const double held = cz_smaller(largest, whole);
    const double inside = cz_smaller(x, whole);
    const double backbone = cz_curve_value(curve, stride, lane, inside);
    const double peak = cz_curve_value(curve, stride, lane, held);
    const CzVehicleEndResponse response = cz_vehicle_end(law, backbone, peak, inside, held);
    if (response.force < 0.0)
        return 0.5 * response.force * response.force / cz_larger(law->tension, 1.0);
    const double path = cz_vehicle_end_stored(law, peak, response.force);
    const double stop = x > whole ? cz_curve_integral(curve, stride, lane, x) -
                                        cz_curve_integral(curve, stride, lane, whole)
                                  : 0.0;
    return cz_smaller(path, cz_curve_integral(curve, stride, lane, cz_larger(inside, 0.0))) + stop;
}

double cz_end_stored(const CzDynamics *dynamics, size_t lane, int end) {
    if (parameter(dynamics, CZ_P_SLAVED_ENDS, lane) > 0.5)
        return 0.0;
    const CzVehicleEndLaw law = {
        cz_larger(parameter(dynamics, CZ_P_END_UNLOADING_REAR + end, lane), 1.0),
        parameter(dynamics, CZ_P_END_SHARE_REAR + end, lane),
        cz_larger(parameter(dynamics, CZ_P_END_SECOND_UNLOADING_REAR + end, lane), 1.0),
        parameter(dynamics, CZ_P_END_TENSION_REAR + end, lane)};
    return crush_stored(&dynamics->lanes->curve[CZ_CURVE_END_REAR + end], dynamics->lanes->stride,
                        lane, &law, scratch(dynamics, CZ_S_END_STROKE_REAR + end, lane),
                        memory(dynamics, CZ_M_END_PEAK_REAR + end, lane));
}

double cz_limp_stored(const CzDynamics *dynamics, size_t lane, int side) {
    if (parameter(dynamics, CZ_P_LIMP_END_A + side, lane) < 0.5)
        return 0.0;
    const CzVehicleEndLaw law = {
        cz_larger(parameter(dynamics, CZ_P_LIMP_UNLOADING_A + side, lane), 1.0),
        parameter(dynamics, CZ_P_LIMP_SHARE_A + side, lane),
        cz_larger(parameter(dynamics, CZ_P_LIMP_SECOND_UNLOADING_A + side, lane), 1.0), 0.0};
    return crush_stored(&dynamics->lanes->curve[CZ_CURVE_LIMP_END_A + side],
                        dynamics->lanes->stride, lane, &law,
                        memory(dynamics, CZ_M_LIMP_A + side, lane),
                        memory(dynamics, CZ_M_LIMP_PEAK_A + side, lane));
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
