/* Recorded time histories of a single design: one column each, its unit in its name. */
#include "simulate/run.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NEVER                                                                                      \
    1e29 /* a strength or an overlap from here on stands for a member that is not there            \
          */

typedef struct {
    CzChannels *channels;
    const CzBatch *batch;
    bool names; /* first pass: write names; later: write values */
    int index;
} Writer;

/* Next channel: counts it, names it or writes its value. */
__attribute__((format(printf, 3, 4))) static void put(Writer *writer, double value,
                                                      const char *format, ...) {
    CzChannels *channels = writer->channels;
    if (writer->names && channels->name != NULL) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(channels->name[writer->index], sizeof channels->name[0], format, arguments);
        va_end(arguments);
    }
    if (!writer->names)
        channels->value[writer->index][channels->n_sample] = value;
    ++writer->index;
}

static void put_car(Writer *writer, int car) {
    const CzBatch *batch = writer->batch;
    const CzCar *description = &batch->model->car[car];
    const size_t lane = cz_lane(batch, car, 0);
    const char *name = description->name;
    const double acceleration =
        cz_block_of(batch->dynamics, lane)->acceleration[CZ_DOF_BODY_X][lane % CZ_LANE_BLOCK];
    put(writer, cz_position(batch, CZ_DOF_BODY_X, lane), "x_%s_m", name);
    put(writer, cz_velocity(batch, CZ_DOF_BODY_X, lane), "v_%s_m_s", name);
    put(writer, acceleration / 9.80665, "a_%s_g", name);
    if (description->model != CZ_MODEL_FULL)
        return;
    put(writer, 1e3 * cz_position(batch, CZ_DOF_BODY_Z, lane), "z_%s_mm", name);
    put(writer, 1e3 * cz_position(batch, CZ_DOF_BODY_PITCH, lane), "pitch_%s_mrad", name);
    for (int axle = 0; axle < 4; ++axle) {
        const double lift = -cz_scratch(batch, CZ_S_WHEEL_APPROACH_0 + axle, lane);
        put(writer, 1e3 * lift, "z_%s_w%d_mm", name, axle + 1);
    }
    static const char *const end_name[] = {"rear", "front"};
    for (int end = 0; end < 2; ++end) {
        put(writer, 1e-3 * cz_scratch(batch, CZ_S_END_REAR + end, lane), "F_end_%s_%s_kN",
            end_name[end], name);
        put(writer, 1e3 * cz_scratch(batch, CZ_S_END_STROKE_REAR + end, lane), "d_end_%s_%s_mm",
            end_name[end], name);
    }
}

/* Strokes of the anti-climbers, and what keeps the faces from climbing. */
static void put_face(Writer *writer, int interface) {
    const CzBatch *batch = writer->batch;
    const size_t lane = cz_lane(batch, interface, 0);
    const CzCar *car = &batch->model->car[interface];
    for (int side = 0; side < 2; ++side)
        if (batch->lanes->curve[CZ_CURVE_FACE_A + side].start[lane] < NEVER)
            put(writer, 1e3 * cz_memory(batch, CZ_M_FACE_A + side, lane), "d_anti-climber_%s_%s_mm",
                side == 0 ? "front" : "rear", car[side].name);
    const bool pushes = cz_scratch(batch, CZ_S_FACE_FORCE, lane) > 0.0;
    if (cz_parameter(batch, CZ_P_FACE_OVERLAP, lane) < NEVER) /* there is none until they meet */
        put(writer, pushes ? 1e3 * cz_scratch(batch, CZ_S_FACE_REMAINING, lane) : NAN,
            "overlap_%s_mm", batch->model->interface_name[interface]);
}

