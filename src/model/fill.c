/* Fills the lanes of one design: error messages, curves of devices, and the loop over the cars. */
#include "model/fill.h"

#include "base/error.h"
#include "laws/vehicle_end.h"

#include <stdarg.h>
#include <stdio.h>

CzStatus cz_fill_refuse(const CzFill *fill, CzPartName part, const void *field, const char *format,
                        ...) {
    char sentence[384];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    static const char *const end_names[] = {"", ", rear ", ", front "};
    cz_fail(fill->error, CZ_STATUS_INPUT, "car %s%s%s: %s", fill->model->car[part.car].name,
            end_names[part.end + 1], part.what, sentence);

    /* The place of the same field in the problem's own vehicles. */
    if (fill->error != NULL) {
        const char *own =
            (const char *)fill->baseline + ((const char *)field - (const char *)fill->vehicles);
        cz_problem_place(fill->model->problem, own, fill->error);
    }
    return CZ_STATUS_INPUT;
}

/* Copies a curve to a lane; fails when it has more breakpoints than the problem's own. */
static CzStatus fill_curve(const CzFill *fill, CzPartName part, const void *field, CzCurveId id,
                           const CzBreakpoints *breakpoints) {
    CzCurveLanes *curve = &fill->lanes->curve[id];
    const size_t lane = cz_fill_lane(fill, part.lane);
    if (breakpoints->n > curve->n_breakpoint)
        return cz_fill_refuse(fill, part, field, "has more stages than in the problem file");
    curve->start[lane] = breakpoints->start;
    curve->usable[lane] = breakpoints->usable;

    /* The last breakpoint remains the last; unused ones are at its place before it, so that
     * breakpoints are in order. */
    const int last = breakpoints->n - 1;
    for (int i = 0; i < curve->n_breakpoint && last >= 0; i++) {
        const size_t slot = (size_t)i * curve->stride + lane;
        const int k = i < last ? i : last;
        const bool is_used = i < last || i == curve->n_breakpoint - 1;
        curve->at[slot] = breakpoints->at[k];
        curve->slope_change[slot] = is_used ? breakpoints->slope_change[k] : 0.0;
    }
    return CZ_OK;
}

/* ---- checks of curves ---- */

static CzStatus check_stages(const CzFill *fill, CzPartName part, const CzStage *stage,
                             int n_stage) {
    for (int i = 0; i < n_stage; i++) {
        if (!(stage[i].stroke > 0.0) || !isfinite(stage[i].stroke))
            return cz_fill_refuse(fill, part, &stage[i].stroke,
                                  "stage %d has a stroke of %g mm; it must be positive", i + 1,
                                  stage[i].stroke * 1e3);
        if (!(stage[i].force >= 0.0) || !isfinite(stage[i].force))
            return cz_fill_refuse(fill, part, &stage[i].force,
                                  "stage %d has a force of %g kN; it must not be negative", i + 1,
                                  stage[i].force * 1e-3);
        if (!isnan(stage[i].end_force) && !(stage[i].end_force >= 0.0))
            return cz_fill_refuse(fill, part, &stage[i].end_force,
                                  "stage %d ends at %g kN; it must not be negative", i + 1,
                                  stage[i].end_force * 1e-3);
    }
    return CZ_OK;
}

static CzStatus check_table(const CzFill *fill, CzPartName part, const CzTable *table) {
    if (table->n_point < 2 || table->x[0] < 0.0)
        return cz_fill_refuse(fill, part, table,
                              "the curve needs at least two points, from stroke 0 on");
    for (int i = 0; i < table->n_point; i++) {
        if (!(table->y[i] >= 0.0) || !isfinite(table->y[i]))
            return cz_fill_refuse(fill, part, table,
                                  "point %d has a force of %g kN; it must not be negative", i + 1,
                                  table->y[i] * 1e-3);
        if (i > 0 && !(table->x[i] > table->x[i - 1]))
            return cz_fill_refuse(fill, part, table, "the strokes must increase; point %d does not",
                                  i + 1);
    }
    return CZ_OK;
}

/* Either stages or a curve; a dynamic curve without a further rate effect. */
static CzStatus check_strength(const CzFill *fill, CzPartName part, const void *field,
                               const CzStage *stage, int n_stage, const CzTable *table,
                               double rise) {
    if (table->given == (n_stage > 0))
        return cz_fill_refuse(fill, part, field, "give either stages or a curve, not %s",
                              table->given ? "both" : "none");
    if (table->given && table->basis == CZ_BASIS_DYNAMIC && rise != 0.0)
        return cz_fill_refuse(
            fill, part, field,
            "a dynamic curve already contains the rate effect; remove the rate and speed factors");
    return table->given ? check_table(fill, part, table) : check_stages(fill, part, stage, n_stage);
}

