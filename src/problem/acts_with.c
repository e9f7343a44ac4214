/* Warns of keys that have no effect without another key of their record, or without a counterpart
 * at the opposite end. A key of a part that is used in several places has an effect when it acts in
 * one of them. */
#include "problem/acts_with.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "problem/acts_on.h"

/* ---- what a vehicle end meets ---- */

typedef struct Meeting {
    const CzVehicle *own, *other; /* `other` NULL: nothing is met */
    const CzEnd *end, *opposite;
    const void *record; /* that has the key */
    bool is_inner;      /* between two vehicles of one train */
} Meeting;

static bool has_full(const Meeting *meeting) {
    return meeting->own->model == CZ_MODEL_FULL || meeting->other->model == CZ_MODEL_FULL;
}

static bool is_inner(const Meeting *meeting) {
    return meeting->other != NULL && meeting->is_inner;
}

static bool is_coupled(const Meeting *meeting) {
    return is_inner(meeting) && meeting->record == &meeting->end->coupler.buffer &&
           meeting->opposite->given && meeting->opposite->coupler.given;
}

static bool is_drawn(const Meeting *meeting) {
    return is_inner(meeting) && meeting->opposite->given && meeting->opposite->draw_gear.given;
}

static bool has_levels(const Meeting *meeting) {
    return meeting->other != NULL && has_full(meeting) && meeting->own->model != CZ_MODEL_FIXED &&
           meeting->other->model != CZ_MODEL_FIXED;
}

static bool has_bare_levels(const Meeting *meeting) {
    return has_levels(meeting) && !meeting->end->anti_climber.given;
}

static bool slides_on_faces(const Meeting *meeting) {
    return has_levels(meeting) && meeting->opposite->given && meeting->opposite->anti_climber.given;
}

static bool slides_on_plates(const Meeting *meeting) {
    return has_levels(meeting) && meeting->opposite->given && meeting->opposite->side_buffers.given;
}

static bool has_superstructures(const Meeting *meeting) {
    return meeting->other != NULL && meeting->own->model == CZ_MODEL_FULL &&
           meeting->other->model == CZ_MODEL_FULL && meeting->opposite->given &&
           meeting->opposite->superstructure.given;
}

static bool crushes(const Meeting *meeting) {
    return meeting->end->n_stages > 0 || meeting->end->curve.given;
}

static const CzTrain *train_named(const CzInput *input, const char *name) {
    for (int i = 0; i < input->n_trains; i++)
        if (input->trains[i].name != NULL && strcmp(input->trains[i].name, name) == 0)
            return &input->trains[i];
    return NULL;
}

/* A train that collides in a scenario: 0 the one behind, 1 the one ahead; NULL for none. */
static const CzTrain *colliding_train(const CzInput *input, const CzScenario *scenario, int which) {
    if (scenario->trains.n_text == 2)
        return train_named(input, scenario->trains.text[which]);
    return which < input->n_trains ? &input->trains[which] : NULL;
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

/* Whether an end meets in some scenario what `holds` requires. */
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
        const CzTrain *partner = colliding_train(input, scenario, is_front);
        if (colliding_train(input, scenario, !is_front) != train || partner == NULL ||
            partner->n_vehicles == 0)
            continue;
        set_other(meeting, &partner->vehicles[is_front ? 0 : partner->n_vehicles - 1]);
        if (holds(meeting))
            return true;
    }
    return false;
}

/* ---- the table ---- */

static const struct {
    bool (*holds)(const Meeting *);
    const char *reason;
} meetings[] = {
#define CZ_MEETING(meeting, predicate, reason) {predicate, reason},
#include "problem/acts_with.def"
};

enum {
#define CZ_MEETING(meeting, predicate, reason) MEETING_##meeting,
#include "problem/acts_with.def"
    NO_MEETING = -1,
    ANY_WORD = -1
};

typedef struct Condition {
    CzRecordId record;
    const char *stem, *sibling;
    int choice; /* of the sibling; ANY_WORD: it is given and not zero */
    const char *word;
    int meeting;
} Condition;

