/* Events of a single design: the first time that a value passes its threshold. */
#include "simulate/devices.h"

#include <math.h>
#include <stdio.h>

#define CRUSHED 1e-4 /* plastic stroke from which an element counts as crushed [m] (ours) */

/* Source of a watched value. */
typedef enum { FROM_MEMORY, FROM_EXTREME, FROM_LIFT_STOP, FROM_BUMP_STOP } Source;

/* A row of the blocks that has watched values. */
typedef struct {
    Source source;
    int row;       /* of the source; bogie for stops */
    size_t offset; /* from the block, or from its memory [bytes] */
    double sign;   /* of the row, so that the watched value increases */
} Guard;

typedef struct {
    int guard;
    size_t lane;
    double threshold; /* passed when the value is larger */
    CzEvent event;    /* without its time */
    bool passed;
} Watched;

struct CzWatch {
    int n_watched, n_guard, n_event;
    int interface; /* that is being listed; -1 when it is a vehicle */
    Watched *watched;
    Guard *guard;
    CzRow *limit; /* lowest thresholds of each guard in the lanes of a block (n_block x n_guard) */
    int *open;    /* guards of each block with thresholds that are not passed (n_block x n_guard) */
    int *n_open;  /* their number (n_block) */
    CzEvent *event;
};

enum {
    MAX_PER_CAR = 64,
    MAX_GUARDS = CZ_ROWS_IN(CzMemory) + CZ_ROWS_IN(CzExtremes) + 4 /* and two stops of two bogies */
};

/* The guard of a row: its offset and sign. */
static Guard guard_of(Source source, int row) {
    const size_t rows = (size_t)row * sizeof(CzRow);
    switch (source) {
    case FROM_MEMORY:
        return (Guard){source, row, rows, 1.0};
    case FROM_EXTREME:
        return (Guard){source, row, offsetof(CzBlock, extreme) + rows, 1.0};
    case FROM_LIFT_STOP:
        return (Guard){source, row, offsetof(CzBlock, published.secondary[row].compression), -1.0};
    case FROM_BUMP_STOP:
        break;
    }
    return (Guard){source, row, offsetof(CzBlock, published.secondary[row].compression), 1.0};
}

/* Index of the guard of a row, which is added when it is new. */
static int find_guard(CzWatch *list, Source source, int row) {
    int k = 0;
    while (k < list->n_guard && (list->guard[k].source != source || list->guard[k].row != row))
        ++k;
    if (k == list->n_guard)
        list->guard[list->n_guard++] = guard_of(source, row);
    return k;
}

static void watch(CzWatch *list, CzEventKind what, Source source, int row, size_t lane,
                  double threshold, const char *kind, const char *name) {
    Watched *watched = &list->watched[list->n_watched++];
    *watched = (Watched){.guard = find_guard(list, source, row),
                         .lane = lane,
                         .threshold = threshold,
                         .event = {.what = what, .interface = list->interface}};
    snprintf(watched->event.where, sizeof watched->event.where, "%s%s%s", kind,
             kind[0] != '\0' ? " " : "", name);
}

/* Place of the second breakpoint: the end of the first stage. */
static double first_stage(const CzBatch *batch, int curve, size_t lane) {
    const CzCurveLanes *lanes = &batch->lanes->curve[curve];
    return lanes->n_breakpoint > 1 ? lanes->at[lanes->stride + lane] : INFINITY;
}

/* Watches exhausted strokes, except of a reversible device that is followed by another one, since
 * that happens in service. */
static void watch_devices(CzWatch *list, const CzBatch *batch, int interface, int side) {
    CzDevice device[CZ_N_DEVICE];
    const int n = cz_devices_list(batch, interface, 0, side, device);
    for (int i = 0; i < n; ++i)
        if (!device[i].is_reversible || !device[i].is_followed)
            watch(list, device[i].is_followed ? CZ_EVENT_TUBE_EXHAUSTED : CZ_EVENT_BOTTOMED_OUT,
                  device[i].from_extremes ? FROM_EXTREME : FROM_MEMORY, device[i].row,
                  device[i].lane, device[i].usable, device[i].text,
                  cz_car(batch, interface + side, 0)->name);
}

