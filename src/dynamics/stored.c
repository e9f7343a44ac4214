/* Elastic energy that the elements could still give back. */
#include "dynamics/stored.h"

#include <math.h>

#include "dynamics/suspension_rows.h"
#include "laws/slider.h"
#include "laws/vehicle_end.h"

#define SMALL_STROKE 1e-7 /* of a buffer, within its first stage [m] */

static double parameter(const CzDynamics *dynamics, int row, size_t lane) {
    return *cz_lane_parameter(dynamics->lanes, row, lane);
}

static double memory(const CzDynamics *dynamics, int row, size_t lane) {
    return cz_row_of(cz_block_of(dynamics, lane)->memory, row)[lane % CZ_LANE_BLOCK];
}

static double published(const CzDynamics *dynamics, int row, size_t lane) {
    return cz_row_of(&cz_block_of(dynamics, lane)->published, row)[lane % CZ_LANE_BLOCK];
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

/* A buffer of one side of a chain in a lane. */
typedef struct BufferAt {
    const CzBufferRows *rows;
    const CzBufferMemory *memory;
    const CzCurveLanes *curve;
} BufferAt;

/* Area under the unloading path of a buffer: down the transition to the lower curve, along it to
 * zero, and its stop; or of its draw spring. The lower curve rises nowhere faster than the
 * transition, so the triangle above it is at least h^2 / 2 k_t. */
static double buffer_stored(const BufferAt *buffer, size_t stride, size_t lane) {
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzBufferRows *rows = buffer->rows;
    const CzCurveLanes *curve = buffer->curve;
    const double stroke = buffer->memory->stroke[i];
    if (stroke < 0.0) {
        const double drawn = cz_larger(-stroke - rows->draw_slack[i], 0.0);
        return 0.5 * rows->draw_stiffness[i] * drawn * drawn;
    }
    const double share = rows->share[i];
    const double transition = cz_larger(rows->transition[i], 1.0);
    const double usable = curve->usable[lane], inside = cz_smaller(stroke, usable);
    const double beyond = stroke - inside;
    const double upper_curve = beyond > 0.0 ? cz_curve_value(curve, stride, lane, usable)
                                            : cz_curve_value(curve, stride, lane, stroke);
    const double line = transition * stroke;
    const double upper = cz_smaller(upper_curve, line);
    const double lower = cz_smaller(share * upper_curve, line);
    const double force = cz_clamp(transition * (stroke - buffer->memory->offset[i]), lower, upper);
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

static size_t block_of(size_t lane) {
    return lane / CZ_LANE_BLOCK;
}

double cz_coupler_stored(const CzDynamics *dynamics, size_t lane, int side) {
    const CzLanes *lanes = dynamics->lanes;
    const BufferAt buffer = {&lanes->block[block_of(lane)].parameter.coupler.side[side].buffer,
                             &cz_block_of(dynamics, lane)->memory->coupler.side[side].buffer,
                             &lanes->curve[CZ_CURVE(buffer[side])]};
    if (parameter(dynamics, CZ_PARAMETER(coupler.exists), lane) < 0.5)
        return 0.0;
    return buffer_stored(&buffer, lanes->stride, lane);
}

double cz_side_stored(const CzDynamics *dynamics, size_t lane, int side) {
    const CzLanes *lanes = dynamics->lanes;
    const BufferAt buffer = {&lanes->block[block_of(lane)].parameter.side_buffers.side[side].buffer,
                             &cz_block_of(dynamics, lane)->memory->side_buffers.side[side].buffer,
                             &lanes->curve[CZ_CURVE(side_buffer[side])]};
    if (parameter(dynamics, CZ_PARAMETER(side_buffers.exists), lane) < 0.5)
        return 0.0;
    return buffer_stored(&buffer, lanes->stride, lane);
}

static double squared(double force, double stiffness) {
    return stiffness > 0.0 ? 0.5 * force * force / stiffness : 0.0;
}

double cz_hinge_stored(const CzDynamics *dynamics, size_t lane, int side) {
    const double engaged = published(dynamics, CZ_PUBLISHED(coupler.engaged), lane);
    if (parameter(dynamics, CZ_PARAMETER(coupler.exists), lane) < 0.5 || !(engaged > 0.0))
        return 0.0;
    const double swing =
        published(dynamics, CZ_PUBLISHED(coupler.swing_vertical[side]), lane) / engaged;
    const double stiffness =
        parameter(dynamics, CZ_PARAMETER(coupler.side[side].hinge_vertical.stiffness), lane);
    const double capacity =
        parameter(dynamics, CZ_PARAMETER(coupler.side[side].hinge_vertical.moment), lane);
    const double offset = memory(dynamics, CZ_MEMORY(coupler.side[side].hinge_vertical), lane);
    const double moment = cz_slider(stiffness, capacity, swing, offset).force;
    const double compliance = stiffness > 0.0 ? 1.0 / stiffness : 0.0;
    const double stop =
        parameter(dynamics, CZ_PARAMETER(coupler.side[side].hinge_vertical.stop_stiffness), lane);
    const double range =
        parameter(dynamics, CZ_PARAMETER(coupler.side[side].hinge_vertical.stop), lane);
    return engaged * (cz_slider_energy(compliance, moment, swing, offset) +
                      cz_stop_energy(stop, range, swing));
}

/* In the compliance of the tubes of a chain. */
static double tubes_stored(const CzDynamics *dynamics, size_t lane, int compliance, int force) {
    const double f = memory(dynamics, force, lane);
    return 0.5 * parameter(dynamics, compliance, lane) * f * f;
}

double cz_coupler_tubes_stored(const CzDynamics *dynamics, size_t lane) {
    return tubes_stored(dynamics, lane, CZ_PARAMETER(coupler.compliance), CZ_MEMORY(coupler.force));
}

double cz_side_tubes_stored(const CzDynamics *dynamics, size_t lane) {
    return tubes_stored(dynamics, lane, CZ_PARAMETER(side_buffers.compliance),
                        CZ_MEMORY(side_buffers.force));
}

/* Force that a buffer rises by in a step that touches it, times the stroke of that step. */
static double touch(const CzDynamics *dynamics, size_t lane, int curve, int transition,
                    double stroke) {
    const double rise = parameter(dynamics, transition, lane) * stroke;
    return (dynamics->lanes->curve[curve].start[lane] + rise) * stroke;
}

double cz_coupler_touch(const CzDynamics *dynamics, size_t lane, int side, double stroke) {
    return touch(dynamics, lane, CZ_CURVE(buffer[side]),
                 CZ_PARAMETER(coupler.side[side].buffer.transition), stroke);
}

double cz_side_touch(const CzDynamics *dynamics, size_t lane, int side, double stroke) {
    return touch(dynamics, lane, CZ_CURVE(side_buffer[side]),
                 CZ_PARAMETER(side_buffers.side[side].buffer.transition), stroke);
}

double cz_superstructure_stored(const CzDynamics *dynamics, size_t lane) {
    const double force = published(dynamics, CZ_PUBLISHED(superstructure.force), lane);
    return 0.5 * force * force / parameter(dynamics, CZ_PARAMETER(superstructure.stiffness), lane);
}

double cz_draw_gear_stored(const CzDynamics *dynamics, size_t lane) {
    return squared(published(dynamics, CZ_PUBLISHED(draw_gear.force), lane),
                   parameter(dynamics, CZ_PARAMETER(draw_gear.stiffness), lane));
}

double cz_face_stored(const CzDynamics *dynamics, size_t lane) {
    const double held = 1.0 - memory(dynamics, CZ_MEMORY(face.lost), lane);
    const double force = memory(dynamics, CZ_MEMORY(face.force), lane);
    return held * 0.5 * parameter(dynamics, CZ_PARAMETER(face.compliance), lane) * force * force;
}

double cz_face_sliding_stored(const CzDynamics *dynamics, size_t lane) {
    return squared(published(dynamics, CZ_PUBLISHED(face.demand_vertical), lane),
                   parameter(dynamics, CZ_PARAMETER(face.stiffness_vertical), lane));
}

double cz_side_sliding_stored(const CzDynamics *dynamics, size_t lane) {
    return squared(published(dynamics, CZ_PUBLISHED(side_buffers.sliding_vertical), lane),
                   CZ_PLATE_STIFFNESS);
}

double cz_secondary_stored(const CzDynamics *dynamics, size_t lane) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    double stored = 0.0;
    for (int bogie = 0; bogie < 2; ++bogie) {
        const CzSuspensionLaw law = cz_suspension_at(&block->parameter.secondary,
                                                     block->parameter.secondary_preload[bogie], i);
        stored += cz_suspension_stored(&law, block->published.secondary[bogie].compression[i]);
    }
    return stored;
}

double cz_primary_stored(const CzDynamics *dynamics, size_t lane) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    double stored = 0.0;
    for (int axle = 0; axle < 4; ++axle) {
        const CzSuspensionLaw law =
            cz_suspension_at(&block->parameter.primary, block->parameter.primary_preload[axle], i);
        stored += cz_suspension_stored(&law, block->published.primary[axle].compression[i]);
    }
    return stored;
}