static const Condition conditions[] = {
#define CZ_ACTS_BESIDE(type, stem, sibling)                                                        \
    {CZ_RECORD_##type, #stem, #sibling, ANY_WORD, NULL, NO_MEETING},
#define CZ_ACTS_AT(type, stem, sibling, constant, word)                                            \
    {CZ_RECORD_##type, #stem, #sibling, constant, #word, NO_MEETING},
#define CZ_ACTS_AGAINST(type, stem, meeting)                                                       \
    {CZ_RECORD_##type, #stem, NULL, ANY_WORD, NULL, MEETING_##meeting},
#include "problem/acts_with.def"
};
enum { N_CONDITION = sizeof conditions / sizeof conditions[0], LONGEST_LIST = 240 };

static const Condition *condition_of(const CzKey *key) {
    for (int i = 0; i < N_CONDITION && key != NULL; i++) {
        const CzRecord *record = &cz_records[conditions[i].record];
        const bool is_of_record = key >= record->key && key < record->key + record->n_key;
        if (is_of_record && strcmp(key->stem, conditions[i].stem) == 0)
            return &conditions[i];
    }
    return NULL;
}

/* Whether a sibling is given and, as a number, not zero, or one that a search may change. */
static bool is_there(const CzProblem *problem, const CzKey *key, const void *field) {
    const CzOptimise *search = &problem->input.optimise;
    const double value = *(const double *)field;
    const bool varies = (key->variation == CZ_VARIATION_VARIES && search->given) ||
                        (key->variation == CZ_VARIATION_FITS && search->n_match > 0);
    return key->kind != CZ_KEY_NUMBER || value > 0 || (value == 0 && varies);
}

static bool sibling_holds(const CzProblem *problem, const Condition *condition,
                          const char *record) {
    const CzKey *sibling = cz_record_key(&cz_records[condition->record], condition->sibling);
    const void *field = record + sibling->offset;
    if (condition->choice != ANY_WORD)
        return *(const int *)field == condition->choice;
    return is_there(problem, sibling, field);
}

static bool is_required(const CzKey *key, const CzVehicle *own) {
    const bool is_full = own != NULL && own->model == CZ_MODEL_FULL;
    return key->presence == CZ_PRESENCE_REQUIRED ||
           (key->presence == CZ_PRESENCE_REQUIRED_FULL && is_full);
}

bool cz_acts_with(const CzProblem *problem, const CzKey *key, const void *field) {
    const Condition *condition = condition_of(key);
    const CzVehicle *own = cz_vehicle_of(problem, field);
    if (condition == NULL || is_required(key, own))
        return true;
    const char *record = (const char *)field - key->offset;
    if (condition->meeting == NO_MEETING)
        return sibling_holds(problem, condition, record);
    if (own == NULL || !own->given)
        return true;
    const uintptr_t at = (uintptr_t)field, rear = (uintptr_t)&own->rear;
    const bool is_rear = at >= rear && at - rear < sizeof own->rear;
    Meeting meeting = {.own = own, .end = is_rear ? &own->rear : &own->front, .record = record};
    return meets(&problem->input, &meeting, meetings[condition->meeting].holds);
}

void cz_acts_with_write(FILE *stream, const CzKey *key) {
    const Condition *condition = condition_of(key);
    if (condition != NULL && condition->sibling != NULL)
        fprintf(stream, "; only with `%s%s%s`", condition->sibling,
                condition->word != NULL ? ": " : "",
                condition->word != NULL ? condition->word : "");
}

/* ---- warnings ---- */

/* A written field with a condition. What a catalogue has is for any problem. */
static bool is_conditional(const CzPlace *place) {
    return place->size == 0 && condition_of(place->key) != NULL &&
           !place->node->source->is_catalogue;
}

static bool is_idle(const CzProblem *problem, const CzPlace *place) {
    return cz_field_acts(problem, place->key, place->address) &&
           !cz_acts_with(problem, place->key, place->address);
}

static int compare_nodes(const void *a, const void *b) {
    const CzNode *first = *(const CzNode *const *)a, *second = *(const CzNode *const *)b;
    return ((uintptr_t)first > (uintptr_t)second) - ((uintptr_t)first < (uintptr_t)second);
}

/* Keys as written that do something in one place at least, in order. */
typedef struct Acting {
    int n_node;
    const CzNode **node;
} Acting;

static bool find_acting(CzProblem *problem, Acting *acting) {
    const CzPlaces *places = &problem->places;
    acting->node = cz_arena_allocate(&problem->reader.arena, (size_t)places->n_place + 1,
                                     sizeof(const CzNode *));
    if (acting->node == NULL)
        return false;
    for (int i = 0; i < places->n_place; i++)
        if (is_conditional(&places->place[i]) && !is_idle(problem, &places->place[i]))
            acting->node[acting->n_node++] = places->place[i].node;
    qsort(acting->node, (size_t)acting->n_node, sizeof(const CzNode *), compare_nodes);
    return true;
}

/* Whether a written key acts nowhere. */
static bool is_in_vain(const CzProblem *problem, const Acting *acting, const CzPlace *place) {
    return is_conditional(place) && is_idle(problem, place) &&
           bsearch(&place->node, acting->node, (size_t)acting->n_node, sizeof(const CzNode *),
                   compare_nodes) == NULL;
}

static bool same_reason(const Condition *a, const Condition *b) {
    return a->meeting == b->meeting && a->choice == b->choice &&
           (a->sibling == b->sibling ||
            (a->sibling != NULL && b->sibling != NULL && strcmp(a->sibling, b->sibling) == 0));
}

/* One warning for the keys of one record that stand one behind the other; returns how many places
 * it is for. */
static int warn(CzProblem *problem, const Acting *acting, int first) {
    CzReader *reader = &problem->reader;
    const CzPlace *place = &problem->places.place[first];
    const Condition *condition = condition_of(place->key);
    char list[LONGEST_LIST] = "";
    int n = 0;
    for (; first + n < problem->places.n_place; n++) {
        const CzPlace *next = place + n;
        const size_t length = strlen(list);
        const bool is_same_record =
            is_conditional(next) && (const char *)next->address - next->key->offset ==
                                        (const char *)place->address - place->key->offset;
        if (!is_same_record || !same_reason(condition_of(next->key), condition) ||
            !is_in_vain(problem, acting, next))
            break;
        snprintf(list + length, sizeof list - length, "%s%s", n > 0 ? ", " : "", next->key->stem);
    }
    if (condition->meeting != NO_MEETING)
        cz_mistake(&reader->warnings, place->node, place->trail, "no effect: %s: %s", list,
                   meetings[condition->meeting].reason);
    else if (condition->word != NULL)
        cz_mistake(&reader->warnings, place->node, place->trail, "no effect without %s: %s: %s",
                   condition->sibling, condition->word, list);
    else
        cz_mistake(&reader->warnings, place->node, place->trail, "no effect without %s: %s",
                   condition->sibling, list);
    cz_mistake_help(&reader->warnings,
                    "take out what has no effect, or add what it should act with");
    return n;
}

void cz_acts_with_check(CzProblem *problem) {
    Acting acting = {0};
    if (!find_acting(problem, &acting))
        return;
    const CzPlaces *places = &problem->places;
    for (int i = 0; i < places->n_place;)
        i += is_in_vain(problem, &acting, &places->place[i]) ? warn(problem, &acting, i) : 1;
}
