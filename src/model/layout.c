/* Places of the cars: from the gaps between the faces of neighbouring ends, added up along the
 * train.
 *
 *   x_B - x_A = (plane_A - gap_A) + gap of the faces + (plane_B - gap_B)
 */
#include "model/layout.h"

#include "base/error.h"
#include "model/fill.h"

/* Half length in figures of a vehicle without a length [m] (ours). */
static double drawn_half(const CzModel *model, int car) {
    return model->car[car].model == CZ_MODEL_FIXED ? 1.0 : 10.0;
}

/* Distance of an end's face from the body's centre of gravity, outwards. For a vehicle without a
 * length the face's arm starts at the foremost plane instead. */
static double face(const CzModel *model, const CzVehicle *vehicles, const CzPairRows *contact,
                   int interface, int side) {
    const int place = interface + side;
    const CzCar *car = &model->car[place];
    const CzVehicle *vehicle = &vehicles[car->vehicle];
    const CzEnd *end = cz_end_of(vehicle, side == CZ_SIDE_A ? CZ_FRONT : CZ_REAR);
    const double x = contact->x[side][interface % CZ_LANE_BLOCK];
    return (side == CZ_SIDE_A ? x : -x) + (car->model == CZ_MODEL_FULL ? end->distance : 0.0) +
           (isnan(vehicle->length) ? drawn_half(model, place) : 0.0);
}

CzStatus cz_model_layout(const CzModel *model, CzLayout *stand, CzError *error) {
    CzArena arena = {0};
    int n_vehicle;
    const CzVehicle *vehicles = cz_problem_vehicles(model->problem, &n_vehicle);
    CzLanes *lanes = cz_model_lanes(model, 1, &arena);
    CzStatus status = lanes == NULL ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a picture")
                                    : cz_model_fill(model, vehicles, 0, lanes, error);
    for (int car = 0; status == CZ_OK && car < model->n_car; car++) {
        const double length = vehicles[model->car[car].vehicle].length;
        stand[car] = (CzLayout){0};
        for (int end = CZ_REAR; end <= CZ_FRONT; end++)
            stand[car].plane[end] = isnan(length) ? drawn_half(model, car) : length / 2.0;
        if (car == 0)
            continue;
        const CzLane at = cz_lane_at(lanes, (size_t)car - 1);
        const CzPairRows *contact = &at.rows->face.contact;
        stand[car].x = stand[car - 1].x + face(model, vehicles, contact, car - 1, CZ_SIDE_A) +
                       contact->distance[at.i] + face(model, vehicles, contact, car - 1, CZ_SIDE_B);
        if (car - 1 == model->colliding || car - 1 == model->perturbed)
            stand[car].rise = contact->rise[at.i];
    }
    cz_arena_free(&arena);
    return status;
}
