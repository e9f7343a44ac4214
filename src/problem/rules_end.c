/* Rules of one vehicle end and of the devices on it. */
#include <math.h>

#include "problem/rules.h"
#include "problem/strokes.h"

/* Turns "at most" into "below" where a rule says so. */
static const double just_above = 1 + 1e-9;

/* ---- curves ---- */

/* A device with a law requires either stages or a curve. */
static void check_law(const CzRules *rules, const CzDevice *device, const void *record,
                      const char *what) {
    const bool has_stages = cz_rule_is_written(rules, device->stages);
    const bool has_curve = cz_rule_is_written(rules, device->curve);
    if (!has_stages && !has_curve)
        cz_rule_absent(rules, record, "%s needs 'stages' or a 'curve'", what);
    if (has_stages && has_curve)
        cz_rule_broken(
            rules, device->curve,
            "%s has 'stages' and a 'curve'; remove one of them, for example by stages: null", what);
}

/* A curve begins at stroke 0; every stage has a force at its beginning or at its end. */
static void check_forces(const CzRules *rules, const CzDevice *device, const char *otherwise) {
    const CzTable *curve = device->curve;
    if (curve->given && curve->x[0] != 0)
        cz_rule_broken(rules, curve, "a curve must begin at stroke 0, but this one begins at %s",
                       CZ_MM(curve->x[0]));
    for (int i = 0; i < device->n_stages; i++)
        if (cz_rule_note(rules, CZ_VALUE_RULE_FORCE, device->stages[i].force <= 0, 0))
            cz_rule_broken(rules, &device->stages[i].force, "%s", otherwise);
}

/* A curve measured at speed already contains the rate effect. */
static void check_rate(const CzRules *rules, const double *factor, const CzTable *curve) {
    if (curve->given && curve->basis == CZ_BASIS_DYNAMIC && *factor > 0)
        cz_rule_broken(
            rules, factor,
            "a dynamic curve already contains the rate effect; this would count it twice");
}

/* A tube or anti-climber: the trigger peak is not below the first force of the curve, and the
 * device is longer than its usable stroke. */
static void check_device(const CzRules *rules, CzDevice device, const void *record,
                         const char *what) {
    const double plateau = device.curve->given   ? device.curve->y[0]
                           : device.n_stages > 0 ? device.stages[0].force
                                                 : NAN;
    const double stroke = cz_device_stroke(device);
    const double room = device.efficiency * *device.installed_length;
    if (!device.given)
        return;
    check_law(rules, &device, record, what);
    check_forces(rules, &device, "a plateau without force absorbs no energy");
    if (cz_rule_note(rules, CZ_VALUE_RULE_TRIGGER, plateau, *device.trigger))
        cz_rule_broken(rules, device.trigger, "a trigger of %s is below the first plateau of %s",
                       CZ_KN(*device.trigger), CZ_KN(plateau));
    check_rate(rules, device.rate_factor, device.curve);
    cz_rule_note(rules, CZ_VALUE_RULE_INSTALLED, stroke, room);
    if (stroke > room * (1 + 1e-12))
        cz_rule_broken(rules, device.installed_length,
                       "a stroke of %s does not fit: %s installed at an efficiency of %g give %s",
                       CZ_MM(stroke), CZ_MM(*device.installed_length), device.efficiency,
                       CZ_MM(room));
}

/* ---- devices ---- */

static void check_buffer(const CzRules *rules, const CzBuffer *buffer) {
    double force = buffer->preload;
    for (int i = 0; i < buffer->n_stages; i++) {
        if (cz_rule_note(rules, CZ_VALUE_RULE_BUFFER, force, buffer->stages[i].force))
            cz_rule_broken(rules, &buffer->stages[i].force,
                           "the force of a buffer must not fall during loading: %s after %s",
                           CZ_KN(buffer->stages[i].force), CZ_KN(force));
        force = buffer->stages[i].force;
    }
}

static void check_tube(const CzRules *rules, const CzTube *tube) {
    check_device(rules, CZ_DEVICE(tube), tube, "a tube");
}

