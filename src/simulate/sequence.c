/* Sequence of the devices of an end: the energy that a device dissipates before an earlier one is
 * used up.
 *
 *   coupler with its tubes, side buffers  ->  anti-climber  ->  crush zone of the end
 *
 * A coupler is used up when its tubes are, or when it has sheared off; a device without a plastic
 * stroke, such as a buffer alone, when its stroke is. The devices are looked at with each sample of
 * the pulses.
 */
#include "simulate/devices.h"

#include <math.h>

enum { N_RANK = CZ_N_SEQUENCE };
#define USED_UP 0.999 /* share of the stroke from which a device counts as used up (ours) */

/* Place of an element in the sequence; N_RANK for one that is not in it. */
static int rank_of(CzElementKind kind) {
    switch (kind) {
    case CZ_ELEMENT_COUPLER:
    case CZ_ELEMENT_SIDE_BUFFERS:
        return 0;
    case CZ_ELEMENT_ANTI_CLIMBER:
        return 1;
    case CZ_ELEMENT_END:
        return 2;
    case CZ_ELEMENT_SUPERSTRUCTURE:
    case CZ_ELEMENT_DRAW_GEAR:
    case CZ_ELEMENT_SLIDE:
    case CZ_N_ELEMENT_KIND:
        break;
    }
    return N_RANK;
}

/* Whether a device has stroke left that later ones must wait for. */
static bool has_stroke(const CzBatch *batch, size_t lane, int side, const CzDevice *device) {
    if (device->class == CZ_DEVICE_RETRACTION || (device->is_reversible && device->is_followed))
        return false;
    if (device->element == CZ_ELEMENT_COUPLER && cz_coupler_is_sheared(batch->dynamics, lane, side))
        return false;
    return cz_device_stroke_now(batch, device) < USED_UP * device->usable;
}

static void look_at_side(const CzBatch *batch, int interface, int design, int side) {
    const size_t lane = cz_lane(batch, interface, design);
    CzDevice device[CZ_N_DEVICE];
    const int n = cz_devices_list(batch, interface, design, side, device);
    int first_left = N_RANK; /* lowest rank with stroke left */
    for (int i = 0; i < n; ++i) {
        const int rank = rank_of(device[i].element);
        if (rank < first_left && has_stroke(batch, lane, side, &device[i]))
            first_left = rank;
    }
    for (int i = 0; i < n; ++i) {
        const int rank = rank_of(device[i].element);
        if (rank > first_left && rank < N_RANK)
            batch->early[lane].energy[side][rank] = cz_device_energy(batch, &device[i]);
    }
}

void cz_sequence_look(const CzBatch *batch, int design) {
    for (int i = 0; i + 1 < batch->n_car; ++i)
        for (int side = 0; side < 2; ++side)
            look_at_side(batch, i, design, side);
}

void cz_sequence_judge(const CzBatch *batch, int interface, int design, int side, int n_element,
                       CzElementResult *element) {
    const size_t lane = cz_lane(batch, interface, design);
    for (int k = 0; k < n_element; ++k) {
        const int rank = rank_of(element[k].kind);
        const double all = fmax(element[k].tube_energy, 0.0);
        element[k].early_energy = NAN;
        if (batch->early != NULL)
            element[k].early_energy =
                rank < N_RANK ? fmin(batch->early[lane].energy[side][rank], all) : 0.0;
    }
}
