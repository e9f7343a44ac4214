/* Devices of a vehicle end as written.
 *
 *   length of a device  = installed length when declared, else stroke / efficiency
 *   anti-climber's path = gap + length + crush zone of the end
 *   coupler's path      = buffer stroke + lengths of its tubes  <=  pivot to face
 *   retraction          = stroke of anti-climber and end that the released coupler must yield
 */
#include "evaluate/devices.h"

#include <math.h>

#include "problem/strokes.h"

enum { MAX_DEVICES = 4 }; /* of one end: two tubes, an anti-climber, a side buffer's tube */

/* The collapsing device at a place of an end. */
static CzDevice device_of(const CzEnd *end, int place) {
    const CzDevice devices[MAX_DEVICES] = {
        CZ_DEVICE(&end->coupler.tube), CZ_DEVICE(&end->coupler.second_tube),
        CZ_DEVICE(&end->anti_climber), CZ_DEVICE(&end->side_buffers.tube)};
    CzDevice device = devices[place];
    if (place == MAX_DEVICES - 1)
        device.count *= end->side_buffers.count;
    return device;
}

/* Installed length as declared, else by the efficiency; 0 without a device. */
static double installed_length(CzDevice device) {
    return isnan(*device.installed_length) ? cz_device_stroke(device) / device.efficiency
                                           : *device.installed_length;
}

double cz_stroke_fit(const CzEnd *end) {
    double worst = NAN;
    for (int i = 0; i < MAX_DEVICES; i++) {
        const CzDevice device = device_of(end, i);
        if (device.given)
            worst = fmax(worst,
                         cz_device_stroke(device) / (device.efficiency * *device.installed_length));
    }
    return worst;
}

double cz_length_used(const CzEnd *end) {
    const CzAntiClimber *device = &end->anti_climber;
    const double stroke = cz_free_stroke(end);
    double path = end->face_gap + stroke;
    if (device->given)
        path = fmax(path, device->gap + installed_length(CZ_DEVICE(device)) + stroke);
    return path / end->available_length;
}

double cz_length_before(const CzEnd *end) {
    return isnan(end->available_length) ? end->face_gap + cz_free_stroke(end)
                                        : end->available_length;
}

double cz_coupler_length_used(const CzEnd *end) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given)
        return NAN;
    double length = cz_total_stroke(coupler->buffer.stages, coupler->buffer.n_stages, NULL);
    length += installed_length(CZ_DEVICE(&coupler->tube));
    length += installed_length(CZ_DEVICE(&coupler->second_tube));
    return length / coupler->length;
}

double cz_retraction_used(const CzEnd *end) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given || !coupler->shear_off.given)
        return NAN;
    const double behind = coupler->anchor == CZ_ANCHOR_END ? 0 : cz_free_stroke(end);
    const double needed = cz_device_stroke(CZ_DEVICE(&end->anti_climber)) + behind;
    return needed > 0 ? needed / coupler->shear_off.retraction_space : 0;
}

/* Largest force of stages and of a curve. */
static double backbone_force(const CzStage *stages, int n_stages, const CzTable *curve) {
    double force = 0;
    for (int i = 0; i < n_stages; i++)
        force = fmax(fmax(force, stages[i].force), stages[i].end_force); /* ignores NaN */
    for (int i = 0; i < curve->n_point; i++)
        force = fmax(force, curve->y[i]);
    return force;
}

/* Largest plastic force of a device at a crush rate, all of them together; 0 when absent. */
static double device_force(CzDevice device, double rate) {
    const double force =
        fmax(backbone_force(device.stages, device.n_stages, device.curve), *device.trigger);
    return device.given ? device.count * force * (1 + *device.rate_factor * rate) : 0;
}

static double anti_climber_force(const CzAntiClimber *device, double rate) {
    return device_force(CZ_DEVICE(device), rate) *
           (1 + device->speed_factor * rate / device->speed_reference);
}

/* The larger of the two tubes. */
static double tubes_force(const CzCoupler *coupler, double rate) {
    return fmax(device_force(CZ_DEVICE(&coupler->tube), rate),
                device_force(CZ_DEVICE(&coupler->second_tube), rate));
}

static double last_stage_force(const CzBuffer *buffer) {
    return buffer->n_stages > 0 ? buffer->stages[buffer->n_stages - 1].force : 0;
}

static double coupler_force(const CzCoupler *coupler, double rate) {
    const double tubes = tubes_force(coupler, rate);
    return tubes > 0 ? tubes : last_stage_force(&coupler->buffer);
}