static double coupler_stroke(const CzCoupler *coupler) {
    return cz_total_stroke(coupler->buffer.stages, coupler->buffer.n_stages, NULL) +
           cz_device_stroke(CZ_DEVICE(&coupler->tube)) +
           cz_device_stroke(CZ_DEVICE(&coupler->second_tube));
}

static void check_coupler(const CzRules *rules, const CzVehicle *vehicle,
                          const CzCoupler *coupler) {
    if (!coupler->given)
        return;
    check_buffer(rules, &coupler->buffer);
    check_tube(rules, &coupler->tube);
    check_tube(rules, &coupler->second_tube);
    cz_rule_note(rules, CZ_VALUE_RULE_COUPLER, coupler_stroke(coupler) * just_above,
                 coupler->length);
    if (coupler_stroke(coupler) >= coupler->length)
        cz_rule_broken(rules, &coupler->length,
                       "buffer and tubes have a stroke of %s in a coupler of %s",
                       CZ_MM(coupler_stroke(coupler)), CZ_MM(coupler->length));
    if (coupler->anchor == CZ_ANCHOR_END && vehicle->model != CZ_MODEL_FULL)
        cz_rule_broken(rules, &coupler->anchor,
                       "only a full vehicle has an end mass that a coupler can be anchored to");
}

static void check_anti_climber(const CzRules *rules, const CzAntiClimber *device) {
    check_device(rules, CZ_DEVICE(device), device, "an anti-climber");
    check_rate(rules, &device->speed_factor, &device->curve);
}

/* ---- the crushable structure ---- */

static void check_zones(const CzRules *rules, const CzEnd *end) {
    for (int i = 1; i < end->n_stages; i++)
        if (end->stages[i].zone < end->stages[i - 1].zone)
            cz_rule_broken(
                rules, &end->stages[i].zone,
                "%s space cannot be behind %s space: stages are listed from the front inwards",
                cz_word_sets[CZ_WORDS_ZONE].word[end->stages[i].zone].word,
                cz_word_sets[CZ_WORDS_ZONE].word[end->stages[i - 1].zone].word);
}

/* Steepest rise of the loading curve [N/m]. */
static double steepest_rise(const CzEnd *end) {
    double steepest = 0, force = 0;
    for (int i = 0; i < end->n_stages; i++) {
        steepest = fmax(steepest, (end->stages[i].force - force) / end->stages[i].stroke);
        force = end->stages[i].force;
    }
    for (int i = 1; i < end->curve.n_point; i++)
        steepest = fmax(steepest, (end->curve.y[i] - end->curve.y[i - 1]) /
                                      (end->curve.x[i] - end->curve.x[i - 1]));
    return steepest;
}

static void check_unloading(const CzRules *rules, const CzEnd *end) {
    const double steepest = steepest_rise(end);
    const bool crushes =
        cz_rule_is_written(rules, end->stages) || cz_rule_is_written(rules, &end->curve);
    if (crushes && !cz_rule_is_written(rules, &end->unloading_stiffness))
        cz_rule_absent(rules, end,
                       "an end that crushes needs its unloading_stiffness: unloading_stiffness_N_m "
                       "or unloading_stiffness_MN_m");
    cz_rule_note(rules, CZ_VALUE_RULE_UNLOADING, steepest, end->unloading_stiffness);
    if (end->unloading_stiffness < steepest * (1 - 1e-12))
        cz_rule_broken(rules, &end->unloading_stiffness,
                       "the unloading of an end must be at least as stiff as its loading: %s, but "
                       "%s in its steepest stage",
                       CZ_IN_UNIT(end->unloading_stiffness, "MN/m", 1e6),
                       CZ_IN_UNIT(steepest, "MN/m", 1e6));
}

static void check_available(const CzRules *rules, const CzEnd *end) {
    const double stroke = cz_free_stroke(end) + cz_device_stroke(CZ_DEVICE(&end->anti_climber));
    cz_rule_note(rules, CZ_VALUE_RULE_AVAILABLE, stroke, end->available_length);
    if (stroke > end->available_length * (1 + 1e-12))
        cz_rule_broken(rules, &end->available_length,
                       "anti-climber and end crush %s in front of the survival space, but only %s "
                       "are available",
                       CZ_MM(stroke), CZ_MM(end->available_length));
}

