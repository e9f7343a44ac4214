/* Events of a single design: the first time that something passes its threshold. */
#include "simulate/run.h"

#include <math.h>
#include <stdio.h>

/* Where a watched value comes from. */
typedef enum { FROM_MEMORY, FROM_EXTREME, FROM_LIFT_STOP, FROM_BUMP_STOP, FROM_SWING } Source;

typedef struct {
    CzEventKind what;
    Source source;
    int row; /* of the source; bogie or side for stops */
    size_t lane;
    double threshold; /* passed when the value is larger */
    char where[48];
    int interface; /* -1 when it is about a vehicle */
} Watched;

struct CzWatch {
    int n_watched, n_event;
    int interface; /* that is being listed; -1 when it is a vehicle */
    Watched *watched;
    CzEvent *event;
};

enum { MOST_PER_CAR = 64 };

static void watch(CzWatch *list, CzEventKind what, Source source, int row, size_t lane,
                  double threshold, const char *kind, const char *name) {
    Watched *next = &list->watched[list->n_watched++];
    *next = (Watched){what, source, row, lane, threshold, "", list->interface};
    snprintf(next->where, sizeof next->where, "%s%s%s", kind, kind[0] != '\0' ? " " : "", name);
}

/* Place of the second kink: the end of the first stage. */
static double first_stage(const CzBatch *batch, int curve, size_t lane) {
    const CzCurveLanes *lanes = &batch->lanes->curve[curve];
    return lanes->n_kink > 1 ? cz_row(lanes->at, batch->lanes->stride, 1)[lane] : INFINITY;
}

static void watch_side(CzWatch *list, const CzBatch *batch, int interface, int side) {
    const size_t lane = cz_lane(batch, interface, 0), own = cz_lane(batch, interface + side, 0);
    const char *name = batch->model->car[interface + side].name;
    const CzCurveLanes *curve = batch->lanes->curve;
    const int which = side == 0 ? 1 : 0;
    const double flowed = 1e-4;
    watch(list, CZ_EVENT_TUBE_FLOW, FROM_MEMORY, CZ_M_TUBE_A + side, lane, flowed, "coupler", name);
    watch(list, CZ_EVENT_SHEAR_OFF, FROM_MEMORY, CZ_M_SHEAR_A + side, lane, flowed, "coupler",
          name);
    watch(list, CZ_EVENT_ANTI_CLIMBER_FLOW, FROM_MEMORY, CZ_M_FACE_A + side, lane, flowed,
          "anti-climber", name);
    watch(list, CZ_EVENT_TUBE_FLOW, FROM_MEMORY, CZ_M_SIDE_TUBE_A + side, lane, flowed,
          "side buffers", name);
    const bool shears = cz_parameter(batch, CZ_P_SHEAR_FORCE_A + side, lane) < 1e29;
    const CzEventKind used_up = shears ? CZ_EVENT_TUBE_USED_UP : CZ_EVENT_BOTTOMED_OUT;
    watch(list, used_up, FROM_MEMORY, CZ_M_TUBE_A + side, lane,
          curve[CZ_CURVE_TUBE_A + side].usable[lane], "coupler tube", name);
    watch(list, used_up, FROM_MEMORY, CZ_M_SECOND_TUBE_A + side, lane,
          curve[CZ_CURVE_SECOND_TUBE_A + side].usable[lane], "second coupler tube", name);
    watch(list, CZ_EVENT_BOTTOMED_OUT, FROM_MEMORY, CZ_M_SHEAR_A + side, lane,
          cz_parameter(batch, CZ_P_SHEAR_SPACE_A + side, lane), "retraction space", name);
    watch(list, CZ_EVENT_BOTTOMED_OUT, FROM_MEMORY, CZ_M_FACE_A + side, lane,
          curve[CZ_CURVE_FACE_A + side].usable[lane], "anti-climber", name);
    watch(list, CZ_EVENT_BOTTOMED_OUT, FROM_MEMORY, CZ_M_SIDE_TUBE_A + side, lane,
          curve[CZ_CURVE_SIDE_TUBE_A + side].usable[lane], "side buffers", name);
    if (cz_parameter(batch, CZ_P_LIMP_END_A + side, lane) > 0.5) {
        const int limp = CZ_CURVE_LIMP_END_A + side;
        watch(list, CZ_EVENT_END_FLOW, FROM_MEMORY, CZ_M_LIMP_PEAK_A + side, lane,
              first_stage(batch, limp, lane), "end", name);
        watch(list, CZ_EVENT_BOTTOMED_OUT, FROM_MEMORY, CZ_M_LIMP_PEAK_A + side, lane,
              curve[limp].usable[lane], "end", name);
    }
    if (batch->model->car[interface + side].model == CZ_MODEL_FULL) {
        const int end = CZ_CURVE_END_REAR + which;
        watch(list, CZ_EVENT_END_FLOW, FROM_MEMORY, CZ_M_END_PEAK_REAR + which, own,
              first_stage(batch, end, own), "end", name);
        watch(list, CZ_EVENT_BOTTOMED_OUT, FROM_MEMORY, CZ_M_END_PEAK_REAR + which, own,
              curve[end].usable[own], "end", name);
    }
    if (cz_parameter(batch, CZ_P_COUPLER, lane) > 0.5)
        watch(list, CZ_EVENT_SWING_STOP, FROM_SWING, side, lane, 0.0, "coupler", name);
}