double cz_link_stored(const CzDynamics *dynamics, size_t lane) {
    double stored = 0.0;
    for (int bogie = 0; bogie < 2; ++bogie) {
        const double stretch = published(dynamics, CZ_PUBLISHED(link[bogie].travel), lane);
        stored +=
            0.5 * parameter(dynamics, CZ_PARAMETER(link.strut.stiffness), lane) * stretch * stretch;
    }
    return stored;
}

double cz_axle_guidance_stored(const CzDynamics *dynamics, size_t lane) {
    double stored = 0.0;
    for (int axle = 0; axle < 4; ++axle) {
        const double stretch = published(dynamics, CZ_PUBLISHED(axle_guidance[axle].travel), lane);
        stored += 0.5 * parameter(dynamics, CZ_PARAMETER(axle_guidance.stiffness), lane) * stretch *
                  stretch;
    }
    return stored;
}

/* Integral of K d^1.5 - N_0 over the approach d, from that at rest on. */
double cz_wheels_stored(const CzDynamics *dynamics, size_t lane) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    const double hertz = parameter(dynamics, CZ_PARAMETER(wheel.hertz), lane);
    double stored = 0.0;
    for (int axle = 0; axle < 4 && hertz > 0.0; ++axle) {
        const double rest = parameter(dynamics, CZ_PARAMETER(wheel.indentation[axle]), lane);
        const double approach = rest - block->position.wheelset[axle].z[i];
        const double pressed = cz_larger(approach, 0.0);
        const double load = block->constant.static_load[axle][i];
        stored += 0.4 * hertz * (pressed * pressed * sqrt(pressed) - rest * rest * sqrt(rest)) -
                  load * (approach - rest);
    }
    return stored;
}

