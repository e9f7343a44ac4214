/* Sequence of the devices of an end: the energy that a device dissipates before the stroke of an
 * earlier one is exhausted.
 *
 *   coupler with its tubes, side buffers  ->  anti-climber  ->  crush zone of the end
 *
 * A coupler is exhausted when its tubes are, or when it has sheared off; a device without a plastic
 * stroke, such as a buffer alone, when its stroke is. The devices are looked at with each sample of
 * the pulses.
 */
#include "simulate/devices.h"

#include <math.h>
#include <string.h>

enum { N_RANK = 3 };
#define EXHAUSTED 0.999 /* share of the stroke from which it counts as exhausted (ours) */

/* Devices of the two sides of an interface. */
struct CzSequence {
    bool is_listed;
    int n[2];
    CzDevice device[2][CZ_N_DEVICE];
    double early[2][N_RANK]; /* energy by place in the sequence when an earlier device last had
                                stroke left [J] */
};

CzSequence *cz_sequence_begin(const CzBatch *batch, CzArena *arena) {
    const size_t n = (size_t)batch->n_car * (size_t)batch->n_design;
    return cz_arena_allocate(arena, n, sizeof(CzSequence));
}

void cz_sequence_move(CzBatch *batch, size_t lane, const CzBatch *from, size_t from_lane) {
    memcpy(batch->sequence[lane].early, from->sequence[from_lane].early,
           sizeof from->sequence[from_lane].early);
}

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
    return cz_device_stroke_now(batch, device) < EXHAUSTED * device->usable;
}

static void look_at_side(const CzBatch *batch, size_t lane, int side) {
    CzSequence *sequence = &batch->sequence[lane];
    const CzDevice *device = sequence->device[side];
    const int n = sequence->n[side];
    int first_left = N_RANK; /* lowest rank with stroke left */
    for (int i = 0; i < n; ++i) {
        const int rank = rank_of(device[i].element);
        if (rank < first_left && has_stroke(batch, lane, side, &device[i]))
            first_left = rank;
    }
    for (int i = 0; i < n; ++i) {
        const int rank = rank_of(device[i].element);
        if (rank > first_left && rank < N_RANK)
            sequence->early[side][rank] = cz_device_energy(batch, &device[i]);
    }
}

void cz_sequence_update(const CzBatch *batch, int design) {
    for (int i = 0; i + 1 < batch->n_car; ++i) {
        const size_t lane = cz_lane(batch, i, design);
        CzSequence *sequence = &batch->sequence[lane];
        for (int side = 0; side < 2; ++side) {
            if (!sequence->is_listed)
                sequence->n[side] = cz_devices_list(batch, i, design, side, sequence->device[side]);
            look_at_side(batch, lane, side);
        }
        sequence->is_listed = true;
    }
}

void cz_sequence_judge(const CzBatch *batch, int interface, int design, int side, int n_element,
                       CzElementResult *element) {
    const size_t lane = cz_lane(batch, interface, design);
    for (int k = 0; k < n_element; ++k) {
        const int rank = rank_of(element[k].kind);
        const double all = fmax(element[k].tube_energy, 0.0);
        element[k].early_energy = NAN;
        if (batch->sequence != NULL)
            element[k].early_energy =
                rank < N_RANK ? fmin(batch->sequence[lane].early[side][rank], all) : 0.0;
    }
}
