/* Metrics: names, parsing, aggregation. */
#include "evaluate/metric.h"
#include "base/error.h"
#include "base/suggest.h"
#include "evaluate/devices.h"
#include "evaluate/place.h"

#include <stdio.h>
#include <string.h>

/* Energies below this count as nothing, so that no share is taken of them [J]. */
static const double nothing = 100;

/* What is smaller than this share of the smallest scale of a margin is what rounding left of zero.
 */
static const double rounding = 1e-9;

static double share_of(double part, double whole) {
    return whole > nothing ? part / whole : NAN;
}

/* What a run has left to collide with. The rule that ends a run waits until for a pitch period none
 * closes in; what neighbours then still do is rattle, of another size at every step. */
static double left_to_close(const CzRunSummary *run) {
    const bool over = run->ended == CZ_ENDED_BY_RULE || run->ended == CZ_ENDED_SETTLED;
    return over ? 0 : run->closing_speed;
}

/* Rib pitch of the coarser of the two faces at an interface; 0 without faces. */
static double rib_pitch(const CzPlace *place) {
    double pitch = 0;
    for (int side = 0; side < 2; side++) {
        const int vehicle = place->interface_index + side;
        const CzVehicle *record = &place->vehicles[place->scene->record[vehicle]];
        const CzAntiClimber *face =
            side == 0 ? &record->front.anti_climber : &record->rear.anti_climber;
        if (face->given && face->rib_count > 0)
            pitch = fmax(pitch, face->face_height / face->rib_count);
    }
    return pitch;
}

static double overlap_in_ribs(const CzPlace *place) {
    return place->interface->min_overlap / rib_pitch(place);
}

static bool is_judged(const CzPlace *place, int vehicle) {
    return !cz_scene_has_obstacle_at(place->scene, vehicle);
}

/* Whether anything at an interface ran beyond its last point, the devices of an obstacle aside. */
static double judged_bottoming(const CzPlace *place) {
    const CzInterfaceResult *interface = place->interface;
    if (is_judged(place, place->interface_index) && is_judged(place, place->interface_index + 1))
        return interface->bottomed_out;
    for (int i = 0; i < interface->n_element; i++)
        if (interface->element[i].bottomed_out && is_judged(place, interface->element[i].vehicle))
            return 1;
    return 0;
}

/* Largest force through the sections at an interface that are judged. */
static double judged_section_force(const CzPlace *place) {
    double force = NAN;
    for (int side = 0; side < 2; side++)
        if (is_judged(place, place->interface_index + side))
            force = fmax(force, place->interface->section_force[side]);
    return force;
}

/* Closure between the end structures over the room that the folded gangways leave; 0 at the
 * colliding interface, which has no gangway. */
static double inner_gap_used(const CzPlace *place) {
    if (place->interface_index == place->scene->colliding)
        return 0;
    double closure = place->interface->shortening;
    for (int i = 0; i < place->interface->n_element; i++)
        if (place->interface->element[i].kind == CZ_ELEMENT_END)
            closure -= place->interface->element[i].stroke;
    const int *record = &place->scene->record[place->interface_index];
    const CzEnd *behind = &place->vehicles[record[0]].front;
    const CzEnd *ahead = &place->vehicles[record[1]].rear;
    const double room =
        behind->face_gap - behind->gangway_block + ahead->face_gap - ahead->gangway_block;
    return room > 0 || isnan(room) ? closure / room : INFINITY;
}

/* Plastic energy of the end structure behind an anti-climber [J]. */
static double energy_behind(const CzPlace *place) {
    for (int i = 0; i < place->interface->n_element; i++) {
        const CzElementResult *element = &place->interface->element[i];
        if (element->kind == CZ_ELEMENT_END && element->vehicle == place->element->vehicle)
            return element->energy;
    }
    return 0;
}

