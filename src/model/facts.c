/* Facts of vehicles and interfaces: loads at rest, frequencies, the coupler as a strut.
 *
 *   F_crit = k_end l / 2 + 2 K_theta / l,   k_end = 2 k / (1 + (a / l_c)^2)
 *
 * l is the strut's length between its pivots, K_theta the stiffness of a hinge, k a bogie's
 * secondary suspension in series with its two primaries, a the pivot's distance from the body's
 * centre of gravity and l_c half the bogie spacing. Above F_crit the strut swings out.
 */
#include "base/error.h"
#include "model/fill.h"
#include "model/own_design.h"
#include "model/vertical_modes.h"

static CzVehicleFacts no_vehicle_facts(void) {
    CzVehicleFacts facts = {.mass = NAN, .bounce_frequency = NAN, .pitch_frequency = NAN};
    for (int bogie = 0; bogie < 2; bogie++)
        facts.secondary_deflection[bogie] = NAN;
    for (int axle = 0; axle < 4; axle++) {
        facts.axle_load[axle] = NAN;
        facts.primary_deflection[axle] = NAN;
    }
    return facts;
}

static CzVehicleFacts vehicle_facts(const CzVehicle *vehicle, const CzStatics *statics) {
    const CzVerticalModes modes = cz_vertical_modes(vehicle, statics);
    CzVehicleFacts facts = {
        .mass = statics->mass, .bounce_frequency = modes.bounce, .pitch_frequency = modes.pitch};
    for (int bogie = 0; bogie < 2; bogie++)
        facts.secondary_deflection[bogie] =
            statics->secondary_load[bogie] / vehicle->bogie.secondary.stiffness;
    for (int axle = 0; axle < 4; axle++) {
        facts.axle_load[axle] = statics->wheel_load[axle];
        facts.primary_deflection[axle] =
            statics->primary_load[axle] / vehicle->bogie.primary.stiffness;
    }
    return facts;
}

/* ---- the coupler as a strut ---- */

static double smaller(double a, double b) {
    if (isnan(a))
        return b;
    return isnan(b) || a < b ? a : b;
}

/* F_crit of one side; NaN when its car does not move up and down. */
static double critical_force(const CzModel *model, const CzLanes *lanes, int interface,
                             const int lane[2], int side) {
    const int own = lane[CZ_SIDE_A], car = lane[side];
    if (model->car[interface + side].model != CZ_MODEL_FULL)
        return NAN;
    const double secondary = cz_lane_value(lanes, car, CZ_P_SECONDARY_STIFFNESS);
    const double primaries = 2.0 * cz_lane_value(lanes, car, CZ_P_PRIMARY_STIFFNESS);
    const double spring = secondary * primaries / (secondary + primaries);
    const double half_spacing = cz_lane_value(lanes, car, CZ_P_BOGIE_X);
    const double length = cz_lane_value(lanes, own, CZ_P_COUPLER_LENGTH);
    const double hinge = cz_lane_value(lanes, own, CZ_OF_SIDE(CZ_P_HINGE_STIFFNESS, side));
    double arm = cz_lane_value(lanes, own, side == CZ_SIDE_A ? CZ_P_PIVOT_X_A : CZ_P_PIVOT_X_B);
    if (cz_lane_value(lanes, own, CZ_OF_SIDE(CZ_P_COUPLER_ON_END, side)) > 0.0)
        arm += cz_lane_value(lanes, car, side == CZ_SIDE_A ? CZ_P_END_X_FRONT : CZ_P_END_X_REAR);
    const double lever = arm / half_spacing;
    return spring / (1.0 + lever * lever) * length + 2.0 * hinge / length;
}

double cz_critical_force(const CzModel *model, const CzLanes *lanes, int interface,
                         const int lane[2]) {
    if (!(cz_lane_value(lanes, lane[CZ_SIDE_A], CZ_P_COUPLER) > 0.0))
        return NAN;
    return smaller(critical_force(model, lanes, interface, lane, CZ_SIDE_A),
                   critical_force(model, lanes, interface, lane, CZ_SIDE_B));
}