static void watch_side(CzWatch *list, const CzBatch *batch, int interface, int side) {
    const size_t lane = cz_lane(batch, interface, 0), own = cz_lane(batch, interface + side, 0);
    const CzInterfaceEquipment *of = &batch->equipment[lane];
    const char *name = cz_car(batch, interface + side, 0)->name;
    const int which = side == 0 ? 1 : 0;
    watch(list, CZ_EVENT_TUBE_ACTIVATION, FROM_MEMORY, CZ_MEMORY(coupler.side[side].tube), lane,
          CRUSHED, "coupler", name);
    if (of->side[side].shears_off)
        watch(list, CZ_EVENT_SHEAR_OFF, FROM_MEMORY, CZ_MEMORY(coupler.side[side].shear), lane,
              CRUSHED, "coupler", name);
    watch(list, CZ_EVENT_ANTI_CLIMBER_ACTIVATION, FROM_MEMORY, CZ_MEMORY(face.side[side].stroke),
          lane, CRUSHED, "anti-climber", name);
    const bool presses_plates = of->side[side].presses_plates;
    if (of->has_side_buffers)
        watch(list, presses_plates ? CZ_EVENT_ANTI_CLIMBER_ACTIVATION : CZ_EVENT_TUBE_ACTIVATION,
              FROM_MEMORY, CZ_MEMORY(side_buffers.side[side].tube), lane, CRUSHED,
              presses_plates ? "anti-climber" : "side buffers", name);
    watch_devices(list, batch, interface, side);
    if (of->side[side].has_massless_end) {
        const int massless = CZ_CURVE(massless[side]);
        watch(list, CZ_EVENT_END_CRUSH, FROM_MEMORY, CZ_MEMORY(face.side[side].massless.peak), lane,
              first_stage(batch, massless, lane), "end", name);
    }
    if (cz_has_end_mass(batch, interface + side, 0, side)) {
        const int end = CZ_CURVE(end[which]);
        watch(list, CZ_EVENT_END_CRUSH, FROM_MEMORY, CZ_MEMORY(end[which].peak), own,
              first_stage(batch, end, own), "end", name);
    }
    if (of->has_couplers)
        watch(list, CZ_EVENT_SWING_STOP, FROM_EXTREME, CZ_EXTREME(swing_vertical[side]), lane,
              of->side[side].swing_stop, "coupler", name);
}

static void watch_interface(CzWatch *list, const CzBatch *batch, int interface) {
    const size_t lane = cz_lane(batch, interface, 0);
    const char *name = batch->design[0].model->interface_name[interface];
    watch(list, CZ_EVENT_CONTACT, FROM_EXTREME, CZ_EXTREME(interface_force), lane, 1e3, "", name);
    watch(list, CZ_EVENT_ANTI_CLIMBER_CONTACT, FROM_MEMORY, CZ_MEMORY(face.speed), lane, 0.0, "",
          name);
    watch(list, CZ_EVENT_OVERRIDE, FROM_EXTREME, CZ_EXTREME(face_climbed), lane, 0.0, "", name);
    if (batch->equipment[lane].has_superstructures)
        watch(list, CZ_EVENT_SUPERSTRUCTURE_CRUSH, FROM_MEMORY, CZ_MEMORY(superstructure.set), lane,
              CRUSHED, "superstructures", name);
    for (int side = 0; side < 2; ++side)
        watch_side(list, batch, interface, side);
}

static void watch_car(CzWatch *list, const CzBatch *batch, int car) {
    static const char *const bogie_name[] = {"rear bogie", "front bogie"};
    const size_t lane = cz_lane(batch, car, 0);
    const CzCar *description = cz_car(batch, car, 0);
    if (description->model != CZ_MODEL_FULL)
        return;
    for (int axle = 0; axle < 4; ++axle) {
        char kind[24];
        snprintf(kind, sizeof kind, "wheelset %d", axle + 1);
        watch(list, CZ_EVENT_WHEEL_LIFT, FROM_EXTREME, CZ_EXTREME(lift[axle]), lane, 1e-3, kind,
              description->name);
        if (description->has_stops)
            watch(list, CZ_EVENT_OVERRIDE, FROM_EXTREME, CZ_EXTREME(lift[axle]), lane,
                  batch->design[0].vehicles[description->vehicle].bogie.flange_height, kind,
                  description->name);
    }
    const CzCarEquipment of = batch->car_equipment[lane];
    for (int bogie = 0; bogie < 2; ++bogie) {
        watch(list, CZ_EVENT_LIFT_STOP, FROM_LIFT_STOP, bogie, lane, of.lift_stop,
              bogie_name[bogie], description->name);
        watch(list, CZ_EVENT_BUMP_STOP, FROM_BUMP_STOP, bogie, lane, of.bump_stop,
              bogie_name[bogie], description->name);
    }
}

static void clear_limits(CzWatch *list, const CzBatch *batch) {
    const size_t n = (size_t)(batch->dynamics->n_block * list->n_guard);
    for (size_t k = 0; k < n; ++k)
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            list->limit[k][i] = INFINITY;
}

/* Lists the guards of a block that some lane still has to pass. */
static void list_open(CzWatch *list, size_t block) {
    const size_t base = block * (size_t)list->n_guard;
    list->n_open[block] = 0;
    for (int k = 0; k < list->n_guard; ++k) {
        bool any = false;
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            any |= list->limit[base + (size_t)k][i] < INFINITY;
        if (any)
            list->open[base + (size_t)list->n_open[block]++] = k;
    }
}

