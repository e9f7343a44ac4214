/* Events of a single design: the first time that something passes its threshold. */
#include "simulate/devices.h"

#include <math.h>
#include <stdio.h>

#define CRUSHED 1e-4 /* plastic stroke from which an element counts as crushed [m] (ours) */

/* Where a watched value comes from. */
typedef enum { FROM_MEMORY, FROM_EXTREME, FROM_LIFT_STOP, FROM_BUMP_STOP } Source;

typedef struct {
    Source source;
    int row; /* of the source; bogie for stops */
    size_t lane;
    const CzBlock *block; /* of the lane */
    double threshold;     /* passed when the value is larger */
    int named;            /* which event: index into CzWatch.named */
} Watched;

/* Values that change only while couplers, faces or side buffers push; values that limits guard. */
typedef enum { WHILE_PUSHED, GUARDED, N_TIME_WINDOW } When;

/* The lowest thresholds of the watched values in the lanes of a block. */
typedef struct {
    _Alignas(64) CzRow lift[4];  /* of the wheelsets */
    CzRow end[2];                /* largest shortening of the crush zones, rear and front */
    CzRow raised[2], pressed[2]; /* extension and compression of the secondary suspensions */
} Limits;

struct CzWatch {
    int n_watched[N_TIME_WINDOW], n_named, n_event;
    int interface; /* that is being listed; -1 when it is a vehicle */
    Watched *watched[N_TIME_WINDOW];
    CzEvent *named; /* (n_named): kind, place and interface of what is watched */
    Limits *limits; /* (n_block) */
    CzEvent *event;
};

enum { MOST_PER_CAR = 64 };

/* Whether a value can pass its threshold only while couplers, faces or side buffers push. Crush
 * zones behind an end mass also crush by its inertia. */
static When when_it_moves(const CzWatch *list, Source source, int row) {
    const bool is_end =
        source == FROM_MEMORY && (row == CZ_MEMORY(end[0].peak) || row == CZ_MEMORY(end[1].peak));
    return list->interface >= 0 && !is_end ? WHILE_PUSHED : GUARDED;
}

static void watch(CzWatch *list, const CzBatch *batch, CzEventKind what, Source source, int row,
                  size_t lane, double threshold, const char *kind, const char *name) {
    const When when = when_it_moves(list, source, row);
    CzEvent *named = &list->named[list->n_named];
    *named = (CzEvent){0.0, what, "", list->interface};
    snprintf(named->where, sizeof named->where, "%s%s%s", kind, kind[0] != '\0' ? " " : "", name);
    list->watched[when][list->n_watched[when]++] = (Watched){
        source, row, lane, cz_block_of(batch->dynamics, lane), threshold, list->n_named++};
}

/* Place of the second breakpoint: the end of the first stage. */
static double first_stage(const CzBatch *batch, int curve, size_t lane) {
    const CzCurveLanes *lanes = &batch->lanes->curve[curve];
    return lanes->n_breakpoint > 1 ? lanes->at[lanes->stride + lane] : INFINITY;
}

/* Strokes that are exhausted, but not of a reversible device that another one follows: that happens
 * in service. */
static void watch_devices(CzWatch *list, const CzBatch *batch, int interface, int side) {
    CzDevice device[CZ_N_DEVICE];
    const int n = cz_devices_list(batch, interface, 0, side, device);
    for (int i = 0; i < n; ++i)
        if (!device[i].is_reversible || !device[i].is_followed)
            watch(list, batch,
                  device[i].is_followed ? CZ_EVENT_TUBE_EXHAUSTED : CZ_EVENT_BOTTOMED_OUT,
                  device[i].from_extremes ? FROM_EXTREME : FROM_MEMORY, device[i].row,
                  device[i].lane, device[i].usable, device[i].text,
                  batch->model->car[interface + side].name);
}

