/* Distances of idle devices from crushing.
 *
 *   tubes of a coupler    1 - F / Fy
 *   anti-climber          g / s + 0.1 (1 - F / Fy)
 *   end                   (1 - used) + 0.1 (1 - F / Fy), by the device in front of it; g / s + ...
 * as long as that device, or the bare face, does not touch zone of an end        1 - stroke / s,
 * more by the above while the end is idle
 *
 * F is the largest force, Fy the one at which the device begins to crush, g the gap left at the
 * largest closure, s the stroke to which shares refer, `used` the share of the stroke of the device
 * in front. A device in front that is stronger than the end does not protect it. The tenth is that
 * of stroke_demand: both are continuous where a stroke is exhausted.
 */
#include "evaluate/activation.h"

#include <math.h>

#include "evaluate/devices.h"
#include "problem/strokes.h"

/* Share of a distance that is due to a force between the plateau in front and the one behind. */
static const double force_share = 0.1;

static double at_least_0(double value) {
    return fmax(value, 0);
}

/* Part of a distance by force: 0 from the force on at which a device crushes. */
static double short_of(double force, double crushing) {
    return crushing > 0 ? at_least_0(1 - force / crushing) : 0;
}

/* Gap that is left between the faces of an interface at its largest closure, for each side that can
 * crush: so a further closure is shared [m]. */
static double gap_left(const CzPlace *place) {
    double gap = 0;
    int n_side = 0;
    for (int side = 0; side < 2; side++) {
        const int vehicle = place->interface_index + side;
        const CzVehicle *record = &place->vehicles[place->scene->record[vehicle]];
        const CzEnd *end = side == 0 ? &record->front : &record->rear;
        gap += end->anti_climber.given ? end->anti_climber.gap : end->face_gap;
        n_side += record->model != CZ_MODEL_FIXED;
    }
    return at_least_0(gap - place->interface->shortening) / (n_side > 0 ? n_side : 1);
}

/* ---- devices -------------------------------------------------------------------------------- */

bool cz_activation_of_tubes(const CzPlace *place, CzActivation *activation) {
    const CzCoupler *coupler = &place->end->coupler;
    if (place->element->kind != CZ_ELEMENT_COUPLER)
        return cz_activation_of_element(place, activation);
    const double crushing = cz_crushing_force(place->end, CZ_ELEMENT_COUPLER, place->rate);
    const double stroke = cz_device_stroke(CZ_DEVICE(&coupler->tube)) +
                          cz_device_stroke(CZ_DEVICE(&coupler->second_tube));
    *activation = (CzActivation){short_of(place->element->peak_force, crushing), crushing * stroke};
    return activation->size > 0;
}

static bool activation_of_anti_climber(const CzPlace *place, CzActivation *activation) {
    const double crushing = cz_crushing_force(place->end, CZ_ELEMENT_ANTI_CLIMBER, place->rate);
    const double stroke = cz_device_stroke(CZ_DEVICE(&place->end->anti_climber));
    if (!(crushing * stroke > 0))
        return false;
    *activation = (CzActivation){gap_left(place) / stroke +
                                     force_share * short_of(place->element->peak_force, crushing),
                                 crushing * stroke};
    return true;
}

/* The element of this kind on the end of a place; NULL when there is none. */
static const CzElementResult *beside(const CzPlace *place, CzElementKind kind) {
    const CzInterfaceResult *interface = place->interface;
    for (int i = 0; i < interface->n_element; i++)
        if (interface->element[i].kind == kind &&
            interface->element[i].vehicle == place->element->vehicle)
            return &interface->element[i];
    return NULL;
}

/* Stroke of the device that protects an end, and its force; its result. NULL without one. */
static const CzElementResult *device_in_front(const CzPlace *place, double *stroke, double *force) {
    const CzElementResult *device = beside(place, CZ_ELEMENT_ANTI_CLIMBER);
    *stroke = cz_device_stroke(CZ_DEVICE(&place->end->anti_climber));
    if (device == NULL) {
        device = beside(place, CZ_ELEMENT_SIDE_BUFFERS);
        const CzSideBuffers *side = &place->end->side_buffers;
        *stroke = cz_device_stroke(CZ_DEVICE(&side->tube));
        if (!side->tube.given)
            *stroke = cz_total_stroke(side->buffer.stages, side->buffer.n_stages, NULL);
    }
    if (device != NULL)
        *force = cz_plastic_force(place->end, device->kind, place->rate);
    return device;
}