/* What bottomed out used its stroke up and hardly more, however hard it was hit. So beyond the last
 * point two things stand for the stroke that was missing: the rise of the force F over the largest
 * plastic one P, up to a tenth of the stroke, and behind an anti-climber the energy E that the end
 * structure had to take in its place:
 *
 *   demand = used + 0.1 (1 - P / F) + E / (P stroke)
 *
 * It does not jump at the last point. A coupler with a shear-off asks for nothing until it lets go:
 * its tubes may be used up. */
static double stroke_demand(const CzPlace *place) {
    const CzElementResult *element = place->element;
    if (element->kind == CZ_ELEMENT_COUPLER && place->end->coupler.shear_off.given &&
        !element->sheared)
        return 0;
    const double plastic = cz_plastic_force(place->end, element->kind, place->rate);
    if (!element->bottomed_out || !(element->peak_force > plastic))
        return element->stroke_used;
    double demand = element->stroke_used + 0.1 * (1 - plastic / element->peak_force);
    if (element->kind == CZ_ELEMENT_ANTI_CLIMBER && element->stroke > 0 && plastic > 0)
        demand += energy_behind(place) / (plastic * element->stroke);
    return demand;
}

static double shear_load(const CzPlace *place) {
    const CzCoupler *coupler = &place->end->coupler;
    if (place->element->kind != CZ_ELEMENT_COUPLER || !coupler->shear_off.given)
        return NAN;
    const double load = place->element->peak_force / coupler->shear_off.force;
    return place->element->sheared ? fmax(load, 1) : load;
}

static double largest_wheel_lift(const CzPlace *place) {
    double lift = place->vehicle->checks_override ? 0 : NAN;
    for (int i = 0; i < 4; i++)
        lift = isnan(lift) ? lift : fmax(lift, place->vehicle->wheel_lift[i]);
    return lift;
}

/* Largest force of a coupler of the interface; NaN when it has none. */
static double coupler_force(const CzPlace *place) {
    double force = NAN;
    for (int i = 0; i < place->interface->n_element; i++)
        if (place->interface->element[i].kind == CZ_ELEMENT_COUPLER)
            force = fmax(force, place->interface->element[i].peak_force);
    return force;
}

/* Whether a design could not be written down and read back. Memory that is lacking counts as
 * broken: such a design is not one to win with. */
static double breaks_rules(const CzPlace *place) {
    return cz_problem_check_vehicles(place->problem, place->vehicles, NULL) != CZ_OK;
}

/* A climb that was seen is one whatever is declared; that none was seen says something only when
 * every full vehicle can lift. */
static double climbed(const CzPlace *place) {
    if (place->run->beyond_validity)
        return 1;
    for (int i = 0; i < place->run->n_vehicle; i++) {
        const CzVehicle *record = &place->vehicles[place->scene->record[i]];
        if (record->model == CZ_MODEL_FULL && !place->run->vehicle[i].checks_override)
            return NAN;
    }
    return place->must_declare ? 0 : NAN;
}

/* The list: one reading function and one row per metric. */
#define CZ_PASTE(a, b) a##b
#define CZ_READER(line) CZ_PASTE(read_, line)
#define CZ_METRIC(level, name, unit, per_unit, scale, absent, expression, doc)                     \
    static double CZ_READER(__LINE__)(const CzPlace *place) {                                      \
        return expression;                                                                         \
    }
#include "evaluate/metrics.def"
#undef CZ_METRIC

