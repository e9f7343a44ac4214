/* Converts the strokes of curves. */
#include "problem/strokes.h"

#include <math.h>

#include "base/number.h"
#include "problem/keys.h"
#include "problem/trace.h"
#include "tree/merge.h"

#define APART 1e-6  /* smallest distance of points, of the stroke (ours) */
#define BEHIND 0.01 /* of the stroke: a larger decrease of plastic strokes is reported (ours) */
#define WITHOUT_FORCE 0.2 /* of the mean force: a smaller first force counts as zero (ours) */

double cz_total_stroke(const CzStage *stage, int n_stage, const CzTable *curve) {
    if (curve != NULL && curve->given)
        return curve->x[curve->n_point - 1];
    double stroke = 0.0;
    for (int i = 0; i < n_stage; i++)
        stroke += stage[i].stroke;
    return stroke;
}

double cz_device_stroke(CzDevice device) {
    return device.given ? cz_total_stroke(device.stages, device.n_stages, device.curve) : 0.0;
}

double cz_free_stroke(const CzEnd *end) {
    double stroke = 0.0;
    if (end->curve.given)
        return cz_total_stroke(NULL, 0, &end->curve);
    for (int i = 0; i < end->n_stages; i++)
        stroke += end->stages[i].zone == CZ_ZONE_SURVIVAL ? 0.0 : end->stages[i].stroke;
    return stroke;
}

static double mean_force(const CzTable *curve) {
    const int last = curve->n_point - 1;
    return cz_work(curve->x, curve->y, 0, last) / curve->x[last];
}

/* Adds compliance times force to the strokes; `*behind` is the largest length by which they then
 * decrease, which no law can. On an elastic rise all plastic strokes are equal and the last force
 * counts: at 0 alone, elsewhere as a rise as steep as the smallest distance of points allows. Other
 * points that do not increase the stroke are dropped. */
static bool add_elastic(CzTable *curve, double compliance, double *behind) {
    const double apart = APART * curve->x[curve->n_point - 1];
    int n = 0, top = 0; /* the point that ends the latest rise */
    for (int i = 0; i < curve->n_point; i++) {
        const double moved = curve->x[i] + compliance * curve->y[i], y = curve->y[i];
        const double x = fmax(moved, 0);
        *behind = fmax(*behind, (n > 0 ? curve->x[n - 1] : 0) - moved);
        if (n == 0 || x > curve->x[n - 1] + apart) {
            curve->x[n] = n == 0 ? 0 : x;
            curve->y[n++] = y;
        } else if (y > curve->y[n - 1]) {
            if (n > 1 && top != n - 1) {
                top = n;
                curve->x[n++] = curve->x[top - 1] + 2 * apart;
            }
            curve->y[n - 1] = y;
        }
    }
    curve->n_point = n;
    return n >= 2;
}

static void convert(CzReader *reader, const CzNode *node, const CzTrail *trail, CzTable *curve,
                    double compliance) {
    const double stroke = curve->x[curve->n_point - 1];
    double behind = 0;
    char stiffness[CZ_NUMBER_TEXT], length[CZ_NUMBER_TEXT];
    curve->converted = true;
    if (isfinite(compliance) && !add_elastic(curve, compliance, &behind))
        cz_mistake(&reader->mistakes, node, trail,
                   "the whole shortening of 'curve' would be elastic: the stiffness is too small "
                   "for it");
    else if (behind > BEHIND * stroke)
        cz_mistake(&reader->warnings, node, trail,
                   "'curve' %s more steeply than its law can follow with a stiffness of %s MN/m: "
                   "the law is up to %s mm behind it",
                   compliance < 0 ? "rises" : "falls",
                   cz_number_print_short(stiffness, 1e-6 / fabs(compliance)),
                   cz_number_print_short(length, 1e3 * behind));
}

/* A curve over plastic strokes begins with the force that starts the crush. */
static void bind_plastic(CzReader *reader, const CzNode *node, const CzTrail *trail, CzTable *curve,
                         double stiffness) {
    if (curve->strokes == CZ_STROKES_TOTAL)
        convert(reader, node, trail, curve, -1 / stiffness);
    else if (curve->strokes == CZ_STROKES_UNSAID && curve->y[0] < WITHOUT_FORCE * mean_force(curve))
        cz_mistake(&reader->warnings, node, trail,
                   "'curve' begins without force, as a total shortening does, but its strokes are "
                   "taken as plastic; 'strokes: total' subtracts the elastic part, 'strokes: "
                   "plastic' confirms plastic strokes");
    curve->strokes = CZ_STROKES_PLASTIC;
}

void cz_bind_strokes(CzReader *reader, const CzRecord *record, const CzNode *node,
                     const CzTrail *trail, void *memory) {
    const CzEntry *entry = cz_node_find(node, "curve");
    if (entry != NULL) { /* place of the messages */
        node = entry->value;
        trail = cz_entry_trail(entry, trail);
    }
    if (record == &cz_records[CZ_RECORD_CzTube]) {
        CzTube *tube = memory;
        if (tube->curve.given)
            bind_plastic(reader, node, trail, &tube->curve, tube->stiffness);
    } else if (record == &cz_records[CZ_RECORD_CzAntiClimber]) {
        CzAntiClimber *device = memory;
        if (device->curve.given)
            bind_plastic(reader, node, trail, &device->curve, device->stiffness);
    } else if (record == &cz_records[CZ_RECORD_CzEnd]) {
        CzEnd *end = memory;
        const double first = end->unloading_stiffness, share = end->unloading_share;
        const double second =
            isnan(end->second_unloading_stiffness) ? first : end->second_unloading_stiffness;
        if (end->curve.given && end->curve.strokes == CZ_STROKES_PLASTIC)
            convert(reader, node, trail, &end->curve, (1 - share) / first + share / second);
        end->curve.strokes = CZ_STROKES_TOTAL;
    }
}

static bool is_of_tube(const CzTube *tube, const double *field) {
    return tube->given && tube->curve.converted && field == &tube->stiffness;
}

static bool is_of_end(const CzEnd *end, const double *field) {
    const bool is_unloading = field == &end->unloading_stiffness ||
                              field == &end->unloading_share ||
                              field == &end->second_unloading_stiffness;
    return is_of_tube(&end->coupler.tube, field) || is_of_tube(&end->coupler.second_tube, field) ||
           is_of_tube(&end->side_buffers.tube, field) ||
           (end->anti_climber.curve.converted && field == &end->anti_climber.stiffness) ||
           (end->curve.converted && is_unloading);
}

bool cz_strokes_depend_on(const CzInput *input, const double *field) {
    for (int t = 0; t < input->n_trains; t++)
        for (int v = 0; v < input->trains[t].n_vehicles; v++) {
            const CzVehicle *vehicle = &input->trains[t].vehicles[v];
            if (is_of_end(&vehicle->front, field) || is_of_end(&vehicle->rear, field))
                return true;
        }
    return false;
}