static void watch_interface(CzWatch *list, const CzBatch *batch, int interface) {
    const size_t lane = cz_lane(batch, interface, 0);
    const char *name = batch->model->interface_name[interface];
    watch(list, CZ_EVENT_CONTACT, FROM_EXTREME, CZ_E_INTERFACE_FORCE, lane, 1e3, "", name);
    watch(list, CZ_EVENT_ANTI_CLIMBER_CONTACT, FROM_MEMORY, CZ_M_FACE_SPEED, lane, 0.0, "", name);
    watch(list, CZ_EVENT_OVERRIDE, FROM_EXTREME, CZ_E_FACE_CLIMBED, lane, 0.0, "", name);
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
        watch(list, CZ_EVENT_WHEEL_LIFT, FROM_EXTREME, CZ_E_LIFT_0 + axle, lane, 1e-3, kind,
              description->name);
        watch(list, CZ_EVENT_OVERRIDE, FROM_EXTREME, CZ_E_LIFT_0 + axle, lane,
              batch->vehicles[0][description->vehicle].bogie.flange_height, kind,
              description->name);
    }
    for (int bogie = 0; bogie < 2; ++bogie) {
        watch(list, CZ_EVENT_LIFT_STOP, FROM_LIFT_STOP, bogie, lane, 0.0, bogie_name[bogie],
              description->name);
        watch(list, CZ_EVENT_BUMP_STOP, FROM_BUMP_STOP, bogie, lane, 0.0, bogie_name[bogie],
              description->name);
    }
}

CzWatch *cz_watch_begin(CzBatch *batch, CzArena *arena) {
    CzWatch *list = cz_arena_allocate(arena, 1, sizeof *list);
    const size_t most = (size_t)batch->model->n_car * MOST_PER_CAR;
    if (list == NULL)
        return NULL;
    list->watched = cz_arena_allocate(arena, most, sizeof *list->watched);
    list->event = cz_arena_allocate(arena, most, sizeof *list->event);
    if (list->watched == NULL || list->event == NULL)
        return NULL;
    for (int car = 0; car < batch->model->n_car; ++car) {
        list->interface = car;
        if (car + 1 < batch->model->n_car)
            watch_interface(list, batch, car);
        list->interface = -1;
        watch_car(list, batch, car);
    }
    return list;
}

/* Compression of the secondary suspension of a bogie [m]. */
static double compression(const CzBatch *batch, size_t lane, int bogie) {
    const double sign = bogie == 0 ? -1.0 : 1.0;
    return cz_position(batch, CZ_DOF_BOGIE_Z_REAR + 3 * bogie, lane) -
           cz_position(batch, CZ_DOF_BODY_Z, lane) -
           sign * cz_parameter(batch, CZ_P_BOGIE_X, lane) * cz_scratch(batch, CZ_S_BODY_SIN, lane);
}

/* Angle of the coupler line against the car, less the free swing; negative while free. The pivots
 * follow the bodies. */
static double swing(const CzBatch *batch, size_t lane, int side) {
    const size_t ahead = lane + (size_t)batch->n_design, own = side == 0 ? lane : ahead;
    const double sin_a = cz_scratch(batch, CZ_S_BODY_SIN, lane),
                 sin_b = cz_scratch(batch, CZ_S_BODY_SIN, ahead);
    const double rise = cz_parameter(batch, CZ_P_PIVOT_RISE, lane) +
                        cz_position(batch, CZ_DOF_BODY_Z, ahead) -
                        cz_position(batch, CZ_DOF_BODY_Z, lane) +
                        cz_parameter(batch, CZ_P_PIVOT_X_B, lane) * sin_b -
                        cz_parameter(batch, CZ_P_PIVOT_X_A, lane) * sin_a;
    const double length = cz_parameter(batch, CZ_P_PIVOT_DISTANCE, lane) +
                          cz_position(batch, CZ_DOF_BODY_X, ahead) -
                          cz_position(batch, CZ_DOF_BODY_X, lane);
    const bool mated = cz_memory(batch, CZ_M_COUPLER_FORCE, lane) != 0.0;
    const double angle = rise / fmax(length, 0.1) - cz_position(batch, CZ_DOF_BODY_PITCH, own);
    return mated ? fabs(angle) - cz_parameter(batch, CZ_P_SWING_STOP_A + side, lane) : -1.0;
}

static double value_of(const Watched *watched, const CzBatch *batch) {
    switch (watched->source) {
    case FROM_MEMORY:
        return cz_memory(batch, watched->row, watched->lane);
    case FROM_EXTREME:
        return cz_extreme(batch, watched->row, watched->lane);
    case FROM_LIFT_STOP:
        return -compression(batch, watched->lane, watched->row) -
               cz_parameter(batch, CZ_P_SECONDARY_LIFT_GAP, watched->lane);
    case FROM_BUMP_STOP:
        return compression(batch, watched->lane, watched->row) -
               cz_parameter(batch, CZ_P_SECONDARY_BUMP_GAP, watched->lane);
    case FROM_SWING:
        return swing(batch, watched->lane, watched->row);
    }
    return 0.0;
}

void cz_watch_look(CzWatch *list, const CzBatch *batch) {
    int n_left = 0;
    for (int i = 0; i < list->n_watched; ++i) {
        const Watched *watched = &list->watched[i];
        if (value_of(watched, batch) > watched->threshold) {
            CzEvent *event = &list->event[list->n_event++];
            *event = (CzEvent){batch->time, watched->what, "", watched->interface};
            snprintf(event->where, sizeof event->where, "%s", watched->where);
        } else {
            if (n_left < i)
                list->watched[n_left] = *watched;
            ++n_left;
        }
    }
    list->n_watched = n_left;
}

const CzEvent *cz_watch_events(const CzWatch *list, int *n_event) {
    *n_event = list->n_event;
    return list->event;
}