static bool activation_of_end(const CzPlace *place, CzActivation *activation) {
    const double crushing = cz_crushing_force(place->end, CZ_ELEMENT_END, place->rate);
    const double short_of_force = short_of(place->element->peak_force, crushing);
    double stroke, force;
    const CzElementResult *device = device_in_front(place, &stroke, &force);
    if (device != NULL && force < crushing) {
        const bool may_not_touch = device->kind == CZ_ELEMENT_ANTI_CLIMBER;
        activation->distance = at_least_0(1 - device->stroke_used) + force_share * short_of_force;
        if (may_not_touch && stroke > 0)
            activation->distance += gap_left(place) / stroke;
        activation->size = force * stroke;
    } else if (device != NULL) {
        activation->distance = short_of_force;
        activation->size = crushing * stroke;
    } else {
        stroke = fmax(place->end->face_gap, cz_free_stroke(place->end));
        activation->distance = gap_left(place) / stroke + force_share * short_of_force;
        activation->size = crushing * stroke;
    }
    if (short_of_force == 0)
        activation->distance = 0;
    return activation->size > 0 && isfinite(activation->distance);
}

bool cz_activation_of_element(const CzPlace *place, CzActivation *activation) {
    switch (place->element->kind) {
    case CZ_ELEMENT_ANTI_CLIMBER:
        return activation_of_anti_climber(place, activation);
    case CZ_ELEMENT_END:
        return activation_of_end(place, activation);
    case CZ_ELEMENT_COUPLER: /* its buffer dissipates energy in any collision */
    case CZ_ELEMENT_SIDE_BUFFERS:
    case CZ_ELEMENT_SUPERSTRUCTURE:
    case CZ_ELEMENT_DRAW_GEAR:
    case CZ_ELEMENT_SLIDE:
    case CZ_N_ELEMENT_KIND:
        break;
    }
    return false;
}

/* ---- zones of an end ------------------------------------------------------------------------ */

/* Stroke of an end in front of a zone; below 0 when it has no such zone. Survival space is also
 * behind the last stage. */
static double stroke_before(const CzEnd *end, CzZone zone) {
    double stroke = 0;
    for (int i = 0; i < end->n_stages; i++) {
        if (end->stages[i].zone == (int)zone)
            return stroke;
        stroke += end->stages[i].stroke;
    }
    return zone == CZ_ZONE_SURVIVAL ? cz_total_stroke(end->stages, end->n_stages, &end->curve) : -1;
}

static bool activation_of_zone(const CzPlace *place, CzZone zone, CzActivation *activation) {
    const double before = stroke_before(place->end, zone);
    if (place->element->kind != CZ_ELEMENT_END || before < 0 ||
        !activation_of_end(place, activation))
        return false;
    if (!(before > 0))
        return true;
    activation->distance += at_least_0(1 - place->element->stroke / before);
    activation->size = before * cz_plastic_force(place->end, CZ_ELEMENT_END, place->rate);
    return true;
}

bool cz_activation_of_temporary_space(const CzPlace *place, CzActivation *activation) {
    return activation_of_zone(place, CZ_ZONE_TEMPORARY, activation);
}

bool cz_activation_of_survival_space(const CzPlace *place, CzActivation *activation) {
    return activation_of_zone(place, CZ_ZONE_SURVIVAL, activation);
}

/* That of the end nearest to crushing its survival space, or with the most energy there. */
bool cz_activation_of_survival_spaces(const CzPlace *place, CzActivation *activation) {
    CzPlace at = *place;
    double most = 0;
    bool found = false;
    for (int i = 0; i < place->run->n_interface; i++)
        for (int k = 0; k < place->run->interface[i].n_element; k++) {
            at.interface = &place->run->interface[i];
            at.interface_index = i;
            at.element = &at.interface->element[k];
            const int vehicle = at.element->vehicle;
            const CzVehicle *record = &place->vehicles[place->scene->record[vehicle]];
            at.end = vehicle == i ? &record->front : &record->rear;
            const double energy = at.element->zone_energy[CZ_ZONE_SURVIVAL];
            CzActivation next;
            if (cz_scene_has_obstacle_at(place->scene, vehicle) ||
                !cz_activation_of_survival_space(&at, &next))
                continue;
            if (!found || energy > most || (energy == most && next.distance < activation->distance))
                *activation = next;
            most = fmax(most, energy);
            found = true;
        }
    return found;
}