/* The lowest thresholds that are not passed yet. */
static void set_limits(CzWatch *list, const CzBatch *batch) {
    clear_limits(list, batch);
    for (int i = 0; i < list->n_watched; ++i) {
        const Watched *watched = &list->watched[i];
        const size_t block = watched->lane / CZ_LANE_BLOCK;
        CzRow *limit = &list->limit[block * (size_t)list->n_guard + (size_t)watched->guard];
        double *lowest = &(*limit)[watched->lane % CZ_LANE_BLOCK];
        if (!watched->passed)
            *lowest = fmin(*lowest, watched->threshold);
    }
    for (int block = 0; block < batch->dynamics->n_block; ++block)
        list_open(list, (size_t)block);
}

CzWatch *cz_watch_begin(const CzBatch *batch, CzArena *arena) {
    CzWatch *list = cz_arena_allocate(arena, 1, sizeof *list);
    const size_t most = (size_t)batch->n_car * MAX_PER_CAR;
    const size_t n_limit = (size_t)batch->dynamics->n_block * MAX_GUARDS;
    if (list == NULL)
        return NULL;
    list->watched = cz_arena_allocate(arena, most, sizeof *list->watched);
    list->guard = cz_arena_allocate(arena, MAX_GUARDS, sizeof *list->guard);
    list->limit = cz_arena_allocate(arena, n_limit, sizeof *list->limit);
    list->open = cz_arena_allocate(arena, n_limit, sizeof *list->open);
    list->n_open = cz_arena_allocate(arena, (size_t)batch->dynamics->n_block, sizeof(int));
    list->event = cz_arena_allocate(arena, most, sizeof *list->event);
    if (list->watched == NULL || list->guard == NULL || list->limit == NULL || list->open == NULL ||
        list->n_open == NULL || list->event == NULL)
        return NULL;
    for (int car = 0; car < batch->n_car; ++car) {
        list->interface = car;
        if (car + 1 < batch->n_car)
            watch_interface(list, batch, car);
        list->interface = -1;
        watch_car(list, batch, car);
    }
    set_limits(list, batch);
    return list;
}

static const double *row_at(const CzBlock *block, const Guard *guard) {
    const bool remembered = guard->source == FROM_MEMORY;
    const void *base = remembered ? (const void *)block->memory : (const void *)block;
    return (const double *)((const char *)base + guard->offset);
}

/* Whether some lane of a block is beyond one of its limits: checking all of them costs little more
 * than a single value. */
static bool is_beyond(const CzWatch *list, size_t block, const CzBlock *rows) {
    const size_t base = block * (size_t)list->n_guard;
    CzRow excess;
    for (int i = 0; i < CZ_LANE_BLOCK; ++i)
        excess[i] = 0.0;
    for (int k = 0; k < list->n_open[block]; ++k) {
        const int which = list->open[base + (size_t)k];
        const double *restrict row = row_at(rows, &list->guard[which]);
        const double *restrict limit = list->limit[base + (size_t)which];
        const double sign = list->guard[which].sign;
#pragma omp simd
        for (int i = 0; i < CZ_LANE_BLOCK; ++i) {
            const double beyond = sign * row[i] - limit[i];
            excess[i] = beyond > excess[i] ? beyond : excess[i];
        }
    }
    double largest = 0.0;
    for (int i = 0; i < CZ_LANE_BLOCK; ++i)
        largest = excess[i] > largest ? excess[i] : largest;
    return largest > 0.0;
}

/* Adds events for the values that have passed their threshold. */
static void list_events(CzWatch *list, const CzBatch *batch) {
    for (int i = 0; i < list->n_watched; ++i) {
        Watched *watched = &list->watched[i];
        const Guard *guard = &list->guard[watched->guard];
        const double *row = row_at(cz_block_of(batch->dynamics, watched->lane), guard);
        if (watched->passed ||
            !(guard->sign * row[watched->lane % CZ_LANE_BLOCK] > watched->threshold))
            continue;
        watched->passed = true;
        watched->event.time = batch->time;
        list->event[list->n_event++] = watched->event;
    }
    set_limits(list, batch);
}

void cz_watch_update(CzWatch *list, const CzBatch *batch) {
    bool any_beyond = false;
    for (int i = 0; i < batch->dynamics->n_block && !any_beyond; ++i)
        any_beyond = is_beyond(list, (size_t)i, &batch->dynamics->block[i]);
    if (any_beyond)
        list_events(list, batch);
}

const CzEvent *cz_watch_events(const CzWatch *list, int *n_event) {
    *n_event = list->n_event;
    return list->event;
}
