/* Energy and momentum of a design: kinetic energy, work, what is stored, what the books leave open.
 */
#include "simulate/run.h"

#include <math.h>

#include "laws/vehicle_end.h"

double cz_kinetic_energy(const CzBatch *batch, int design) {
    double energy = 0.0;
    for (int car = 0; car < batch->model->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        for (int dof = 0; dof < CZ_N_DOF; ++dof) {
            const double v = cz_velocity(batch, dof, lane);
            energy += 0.5 * cz_row(batch->lanes->mass, batch->lanes->stride, dof)[lane] * v * v;
        }
    }
    return energy;
}

double cz_total_work(const CzBatch *batch, int design) {
    double work = 0.0;
    for (int car = 0; car < batch->model->n_car; ++car)
        for (int row = 0; row < CZ_N_LEDGER; ++row)
            work += cz_work(batch, row, cz_lane(batch, car, design));
    return work;
}

double cz_momentum_error(const CzBatch *batch, int design) {
    static const int along[] = {CZ_DOF_BODY_X,       CZ_DOF_END_X_REAR,    CZ_DOF_END_X_FRONT,
                                CZ_DOF_BOGIE_X_REAR, CZ_DOF_BOGIE_X_FRONT, CZ_DOF_WHEEL_X_0,
                                CZ_DOF_WHEEL_X_1,    CZ_DOF_WHEEL_X_2,     CZ_DOF_WHEEL_X_3};
    double change = 0.0, scale = 0.0;
    for (int car = 0; car < batch->model->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        for (size_t k = 0; k < sizeof along / sizeof along[0]; ++k) {
            const double mass = cz_row(batch->lanes->mass, batch->lanes->stride, along[k])[lane];
            const double before =
                cz_row(batch->lanes->velocity, batch->lanes->stride, along[k])[lane];
            change += mass * (cz_velocity(batch, along[k], lane) - before);
            scale += mass * fabs(before);
        }
        change -= cz_velocity(batch, CZ_ROW_IMPULSE, lane);
    }
    return scale > 0.0 ? fabs(change) / scale : 0.0;
}

double cz_curve_value(const CzCurveLanes *curve, size_t stride, size_t lane, double x) {
    double value = curve->start[lane];
    for (int kink = 0; kink < curve->n_kink; ++kink)
        value += cz_row(curve->slope_change, stride, kink)[lane] *
                 fmax(x - cz_row(curve->at, stride, kink)[lane], 0.0);
    return value;
}

double cz_curve_integral(const CzCurveLanes *curve, size_t stride, size_t lane, double x) {
    double integral = curve->start[lane] * x;
    for (int kink = 0; kink < curve->n_kink; ++kink) {
        const double beyond = fmax(x - cz_row(curve->at, stride, kink)[lane], 0.0);
        integral += 0.5 * cz_row(curve->slope_change, stride, kink)[lane] * beyond * beyond;
    }
    return integral;
}

/* Area under the unloading curve of a buffer, or of its draw spring. */
static double buffer_stored(const CzBatch *batch, size_t lane, int curve, double stroke,
                            double share, double draw, double slack) {
    if (stroke < 0.0) {
        const double drawn = fmax(-stroke - slack, 0.0);
        return 0.5 * draw * drawn * drawn;
    }
    return share *
           cz_curve_integral(&batch->lanes->curve[curve], batch->lanes->stride, lane, stroke);
}

double cz_coupler_stored(const CzBatch *batch, size_t lane, int side) {
    if (cz_parameter(batch, CZ_P_COUPLER, lane) < 0.5)
        return 0.0;
    const double force = cz_memory(batch, CZ_M_COUPLER_FORCE, lane);
    const double elastic =
        0.25 * cz_parameter(batch, CZ_P_COUPLER_COMPLIANCE, lane) * force * force;
    return elastic + buffer_stored(batch, lane, CZ_CURVE_BUFFER_A + side,
                                   cz_memory(batch, CZ_M_BUFFER_A + side, lane),
                                   cz_parameter(batch, CZ_P_BUFFER_SHARE_A + side, lane),
                                   cz_parameter(batch, CZ_P_BUFFER_DRAW_STIFFNESS_A + side, lane),
                                   cz_parameter(batch, CZ_P_BUFFER_DRAW_SLACK_A + side, lane));
}