static CzStatus check_trigger(const CzFill *fill, CzPartName part, const double *trigger) {
    if (*trigger < 0.0)
        return cz_fill_refuse(fill, part, trigger, "trigger of %g kN; it must not be negative",
                              *trigger * 1e-3);
    return CZ_OK;
}

/* A buffer's force must not fall, nor rise more steeply than the transition between its two
 * curves. */
static CzStatus check_rise(const CzFill *fill, CzPartName part, const CzBuffer *buffer) {
    double force = buffer->preload;
    for (int i = 0; i < buffer->n_stages; i++) {
        const CzStage *stage = &buffer->stages[i];
        const double slope = (stage->force - force) / stage->stroke;
        if (!(stage->force > 0.0) || stage->force < force)
            return cz_fill_refuse(fill, part, &stage->force,
                                  "stage %d ends at %g kN, after %g kN; a buffer's force must be "
                                  "positive and must not fall",
                                  i + 1, stage->force * 1e-3, force * 1e-3);
        if (slope > buffer->transition_stiffness)
            return cz_fill_refuse(fill, part, &stage->force,
                                  "stage %d rises by %g MN/m, faster than the transition stiffness "
                                  "of %g MN/m: a cycle would create energy",
                                  i + 1, slope * 1e-6, buffer->transition_stiffness * 1e-6);
        force = stage->force;
    }
    return CZ_OK;
}

/* A stage after the first must not rise so fast that unloading returns more energy than it
 * received. */
static CzStatus check_unloading(const CzFill *fill, CzPartName part, const CzEnd *end) {
    const CzVehicleEndLaw law = {.unloading = end->unloading_stiffness,
                                 .share = end->unloading_share,
                                 .second_unloading = cz_second_unloading(end)};
    const double steepest = cz_vehicle_end_steepest(&law);
    const CzTable *table = &end->curve;
    const int n = table->given ? table->n_point - 1 : end->n_stages;
    for (int i = 1; i < n; i++) {
        const double slope =
            table->given
                ? (table->y[i + 1] - table->y[i]) / (table->x[i + 1] - table->x[i])
                : (end->stages[i].force - end->stages[i - 1].force) / end->stages[i].stroke;
        if (slope > steepest)
            return cz_fill_refuse(
                fill, part, table->given ? (const void *)table : &end->stages[i].force,
                "%s %d rises by %g MN/m; with these unloading stiffnesses more than %g MN/m would "
                "return more energy than it received",
                table->given ? "segment" : "stage", i + 1, slope * 1e-6, steepest * 1e-6);
    }
    return CZ_OK;
}

/* ---- curves of devices ---- */

CzStatus cz_fill_buffer(const CzFill *fill, CzPartName part, const CzBuffer *buffer, int count,
                        CzCurveId id) {
    CzBreakpoints breakpoints;
    if (buffer == NULL) {
        cz_breakpoints_spring(&breakpoints, CZ_NEVER);
        return fill_curve(fill, part, NULL, id, &breakpoints);
    }
    if (buffer->n_stages < 1)
        return cz_fill_refuse(fill, part, buffer, "has no stages");
    CZ_TRY(check_stages(fill, part, buffer->stages, buffer->n_stages));
    CZ_TRY(check_rise(fill, part, buffer));
    const CzTable none = {.given = false};
    cz_breakpoints_loading(&breakpoints, buffer->preload, buffer->stages, buffer->n_stages, &none,
                           buffer->bottom_stiffness);
    cz_breakpoints_scale(&breakpoints, count);
    return fill_curve(fill, part, buffer, id, &breakpoints);
}

CzStatus cz_fill_tube(const CzFill *fill, CzPartName part, const CzTube *tube, int count,
                      CzCurveId id) {
    CzBreakpoints breakpoints;
    if (!tube->given) {
        cz_breakpoints_rigid_member(&breakpoints);
        return fill_curve(fill, part, tube, id, &breakpoints);
    }
    CZ_TRY(check_strength(fill, part, tube, tube->stages, tube->n_stages, &tube->curve,
                          tube->rate_factor));
    CZ_TRY(check_trigger(fill, part, &tube->trigger));
    cz_breakpoints_strength(&breakpoints, tube->stages, tube->n_stages, &tube->curve, tube->trigger,
                            tube->trigger_length, tube->bottom_stiffness);
    cz_breakpoints_scale(&breakpoints, (double)tube->count * count);
    return fill_curve(fill, part, tube, id, &breakpoints);
}

