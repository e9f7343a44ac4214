/* Recorded time histories of a single design, in the units of channels.def. */
#include "simulate/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/gravity.h"

/* Passes over the columns of a batch: counts them, lists them, or writes their values. */
typedef struct {
    CzChannels *channels;
    const CzBatch *batch;
    bool values; /* write values; else list the columns once there is memory for them */
    int n;       /* columns so far */
} Writer;

/* The next column. */
static void put(Writer *writer, CzChannel channel, int place, double value) {
    CzChannels *channels = writer->channels;
    if (writer->values)
        channels->value[writer->n][channels->n_sample] = value;
    else if (channels->column != NULL)
        channels->column[writer->n] = (CzColumn){channel, place};
    ++writer->n;
}

static void put_car(Writer *writer, int car) {
    const CzBatch *batch = writer->batch;
    const CzCar *description = cz_car(batch, car, 0);
    const size_t lane = cz_lane(batch, car, 0);
    const double acceleration =
        cz_block_of(batch->dynamics, lane)->acceleration.body.x[lane % CZ_LANE_BLOCK];
    put(writer, CZ_CHANNEL_BODY_DISPLACEMENT, car, cz_position(batch, CZ_DOF(body.x), lane));
    put(writer, CZ_CHANNEL_BODY_SPEED, car, cz_velocity(batch, CZ_DOF(body.x), lane));
    put(writer, CZ_CHANNEL_BODY_ACCELERATION, car, acceleration / CZ_GRAVITY);
    if (description->model != CZ_MODEL_FULL)
        return;
    put(writer, CZ_CHANNEL_BODY_RISE, car, 1e3 * cz_position(batch, CZ_DOF(body.z), lane));
    put(writer, CZ_CHANNEL_BODY_PITCH, car, 1e3 * cz_position(batch, CZ_DOF(body.pitch), lane));
    for (int axle = 0; axle < 4; ++axle) {
        const double lift = -cz_published(batch, CZ_PUBLISHED(wheel[axle].approach), lane);
        put(writer, CZ_CHANNEL_WHEEL_LIFT, cz_wheelset_place(car, axle), 1e3 * lift);
    }
    for (int end = 0; end < 2; ++end) {
        const int place = cz_end_place(car, end);
        put(writer, CZ_CHANNEL_END_FORCE, place,
            1e-3 * cz_published(batch, CZ_PUBLISHED(end[end].force), lane));
        put(writer, CZ_CHANNEL_END_STROKE, place,
            1e3 * cz_published(batch, CZ_PUBLISHED(end[end].stroke), lane));
    }
}

/* Strokes of the anti-climbers, and their resistance to climbing. */
static void put_face(Writer *writer, int interface) {
    const CzBatch *batch = writer->batch;
    const size_t lane = cz_lane(batch, interface, 0);
    const CzInterfaceEquipment *of = &batch->equipment[lane];
    for (int side = 0; side < 2; ++side)
        if (of->side[side].has_anti_climber || of->side[side].presses_plates)
            put(writer, CZ_CHANNEL_ANTI_CLIMBER_STROKE, cz_end_place(interface + side, side == 0),
                1e3 * cz_memory(batch,
                                of->side[side].presses_plates
                                    ? CZ_MEMORY(side_buffers.side[side].tube)
                                    : CZ_MEMORY(face.side[side].stroke),
                                lane));
    const bool pushes = cz_published(batch, CZ_PUBLISHED(face.force), lane) > 0.0;
    if (of->can_climb) /* there is no overlap before contact */
        put(writer, CZ_CHANNEL_ANTI_CLIMBER_OVERLAP, interface,
            pushes ? 1e3 * cz_published(batch, CZ_PUBLISHED(face.remaining), lane) : NAN);
}

