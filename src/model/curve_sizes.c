/* Number of breakpoints of each curve in the lanes: the largest over all cars and both ends. */
#include "model/curve_sizes.h"

#include "model/fill.h"

static void need(CzModel *model, CzCurveId id, int n_breakpoint) {
    if (n_breakpoint > model->n_breakpoint[id])
        model->n_breakpoint[id] = n_breakpoint;
}

static int in_tube(const CzTube *tube) {
    return tube->given ? cz_breakpoints_in_strength(tube->n_stages, &tube->curve) : 0;
}

static int in_buffer(const CzBuffer *buffer) {
    const CzTable none = {.given = false};
    return buffer->given ? cz_breakpoints_in_loading(buffer->n_stages, &none) : 0;
}

static void size_side(CzModel *model, const CzEnd *end, int side) {
    const CzCoupler *coupler = &end->coupler;
    if (coupler->given) {
        need(model, CZ_CURVE(buffer[side]), in_buffer(&coupler->buffer));
        need(model, CZ_CURVE(tube[side]), in_tube(&coupler->tube));
        need(model, CZ_CURVE(second_tube[side]), in_tube(&coupler->second_tube));
    }
    const CzAntiClimber *anti_climber = &end->anti_climber;
    if (anti_climber->given) {
        const int n = cz_breakpoints_in_strength(anti_climber->n_stages, &anti_climber->curve);
        need(model, CZ_CURVE(face[side]), n);
        if (anti_climber->in_line_with_buffers)
            need(model, CZ_CURVE(side_tube[side]), n);
    }
    if (end->side_buffers.given) {
        need(model, CZ_CURVE(side_buffer[side]), in_buffer(&end->side_buffers.buffer));
        need(model, CZ_CURVE(side_tube[side]), in_tube(&end->side_buffers.tube));
    }
}

static void size_end(CzModel *model, const CzVehicle *vehicle, int which) {
    const CzEnd *end = cz_end_of(vehicle, which);
    if (!cz_end_crushes(end))
        return;
    const int side = which == CZ_FRONT ? CZ_SIDE_A : CZ_SIDE_B;
    const int n_breakpoint = cz_breakpoints_in_loading(end->n_stages, &end->curve);
    if (cz_end_mass(vehicle, end) > 0.0)
        need(model, CZ_CURVE(end[which]), n_breakpoint);
    if (vehicle->model != CZ_MODEL_FULL)
        need(model, CZ_CURVE(massless[side]), n_breakpoint);
}

void cz_model_size_curves(CzModel *model, const CzVehicle *vehicles) {
    static const CzCurveId springs[] = {
        CZ_CURVE(end[0]),         CZ_CURVE(end[1]),         CZ_CURVE(buffer[0]),
        CZ_CURVE(buffer[1]),      CZ_CURVE(massless[0]),    CZ_CURVE(massless[1]),
        CZ_CURVE(side_buffer[0]), CZ_CURVE(side_buffer[1]),
    };
    for (size_t i = 0; i < sizeof springs / sizeof springs[0]; i++)
        need(model, springs[i], 1);
    for (int car = 0; car < model->n_car; car++) {
        const CzVehicle *vehicle = &vehicles[model->car[car].vehicle];
        for (int which = CZ_REAR; which <= CZ_FRONT; which++) {
            const CzEnd *end = cz_end_of(vehicle, which);
            if (!end->given)
                continue;
            size_end(model, vehicle, which);
            size_side(model, end, which == CZ_FRONT ? CZ_SIDE_A : CZ_SIDE_B);
        }
    }
}
