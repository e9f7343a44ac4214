/* Devices of an interface whose stroke can be exhausted: the share used, and bottoming out. */
#ifndef CZ_SIMULATE_DEVICES_H
#define CZ_SIMULATE_DEVICES_H

#include "simulate/run.h"

typedef enum CzDeviceClass {
#define CZ_DEVICE(name, element, text, source, row, limit, of, follower, kind) CZ_DEVICE_##name,
#include "simulate/devices.def"
#undef CZ_DEVICE
    CZ_N_DEVICE,
    CZ_DEVICE_NONE = CZ_N_DEVICE
} CzDeviceClass;

typedef struct CzDevice {
    CzDeviceClass class;
    CzElementKind element;
    const char *text;   /* such as "coupler tube" */
    bool from_extremes; /* the row of the largest stroke: an extreme, or a memory that only grows */
    int row;
    size_t lane;
    double usable;      /* usable stroke [m] */
    int curve;          /* of its force over the stroke; -1 without one */
    bool is_reversible; /* extends again after its stroke */
    bool is_followed;   /* another device of the element deflects after it */
} CzDevice;

/* Devices of side A (0) or B (1) of an interface, in the order of the list; returns how many. */
int cz_devices_list(const CzBatch *batch, int interface, int design, int side,
                    CzDevice device[CZ_N_DEVICE]);

/* Largest stroke so far [m], and the energy under the device's curve up to it [J]. */
double cz_device_stroke_now(const CzBatch *batch, const CzDevice *device);
double cz_device_energy(const CzBatch *batch, const CzDevice *device);

/* Sets the share of stroke used and bottoming out in the elements of a side. */
void cz_devices_judge(const CzBatch *batch, int interface, int design, int side, int n_element,
                      CzElementResult *element);

#endif