static void put_interface(Writer *writer, int interface) {
    const CzBatch *batch = writer->batch;
    const size_t lane = cz_lane(batch, interface, 0);
    const CzInterfaceEquipment *of = &batch->equipment[lane];
    put(writer, CZ_CHANNEL_INTERFACE_FORCE, interface,
        1e-3 * cz_published(batch, CZ_PUBLISHED(interface.force), lane));
    put(writer, CZ_CHANNEL_INTERFACE_CLOSURE, interface,
        1e3 * (cz_position(batch, CZ_DOF(body.x), lane) -
               cz_position(batch, CZ_DOF(body.x), cz_lane(batch, interface + 1, 0))));
    if (of->has_couplers)
        put(writer, CZ_CHANNEL_COUPLER_FORCE, interface,
            1e-3 * cz_published(batch, CZ_PUBLISHED(coupler.force), lane));
    put(writer, CZ_CHANNEL_ANTI_CLIMBER_FORCE, interface,
        1e-3 * cz_published(batch, CZ_PUBLISHED(face.force), lane));
    put(writer, CZ_CHANNEL_ANTI_CLIMBER_VERTICAL, interface,
        1e-3 * cz_published(batch, CZ_PUBLISHED(face.demand_vertical), lane));
    if (of->has_side_buffers)
        put(writer, CZ_CHANNEL_SIDE_BUFFER_FORCE, interface,
            1e-3 * cz_published(batch, CZ_PUBLISHED(side_buffers.force), lane));
    put_face(writer, interface);
    put(writer, CZ_CHANNEL_INTERFACE_ENERGY, interface,
        1e-3 * cz_interface_energy(batch, interface, 0));
}

/* Energy so far by its place, and the residual of its balance. */
static void put_energy(Writer *writer) {
    const CzBatch *batch = writer->batch;
    const CzEnergy energy = cz_energy_fill(batch, 0);
    put(writer, CZ_CHANNEL_KINETIC_ENERGY, 0, 1e-3 * energy.final_kinetic);
    put(writer, CZ_CHANNEL_ENERGY_TAKEN_UP, 0, 1e-3 * batch->design[0].work);
    put(writer, CZ_CHANNEL_WHEEL_RAIL_ENERGY, 0, 1e-3 * energy.wheel_rail);
    put(writer, CZ_CHANNEL_RUNNING_GEAR_ENERGY, 0, 1e-3 * energy.running_gear);
    put(writer, CZ_CHANNEL_TRACK_ENERGY, 0, 1e-3 * energy.track);
    put(writer, CZ_CHANNEL_STORED_ENERGY, 0, 1e-3 * energy.stored);
    put(writer, CZ_CHANNEL_ENERGY_IMBALANCE, 0, 1e-3 * cz_balance_residual(batch, 0));
}

static void put_all(Writer *writer) {
    const CzBatch *batch = writer->batch;
    cz_accounts_take(batch, 0);
    put(writer, CZ_CHANNEL_TIME, 0, 1e3 * batch->time);
    for (int car = 0; car < batch->n_car; ++car)
        put_car(writer, car);
    for (int interface = 0; interface + 1 < batch->n_car; ++interface)
        put_interface(writer, interface);
    put_energy(writer);
}

CzStatus cz_channels_begin(CzChannels *channels, const CzBatch *batch) {
    memset(channels, 0, sizeof *channels);
    Writer count = {channels, batch, false, 0};
    put_all(&count);
    channels->column = malloc((size_t)count.n * sizeof *channels->column);
    channels->value = calloc((size_t)count.n, sizeof *channels->value);
    if (channels->column == NULL || channels->value == NULL)
        return CZ_STATUS_NO_MEMORY;
    channels->n_column = count.n;
    Writer list = {channels, batch, false, 0};
    put_all(&list);
    return CZ_OK;
}

CzStatus cz_channels_add(CzChannels *channels, const CzBatch *batch) {
    if (channels->n_sample == channels->capacity) {
        const int capacity = channels->capacity == 0 ? 1024 : 2 * channels->capacity;
        for (int i = 0; i < channels->n_column; ++i) {
            double *longer = realloc(channels->value[i], (size_t)capacity * sizeof *longer);
            if (longer == NULL)
                return CZ_STATUS_NO_MEMORY;
            channels->value[i] = longer;
        }
        channels->capacity = capacity;
    }
    Writer values = {channels, batch, true, 0};
    put_all(&values);
    ++channels->n_sample;
    return CZ_OK;
}

void cz_channels_blank_totals(CzChannels *channels, double from) {
    for (int i = 0; i < channels->n_column; ++i) {
        if (!cz_channel_info(channels->column[i].channel)->is_total)
            continue;
        for (int k = 0; k < channels->n_sample; ++k)
            if (1e-3 * channels->value[0][k] > from)
                channels->value[i][k] = NAN;
    }
}

void cz_channels_free(CzChannels *channels) {
    for (int i = 0; i < channels->n_column; ++i)
        free(channels->value[i]);
    free(channels->value);
    free(channels->column);
    memset(channels, 0, sizeof *channels);
}