#define SKIP(why) false, why
#define UNKNOWN(why) true, why
#define CZ_METRIC(level, name, unit, per_unit, scale, absent, expression, doc)                     \
    {CZ_LEVEL_##level, name, unit, per_unit, scale, absent, CZ_READER(__LINE__), doc},
static const CzMetricKind kinds[] = {
#include "evaluate/metrics.def"
};
#undef CZ_METRIC
#undef SKIP
#undef UNKNOWN

enum { N_KIND = sizeof kinds / sizeof kinds[0] };

int cz_n_metric_kind(void) {
    return N_KIND;
}

const CzMetricKind *cz_metric_kind(int index) {
    return &kinds[index];
}

/* ---- rules between values -----------------------------------------------------------------------
 */

static double rule_ratio(const CzPlace *place, CzValueRule rule) {
    double ratio[CZ_N_VALUE_RULE];
    cz_problem_rule_ratios(place->problem, place->vehicles, place->record, place->end, ratio);
    return ratio[rule];
}

#define CZ_VALUE_RULE(constant, name, doc)                                                         \
    static double read_rule_##constant(const CzPlace *place) {                                     \
        return rule_ratio(place, CZ_VALUE_RULE_##constant);                                        \
    }
#include "problem/value_rules.def"
#undef CZ_VALUE_RULE

const CzMetricKind *cz_metric_of_rule(CzValueRule rule) {
#define CZ_VALUE_RULE(constant, name, doc)                                                         \
    {CZ_LEVEL_END, name, "", 1, 0.01, false, "no end has such a value", read_rule_##constant, doc},
    static const CzMetricKind of_rule[] = {
#include "problem/value_rules.def"
    };
#undef CZ_VALUE_RULE
    return &of_rule[rule];
}

/* ---- reading the text --------------------------------------------------------------------------
 */

/* Takes the word behind the last dot off a text of n letters and returns it. */
static const char *take_last_word(char *text) {
    char *dot = strrchr(text, '.');
    if (dot == NULL)
        return text;
    *dot = '\0';
    return dot + 1;
}

static bool read_aggregate(const char *word, CzAggregate *aggregate) {
    static const char *const words[] = {[CZ_AGGREGATE_MAX] = "max",
                                        [CZ_AGGREGATE_MIN] = "min",
                                        [CZ_AGGREGATE_SUM] = "sum",
                                        [CZ_AGGREGATE_MEAN] = "mean"};
    for (int i = CZ_AGGREGATE_MAX; i <= CZ_AGGREGATE_MEAN; i++)
        if (strcmp(word, words[i]) == 0) {
            *aggregate = (CzAggregate)i;
            return true;
        }
    return false;
}

static const CzMetricKind *find_kind(const char *name) {
    for (int i = 0; i < N_KIND; i++)
        if (strcmp(kinds[i].name, name) == 0)
            return &kinds[i];
    return NULL;
}

static CzStatus fail_unknown(const char *text, const char *name, CzError *error) {
    CzSuggestion nearest = {0};
    for (int i = 0; i < N_KIND; i++)
        cz_suggest(&nearest, name, kinds[i].name);
    const CzStatus status = cz_fail(error, CZ_STATUS_INPUT, "there is no metric '%s'", text);
    cz_suggest_help(&nearest, error);
    return status;
}

/* Splits "LEVEL.SELECTOR.NAME" into "LEVEL.NAME" and the selector. */
static void split_selector(const char *text, char *name, size_t n_name, char *selector,
                           size_t n_selector) {
    snprintf(name, n_name, "%s", text);
    snprintf(selector, n_selector, "*");
    const char *first = strchr(text, '.');
    const char *last = strrchr(text, '.');
    if (first == NULL || first == last)
        return;
    snprintf(name, n_name, "%.*s%s", (int)(first - text), text, last);
    snprintf(selector, n_selector, "%.*s", (int)(last - first - 1), first + 1);
}

CzStatus cz_metric_parse(const char *text, CzMetric *metric, CzError *error) {
    char copy[CZ_PATH_ROOM], name[CZ_PATH_ROOM];
    if (strlen(text) >= sizeof copy)
        return cz_fail(error, CZ_STATUS_INPUT, "the metric '%.40s...' is longer than %d letters",
                       text, CZ_PATH_ROOM - 1);
    snprintf(copy, sizeof copy, "%s", text);
    metric->aggregate = CZ_AGGREGATE_WORST;
    CzAggregate aggregate;
    if (read_aggregate(take_last_word(copy), &aggregate))
        metric->aggregate = aggregate;
    else
        snprintf(copy, sizeof copy, "%s", text);
    split_selector(copy, name, sizeof name, metric->selector, sizeof metric->selector);
    metric->kind = find_kind(name);
    return metric->kind != NULL ? CZ_OK : fail_unknown(text, name, error);
}

bool cz_metric_is_total(const CzMetricKind *kind) {
    static const char *const totals[] = {
#define CZ_TOTAL(name) name,
#include "evaluate/totals.def"
#undef CZ_TOTAL
    };
    for (size_t i = 0; i < sizeof totals / sizeof totals[0]; i++)
        if (strcmp(kind->name, totals[i]) == 0)
            return true;
    return false;
}

bool cz_metric_picks(const CzMetric *metric, const CzScene *scene) {
    return cz_places_count(scene, metric->kind->level, metric->selector) > 0;
}

/* ---- value --------------------------------------------------------------------------------------
 */

/* What a walk over the places adds up. */
typedef struct Sum {
    const CzMetricKind *kind;
    bool seeks_max;
    int n_known;
    double extreme, total; /* in the unit */
    double when[2];        /* of the extreme [s] */
    char where[CZ_WHERE_ROOM], unknown_where[CZ_WHERE_ROOM];
    bool any_unknown;
} Sum;

static void add_place(const CzPlace *place, void *data) {
    Sum *sum = data;
    const double value = sum->kind->value(place) / sum->kind->per_unit;
    if (isnan(value)) {
        const bool unknown = sum->kind->may_be_unknown && place->must_declare;
        if (unknown && !sum->any_unknown)
            memcpy(sum->unknown_where, place->name, sizeof sum->unknown_where);
        sum->any_unknown |= unknown;
        return;
    }
    const bool first = sum->n_known++ == 0;
    sum->total += value;
    if (first || (sum->seeks_max ? value > sum->extreme : value < sum->extreme)) {
        sum->extreme = value;
        memcpy(sum->where, place->name, sizeof sum->where);
        cz_metric_when(sum->kind, place, sum->when);
    }
}

static double aggregate_value(const Sum *sum, CzAggregate aggregate) {
    if (sum->n_known == 0)
        return NAN;
    if (aggregate == CZ_AGGREGATE_SUM)
        return sum->total;
    return aggregate == CZ_AGGREGATE_MEAN ? sum->total / sum->n_known : sum->extreme;
}

CzMetricValue cz_metric_value(const CzMetric *metric, const CzSubject *subject, bool worst_is_max) {
    const CzAggregate aggregate = metric->aggregate;
    Sum sum = {.kind = metric->kind,
               .when = {NAN, NAN},
               .seeks_max = aggregate == CZ_AGGREGATE_MAX ||
                            (aggregate != CZ_AGGREGATE_MIN && worst_is_max)};
    cz_places_visit(subject, metric->kind->level, metric->selector, add_place, &sum);
    CzMetricValue value = {.known = CZ_KNOWN, .value = aggregate_value(&sum, aggregate)};
    if (fabs(value.value) < rounding * metric->kind->scale) /* not of a yes or no */
        value.value = 0;
    const bool is_one = aggregate != CZ_AGGREGATE_SUM && aggregate != CZ_AGGREGATE_MEAN;
    value.when[0] = is_one ? sum.when[0] : NAN;
    value.when[1] = is_one ? sum.when[1] : NAN;
    memcpy(value.where, sum.where, sizeof value.where);
    memcpy(value.unknown_where, sum.unknown_where, sizeof value.unknown_where);
    if (sum.any_unknown || (sum.n_known == 0 && metric->kind->may_be_unknown))
        value.known = CZ_UNKNOWN;
    else if (sum.n_known == 0)
        value.known = CZ_DOES_NOT_APPLY;
    if (value.known != CZ_KNOWN)
        value.why = metric->kind->absent;
    return value;
}
