/* What the devices of a vehicle end need as written.
 *
 *   length of a device  = installed length when declared, else stroke / efficiency
 *   anti-climber's path = gap + length + crush zone of the end
 *   coupler's path      = buffer stroke + lengths of its tubes  <=  pivot to face
 *   retraction          = stroke of anti-climber and end that the released coupler must follow
 */
#include "evaluate/devices.h"

#include <string.h>

enum { MOST_DEVICES = 4 }; /* of one end: two tubes, an anti-climber, a side buffer's tube */

/* One device as far as room, mass and likeness go. */
typedef struct Device {
    int count;
    double stroke, installed_length, efficiency, mass_per_stroke;
    const CzStage *stages;
    int n_stages;
    const CzTable *curve;
} Device;

static double stages_stroke(const CzStage *stages, int n_stages) {
    double stroke = 0;
    for (int i = 0; i < n_stages; i++)
        stroke += stages[i].stroke;
    return stroke;
}

static double table_stroke(const CzTable *table) {
    return table->n_point > 0 ? table->x[table->n_point - 1] : 0;
}

/* Stroke of a device given by stages or by a curve. */
static double curve_stroke(const CzStage *stages, int n_stages, const CzTable *curve) {
    return n_stages > 0 ? stages_stroke(stages, n_stages) : table_stroke(curve);
}

double cz_buffer_stroke(const CzBuffer *buffer) {
    return buffer->given ? stages_stroke(buffer->stages, buffer->n_stages) : 0;
}

double cz_tube_stroke(const CzTube *tube) {
    return tube->given ? curve_stroke(tube->stages, tube->n_stages, &tube->curve) : 0;
}

double cz_anti_climber_stroke(const CzAntiClimber *anti_climber) {
    if (!anti_climber->given)
        return 0;
    return curve_stroke(anti_climber->stages, anti_climber->n_stages, &anti_climber->curve);
}

double cz_end_stroke(const CzEnd *end) {
    if (end->n_stages == 0)
        return table_stroke(&end->curve);
    double stroke = 0;
    for (int i = 0; i < end->n_stages; i++)
        if (end->stages[i].zone != CZ_ZONE_SURVIVAL)
            stroke += end->stages[i].stroke;
    return stroke;
}

static Device tube_device(const CzTube *tube) {
    return (Device){tube->count,      cz_tube_stroke(tube),  tube->installed_length,
                    tube->efficiency, tube->mass_per_stroke, tube->stages,
                    tube->n_stages,   &tube->curve};
}

static Device anti_climber_device(const CzAntiClimber *anti_climber) {
    return (Device){anti_climber->count,
                    cz_anti_climber_stroke(anti_climber),
                    anti_climber->installed_length,
                    anti_climber->efficiency,
                    anti_climber->mass_per_stroke,
                    anti_climber->stages,
                    anti_climber->n_stages,
                    &anti_climber->curve};
}

/* Lists the collapsing devices of an end and returns how many there are. */
static int list_devices(const CzEnd *end, Device device[MOST_DEVICES]) {
    int n = 0;
    if (end->coupler.given && end->coupler.tube.given)
        device[n++] = tube_device(&end->coupler.tube);
    if (end->coupler.given && end->coupler.second_tube.given)
        device[n++] = tube_device(&end->coupler.second_tube);
    if (end->anti_climber.given)
        device[n++] = anti_climber_device(&end->anti_climber);
    if (end->side_buffers.given && end->side_buffers.tube.given) {
        device[n] = tube_device(&end->side_buffers.tube);
        device[n++].count *= end->side_buffers.count;
    }
    return n;
}

/* Length that a device absorbs. */
static double installed_length(const Device *device) {
    return isnan(device->installed_length) ? device->stroke / device->efficiency
                                           : device->installed_length;
}