static void watch_side(CzWatch *list, const CzBatch *batch, int interface, int side) {
    const size_t lane = cz_lane(batch, interface, 0), own = cz_lane(batch, interface + side, 0);
    const CzInterfaceEquipment *of = &batch->equipment[lane];
    const char *name = batch->model->car[interface + side].name;
    const int which = side == 0 ? 1 : 0;
    watch(list, batch, CZ_EVENT_TUBE_ACTIVATION, FROM_MEMORY, CZ_MEMORY(coupler.side[side].tube),
          lane, CRUSHED, "coupler", name);
    watch(list, batch, CZ_EVENT_SHEAR_OFF, FROM_MEMORY, CZ_MEMORY(coupler.side[side].shear), lane,
          CRUSHED, "coupler", name);
    watch(list, batch, CZ_EVENT_ANTI_CLIMBER_ACTIVATION, FROM_MEMORY,
          CZ_MEMORY(face.side[side].stroke), lane, CRUSHED, "anti-climber", name);
    watch(list, batch, CZ_EVENT_TUBE_ACTIVATION, FROM_MEMORY,
          CZ_MEMORY(side_buffers.side[side].tube), lane, CRUSHED, "side buffers", name);
    watch_devices(list, batch, interface, side);
    if (of->side[side].has_massless_end) {
        const int massless = CZ_CURVE(massless[side]);
        watch(list, batch, CZ_EVENT_END_CRUSH, FROM_MEMORY,
              CZ_MEMORY(face.side[side].massless.peak), lane, first_stage(batch, massless, lane),
              "end", name);
    }
    if (batch->model->car[interface + side].model == CZ_MODEL_FULL) {
        const int end = CZ_CURVE(end[which]);
        watch(list, batch, CZ_EVENT_END_CRUSH, FROM_MEMORY, CZ_MEMORY(end[which].peak), own,
              first_stage(batch, end, own), "end", name);
    }
    if (of->has_couplers)
        watch(list, batch, CZ_EVENT_SWING_STOP, FROM_EXTREME, CZ_EXTREME(swing_vertical[side]),
              lane, of->side[side].swing_stop, "coupler", name);
}

static void watch_interface(CzWatch *list, const CzBatch *batch, int interface) {
    const size_t lane = cz_lane(batch, interface, 0);
    const char *name = batch->model->interface_name[interface];
    watch(list, batch, CZ_EVENT_CONTACT, FROM_EXTREME, CZ_EXTREME(interface_force), lane, 1e3, "",
          name);
    watch(list, batch, CZ_EVENT_ANTI_CLIMBER_CONTACT, FROM_MEMORY, CZ_MEMORY(face.speed), lane, 0.0,
          "", name);
    watch(list, batch, CZ_EVENT_OVERRIDE, FROM_EXTREME, CZ_EXTREME(face_climbed), lane, 0.0, "",
          name);
    watch(list, batch, CZ_EVENT_SUPERSTRUCTURE_CRUSH, FROM_MEMORY, CZ_MEMORY(superstructure.set),
          lane, CRUSHED, "superstructures", name);
    for (int side = 0; side < 2; ++side)
        watch_side(list, batch, interface, side);
}

static void watch_car(CzWatch *list, const CzBatch *batch, int car) {
    static const char *const bogie_name[] = {"rear bogie", "front bogie"};
    const size_t lane = cz_lane(batch, car, 0);
    const CzCar *description = &batch->model->car[car];
    if (description->model != CZ_MODEL_FULL)
        return;
    for (int axle = 0; axle < 4; ++axle) {
        char kind[24];
        snprintf(kind, sizeof kind, "wheelset %d", axle + 1);
        watch(list, batch, CZ_EVENT_WHEEL_LIFT, FROM_EXTREME, CZ_EXTREME(lift[axle]), lane, 1e-3,
              kind, description->name);
        if (description->has_stops)
            watch(list, batch, CZ_EVENT_OVERRIDE, FROM_EXTREME, CZ_EXTREME(lift[axle]), lane,
                  batch->vehicles[0][description->vehicle].bogie.flange_height, kind,
                  description->name);
    }
    const CzCarEquipment of = cz_car_equipment(batch->lanes, lane);
    for (int bogie = 0; bogie < 2; ++bogie) {
        watch(list, batch, CZ_EVENT_LIFT_STOP, FROM_LIFT_STOP, bogie, lane, of.lift_stop,
              bogie_name[bogie], description->name);
        watch(list, batch, CZ_EVENT_BUMP_STOP, FROM_BUMP_STOP, bogie, lane, of.bump_stop,
              bogie_name[bogie], description->name);
    }
}