static double side_buffers_force(const CzSideBuffers *side, double rate) {
    const double tube = device_force(CZ_DEVICE(&side->tube), rate);
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

/* Force at which stages or a curve begin to crush; 0 without any. */
static double first_force(const CzStage *stages, int n_stages, const CzTable *curve) {
    if (n_stages > 0)
        return stages[0].force;
    for (int i = 0; i < curve->n_point; i++)
        if (curve->y[i] > 0)
            return curve->y[i];
    return 0;
}

/* The same of a device, all of them together, at a crush rate: its trigger where that is larger. */
static double device_crushing_force(CzDevice device, double rate) {
    const double force =
        fmax(first_force(device.stages, device.n_stages, device.curve), *device.trigger);
    return device.given ? device.count * force * (1 + *device.rate_factor * rate) : 0;
}

double cz_crushing_force(const CzEnd *end, CzElementKind kind, double rate) {
    const CzAntiClimber *face = &end->anti_climber;
    const double tube = device_crushing_force(CZ_DEVICE(&end->coupler.tube), rate);
    const double second = device_crushing_force(CZ_DEVICE(&end->coupler.second_tube), rate);
    if (kind == CZ_ELEMENT_END)
        return first_force(end->stages, end->n_stages, &end->curve);
    if (kind == CZ_ELEMENT_ANTI_CLIMBER)
        return device_crushing_force(CZ_DEVICE(face), rate) *
               (1 + face->speed_factor * rate / face->speed_reference);
    return tube > 0 && second > 0 ? fmin(tube, second) : fmax(tube, second);
}

double cz_tube_over_shear_off(const CzEnd *end, double rate) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given || !coupler->shear_off.given)
        return NAN;
    return tubes_force(coupler, rate) / coupler->shear_off.force;
}

double cz_shear_off_over_strength(const CzEnd *end) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given || !coupler->shear_off.given)
        return 0;
    return coupler->shear_off.force / end->proof_strength;
}

double cz_buffer_over_tube(const CzEnd *end) {
    const CzCoupler *coupler = &end->coupler;
    if (!coupler->given || !coupler->tube.given)
        return NAN;
    const double standing = 0; /* at this rate the tube is weakest */
    return last_stage_force(&coupler->buffer) /
           cz_crushing_force(end, CZ_ELEMENT_COUPLER, standing);
}

double cz_anti_climber_over_end(const CzEnd *end, double rate) {
    const double behind = cz_plastic_force(end, CZ_ELEMENT_END, rate);
    return end->anti_climber.given && behind > 0
               ? anti_climber_force(&end->anti_climber, rate) / behind
               : NAN;
}

double cz_end_over_strength(const CzEnd *end) {
    double force = backbone_force(NULL, 0, &end->curve);
    for (int i = 0; i < end->n_stages; i++)
        if (end->stages[i].zone != CZ_ZONE_SURVIVAL)
            force = fmax(fmax(force, end->stages[i].force), end->stages[i].end_force);
    return force > 0 ? force / end->proof_strength : 0;
}

double cz_force_ladder(const CzEnd *end, double rate) {
    const double of_strength[] = {cz_shear_off_over_strength(end), cz_end_over_strength(end)};
    if (isnan(of_strength[0]) || isnan(of_strength[1]))
        return NAN;
    const double of_coupler = fmax(cz_buffer_over_tube(end), cz_tube_over_shear_off(end, rate));
    return fmax(fmax(of_strength[0], of_strength[1]),
                fmax(of_coupler, cz_anti_climber_over_end(end, rate))); /* ignores NaN */
}

/* The device at a place of a train, counted from the first vehicle, rear before front. */
static CzDevice device_at(const CzVehicle *vehicle, int place) {
    const int i = place / MAX_DEVICES;
    return device_of(i % 2 == 0 ? &vehicle[i / 2].rear : &vehicle[i / 2].front,
                     place % MAX_DEVICES);
}

static int n_place(int n_vehicle) {
    return 2 * n_vehicle * MAX_DEVICES;
}

static double device_mass(CzDevice device) {
    return device.mass_per_stroke * cz_device_stroke(device);
}

/* Adds up a quantity of all devices of a train. */
static double sum_devices(int n_vehicle, const CzVehicle *vehicle, double (*quantity)(CzDevice)) {
    double sum = NAN;
    for (int i = 0; i < n_place(n_vehicle); i++) {
        const CzDevice device = device_at(vehicle, i);
        if (device.given)
            sum = (isnan(sum) ? 0 : sum) + device.count * quantity(device);
    }
    return sum;
}

double cz_train_installed_length(int n_vehicle, const CzVehicle *vehicle) {
    return sum_devices(n_vehicle, vehicle, installed_length);
}

double cz_train_absorber_mass(int n_vehicle, const CzVehicle *vehicle) {
    return sum_devices(n_vehicle, vehicle, device_mass);
}

/* Whether two devices are the same part. */
static bool is_alike(const CzDevice *a, const CzDevice *b) {
    if (cz_device_stroke(*a) != cz_device_stroke(*b) || a->n_stages != b->n_stages ||
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
    for (int i = 0; i < n_place(n_vehicle); i++) {
        const CzDevice device = device_at(vehicle, i);
        bool is_new = device.given;
        for (int k = 0; k < i && is_new; k++) {
            const CzDevice earlier = device_at(vehicle, k);
            is_new = !earlier.given || !is_alike(&device, &earlier);
        }
        n_part += is_new;
        any |= device.given;
    }
    return any ? n_part : NAN;
}
