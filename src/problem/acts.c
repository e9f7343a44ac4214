/* Keys that have an effect in some cases only, and warnings of keys without effect. */
#include "problem/acts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "problem/meeting.h"

/* ---- the partner of a vehicle end ---- */

typedef struct Meeting {
    const CzVehicle *own, *other; /* `other` NULL: no partner */
    const CzEnd *end, *opposite;
    const void *record; /* that has the key */
    bool is_inner;      /* between two vehicles of one train */
} Meeting;

static bool is_model(const Meeting *meeting, int model) {
    return meeting->own->model == model || meeting->other->model == model;
}

static bool is_inner(const Meeting *meeting) {
    return meeting->other != NULL && meeting->is_inner;
}

static bool is_coupled(const Meeting *meeting) {
    return is_inner(meeting) && meeting->record == &meeting->end->coupler.buffer &&
           meeting->opposite->coupler.given;
}

static bool is_drawn(const Meeting *meeting) {
    return is_inner(meeting) && meeting->opposite->draw_gear.given;
}

static bool has_levels(const Meeting *meeting) {
    return meeting->other != NULL && is_model(meeting, CZ_MODEL_FULL) &&
           !is_model(meeting, CZ_MODEL_FIXED);
}

/* Whether the other end has a part of a kind and this one none, so that it strikes this end. */
static bool is_struck_by(const Meeting *meeting, CzPartKind kind) {
    return meeting->other != NULL && cz_end_has(meeting->opposite, kind) &&
           !cz_end_has(meeting->end, kind);
}

static bool is_struck_by_coupler(const Meeting *meeting) {
    return is_struck_by(meeting, CZ_PART_COUPLER);
}

static bool is_struck_at_height(const Meeting *meeting) {
    return (is_struck_by(meeting, CZ_PART_FACE) || is_struck_by(meeting, CZ_PART_COUPLER) ||
            is_struck_by(meeting, CZ_PART_SIDE_BUFFERS)) &&
           has_levels(meeting);
}

static bool is_rigid_and_struck(const Meeting *meeting) {
    return meeting->own->model == CZ_MODEL_RIGID &&
           (is_struck_by(meeting, CZ_PART_COUPLER) || is_struck_by(meeting, CZ_PART_SIDE_BUFFERS));
}

static bool faces_buffers(const Meeting *meeting) {
    return is_struck_by(meeting, CZ_PART_SIDE_BUFFERS) &&
           !cz_end_has(meeting->opposite, CZ_PART_FACE);
}

static bool acts_as_face(const Meeting *meeting) {
    return meeting->other != NULL &&
           !(faces_buffers(meeting) && meeting->end->anti_climber.in_line_with_buffers);
}

static bool slides_as_face(const Meeting *meeting) {
    return has_levels(meeting) && acts_as_face(meeting);
}

static bool has_bare_levels(const Meeting *meeting) {
    return has_levels(meeting) &&
           (!meeting->end->anti_climber.given || !isnan(meeting->end->face_height));
}

static bool has_faces(const Meeting *meeting) {
    return has_levels(meeting) && meeting->opposite->anti_climber.given;
}

static bool slides_bare(const Meeting *meeting) {
    return has_levels(meeting) &&
           (!meeting->end->anti_climber.given ||
            (is_struck_by(meeting, CZ_PART_SIDE_BUFFERS) && acts_as_face(meeting)));
}

static bool has_superstructures(const Meeting *meeting) {
    return meeting->other != NULL && meeting->own->model == CZ_MODEL_FULL &&
           meeting->other->model == CZ_MODEL_FULL && meeting->opposite->superstructure.given;
}

/* The mass of tubes and anti-climbers acts without a partner, too. */
static bool meets_or_weighs(const Meeting *meeting) {
    const CzEnd *end = meeting->end;
    const bool has_mass =
        end->coupler.tube.mass_per_stroke > 0 || end->coupler.second_tube.mass_per_stroke > 0 ||
        end->anti_climber.mass_per_stroke > 0 || end->side_buffers.tube.mass_per_stroke > 0;
    return meeting->other != NULL || (has_mass && meeting->own->model != CZ_MODEL_FIXED);
}