/* The row of limits that a guarded value belongs to. */
static double *limit_row(Limits *limits, const Watched *watched) {
    switch (watched->source) {
    case FROM_EXTREME:
        for (int axle = 1; axle < 4; ++axle)
            if (watched->row == CZ_EXTREME(lift[axle]))
                return limits->lift[axle];
        return limits->lift[0];
    case FROM_LIFT_STOP:
        return limits->raised[watched->row];
    case FROM_BUMP_STOP:
        return limits->pressed[watched->row];
    case FROM_MEMORY:
        break;
    }
    return limits->end[watched->row == CZ_MEMORY(end[1].peak)];
}

static void set_limits(CzWatch *list, const CzBatch *batch) {
    const CzDynamics *dynamics = batch->dynamics;
    const size_t n = (size_t)dynamics->n_block * sizeof(Limits) / sizeof(double);
    for (size_t i = 0; i < n; ++i)
        ((double *)list->limits)[i] = INFINITY;
    for (int i = 0; i < list->n_watched[GUARDED]; ++i) {
        const Watched *watched = &list->watched[GUARDED][i];
        double *row = limit_row(&list->limits[watched->block - dynamics->block], watched);
        double *limit = &row[watched->lane % CZ_LANE_BLOCK];
        *limit = fmin(*limit, watched->threshold);
    }
}

CzWatch *cz_watch_begin(CzBatch *batch, CzArena *arena) {
    CzWatch *list = cz_arena_allocate(arena, 1, sizeof *list);
    const size_t most = (size_t)batch->model->n_car * MOST_PER_CAR;
    if (list == NULL)
        return NULL;
    for (int when = 0; when < N_TIME_WINDOW; ++when) {
        list->watched[when] = cz_arena_allocate(arena, most, sizeof *list->watched[when]);
        if (list->watched[when] == NULL)
            return NULL;
    }
    list->named = cz_arena_allocate(arena, most, sizeof *list->named);
    list->limits = cz_arena_allocate(arena, (size_t)batch->dynamics->n_block, sizeof *list->limits);
    list->event = cz_arena_allocate(arena, most, sizeof *list->event);
    if (list->named == NULL || list->limits == NULL || list->event == NULL)
        return NULL;
    for (int car = 0; car < batch->model->n_car; ++car) {
        list->interface = car;
        if (car + 1 < batch->model->n_car)
            watch_interface(list, batch, car);
        list->interface = -1;
        watch_car(list, batch, car);
    }
    set_limits(list, batch);
    return list;
}

static double value_of(const Watched *watched) {
    const size_t i = watched->lane % CZ_LANE_BLOCK;
    switch (watched->source) {
    case FROM_MEMORY:
        return cz_const_row_of(watched->block->memory, watched->row)[i];
    case FROM_EXTREME:
        return cz_const_row_of(&watched->block->extreme, watched->row)[i];
    case FROM_LIFT_STOP:
        return -watched->block->published.secondary[watched->row].compression[i];
    case FROM_BUMP_STOP:
        return watched->block->published.secondary[watched->row].compression[i];
    }
    return 0.0;
}