CzStatus cz_fill_anti_climber(const CzFill *fill, CzPartName part,
                              const CzAntiClimber *anti_climber, CzCurveId id) {
    CzBreakpoints breakpoints;
    if (anti_climber == NULL) {
        cz_breakpoints_rigid_member(&breakpoints);
        return fill_curve(fill, part, anti_climber, id, &breakpoints);
    }
    CZ_TRY(check_strength(fill, part, anti_climber, anti_climber->stages, anti_climber->n_stages,
                          &anti_climber->curve,
                          anti_climber->rate_factor + anti_climber->speed_factor));
    CZ_TRY(check_trigger(fill, part, &anti_climber->trigger));
    cz_breakpoints_strength(&breakpoints, anti_climber->stages, anti_climber->n_stages,
                            &anti_climber->curve, anti_climber->trigger,
                            anti_climber->trigger_length, anti_climber->bottom_stiffness);
    cz_breakpoints_scale(&breakpoints, anti_climber->count);
    return fill_curve(fill, part, anti_climber, id, &breakpoints);
}

CzStatus cz_fill_end(const CzFill *fill, CzPartName part, const CzEnd *end, CzCurveId id) {
    CzBreakpoints breakpoints;
    if (!cz_end_crushes(end)) {
        cz_breakpoints_spring(&breakpoints, end->bottom_stiffness);
        return fill_curve(fill, part, end, id, &breakpoints);
    }
    CZ_TRY(check_strength(fill, part, end, end->stages, end->n_stages, &end->curve, 0.0));
    if (end->curve.given && (end->curve.x[0] != 0.0 || end->curve.y[0] != 0.0))
        return cz_fill_refuse(fill, part, &end->curve,
                              "the curve must start at stroke 0 with force 0");
    CZ_TRY(check_unloading(fill, part, end));
    cz_breakpoints_loading(&breakpoints, 0.0, end->stages, end->n_stages, &end->curve,
                           end->bottom_stiffness);
    return fill_curve(fill, part, end, id, &breakpoints);
}

/* ---- end masses ---- */

CzOffsets cz_fill_offsets(const CzModel *model, int interface) {
    const CzInput *input = cz_problem_input(model->problem);
    const CzScenario *scenario = model->scenario;
    const double ahead = input->trains[model->train[1]].height_offset;
    if (interface == model->colliding)
        return (CzOffsets){{input->trains[model->train[0]].height_offset,
                            isnan(scenario->height_offset) ? ahead : scenario->height_offset}};
    return (CzOffsets){{0.0, interface == model->perturbed ? scenario->perturbation : 0.0}};
}

double cz_fill_end_mass(const CzFill *fill, int car, int which) {
    const CzVehicle *vehicle = cz_fill_vehicle(fill, car);
    const CzEnd *end = cz_end_of(vehicle, which);
    const double mass = cz_end_mass(vehicle, end);
    const int other = which == CZ_FRONT ? car + 1 : car - 1;
    if (vehicle->model == CZ_MODEL_FULL || mass == 0.0)
        return mass;
    if (other < 0 || other >= fill->model->n_car)
        return 0.0;
    const CzVehicle *opposite = cz_fill_vehicle(fill, other);
    const CzOffsets offset = cz_fill_offsets(fill->model, which == CZ_FRONT ? car : other);
    const int side = which == CZ_FRONT ? CZ_SIDE_A : CZ_SIDE_B;
    const double rise =
        opposite->model == CZ_MODEL_FULL ? offset.side[side] - offset.side[1 - side] : NAN;
    return cz_end_is_struck(end, cz_end_of(opposite, 1 - which), rise) ? mass : 0.0;
}

/* ---- all cars ---- */

CzStatus cz_model_fill(const CzModel *model, const CzVehicle *vehicles, int design, CzLanes *lanes,
                       CzError *error) {
    int n_vehicle;
    const CzFill fill = {.model = model,
                         .vehicles = vehicles,
                         .baseline = cz_problem_vehicles(model->problem, &n_vehicle),
                         .lanes = lanes,
                         .design = design,
                         .error = error};
    CzStatics behind = {0};
    for (int car = 0; car < model->n_car; car++) {
        CzStatics statics;
        CZ_TRY(cz_fill_statics(&fill, car, &statics));
        CZ_TRY(cz_fill_car(&fill, car, &statics));
        if (car > 0)
            CZ_TRY(cz_fill_interface(&fill, car - 1, &behind, &statics));
        behind = statics;
    }
    return CZ_OK;
}