double cz_stroke_fit(const CzEnd *end) {
    Device device[MOST_DEVICES];
    const int n_device = list_devices(end, device);
    double worst = NAN;
    for (int i = 0; i < n_device; i++)
        worst = fmax(worst, device[i].stroke / (device[i].efficiency * device[i].installed_length));
    return worst;
}

double cz_length_used(const CzEnd *end) {
    double path = end->face_gap + cz_end_stroke(end);
    if (end->anti_climber.given) {
        const Device device = anti_climber_device(&end->anti_climber);
        path = fmax(path, end->anti_climber.gap + installed_length(&device) + cz_end_stroke(end));
    }
    return path / end->available_length;
}

double cz_coupler_length_used(const CzEnd *end) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given)
        return NAN;
    double length = cz_buffer_stroke(&coupler->buffer);
    const CzTube *tube[] = {&coupler->tube, &coupler->second_tube};
    for (int i = 0; i < 2; i++)
        if (tube[i]->given) {
            const Device device = tube_device(tube[i]);
            length += installed_length(&device);
        }
    return length / coupler->length;
}

double cz_retraction_used(const CzEnd *end) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given || !coupler->shear_off.given)
        return NAN;
    const double end_stroke = coupler->anchor == CZ_ANCHOR_END ? 0 : cz_end_stroke(end);
    const double needed = cz_anti_climber_stroke(&end->anti_climber) + end_stroke;
    return needed > 0 ? needed / coupler->shear_off.retraction_space : 0;
}

/* Largest plastic force of a tube at a crush rate, all devices side by side; 0 when absent. */
static double tube_force(const CzTube *tube, double rate) {
    if (!tube->given)
        return 0;
    double force = isnan(tube->trigger) ? 0 : tube->trigger;
    for (int i = 0; i < tube->n_stages; i++) {
        force = fmax(force, tube->stages[i].force);
        force = fmax(force, tube->stages[i].end_force); /* fmax passes over NaN */
    }
    for (int i = 0; i < tube->curve.n_point; i++)
        force = fmax(force, tube->curve.y[i]);
    return tube->count * force * (1 + tube->rate_factor * rate);
}

static double last_stage_force(const CzStage *stages, int n_stages) {
    return n_stages > 0 ? stages[n_stages - 1].force : 0;
}

static double anti_climber_force(const CzAntiClimber *climber, double rate) {
    const CzTube like = {.given = climber->given,
                         .count = climber->count,
                         .n_stages = climber->n_stages,
                         .curve = climber->curve,
                         .trigger = climber->trigger,
                         .rate_factor = climber->rate_factor};
    CzTube tube = like;
    memcpy(tube.stages, climber->stages, sizeof tube.stages);
    return tube_force(&tube, rate) * (1 + climber->speed_factor * rate / climber->speed_reference);
}

static double coupler_force(const CzCoupler *coupler, double rate) {
    const double tubes =
        fmax(tube_force(&coupler->tube, rate), tube_force(&coupler->second_tube, rate));
    return tubes > 0 ? tubes : last_stage_force(coupler->buffer.stages, coupler->buffer.n_stages);
}

static double side_buffers_force(const CzSideBuffers *side, double rate) {
    const double tube = tube_force(&side->tube, rate);
    const double buffer = last_stage_force(side->buffer.stages, side->buffer.n_stages);
    return side->count * (tube > 0 ? tube : buffer);
}

static double structure_force(const CzEnd *end) {
    double force = 0;
    for (int i = 0; i < end->n_stages; i++)
        force = fmax(force, end->stages[i].force);
    for (int i = 0; i < end->curve.n_point; i++)
        force = fmax(force, end->curve.y[i]);
    return force;
}