/* Makes events of the values of a list that passed their threshold and takes them out. */
static void look_at_list(CzWatch *list, const CzBatch *batch, When when) {
    Watched *first = list->watched[when];
    int n_left = 0;
    for (int i = 0; i < list->n_watched[when]; ++i) {
        const Watched *watched = &first[i];
        if (value_of(watched) > watched->threshold) {
            CzEvent *event = &list->event[list->n_event++];
            *event = list->named[watched->named];
            event->time = batch->time;
        } else {
            if (n_left < i)
                first[n_left] = *watched;
            ++n_left;
        }
    }
    list->n_watched[when] = n_left;
}

/* Whether superstructures push in some lane. */
static bool superstructures_push(const CzBlock *block) {
    double force = 0.0;
    for (size_t i = 0; i < CZ_LANE_BLOCK; ++i)
        force += block->published.superstructure.force[i];
    return force != 0.0;
}

/* Whether nothing between the cars pushed in the last step. */
static bool nothing_pushes(const CzBatch *batch) {
    const CzDynamics *dynamics = batch->dynamics;
    bool all_rest = !batch->lanes->has_side_buffers;
    for (int i = 0; i < dynamics->n_block && all_rest; ++i)
        all_rest =
            (!batch->lanes->has_couplers || dynamics->block[i].couplers_rest) &&
            dynamics->block[i].faces_rest &&
            (!batch->lanes->has_superstructures || !superstructures_push(&dynamics->block[i]));
    return all_rest;
}

/* Whether some lane of a block, of the first n, is beyond one of its limits: all of them at once
 * cost little more than a single value. */
static bool is_beyond(const CzBlock *block, const Limits *limits, size_t n) {
    const CzRow *lift = (const CzRow *)block->extreme.lift;
    const CzEndMemory *end = block->memory->end;
    const double *restrict rear = block->published.secondary[0].compression,
                           *restrict front = block->published.secondary[1].compression;
    double n_beyond = 0.0;
#pragma omp simd reduction(+ : n_beyond)
    for (size_t i = 0; i < n; ++i) {
        double beyond = 0.0;
        beyond += lift[0][i] > limits->lift[0][i] ? 1.0 : 0.0;
        beyond += lift[1][i] > limits->lift[1][i] ? 1.0 : 0.0;
        beyond += lift[2][i] > limits->lift[2][i] ? 1.0 : 0.0;
        beyond += lift[3][i] > limits->lift[3][i] ? 1.0 : 0.0;
        beyond += end[0].peak[i] > limits->end[0][i] ? 1.0 : 0.0;
        beyond += end[1].peak[i] > limits->end[1][i] ? 1.0 : 0.0;
        beyond += -rear[i] > limits->raised[0][i] ? 1.0 : 0.0;
        beyond += -front[i] > limits->raised[1][i] ? 1.0 : 0.0;
        beyond += rear[i] > limits->pressed[0][i] ? 1.0 : 0.0;
        beyond += front[i] > limits->pressed[1][i] ? 1.0 : 0.0;
        n_beyond += beyond;
    }
    return n_beyond > 0.0;
}

void cz_watch_look(CzWatch *list, const CzBatch *batch) {
    if (!nothing_pushes(batch))
        look_at_list(list, batch, WHILE_PUSHED);
    bool any_beyond = false;
    size_t n_left = (size_t)batch->model->n_car; /* lanes: events are those of a single design */
    for (int i = 0; i < batch->dynamics->n_block && !any_beyond; ++i) {
        const size_t n = n_left < CZ_LANE_BLOCK ? n_left : CZ_LANE_BLOCK;
        any_beyond = is_beyond(&batch->dynamics->block[i], &list->limits[i], n);
        n_left -= n;
    }
    if (any_beyond) {
        look_at_list(list, batch, GUARDED);
        set_limits(list, batch);
    }
}

const CzEvent *cz_watch_events(const CzWatch *list, int *n_event) {
    *n_event = list->n_event;
    return list->event;
}