static void check_structure(const CzRules *rules, const CzVehicle *vehicle, const CzEnd *end) {
    const bool is_rigid =
        !cz_rule_is_written(rules, end->stages) && !cz_rule_is_written(rules, &end->curve);
    const CzDevice crushing = {
        .stages = end->stages, .n_stages = end->n_stages, .curve = &end->curve};
    if (!is_rigid || vehicle->model == CZ_MODEL_FULL) /* other ends may be rigid */
        check_law(rules, &crushing, end, "an end");
    if (end->n_stages > CZ_MAX_END_STAGES)
        cz_rule_broken(rules, end->stages, "an end has %d stages; at most %d are allowed",
                       end->n_stages, (int)CZ_MAX_END_STAGES);
    check_forces(rules, &crushing, "a stage of an end needs a force at its end");
    check_zones(rules, end);
    check_unloading(rules, end);
    check_available(rules, end);
}

/* ---- devices side by side ---- */

static void check_gaps(const CzRules *rules, const CzEnd *end) {
    const CzAntiClimber *device = &end->anti_climber;
    const CzCoupler *coupler = &end->coupler;
    if (device->given)
        cz_rule_note(rules, CZ_VALUE_RULE_BARE_END, device->gap * just_above, end->face_gap);
    if (device->given && device->gap >= end->face_gap)
        cz_rule_broken(rules, &device->gap,
                       "an anti-climber %s behind the foremost plane is behind the bare end at %s",
                       CZ_MM(device->gap), CZ_MM(end->face_gap));
    if (!device->given || !coupler->given)
        return;
    if (cz_rule_note(rules, CZ_VALUE_RULE_REACHED, device->gap, coupler->gap + coupler->length))
        cz_rule_broken(rules, &device->gap,
                       "an anti-climber %s behind the foremost plane makes no contact: the coupler "
                       "is only %s long",
                       CZ_MM(device->gap), CZ_MM(coupler->length));
    const double travel = coupler_stroke(coupler) + coupler->shear_off.retraction_space;
    if (coupler->shear_off.given &&
        cz_rule_note(rules, CZ_VALUE_RULE_RETRACTION, device->gap, coupler->gap + travel))
        cz_rule_broken(rules, &coupler->shear_off.retraction_space,
                       "the released coupler reaches its stop after %s, before contact of the "
                       "anti-climber at %s",
                       CZ_MM(coupler->gap + travel), CZ_MM(device->gap));
}

/* The residual force of a sheared coupler is less than its shear-off force. */
static void check_shear_off(const CzRules *rules, const CzShearOff *device) {
    if (device->given && device->residual_force >= device->force)
        cz_rule_broken(rules, &device->residual_force,
                       "a residual force of %s is not below the shear-off force of %s",
                       CZ_KN(device->residual_force), CZ_KN(device->force));
}

void cz_rules_check_end(const CzRules *rules, const CzVehicle *vehicle, const CzEnd *end) {
    if (!end->given)
        return;
    check_structure(rules, vehicle, end);
    check_shear_off(rules, &end->coupler.shear_off);
    check_coupler(rules, vehicle, &end->coupler);
    check_anti_climber(rules, &end->anti_climber);
    check_buffer(rules, &end->side_buffers.buffer);
    check_tube(rules, &end->side_buffers.tube);
    check_gaps(rules, end);
    if (end->slide.given && vehicle->model != CZ_MODEL_FIXED)
        cz_rule_broken(rules, &end->slide, "only a fixed vehicle can have a slide");
    if (end->slide.given && end == &vehicle->front && vehicle->rear.given &&
        vehicle->rear.slide.given)
        cz_rule_broken(rules, &end->slide,
                       "a vehicle slides as a whole: one of its ends has the slide, not both");
    if (vehicle->model == CZ_MODEL_FULL && end->distance > vehicle->length / 2)
        cz_rule_broken(rules, &end->distance,
                       "an end mass %s from the middle is beyond half the vehicle's length, %s",
                       CZ_MM(end->distance), CZ_MM(vehicle->length / 2));
}