double cz_plastic_force(const CzEnd *end, CzElementKind kind, double rate) {
    switch (kind) {
    case CZ_ELEMENT_COUPLER:
        return coupler_force(&end->coupler, rate);
    case CZ_ELEMENT_ANTI_CLIMBER:
        return anti_climber_force(&end->anti_climber, rate);
    case CZ_ELEMENT_END:
        return structure_force(end);
    case CZ_ELEMENT_SIDE_BUFFERS:
        return side_buffers_force(&end->side_buffers, rate);
    case CZ_ELEMENT_SUPERSTRUCTURE:
        return end->superstructure.given ? end->superstructure.strength : 0;
    case CZ_ELEMENT_SLIDE:
        return end->slide.force;
    case CZ_ELEMENT_DRAW_GEAR:
    case CZ_N_ELEMENT_KIND:
        break;
    }
    return 0;
}

double cz_tube_over_shear_off(const CzEnd *end, double rate) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given || !coupler->shear_off.given)
        return NAN;
    const double force =
        fmax(tube_force(&coupler->tube, rate), tube_force(&coupler->second_tube, rate));
    return force / coupler->shear_off.force;
}

double cz_shear_off_over_strength(const CzEnd *end) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given || !coupler->shear_off.given)
        return 0;
    return coupler->shear_off.force / end->proof_strength;
}

/* Adds up a quantity of all devices of a train. */
static double sum_devices(int n_vehicle, const CzVehicle *vehicle,
                          double (*quantity)(const Device *)) {
    double sum = NAN;
    for (int i = 0; i < 2 * n_vehicle; i++) {
        const CzEnd *end = i % 2 == 0 ? &vehicle[i / 2].rear : &vehicle[i / 2].front;
        Device device[MOST_DEVICES];
        const int n_device = end->given ? list_devices(end, device) : 0;
        for (int j = 0; j < n_device; j++)
            sum = (isnan(sum) ? 0 : sum) + device[j].count * quantity(&device[j]);
    }
    return sum;
}

static double device_mass(const Device *device) {
    return device->mass_per_stroke * device->stroke;
}

double cz_train_installed_length(int n_vehicle, const CzVehicle *vehicle) {
    return sum_devices(n_vehicle, vehicle, installed_length);
}

double cz_train_absorber_mass(int n_vehicle, const CzVehicle *vehicle) {
    return sum_devices(n_vehicle, vehicle, device_mass);
}

/* Whether a buyer would call two devices the same part. */
static bool is_alike(const Device *a, const Device *b) {
    if (a->stroke != b->stroke || a->n_stages != b->n_stages ||
        a->curve->n_point != b->curve->n_point)
        return false;
    for (int i = 0; i < a->n_stages; i++)
        if (a->stages[i].stroke != b->stages[i].stroke || a->stages[i].force != b->stages[i].force)
            return false;
    for (int i = 0; i < a->curve->n_point; i++)
        if (a->curve->x[i] != b->curve->x[i] || a->curve->y[i] != b->curve->y[i])
            return false;
    return true;
}

/* Whether a device of an earlier end is like this one. */
static bool was_seen(const Device *device, int n_end, const CzVehicle *vehicle) {
    for (int i = 0; i < n_end; i++) {
        const CzEnd *end = i % 2 == 0 ? &vehicle[i / 2].rear : &vehicle[i / 2].front;
        Device earlier[MOST_DEVICES];
        const int n_earlier = end->given ? list_devices(end, earlier) : 0;
        for (int j = 0; j < n_earlier; j++)
            if (is_alike(device, &earlier[j]))
                return true;
    }
    return false;
}

double cz_train_part_count(int n_vehicle, const CzVehicle *vehicle) {
    int n_part = 0;
    bool any = false;
    for (int i = 0; i < 2 * n_vehicle; i++) {
        const CzEnd *end = i % 2 == 0 ? &vehicle[i / 2].rear : &vehicle[i / 2].front;
        Device device[MOST_DEVICES];
        const int n_device = end->given ? list_devices(end, device) : 0;
        for (int j = 0; j < n_device; j++) {
            any = true;
            bool seen = was_seen(&device[j], i, vehicle);
            for (int k = 0; k < j && !seen; k++)
                seen = is_alike(&device[j], &device[k]);
            n_part += !seen;
        }
    }
    return any ? n_part : NAN;
}