/* Largest strength of a tube before it bottoms out. */
static double largest_strength(const CzLanes *lanes, CzCurveId id, int lane) {
    const CzCurveLanes *curve = &lanes->curve[id];
    double largest = curve->start[lane];
    for (int i = 0; i < curve->n_kink; i++) {
        const double x = curve->at[(size_t)i * lanes->stride + (size_t)lane];
        double value = curve->start[lane];
        for (int j = 0; j < curve->n_kink; j++) {
            const size_t slot = (size_t)j * lanes->stride + (size_t)lane;
            value += curve->slope_change[slot] * fmax(x - curve->at[slot], 0.0);
        }
        if (x <= curve->usable[lane] && value > largest)
            largest = value;
    }
    return largest;
}

/* Largest plastic force of one side before it shears off; NaN without tubes. */
static double tube_force(const CzLanes *lanes, int interface, int side) {
    const double first = largest_strength(lanes, CZ_OF_SIDE(CZ_CURVE_TUBE, side), interface);
    const double second =
        largest_strength(lanes, CZ_OF_SIDE(CZ_CURVE_SECOND_TUBE, side), interface);
    const double shear = cz_lane_value(lanes, interface, CZ_OF_SIDE(CZ_P_SHEAR_FORCE, side));
    if (first >= CZ_NEVER && second >= CZ_NEVER)
        return NAN;
    const double largest = first >= CZ_NEVER    ? second
                           : second >= CZ_NEVER ? first
                                                : fmax(first, second);
    return fmin(largest, shear);
}

static CzInterfaceFacts interface_facts(const CzModel *model, const CzLanes *lanes,
                                        const CzVehicle *vehicles, int interface) {
    CzInterfaceFacts facts = {
        .strut_length = NAN, .critical_force = NAN, .tube_force = NAN, .anti_climber_gap = NAN};
    if (cz_lane_value(lanes, interface, CZ_P_COUPLER) > 0.0) {
        if (cz_lane_value(lanes, interface, CZ_P_TILTS) > 0.0)
            facts.strut_length = cz_lane_value(lanes, interface, CZ_P_COUPLER_LENGTH);
        facts.critical_force =
            cz_critical_force(model, lanes, interface, (const int[]){interface, interface + 1});
        facts.tube_force = smaller(tube_force(lanes, interface, CZ_SIDE_A),
                                   tube_force(lanes, interface, CZ_SIDE_B));
    }
    const CzEnd *a = &vehicles[model->car[interface].vehicle].front;
    const CzEnd *b = &vehicles[model->car[interface + 1].vehicle].rear;
    if ((a->given && a->anti_climber.given) || (b->given && b->anti_climber.given))
        facts.anti_climber_gap = cz_lane_value(lanes, interface, CZ_P_FACE_GAP);
    return facts;
}

CzStatus cz_model_find_facts(CzModel *model, CzLanes *lanes, CzError *error) {
    int n_vehicle;
    const CzVehicle *vehicles = cz_problem_vehicles(model->problem, &n_vehicle);
    const CzFill fill = {
        .model = model, .vehicles = vehicles, .baseline = vehicles, .lanes = lanes, .error = error};
    const size_t n = (size_t)model->n_car;
    model->facts = cz_arena_allocate(&model->arena, n, sizeof *model->facts);
    model->interface_facts = cz_arena_allocate(&model->arena, n, sizeof *model->interface_facts);
    if (model->facts == NULL || model->interface_facts == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %d cars", model->n_car);
    for (int car = 0; car < model->n_car; car++) {
        CzStatics statics;
        CZ_TRY(cz_fill_statics(&fill, car, &statics));
        model->facts[car] = model->car[car].model == CZ_MODEL_FULL
                                ? vehicle_facts(cz_fill_vehicle(&fill, car), &statics)
                                : no_vehicle_facts();
    }
    for (int interface = 0; interface < model->n_car - 1; interface++)
        model->interface_facts[interface] = interface_facts(model, lanes, vehicles, interface);
    return CZ_OK;
}