double cz_face_stored(const CzBatch *batch, size_t lane, int side) {
    (void)side; /* the elasticity of both sides is one compliance */
    const double force = cz_memory(batch, CZ_M_FACE_FORCE, lane);
    return 0.25 * cz_parameter(batch, CZ_P_FACE_COMPLIANCE, lane) * force * force;
}

double cz_side_stored(const CzBatch *batch, size_t lane, int side) {
    if (cz_parameter(batch, CZ_P_SIDE_BUFFERS, lane) < 0.5)
        return 0.0;
    const double force = cz_memory(batch, CZ_M_SIDE_FORCE, lane);
    const double elastic = 0.25 * cz_parameter(batch, CZ_P_SIDE_COMPLIANCE, lane) * force * force;
    return elastic + buffer_stored(batch, lane, CZ_CURVE_SIDE_BUFFER_A + side,
                                   cz_memory(batch, CZ_M_SIDE_BUFFER_A + side, lane),
                                   cz_parameter(batch, CZ_P_SIDE_SHARE_A + side, lane), 0.0, 0.0);
}

/* Energy that a crush zone gives back from shortening x, its largest being `largest`: along the
 * unloading path, and on the stop beyond the last stage. */
static double crush_stored(const CzCurveLanes *curve, size_t stride, size_t lane,
                           const CzVehicleEndLaw *law, double x, double largest) {
    const double whole = curve->usable[lane];
    const double held = fmin(largest, whole);
    const double inside = fmin(x, whole);
    const double backbone = cz_curve_value(curve, stride, lane, inside);
    const double peak = cz_curve_value(curve, stride, lane, held);
    const CzVehicleEndResponse response = cz_vehicle_end(law, backbone, peak, inside, held);
    if (response.force < 0.0)
        return 0.5 * response.force * response.force / fmax(law->tension, 1.0);
    const double path = cz_vehicle_end_stored(law, peak, response.force);
    const double stop = x > whole ? cz_curve_integral(curve, stride, lane, x) -
                                        cz_curve_integral(curve, stride, lane, whole)
                                  : 0.0;
    return fmin(path, cz_curve_integral(curve, stride, lane, fmax(inside, 0.0))) + stop;
}

double cz_end_stored(const CzBatch *batch, size_t lane, int end) {
    if (cz_parameter(batch, CZ_P_SLAVED_ENDS, lane) > 0.5)
        return 0.0;
    const CzVehicleEndLaw law = {
        fmax(cz_parameter(batch, CZ_P_END_UNLOADING_REAR + end, lane), 1.0),
        cz_parameter(batch, CZ_P_END_SHARE_REAR + end, lane),
        fmax(cz_parameter(batch, CZ_P_END_SECOND_UNLOADING_REAR + end, lane), 1.0),
        cz_parameter(batch, CZ_P_END_TENSION_REAR + end, lane)};
    return crush_stored(&batch->lanes->curve[CZ_CURVE_END_REAR + end], batch->lanes->stride, lane,
                        &law, cz_scratch(batch, CZ_S_END_STROKE_REAR + end, lane),
                        cz_memory(batch, CZ_M_END_PEAK_REAR + end, lane));
}

double cz_limp_stored(const CzBatch *batch, size_t lane, int side) {
    if (cz_parameter(batch, CZ_P_LIMP_END_A + side, lane) < 0.5)
        return 0.0;
    const CzVehicleEndLaw law = {
        fmax(cz_parameter(batch, CZ_P_LIMP_UNLOADING_A + side, lane), 1.0),
        cz_parameter(batch, CZ_P_LIMP_SHARE_A + side, lane),
        fmax(cz_parameter(batch, CZ_P_LIMP_SECOND_UNLOADING_A + side, lane), 1.0), 0.0};
    return crush_stored(&batch->lanes->curve[CZ_CURVE_LIMP_END_A + side], batch->lanes->stride,
                        lane, &law, cz_memory(batch, CZ_M_LIMP_A + side, lane),
                        cz_memory(batch, CZ_M_LIMP_PEAK_A + side, lane));
}
