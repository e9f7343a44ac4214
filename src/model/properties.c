/* Properties of vehicles and interfaces before a run: loads at rest, frequencies, couplers. */
#include "base/error.h"
#include "model/fill.h"
#include "model/own_design.h"
#include "model/vertical_modes.h"

static CzVehicleProperties no_vehicle_properties(void) {
    CzVehicleProperties properties = {.mass = NAN, .bounce_frequency = NAN, .pitch_frequency = NAN};
    for (int bogie = 0; bogie < 2; bogie++)
        properties.secondary_deflection[bogie] = NAN;
    for (int axle = 0; axle < 4; axle++) {
        properties.axle_load[axle] = NAN;
        properties.primary_deflection[axle] = NAN;
    }
    return properties;
}

static CzVehicleProperties vehicle_properties(const CzVehicle *vehicle, const CzStatics *statics) {
    const CzVerticalModes modes = cz_vertical_modes(vehicle, statics);
    CzVehicleProperties properties = {
        .mass = statics->mass, .bounce_frequency = modes.bounce, .pitch_frequency = modes.pitch};
    for (int bogie = 0; bogie < 2; bogie++)
        properties.secondary_deflection[bogie] =
            statics->secondary_load[bogie] / vehicle->bogie.secondary.stiffness;
    for (int axle = 0; axle < 4; axle++) {
        properties.axle_load[axle] = statics->wheel_load[axle];
        properties.primary_deflection[axle] =
            statics->primary_load[axle] / vehicle->bogie.primary.stiffness;
    }
    return properties;
}

/* ---- couplers ---- */

/* Largest strength of a tube before it bottoms out. */
static double largest_strength(const CzCurveLanes *curve, size_t lane) {
    double largest = curve->start[lane];
    for (int i = 0; i < curve->n_breakpoint; i++) {
        const double x = curve->at[(size_t)i * curve->stride + lane];
        if (x <= curve->usable[lane])
            largest = fmax(largest, cz_curve_value(curve, lane, x));
    }
    return largest;
}

/* Largest plastic force of one side before it shears off; NaN without tubes. */
static double tube_force(const CzLanes *lanes, int interface, int side) {
    const CzLane at = cz_lane_at(lanes, (size_t)interface);
    const size_t lane = (size_t)interface;
    const double first = largest_strength(&lanes->curve[CZ_CURVE(tube[side])], lane);
    const double second = largest_strength(&lanes->curve[CZ_CURVE(second_tube[side])], lane);
    if (first >= CZ_NEVER && second >= CZ_NEVER)
        return NAN;
    const double largest = first >= CZ_NEVER    ? second
                           : second >= CZ_NEVER ? first
                                                : fmax(first, second);
    return fmin(largest, at.rows->coupler.side[side].shear.force[at.i]);
}

static CzInterfaceProperties interface_properties(const CzModel *model, const CzLanes *lanes,
                                                  const CzVehicle *vehicles, int interface,
                                                  double critical_force) {
    const CzLane at = cz_lane_at(lanes, (size_t)interface);
    const CzCouplerRows *coupler = &at.rows->coupler;
    CzInterfaceProperties properties = {.strut_length = NAN,
                                        .critical_force = critical_force,
                                        .tube_force = NAN,
                                        .anti_climber_gap = NAN};
    if (coupler->exists[at.i] > 0.0) {
        if (at.rows->tilts[at.i] > 0.0)
            properties.strut_length = coupler->length[at.i];
        properties.tube_force =
            fmin(tube_force(lanes, interface, CZ_SIDE_A), tube_force(lanes, interface, CZ_SIDE_B));
    }
    const CzEnd *a = &vehicles[model->car[interface].vehicle].front;
    const CzEnd *b = &vehicles[model->car[interface + 1].vehicle].rear;
    if ((a->given && a->anti_climber.given) || (b->given && b->anti_climber.given))
        properties.anti_climber_gap = at.rows->face.contact.distance[at.i];
    return properties;
}

static CzStatus find_interface_properties(CzModel *model, const CzLanes *lanes,
                                          const CzVehicle *vehicles, CzError *error) {
    double *force = cz_arena_allocate(&model->arena, (size_t)model->n_car, sizeof *force);
    if (force == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d cars", model->n_car);
    CZ_TRY(cz_critical_forces(model, lanes, 0, force, error));
    for (int i = 0; i < model->n_car - 1; i++)
        model->interface_properties[i] = interface_properties(model, lanes, vehicles, i, force[i]);
    return CZ_OK;
}

CzStatus cz_model_find_properties(CzModel *model, CzLanes *lanes, CzError *error) {
    int n_vehicle;
    const CzVehicle *vehicles = cz_problem_vehicles(model->problem, &n_vehicle);
    const CzFill fill = {
        .model = model, .vehicles = vehicles, .baseline = vehicles, .lanes = lanes, .error = error};
    const size_t n = (size_t)model->n_car;
    model->properties = cz_arena_allocate(&model->arena, n, sizeof *model->properties);
    model->interface_properties =
        cz_arena_allocate(&model->arena, n, sizeof *model->interface_properties);
    if (model->properties == NULL || model->interface_properties == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d cars", model->n_car);
    for (int car = 0; car < model->n_car; car++) {
        CzStatics statics;
        CZ_TRY(cz_fill_statics(&fill, car, &statics));
        model->properties[car] = model->car[car].model == CZ_MODEL_FULL
                                     ? vehicle_properties(cz_fill_vehicle(&fill, car), &statics)
                                     : no_vehicle_properties();
    }
    return find_interface_properties(model, lanes, vehicles, error);
}
