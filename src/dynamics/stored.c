/* Elastic energy that the elements can return. */
#include "dynamics/stored.h"

#include <math.h>

#include "dynamics/law_rows.h"
#include "laws/slider.h"

#define SMALL_STROKE 1e-7 /* of a buffer, within its first stage [m] */

/* Energy of a spring from its deflection, and from its force. */
static double by_stretch(double stiffness, double stretch) {
    return 0.5 * stiffness * stretch * stretch;
}
static double by_force(double force, double stiffness) {
    return stiffness > 0.0 ? 0.5 * force * force / stiffness : 0.0;
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
static double buffer_stored(const BufferAt *buffer, size_t lane) {
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
    const double upper_curve =
        beyond > 0.0 ? cz_curve_value(curve, lane, usable) : cz_curve_value(curve, lane, stroke);
    const double line = transition * stroke;
    const double upper = cz_smaller(upper_curve, line);
    const double lower = cz_smaller(share * upper_curve, line);
    const double force = cz_clamp(transition * (stroke - buffer->memory->offset[i]), lower, upper);
    const double over = force - lower;
    /* Near zero the lower curve is the transition itself: subtract the triangle above it. */
    const double first = share * cz_curve_value(curve, lane, 0.0);
    const double rise = (share * cz_curve_value(curve, lane, SMALL_STROKE) - first) / SMALL_STROKE;
    const double triangle = 0.5 * first * first / cz_larger(transition - rise, 1.0);
    const double along = share * cz_curve_integral(curve, lane, inside) - triangle;
    const double below =
        share * upper_curve > line ? 0.5 * line * stroke : along + share * upper_curve * beyond;
    const double stop =
        beyond > 0.0 ? 0.5 * beyond * (cz_curve_value(curve, lane, stroke) - upper_curve) : 0.0;
    return below + 0.5 * over * over / transition + stop;
}

static double hinge_stored(const CzBlock *d, size_t i, int side) {
    const CzHingeRows *rows = &d->parameter.coupler.side[side].hinge_vertical;
    const double engaged = d->published.coupler.engaged[i];
    if (d->parameter.coupler.exists[i] < 0.5 || !(engaged > 0.0))
        return 0.0;
    const double swing = d->published.coupler.swing_vertical[side][i] / engaged;
    const double offset = d->memory->coupler.side[side].hinge_vertical[i];
    const double moment = cz_slider(rows->stiffness[i], rows->moment[i], swing, offset).force;
    return engaged *
           (cz_slider_energy(d->constant.hinge_compliance[side][i], moment, swing, offset) +
            cz_stop_energy(rows->stop_stiffness[i], rows->stop[i], swing));
}

/* Rise of a buffer's force in the step of first touch, times the stroke of that step. */
static double touch(const CzCurveLanes *curve, const CzBufferRows *rows, size_t lane,
                    double stroke) {
    const double rise = rows->transition[lane % CZ_LANE_BLOCK] * stroke;
    return (curve->start[lane] + rise) * stroke;
}

double cz_coupler_touch(const CzDynamics *dynamics, size_t lane, int side, double stroke) {
    return touch(&dynamics->lanes->curve[CZ_CURVE(buffer[side])],
                 &cz_block_of(dynamics, lane)->parameter.coupler.side[side].buffer, lane, stroke);
}

double cz_side_touch(const CzDynamics *dynamics, size_t lane, int side, double stroke) {
    return touch(&dynamics->lanes->curve[CZ_CURVE(side_buffer[side])],
                 &cz_block_of(dynamics, lane)->parameter.side_buffers.side[side].buffer, lane,
                 stroke);
}

double cz_superstructure_touch(const CzDynamics *dynamics, size_t lane, double stroke) {
    const CzSuperstructureRows *rows = &cz_block_of(dynamics, lane)->parameter.superstructure;
    const size_t i = lane % CZ_LANE_BLOCK;
    return cz_smaller(rows->strength[i], rows->stiffness[i] * stroke) * stroke;
}

/* Integral of K d^1.5 - N_0 over the approach d, starting at rest. */
static double wheels_stored(const CzBlock *d, size_t i) {
    const double hertz = d->parameter.wheel.hertz[i];
    double stored = 0.0;
    for (int axle = 0; axle < 4 && hertz > 0.0; ++axle) {
        const double rest = d->parameter.wheel.indentation[axle][i];
        const double approach = rest - d->position.wheelset[axle].z[i];
        const double pressed = cz_larger(approach, 0.0);
        stored += 0.4 * hertz * (pressed * pressed * sqrt(pressed) - rest * rest * sqrt(rest)) -
                  d->constant.static_load[axle][i] * (approach - rest);
    }
    return stored;
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
static double area_of_path(const CzCurveLanes *curve, size_t lane, double from, double to,
                           double slope, double end) {
    double area = 0.0, begin = from, backbone_slope = 0.0;
    double value = from < to ? cz_curve_value(curve, lane, from) : 0.0;
    for (int k = 0; k <= curve->n_breakpoint && begin < to; ++k) {
        const bool is_last = k == curve->n_breakpoint;
        const size_t slot = (size_t)k * curve->stride + lane;
        const double stop = is_last ? to : cz_smaller(curve->at[slot], to);
        if (stop > begin) {
            const double next = value + backbone_slope * (stop - begin);
            area += area_below(stop - begin, cz_larger(end - slope * (to - begin), 0.0),
                               cz_larger(end - slope * (to - stop), 0.0), cz_larger(value, 0.0),
                               cz_larger(next, 0.0));
            begin = stop;
            value = next;
        }
        if (!is_last)
            backbone_slope += curve->slope_change[slot];
    }
    return area;
}

/* Energy that a crush zone returns from shortening x, its largest being `largest`: along the
 * unloading path, which is never above the backbone, and on the stop beyond the last stage. */
static double crush_stored(const CzCurveLanes *curve, size_t lane, const CzVehicleEndLaw *law,
                           double x, double largest) {
    const double whole = curve->usable[lane];
    const double held = cz_smaller(largest, whole), inside = cz_smaller(x, whole);
    const double peak = cz_curve_value(curve, lane, held);
    const double turn = held - (1.0 - law->share) * peak / law->unloading;
    const double residual = cz_positive_part(turn - law->share * peak / law->second_unloading);
    if (inside < residual) {
        const double pulled = law->tension * (residual - inside);
        return 0.5 * pulled * pulled / cz_larger(law->tension, 1.0);
    }
    const double low = cz_larger(cz_smaller(inside, turn), residual);
    const double high = cz_larger(turn, residual);
    const double below = area_of_path(curve, lane, residual, low, law->second_unloading,
                                      law->share * peak - law->second_unloading * (turn - low));
    const double above = area_of_path(curve, lane, high, inside, law->unloading,
                                      peak - law->unloading * (held - inside));
    const double stop =
        x > whole ? cz_curve_integral(curve, lane, x) - cz_curve_integral(curve, lane, whole) : 0.0;
    return below + above + stop;
}

/* Work of loading to a largest shortening less the energy returned by unloading from there. */
static double crush_lost(const CzCurveLanes *curve, size_t lane, const CzVehicleEndLaw *law,
                         double largest) {
    const double held = cz_smaller(largest, curve->usable[lane]);
    return cz_curve_integral(curve, lane, held) - crush_stored(curve, lane, law, held, held);
}

/* The energy that a crush zone has received depends on its state alone, so that no error
 * accumulates. */
static void fill_crush(const CzCurveLanes *curve, size_t lane, const CzVehicleEndLaw *law, double x,
                       double largest, CzCrushEnergy *energy) {
    if (largest == energy->largest && x == energy->shortening)
        return;
    if (largest != energy->largest)
        energy->lost = crush_lost(curve, lane, law, largest);
    energy->largest = largest;
    energy->shortening = x;
    energy->stored = crush_stored(curve, lane, law, x, largest);
    energy->received = energy->lost + energy->stored;
}

static void fill_end(const CzDynamics *dynamics, size_t lane, int end, CzCrushEnergy *energy) {
    const CzBlock *d = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzVehicleEndLaw law = cz_crush_at(&d->parameter.end[end].crush, i);
    if (d->parameter.slaved_ends[end][i] < 0.5)
        fill_crush(&dynamics->lanes->curve[CZ_CURVE(end[end])], lane, &law,
                   d->published.end[end].stroke[i], d->memory->end[end].peak[i], energy);
}

static void fill_massless(const CzDynamics *dynamics, size_t lane, int side,
                          CzCrushEnergy *energy) {
    const CzBlock *d = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzFaceRows *rows = &d->parameter.face;
    const CzMasslessMemory *memory = &d->memory->face.side[side].massless;
    const CzVehicleEndLaw law = cz_crush_at(&rows->side[side].massless, i);
    if (rows->side[side].has_massless[i] > 0.5)
        fill_crush(&dynamics->lanes->curve[CZ_CURVE(massless[side])], lane, &law, memory->stroke[i],
                   memory->peak[i], energy);
}

double cz_massless_received_at(const CzDynamics *dynamics, size_t lane, int side, double x,
                               double largest) {
    const CzFaceRows *rows = &cz_block_of(dynamics, lane)->parameter.face;
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzCurveLanes *curve = &dynamics->lanes->curve[CZ_CURVE(massless[side])];
    const CzVehicleEndLaw law = cz_crush_at(&rows->side[side].massless, i);
    if (rows->side[side].has_massless[i] < 0.5)
        return 0.0;
    return crush_lost(curve, lane, &law, largest) + crush_stored(curve, lane, &law, x, largest);
}

static void fill_buffers(const CzDynamics *dynamics, const CzBlock *d, size_t lane, int side,
                         CzStored *stored) {
    const CzCurveLanes *curve = dynamics->lanes->curve;
    const CzParameters *of = &d->parameter;
    const BufferAt coupler = {&of->coupler.side[side].buffer, &d->memory->coupler.side[side].buffer,
                              &curve[CZ_CURVE(buffer[side])]};
    const BufferAt beside = {&of->side_buffers.side[side].buffer,
                             &d->memory->side_buffers.side[side].buffer,
                             &curve[CZ_CURVE(side_buffer[side])]};
    const size_t i = lane % CZ_LANE_BLOCK;
    stored->coupler[side] = of->coupler.exists[i] > 0.5 ? buffer_stored(&coupler, lane) : 0.0;
    stored->side_buffers[side] =
        of->side_buffers.exists[i] > 0.5 ? buffer_stored(&beside, lane) : 0.0;
}

static void fill_interface(const CzDynamics *dynamics, const CzBlock *d, size_t lane,
                           CzStored *stored) {
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzParameters *of = &d->parameter;
    const CzPublished *now = &d->published;
    const CzMemory *memory = d->memory;
    for (int side = 0; side < 2; ++side) {
        fill_buffers(dynamics, d, lane, side, stored);
        stored->hinge[side] = hinge_stored(d, i, side);
        fill_massless(dynamics, lane, side, &stored->massless[side]);
    }
    stored->coupler_tubes = by_stretch(of->coupler.compliance[i], memory->coupler.force[i]);
    stored->side_tubes = by_stretch(of->side_buffers.compliance[i], memory->side_buffers.force[i]);
    stored->side_sliding = by_force(now->side_buffers.sliding_vertical[i], CZ_PLATE_STIFFNESS);
    stored->face =
        by_stretch((1.0 - memory->face.lost[i]) * of->face.compliance[i], memory->face.force[i]);
    stored->face_sliding = by_force(now->face.demand_vertical[i], of->face.stiffness_vertical[i]);
    stored->superstructure =
        by_force(now->superstructure.force[i], of->superstructure.stiffness[i]);
    stored->draw_gear = by_force(now->draw_gear.force[i], of->draw_gear.stiffness[i]);
}

/* Springs of the running gear, all of a car. */
static void fill_gear(const CzBlock *d, size_t i, CzStored *stored) {
    const CzParameters *of = &d->parameter;
    stored->secondary = stored->primary = stored->link = stored->axle_guidance = 0.0;
    for (int bogie = 0; bogie < 2; ++bogie) {
        const CzSuspensionLaw law =
            cz_suspension_at(&of->secondary, of->secondary_preload[bogie], i);
        stored->secondary +=
            cz_suspension_stored(&law, d->published.secondary[bogie].compression[i]);
        stored->link += by_stretch(of->link.strut.stiffness[i], d->published.link[bogie].travel[i]);
    }
    for (int axle = 0; axle < 4; ++axle) {
        const CzSuspensionLaw law = cz_suspension_at(&of->primary, of->primary_preload[axle], i);
        stored->primary += cz_suspension_stored(&law, d->published.primary[axle].compression[i]);
        stored->axle_guidance +=
            by_stretch(of->axle_guidance.stiffness[i], d->published.axle_guidance[axle].travel[i]);
    }
    stored->wheels = wheels_stored(d, i);
}

static void fill_car(const CzDynamics *dynamics, const CzBlock *d, size_t lane, CzStored *stored) {
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzDragRows *drag = &d->parameter.drag;
    for (int end = 0; end < 2; ++end) {
        const CzEndRows *of = &d->parameter.end[end];
        const double folded = d->position.end[end].pitch[i] - d->position.body.pitch[i];
        fill_end(dynamics, lane, end, &stored->end[end]);
        stored->guide[end] =
            by_stretch(of->guide_vertical.stiffness[i], d->published.end[end].slip_vertical[i]);
        stored->fold[end] =
            by_stretch(of->fold_pitch.stiffness[i], folded - d->memory->end[end].fold_pitch[i]);
    }
    if (dynamics->lanes->has.full_cars)
        fill_gear(d, i, stored);
    stored->slide =
        cz_stop_energy(drag->slide_stiffness[i], drag->slide_length[i], d->position.body.x[i]);
}

void cz_stored_fill(const CzDynamics *dynamics, size_t lane, CzStored *stored) {
    const CzBlock *d = cz_block_of(dynamics, lane);
    fill_interface(dynamics, d, lane, stored);
    fill_car(dynamics, d, lane, stored);
}

void cz_track_stored(const CzKernel *kernel, const CzDynamics *dynamics, int block, CzRow stored) {
    kernel->track_energy(dynamics, block, stored);
    for (int i = 0; i < CZ_LANE_BLOCK; ++i)
        stored[i] -= dynamics->block[block].rail_rest_energy[i];
}