double cz_guide_stored(const CzDynamics *dynamics, size_t lane, int end) {
    const double across = published(dynamics, CZ_PUBLISHED(end[end].slip_vertical), lane);
    return 0.5 * parameter(dynamics, CZ_PARAMETER(end[end].guide_vertical.stiffness), lane) *
           across * across;
}

double cz_fold_stored(const CzDynamics *dynamics, size_t lane, int end) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    const double angle = block->position.end[end].pitch[i] - block->position.body.pitch[i] -
                         memory(dynamics, CZ_MEMORY(end[end].fold_pitch), lane);
    return 0.5 * parameter(dynamics, CZ_PARAMETER(end[end].fold_pitch.stiffness), lane) * angle *
           angle;
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
        cz_larger(parameter(dynamics, CZ_PARAMETER(end[end].crush.unloading), lane), 1.0),
        parameter(dynamics, CZ_PARAMETER(end[end].crush.share), lane),
        cz_larger(parameter(dynamics, CZ_PARAMETER(end[end].crush.second_unloading), lane), 1.0),
        parameter(dynamics, CZ_PARAMETER(end[end].crush.tension), lane)};
}

static CzVehicleEndLaw massless_law(const CzDynamics *dynamics, size_t lane, int side) {
    return (CzVehicleEndLaw){
        cz_larger(parameter(dynamics, CZ_PARAMETER(face.side[side].massless.unloading), lane), 1.0),
        parameter(dynamics, CZ_PARAMETER(face.side[side].massless.share), lane),
        cz_larger(
            parameter(dynamics, CZ_PARAMETER(face.side[side].massless.second_unloading), lane),
            1.0),
        0.0};
}