static bool crushes(const Meeting *meeting) {
    return meeting->end->n_stages > 0 || meeting->end->curve.given;
}

static bool is_stage_of_end(const Meeting *meeting) {
    const uintptr_t at = (uintptr_t)meeting->record, first = (uintptr_t)meeting->end->stages;
    return at >= first && at - first < sizeof meeting->end->stages;
}

static const CzTrain *train_of(const CzInput *input, const CzVehicle *vehicle) {
    for (int i = 0; i < input->n_trains; i++) {
        const CzTrain *train = &input->trains[i];
        if (train->n_vehicles > 0 && vehicle >= train->vehicles &&
            vehicle < train->vehicles + train->n_vehicles)
            return train;
    }
    return NULL;
}

static void set_other(Meeting *meeting, const CzVehicle *other) {
    meeting->other = other;
    meeting->opposite = meeting->end == &meeting->own->front ? &other->rear : &other->front;
}

/* Whether an end has in some scenario a partner for which `holds` is true. */
static bool meets(const CzInput *input, Meeting *meeting, bool (*holds)(const Meeting *)) {
    const CzTrain *train = train_of(input, meeting->own);
    if (train == NULL || holds(meeting))
        return true;
    const bool is_front = meeting->end == &meeting->own->front;
    const int next = (int)(meeting->own - train->vehicles) + (is_front ? 1 : -1);
    meeting->is_inner = next >= 0 && next < train->n_vehicles;
    if (meeting->is_inner) {
        set_other(meeting, &train->vehicles[next]);
        return holds(meeting);
    }
    for (int i = 0; i < input->n_scenarios; i++) {
        const CzScenario *scenario = &input->scenarios[i];
        const CzTrain *partner = cz_input_train(input, scenario, is_front);
        if (cz_input_train(input, scenario, !is_front) != train || partner == NULL ||
            partner->n_vehicles == 0)
            continue;
        set_other(meeting, &partner->vehicles[is_front ? 0 : partner->n_vehicles - 1]);
        if (holds(meeting))
            return true;
    }
    return false;
}

/* ---- which keys ---- */

typedef enum { EVERY, MOVING, FULL } Models; /* MOVING: full and rigid vehicles */

/* Requirement of keys of a record. One of the four is given. */
typedef struct Condition {
    CzRecordId record;
    const char *stems; /* of the keys, with blanks between */
    Models models;
    const char *sibling; /* this key must be given and not zero, */
    int word;            /* or be this word, unless it is the first */
    bool (*meets)(const Meeting *);
    const char *reason; /* of the warning, with `meets` */
} Condition;

