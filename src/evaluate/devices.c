/* Devices of a vehicle end as written.
 *
 *   length of a device  = installed length when declared, else stroke / efficiency
 *   anti-climber's path = gap + length + crush zone of the end
 *   coupler's path      = buffer stroke + lengths of its tubes  <=  pivot to face
 *   retraction          = stroke of anti-climber and end that the released coupler must follow
 */
#include "evaluate/devices.h"

#include <math.h>

#include "problem/strokes.h"

enum { MOST_DEVICES = 4 }; /* of one end: two tubes, an anti-climber, a side buffer's tube */

/* A collapsing device: length, mass and likeness. */
typedef struct Device {
    int count;
    double stroke, installed_length, efficiency, mass_per_stroke;
    const CzStage *stages;
    int n_stages;
    const CzTable *curve;
} Device;

static double buffer_stroke(const CzBuffer *buffer) {
    return buffer->given ? cz_total_stroke(buffer->stages, buffer->n_stages, NULL) : 0;
}

static double tube_stroke(const CzTube *tube) {
    return tube->given ? cz_total_stroke(tube->stages, tube->n_stages, &tube->curve) : 0;
}

static double anti_climber_stroke(const CzAntiClimber *device) {
    return device->given ? cz_total_stroke(device->stages, device->n_stages, &device->curve) : 0;
}

/* Stroke of an end's crush zone outside the survival space. */
static double end_stroke(const CzEnd *end) {
    if (end->n_stages == 0)
        return cz_total_stroke(NULL, 0, &end->curve);
    double stroke = 0;
    for (int i = 0; i < end->n_stages; i++)
        if (end->stages[i].zone != CZ_ZONE_SURVIVAL)
            stroke += end->stages[i].stroke;
    return stroke;
}

static Device tube_device(const CzTube *tube) {
    return (Device){tube->count,      tube_stroke(tube),     tube->installed_length,
                    tube->efficiency, tube->mass_per_stroke, tube->stages,
                    tube->n_stages,   &tube->curve};
}

static Device anti_climber_device(const CzAntiClimber *anti_climber) {
    return (Device){anti_climber->count,
                    anti_climber_stroke(anti_climber),
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

/* Installed length as declared, else by the efficiency. */
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
    double path = end->face_gap + end_stroke(end);
    if (end->anti_climber.given) {
        const Device device = anti_climber_device(&end->anti_climber);
        path = fmax(path, end->anti_climber.gap + installed_length(&device) + end_stroke(end));
    }
    return path / end->available_length;
}

double cz_coupler_length_used(const CzEnd *end) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given)
        return NAN;
    double length = buffer_stroke(&coupler->buffer);
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
    const double behind = coupler->anchor == CZ_ANCHOR_END ? 0 : end_stroke(end);
    const double needed = anti_climber_stroke(&end->anti_climber) + behind;
    return needed > 0 ? needed / coupler->shear_off.retraction_space : 0;
}

/* Largest force of stages and of a curve. */
static double backbone_force(const CzStage *stages, int n_stages, const CzTable *curve) {
    double force = 0;
    for (int i = 0; i < n_stages; i++)
        force = fmax(fmax(force, stages[i].force), stages[i].end_force); /* passes over NaN */
    for (int i = 0; i < curve->n_point; i++)
        force = fmax(force, curve->y[i]);
    return force;
}

/* Largest plastic force of a tube at a crush rate, all devices together; 0 when absent. */
static double tube_force(const CzTube *tube, double rate) {
    const double force =
        fmax(backbone_force(tube->stages, tube->n_stages, &tube->curve), tube->trigger);
    return tube->given ? tube->count * force * (1 + tube->rate_factor * rate) : 0;
}

static double anti_climber_force(const CzAntiClimber *climber, double rate) {
    const double force =
        fmax(backbone_force(climber->stages, climber->n_stages, &climber->curve), climber->trigger);
    return climber->given ? climber->count * force * (1 + climber->rate_factor * rate) *
                                (1 + climber->speed_factor * rate / climber->speed_reference)
                          : 0;
}

static double last_stage_force(const CzBuffer *buffer) {
    return buffer->n_stages > 0 ? buffer->stages[buffer->n_stages - 1].force : 0;
}

static double coupler_force(const CzCoupler *coupler, double rate) {
    const double tubes =
        fmax(tube_force(&coupler->tube, rate), tube_force(&coupler->second_tube, rate));
    return tubes > 0 ? tubes : last_stage_force(&coupler->buffer);
}

static double side_buffers_force(const CzSideBuffers *side, double rate) {
    const double tube = tube_force(&side->tube, rate);
    const double buffer = last_stage_force(&side->buffer);
    return side->count * (tube > 0 ? tube : buffer);
}

double cz_plastic_force(const CzEnd *end, CzElementKind kind, double rate) {
    switch (kind) {
    case CZ_ELEMENT_COUPLER:
        return coupler_force(&end->coupler, rate);
    case CZ_ELEMENT_ANTI_CLIMBER:
        return anti_climber_force(&end->anti_climber, rate);
    case CZ_ELEMENT_END:
        return backbone_force(end->stages, end->n_stages, &end->curve);
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

/* The device in one of the places of a train's ends; false where there is none. */
static bool device_at(const CzVehicle *vehicle, int place, Device *device) {
    const int i = place / MOST_DEVICES;
    const CzEnd *end = i % 2 == 0 ? &vehicle[i / 2].rear : &vehicle[i / 2].front;
    Device of_end[MOST_DEVICES];
    if (!end->given || place % MOST_DEVICES >= list_devices(end, of_end))
        return false;
    *device = of_end[place % MOST_DEVICES];
    return true;
}

static int n_place(int n_vehicle) {
    return 2 * n_vehicle * MOST_DEVICES;
}

static double device_mass(const Device *device) {
    return device->mass_per_stroke * device->stroke;
}

/* Adds up a quantity of all devices of a train. */
static double sum_devices(int n_vehicle, const CzVehicle *vehicle,
                          double (*quantity)(const Device *)) {
    double sum = NAN;
    Device device;
    for (int i = 0; i < n_place(n_vehicle); i++)
        if (device_at(vehicle, i, &device))
            sum = (isnan(sum) ? 0 : sum) + device.count * quantity(&device);
    return sum;
}

double cz_train_installed_length(int n_vehicle, const CzVehicle *vehicle) {
    return sum_devices(n_vehicle, vehicle, installed_length);
}

double cz_train_absorber_mass(int n_vehicle, const CzVehicle *vehicle) {
    return sum_devices(n_vehicle, vehicle, device_mass);
}

/* Whether two devices are the same part. */
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

double cz_train_part_count(int n_vehicle, const CzVehicle *vehicle) {
    int n_part = 0;
    bool any = false;
    Device device, earlier;
    for (int i = 0; i < n_place(n_vehicle); i++) {
        if (!device_at(vehicle, i, &device))
            continue;
        bool is_new = true;
        for (int k = 0; k < i && is_new; k++)
            is_new = !device_at(vehicle, k, &earlier) || !is_alike(&device, &earlier);
        n_part += is_new;
        any = true;
    }
    return any ? n_part : NAN;
}