static void put_interface(Writer *writer, int interface) {
    const CzBatch *batch = writer->batch;
    const size_t lane = cz_lane(batch, interface, 0), ahead = cz_lane(batch, interface + 1, 0);
    const char *name = batch->model->interface_name[interface];
    const double closure =
        cz_position(batch, CZ_DOF_BODY_X, lane) - cz_position(batch, CZ_DOF_BODY_X, ahead);
    put(writer, 1e-3 * cz_scratch(batch, CZ_S_INTERFACE_FORCE, lane), "F_%s_kN", name);
    put(writer, 1e3 * closure, "d_%s_mm", name);
    if (cz_parameter(batch, CZ_P_COUPLER, lane) > 0.5)
        put(writer, 1e-3 * cz_scratch(batch, CZ_S_COUPLER_FORCE, lane), "F_coupler_%s_kN", name);
    put(writer, 1e-3 * cz_scratch(batch, CZ_S_FACE_FORCE, lane), "F_anti-climber_%s_kN", name);
    put(writer, 1e-3 * cz_scratch(batch, CZ_S_FACE_DEMAND, lane), "Fz_anti-climber_%s_kN", name);
    if (cz_parameter(batch, CZ_P_SIDE_BUFFERS, lane) > 0.5)
        put(writer, 1e-3 * cz_scratch(batch, CZ_S_SIDE_FORCE, lane), "F_side-buffers_%s_kN", name);
    put_face(writer, interface);
    put(writer, 1e-3 * cz_interface_energy(batch, interface, 0), "E_%s_kJ", name);
}

/* Energy so far: where it is now, and what does not add up. */
static void put_energy(Writer *writer) {
    const CzBatch *batch = writer->batch;
    const CzEnergy energy = cz_energy_fill(batch, 0);
    const double kinetic = energy.final_kinetic, work = cz_total_work(batch, 0);
    put(writer, 1e-3 * kinetic, "E_kinetic_kJ");
    put(writer, 1e-3 * work, "E_taken_up_kJ");
    put(writer, 1e-3 * energy.wheel_rail, "E_wheel_rail_kJ");
    put(writer, 1e-3 * energy.running_gear, "E_running_gear_kJ");
    put(writer, 1e-3 * energy.track, "E_track_kJ");
    put(writer, 1e-3 * energy.stored, "E_stored_kJ");
    put(writer, 1e-3 * cz_balance_residual(batch, 0), "E_imbalance_kJ");
}

static void put_all(Writer *writer) {
    const CzBatch *batch = writer->batch;
    put(writer, 1e3 * batch->time, "t_ms");
    for (int car = 0; car < batch->model->n_car; ++car)
        put_car(writer, car);
    for (int interface = 0; interface + 1 < batch->model->n_car; ++interface)
        put_interface(writer, interface);
    put_energy(writer);
}

CzStatus cz_channels_begin(CzChannels *channels, const CzBatch *batch) {
    memset(channels, 0, sizeof *channels);
    Writer count = {channels, batch, true, 0};
    put_all(&count);
    channels->name = malloc((size_t)count.index * sizeof channels->name[0]);
    channels->value = calloc((size_t)count.index, sizeof channels->value[0]);
    if (channels->name == NULL || channels->value == NULL)
        return CZ_STATUS_NO_MEMORY;
    channels->n_channel = count.index;
    Writer names = {channels, batch, true, 0};
    put_all(&names);
    return CZ_OK;
}

CzStatus cz_channels_add(CzChannels *channels, const CzBatch *batch) {
    if (channels->n_sample == channels->capacity) {
        const int capacity = channels->capacity == 0 ? 1024 : 2 * channels->capacity;
        for (int i = 0; i < channels->n_channel; ++i) {
            double *longer = realloc(channels->value[i], (size_t)capacity * sizeof *longer);
            if (longer == NULL)
                return CZ_STATUS_NO_MEMORY;
            channels->value[i] = longer;
        }
        channels->capacity = capacity;
    }
    Writer values = {channels, batch, false, 0};
    put_all(&values);
    ++channels->n_sample;
    return CZ_OK;
}

void cz_channels_blank_totals(CzChannels *channels, double from) {
    for (int i = 0; i < channels->n_channel; ++i) {
        if (strncmp(channels->name[i], "E_", 2) != 0 ||
            strcmp(channels->name[i], "E_imbalance_kJ") == 0)
            continue;
        for (int k = 0; k < channels->n_sample; ++k)
            if (1e-3 * channels->value[0][k] > from)
                channels->value[i][k] = NAN;
    }
}

void cz_channels_free(CzChannels *channels) {
    for (int i = 0; i < channels->n_channel; ++i)
        free(channels->value[i]);
    free(channels->value);
    free(channels->name);
    memset(channels, 0, sizeof *channels);
}