#define ON(type, models, stems) {CZ_RECORD_##type, stems, models, NULL, 0, NULL, NULL},
#define BESIDE(type, sibling, stems) {CZ_RECORD_##type, stems, EVERY, sibling, 0, NULL, NULL},
#define AT(type, sibling, word, stems) {CZ_RECORD_##type, stems, EVERY, sibling, word, NULL, NULL},
#define AGAINST(type, meets, reason, stems)                                                        \
    {CZ_RECORD_##type, stems, EVERY, NULL, 0, meets, reason},
static const Condition conditions[] = {
#include "problem/acts.def"
};
enum { N_CONDITION = sizeof conditions / sizeof conditions[0], LONGEST_LIST = 320 };

static bool is_of(const Condition *condition, const CzKey *key) {
    const CzRecord *record = &cz_records[condition->record];
    return key >= record->key && key < record->key + record->n_key &&
           cz_text_is_word(key->stem, condition->stems);
}

static bool acts_on(const Condition *condition, CzVehicleModel model) {
    return condition->models == EVERY || model == CZ_MODEL_FULL ||
           (model == CZ_MODEL_RIGID && condition->models == MOVING);
}

bool cz_key_acts_on(const CzKey *key, CzVehicleModel model) {
    for (int i = 0; i < N_CONDITION; i++)
        if (is_of(&conditions[i], key) && !acts_on(&conditions[i], model))
            return false;
    return true;
}

bool cz_key_is_conditional(const CzKey *key) {
    for (int i = 0; i < N_CONDITION; i++)
        if (conditions[i].models == EVERY && is_of(&conditions[i], key))
            return true;
    return false;
}

/* The vehicle that has a field; NULL for a field elsewhere, or a vehicle that could not be read.
 */
static const CzVehicle *vehicle_of(const CzProblem *problem, const void *address) {
    const uintptr_t at = (uintptr_t)address, start = (uintptr_t)problem->vehicle;
    if (at < start || at - start >= (size_t)problem->n_vehicle * sizeof(CzVehicle))
        return NULL;
    const CzVehicle *vehicle = &problem->vehicle[(at - start) / sizeof(CzVehicle)];
    return vehicle->given ? vehicle : NULL;
}

bool cz_field_acts_on_model(const CzProblem *problem, const CzKey *key, const void *field) {
    const CzVehicle *own = vehicle_of(problem, field);
    return own == NULL || cz_key_acts_on(key, (CzVehicleModel)own->model);
}

/* Whether a sibling key is the required word, or is given and, if a number, not zero or variable in
 * a search. */
static bool sibling_holds(const CzProblem *problem, const Condition *condition,
                          const char *record) {
    const CzOptimise *search = &problem->input.optimise;
    const CzKey *key = cz_record_key(&cz_records[condition->record], condition->sibling);
    const void *field = record + key->offset;
    if (condition->word > 0)
        return *(const int *)field == condition->word;
    const double value = *(const double *)field;
    const bool varies = (key->variation == CZ_VARIATION_VARIES && search->given) ||
                        (key->variation == CZ_VARIATION_FITS && search->n_match > 0);
    return value >= 0 && (value > 0 || varies);
}

static bool holds(const CzProblem *problem, const Condition *condition, const CzKey *key,
                  const void *field) {
    const CzVehicle *own = vehicle_of(problem, field);
    const char *record = (const char *)field - key->offset;
    if (condition->models != EVERY)
        return own == NULL || acts_on(condition, (CzVehicleModel)own->model);
    if (key->presence == CZ_PRESENCE_REQUIRED ||
        (key->presence == CZ_PRESENCE_REQUIRED_FULL && own != NULL && own->model == CZ_MODEL_FULL))
        return true;
    if (condition->sibling != NULL)
        return sibling_holds(problem, condition, record);
    if (own == NULL)
        return true;
    const uintptr_t at = (uintptr_t)field, rear = (uintptr_t)&own->rear;
    const bool is_rear = at >= rear && at - rear < sizeof own->rear;
    Meeting meeting = {.own = own, .end = is_rear ? &own->rear : &own->front, .record = record};
    return meets(&problem->input, &meeting, condition->meets);
}

/* The requirement that a field of a key does not meet; NULL when it has an effect. */
static const Condition *find_unmet(const CzProblem *problem, const CzKey *key, const void *field) {
    for (int i = 0; i < N_CONDITION; i++)
        if (is_of(&conditions[i], key) && !holds(problem, &conditions[i], key, field))
            return &conditions[i];
    return NULL;
}

bool cz_field_acts(const CzProblem *problem, const CzKey *key, const void *field) {
    return find_unmet(problem, key, field) == NULL;
}

/* The required word of a sibling key; NULL for any. */
static const char *word_of(const Condition *condition) {
    if (condition->word == 0)
        return NULL;
    const CzKey *key = cz_record_key(&cz_records[condition->record], condition->sibling);
    return key->words->word[condition->word].word;
}

void cz_acts_write(FILE *stream, const CzKey *key) {
    for (int i = 0; i < N_CONDITION; i++) {
        const Condition *condition = &conditions[i];
        if (!is_of(condition, key))
            continue;
        const char *word = word_of(condition);
        if (condition->models != EVERY)
            fputs(condition->models == FULL ? "; of full vehicles only" : "; not of fixed vehicles",
                  stream);
        else if (condition->sibling != NULL)
            fprintf(stream, "; only with `%s%s%s`", condition->sibling, word != NULL ? ": " : "",
                    word != NULL ? word : "");
    }
}

/* ---- warnings ---- */

static int compare_nodes(const void *a, const void *b) {
    const uintptr_t first = (uintptr_t) * (const CzNode *const *)a;
    const uintptr_t second = (uintptr_t) * (const CzNode *const *)b;
    return (first > second) - (first < second);
}

/* Finds the unmet requirement of each written field (n_place). Fields inside a record without
 * effect are not listed. */
static void list_unmet(CzProblem *problem, const Condition **unmet, const CzNode **acting) {
    const CzPlaces *places = &problem->places;
    int n_acting = 0;
    for (int i = 0; i < places->n_place; i++) {
        const CzPlace *place = &places->place[i];
        if (place->size > 0 || place->key == NULL)
            continue;
        unmet[i] = find_unmet(problem, place->key, place->address);
        if (unmet[i] == NULL && cz_key_is_conditional(place->key))
            acting[n_acting++] = place->node;
    }
    qsort(acting, (size_t)n_acting, sizeof(const CzNode *), compare_nodes);
    for (int i = 0; i < places->n_place; i++) {
        const CzPlace *place = &places->place[i];
        if (unmet[i] == NULL || unmet[i]->models != EVERY)
            continue;
        if (place->node->source->is_general ||
            bsearch(&place->node, acting, (size_t)n_acting, sizeof(const CzNode *),
                    compare_nodes) != NULL)
            unmet[i] = NULL;
        const uintptr_t start = (uintptr_t)place->address;
        for (int k = i - 1; k >= 0 && unmet[i] != NULL && place->key->kind == CZ_KEY_CHILD &&
                            (uintptr_t)places->place[k].address - start < place->key->child->size;
             k--)
            unmet[k] = NULL;
    }
}

/* One warning for all fields of a record with the same unmet requirement, at the first of them. */
static void warn(CzProblem *problem, const Condition **unmet, int first) {
    const CzPlace *place = &problem->places.place[first];
    const CzVehicle *own = vehicle_of(problem, place->address);
    const char *record = (const char *)place->address - place->key->offset;
    const Condition *condition = unmet[first];
    char list[LONGEST_LIST] = "";
    for (int i = first; i < problem->places.n_place &&
                        vehicle_of(problem, problem->places.place[i].address) == own;
         i++) {
        const CzPlace *next = &problem->places.place[i];
        const size_t n = strlen(list);
        if (unmet[i] != condition || (const char *)next->address - next->key->offset != record)
            continue;
        snprintf(list + n, sizeof list - n, "%s%s", n > 0 ? ", " : "", next->key->stem);
        unmet[i] = NULL;
    }
    static const char help[] = "remove the key, or add what it acts with";
    CzMistakes *warnings = &problem->reader.warnings;
    const char *word = word_of(condition);
    if (condition->models != EVERY)
        cz_mistake(warnings, place->node, place->trail, "no effect on model: %s: %s",
                   cz_word_sets[CZ_WORDS_MODEL].word[own->model].word, list);
    else if (condition->meets != NULL)
        cz_mistake(warnings, place->node, place->trail, "no effect: %s: %s" CZ_HELP "%s", list,
                   condition->reason, help);
    else
        cz_mistake(warnings, place->node, place->trail, "no effect without %s%s%s: %s" CZ_HELP "%s",
                   condition->sibling, word != NULL ? ": " : "", word != NULL ? word : "", list,
                   help);
}

void cz_acts_check(CzProblem *problem) {
    const size_t n = (size_t)problem->places.n_place + 1;
    CzArena *arena = &problem->reader.arena;
    const Condition **unmet = cz_arena_allocate(arena, n, sizeof(const Condition *));
    const CzNode **acting = cz_arena_allocate(arena, n, sizeof(const CzNode *));
    if (unmet == NULL || acting == NULL)
        return;
    list_unmet(problem, unmet, acting);
    for (int i = 0; i < problem->places.n_place; i++)
        if (unmet[i] != NULL)
            warn(problem, unmet, i);
}
