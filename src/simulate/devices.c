/* Strokes of devices: one list for the results, the events and the checks that read them. */
#include "simulate/devices.h"

#include <math.h>

typedef enum { MEMORY, EXTREME, OF_CAR, OF_SLIDE } Source;
typedef enum { CURVE, RETRACTION_SPACE, SLIDE_LENGTH } Limit;
typedef enum { REVERSIBLE, COLLAPSES } Kind;

typedef struct {
    CzElementKind element;
    const char *text;
    Source source;
    int row[2];
    Limit limit;
    int of[2]; /* CzCurveId */
    CzDeviceClass follower;
    Kind kind;
} Class;

static const Class classes[CZ_N_DEVICE] = {
#define CZ_DEVICE(name, element, text, source, row, limit, of, follower, kind)                     \
    {element, text, source, row, limit, of, CZ_DEVICE_##follower, kind},
#include "simulate/devices.def"
#undef CZ_DEVICE
};

/* Whether the side has the connection to which the device belongs; a bare wall has none. */
static bool has_element(const CzBatch *batch, size_t lane, int car, int design, int side,
                        CzDeviceClass class) {
    const bool has_mass = cz_has_end_mass(batch, car, design, side);
    if (class == CZ_DEVICE_END || class == CZ_DEVICE_MASSLESS_END)
        return has_mass == (class == CZ_DEVICE_END);
    const CzInterfaceEquipment *of = &batch->equipment[lane];
    if (classes[class].element == CZ_ELEMENT_COUPLER)
        return of->has_couplers;
    if (classes[class].element == CZ_ELEMENT_SIDE_BUFFERS)
        return of->has_side_buffers;
    return true;
}

/* Whether the end of this side is the one to which results of the vehicle's slide are assigned. */
static bool has_slide(const CzBatch *batch, int car, int design, int side) {
    const CzEnd *end = cz_end_at(batch, car, design, side);
    return end->given && end->slide.given;
}

/* Usable stroke of a device of a side or an end, in its lane. */
static double usable_of(const CzBatch *batch, const Class *kind, int which, size_t lane) {
    if (kind->limit == RETRACTION_SPACE)
        return batch->equipment[lane].side[which].retraction_space;
    return kind->limit == SLIDE_LENGTH ? batch->car_equipment[lane].slide_length
                                       : batch->lanes->curve[kind->of[which]].usable[lane];
}

/* A device of a side; its usable stroke is infinite when it is missing. */
static CzDevice device_of(const CzBatch *batch, int interface, int design, int side,
                          CzDeviceClass class) {
    const Class *kind = &classes[class];
    const int car = interface + side;
    const bool slides = kind->source == OF_SLIDE;
    const bool of_car = kind->source == OF_CAR || slides;
    const int which = slides ? 0 : of_car ? 1 - side : side; /* side A is a front end */
    const size_t own = cz_lane(batch, of_car ? car : interface, design);
    const double usable = usable_of(batch, kind, which, own);
    const bool is_there =
        usable < CZ_MISSING &&
        has_element(batch, cz_lane(batch, interface, design), car, design, side, class) &&
        (!slides || has_slide(batch, car, design, side));
    const size_t lane = cz_lane(batch, interface, design);
    const bool on_plates =
        class == CZ_DEVICE_SIDE_TUBE && batch->equipment[lane].side[side].presses_plates;
    const Class *named = on_plates ? &classes[CZ_DEVICE_ANTI_CLIMBER] : kind;
    return (CzDevice){.class = class,
                      .element = named->element,
                      .text = named->text,
                      .from_extremes = kind->source == EXTREME || slides,
                      .row = kind->row[which],
                      .lane = own,
                      .usable = is_there ? usable : INFINITY,
                      .curve = kind->limit == CURVE ? kind->of[which] : -1,
                      .is_reversible = kind->kind == REVERSIBLE};
}

int cz_devices_list(const CzBatch *batch, int interface, int design, int side,
                    CzDevice device[CZ_N_DEVICE]) {
    int n = 0;
    for (int class = 0; class < CZ_N_DEVICE; ++class) {
        const CzDevice next = device_of(batch, interface, design, side, (CzDeviceClass) class);
        if (isfinite(next.usable))
            device[n++] = next;
    }
    for (int i = 0; i < n; ++i)
        for (int k = i + 1; k < n; ++k)
            device[i].is_followed |= device[k].element == device[i].element &&
                                     device[k].class >= classes[device[i].class].follower;
    return n;
}

double cz_device_stroke_now(const CzBatch *batch, const CzDevice *device) {
    return device->from_extremes ? cz_extreme(batch, device->row, device->lane)
                                 : cz_memory(batch, device->row, device->lane);
}

double cz_device_energy(const CzBatch *batch, const CzDevice *device) {
    const double stroke = cz_device_stroke_now(batch, device);
    return device->curve < 0 || !(stroke > 0.0)
               ? 0.0
               : cz_curve_integral(&batch->lanes->curve[device->curve], device->lane, stroke);
}

/* Adds one device to its element. Where another device follows, travel beyond the stroke is the
 * deflection of a stop. For a coupler that has sheared off only the retraction space counts. */
static void judge(const CzBatch *batch, const CzDevice *device, CzElementResult *element) {
    const double used = cz_device_stroke_now(batch, device) / device->usable;
    element->bottomed_out |= !device->is_followed && used > 1.0;
    if (device->is_reversible && !device->is_followed)
        element->stroke = cz_device_stroke_now(batch, device);
    if (device->class == CZ_DEVICE_RETRACTION)
        element->stroke_used = element->sheared ? used : element->stroke_used;
    else if (!device->is_reversible || !device->is_followed)
        element->stroke_used =
            fmax(element->stroke_used, device->is_followed ? fmin(used, 1) : used);
}

void cz_devices_judge(const CzBatch *batch, int interface, int design, int side, int n_element,
                      CzElementResult *element) {
    CzDevice device[CZ_N_DEVICE];
    const int n = cz_devices_list(batch, interface, design, side, device);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n_element; ++k)
            if (element[k].kind == device[i].element)
                judge(batch, &device[i], &element[k]);
}
