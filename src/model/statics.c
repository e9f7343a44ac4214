/* Masses and static loads of a car on the rigid track, in closed form.
 *
 *   body = (mass - bogies - wheelsets - ends) * mass factor + payload * share + absorbers
 *   F_front + F_rear = (body + ends) g         (F_front - F_rear) l_c = (m_ef d_f - m_er d_r) g
 *
 * The body's centre of gravity is midway between the foremost planes of the car as given in its
 * file. Absorbers longer than `drawn_stroke` (by default the stroke in the file) move their
 * foremost plane outwards by the additional stroke over the efficiency.
 */
#include "model/fill.h"

#include "base/error.h"
#include "base/gravity.h"
#include "problem/strokes.h"

static double device_mass(CzDevice device, int count) {
    return device.mass_per_stroke * device.count * count * cz_device_stroke(device);
}

static double absorber_mass(const CzEnd *end) {
    return device_mass(CZ_DEVICE(&end->coupler.tube), 1) +
           device_mass(CZ_DEVICE(&end->coupler.second_tube), 1) +
           device_mass(CZ_DEVICE(&end->anti_climber), 1) +
           device_mass(CZ_DEVICE(&end->side_buffers.tube), end->side_buffers.count);
}

/* Additional length of an end by an anti-climber with another stroke than the drawn one [m]. */
static double added_length(const CzEnd *end, const CzEnd *baseline) {
    const CzAntiClimber *device = &end->anti_climber;
    if (!device->given)
        return 0.0;
    const double drawn = isnan(device->drawn_stroke)
                             ? cz_device_stroke(CZ_DEVICE(&baseline->anti_climber))
                             : device->drawn_stroke;
    return (cz_device_stroke(CZ_DEVICE(device)) - drawn) / device->efficiency;
}

static CzStatus check_positive(const CzFill *fill, int car, const double *value, const char *what) {
    if (*value > 0.0 && isfinite(*value))
        return CZ_OK;
    return cz_fill_refuse(fill, (CzPartName){car, -1, car, ""}, value,
                          "%s is %g; it must be positive", what, *value);
}

/* Masses of a full car, and their static loads on springs and rails. */
static CzStatus full_statics(const CzFill *fill, int car, const CzVehicle *vehicle,
                             CzStatics *statics) {
    const CzScenario *scenario = fill->model->scenario;
    const CzPartName name = {car, -1, car, ""};
    if (!vehicle->rear.given || !vehicle->front.given)
        return cz_fill_refuse(fill, name, vehicle,
                              "a full vehicle needs both ends; its %s is missing",
                              vehicle->rear.given ? "front" : "rear");
    CZ_TRY(check_positive(fill, car, &vehicle->length, "length"));
    CZ_TRY(check_positive(fill, car, &vehicle->pitch_inertia, "pitch inertia"));
    CZ_TRY(check_positive(fill, car, &vehicle->bogie_spacing, "bogie spacing"));
    CZ_TRY(check_positive(fill, car, &vehicle->rear.mass, "mass of the rear end"));
    CZ_TRY(check_positive(fill, car, &vehicle->front.mass, "mass of the front end"));

    /* Masses. */
    const CzBogie *bogie = &vehicle->bogie;
    const double ends = vehicle->rear.mass + vehicle->front.mass;
    const double gear = 2.0 * bogie->mass + 4.0 * bogie->wheelset_mass;
    const double bare = vehicle->mass - gear - ends;
    if (!(bare > 0.0))
        return cz_fill_refuse(fill, name, &vehicle->mass,
                              "mass %g kg leaves no mass for the body: bogies and wheelsets have "
                              "%g kg, the ends %g kg",
                              vehicle->mass, gear, ends);
    statics->body_mass = bare * scenario->mass_factor + vehicle->payload * scenario->payload_share +
                         absorber_mass(&vehicle->rear) + absorber_mass(&vehicle->front);
    statics->body_inertia = vehicle->pitch_inertia * scenario->mass_factor;
    statics->mass = statics->body_mass + ends + gear;
    statics->weight = statics->mass * CZ_GRAVITY;

    /* Loads. */
    const double carried = (statics->body_mass + ends) * CZ_GRAVITY;
    const double moment = (vehicle->front.mass * vehicle->front.distance -
                           vehicle->rear.mass * vehicle->rear.distance) *
                          CZ_GRAVITY;
    for (int end = CZ_REAR; end <= CZ_FRONT; end++) {
        const double share = moment / vehicle->bogie_spacing;
        const double load = carried / 2.0 + (end == CZ_FRONT ? share : -share);
        if (!(load > 0.0))
            return cz_fill_refuse(fill, name, &vehicle->bogie_spacing,
                                  "the %s bogie carries no load at rest (%g kN)",
                                  end == CZ_FRONT ? "front" : "rear", load * 1e-3);
        statics->secondary_load[end] = load;
        for (int axle = 2 * end; axle < 2 * end + 2; axle++) {
            statics->primary_load[axle] = (load + bogie->mass * CZ_GRAVITY) / 2.0;
            statics->wheel_load[axle] =
                statics->primary_load[axle] + bogie->wheelset_mass * CZ_GRAVITY;
        }
    }
    return CZ_OK;
}

CzStatus cz_fill_statics(const CzFill *fill, int car, CzStatics *statics) {
    const CzCar *place = &fill->model->car[car];
    const CzVehicle *vehicle = cz_fill_vehicle(fill, car);
    const CzVehicle *baseline = &fill->baseline[place->vehicle];
    *statics = (CzStatics){0};
    for (int end = CZ_REAR; end <= CZ_FRONT; end++) {
        const double half = isnan(vehicle->length) ? 0.0 : vehicle->length / 2.0;
        statics->plane[end] =
            half + added_length(cz_end_of(vehicle, end), cz_end_of(baseline, end));
    }
    if (place->model == CZ_MODEL_FIXED) {
        const CzSlide *slide = cz_slide_of(vehicle);
        statics->body_mass = statics->mass = slide == NULL ? 0.0 : slide->mass;
        return CZ_OK;
    }
    CZ_TRY(check_positive(fill, car, &vehicle->mass, "mass"));
    if (place->model == CZ_MODEL_FULL)
        return full_statics(fill, car, vehicle, statics);

    const CzScenario *scenario = fill->model->scenario;
    const double ends =
        cz_fill_end_mass(fill, car, CZ_REAR) + cz_fill_end_mass(fill, car, CZ_FRONT);
    statics->body_mass = (vehicle->mass - ends) * scenario->mass_factor +
                         vehicle->payload * scenario->payload_share +
                         absorber_mass(&vehicle->rear) + absorber_mass(&vehicle->front);
    statics->mass = statics->body_mass + ends;
    statics->weight = statics->mass * CZ_GRAVITY;
    return CZ_OK;
}