typedef double OfCrush(const CzCurveLanes *curve, size_t stride, size_t lane,
                       const CzVehicleEndLaw *law, double x, double largest);

static double of_end(const CzDynamics *dynamics, size_t lane, int end, OfCrush *function) {
    if (parameter(dynamics, CZ_PARAMETER(slaved_ends), lane) > 0.5)
        return 0.0;
    const CzVehicleEndLaw law = end_law(dynamics, lane, end);
    return function(&dynamics->lanes->curve[CZ_CURVE(end[end])], dynamics->lanes->stride, lane,
                    &law, published(dynamics, CZ_PUBLISHED(end[end].stroke), lane),
                    memory(dynamics, CZ_MEMORY(end[end].peak), lane));
}

static double of_massless_at(const CzDynamics *dynamics, size_t lane, int side, OfCrush *function,
                             double x, double largest) {
    if (parameter(dynamics, CZ_PARAMETER(face.side[side].has_massless), lane) < 0.5)
        return 0.0;
    const CzVehicleEndLaw law = massless_law(dynamics, lane, side);
    return function(&dynamics->lanes->curve[CZ_CURVE(massless[side])], dynamics->lanes->stride,
                    lane, &law, x, largest);
}

static double of_massless(const CzDynamics *dynamics, size_t lane, int side, OfCrush *function) {
    return of_massless_at(dynamics, lane, side, function,
                          memory(dynamics, CZ_MEMORY(face.side[side].massless.stroke), lane),
                          memory(dynamics, CZ_MEMORY(face.side[side].massless.peak), lane));
}

double cz_end_stored(const CzDynamics *dynamics, size_t lane, int end) {
    return of_end(dynamics, lane, end, crush_stored);
}

double cz_end_received(const CzDynamics *dynamics, size_t lane, int end) {
    return of_end(dynamics, lane, end, crush_received);
}

double cz_massless_stored(const CzDynamics *dynamics, size_t lane, int side) {
    return of_massless(dynamics, lane, side, crush_stored);
}

double cz_massless_received(const CzDynamics *dynamics, size_t lane, int side) {
    return of_massless(dynamics, lane, side, crush_received);
}

double cz_massless_received_at(const CzDynamics *dynamics, size_t lane, int side, double x,
                               double largest) {
    return of_massless_at(dynamics, lane, side, crush_received, x, largest);
}

double cz_slide_stored(const CzDynamics *dynamics, size_t lane) {
    const double x = cz_block_of(dynamics, lane)->position.body.x[lane % CZ_LANE_BLOCK];
    const double over =
        cz_larger(fabs(x) - parameter(dynamics, CZ_PARAMETER(drag.slide_length), lane), 0.0);
    return 0.5 * parameter(dynamics, CZ_PARAMETER(drag.slide_stiffness), lane) * over * over;
}

double cz_track_stored(const CzDynamics *dynamics, size_t lane) {
    return cz_dynamics_track_energy(dynamics, lane) -
           cz_block_of(dynamics, lane)->rail_rest_energy[lane % CZ_LANE_BLOCK];
}
