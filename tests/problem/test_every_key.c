/* No key without effect: for every key of keys.def that a vehicle can have, on every model of
 * vehicle that it can be written for, a change of it changes the results of some collision, or the
 * reader refuses or warns. Other keys have a change of their own in every_key.def. A new key
 * without either fails here. */
#include "support/check.h"

#include <stdbool.h>

#include "problem/acts.h"
#include "problem/every_key.h"

/* ---- changes ---- */

/* Values for keys of which a quarter more or less has no effect. */
static const struct {
    CzRecordId record;
    const char *stem, *value;
} values[] = {
#define CZ_VALUE(type, stem, value) {CZ_RECORD_##type, #stem, value},
#define CZ_CHANGE(type, stem, from, to)
#define CZ_EXCEPTION(type, stem, reason)
#include "problem/every_key.def"
#undef CZ_VALUE
#undef CZ_CHANGE
#undef CZ_EXCEPTION
};
enum { N_VALUE = sizeof values / sizeof values[0], MAX_VALUES = 8 };

typedef struct {
    int n;
    char text[MAX_VALUES][400]; /* "key: value" */
} Changes;

static void add_number(Changes *changes, const CzKey *key, double value) {
    const CzUnit *unit = cz_unit_si(key->dimension);
    if (key->kind == CZ_KEY_NUMBER && (value < key->lo || value > key->hi))
        return;
    snprintf(changes->text[changes->n++], sizeof changes->text[0], "%s%s%s: %.9g", key->stem,
             unit->suffix[0] != '\0' ? "_" : "", unit->suffix, value);
}

/* Values to replace a key's own value, which `record` contains. */
static Changes changes_of(CzRecordId id, const CzKey *key, const char *record) {
    Changes changes = {0};
    for (int i = 0; i < N_VALUE; i++)
        if (values[i].record == id && strcmp(values[i].stem, key->stem) == 0)
            snprintf(changes.text[changes.n++], sizeof changes.text[0], "%s", values[i].value);
    const void *field = record + key->offset;
    if (key->kind == CZ_KEY_NUMBER && isfinite(*(const double *)field)) {
        static const double factors[] = {1.25, 0.8, 3.0, 0.3};
        for (int i = 0; i < 4 && *(const double *)field != 0.0; i++)
            add_number(&changes, key, *(const double *)field * factors[i]);
    } else if (key->kind == CZ_KEY_COUNT) {
        for (int more = -1; more <= 1; more += 2)
            snprintf(changes.text[changes.n++], sizeof changes.text[0], "%s: %d", key->stem,
                     *(const int *)field + more);
    } else if (key->kind == CZ_KEY_FLAG)
        snprintf(changes.text[changes.n++], sizeof changes.text[0], "%s: %s", key->stem,
                 *(const bool *)field ? "false" : "true");
    else if (key->kind == CZ_KEY_CHOICE)
        for (int word = 0; word < key->words->n_word; word++)
            if (word != *(const int *)field)
                snprintf(changes.text[changes.n++], sizeof changes.text[0], "%s: %s", key->stem,
                         key->words->word[word].word);
    return changes;
}

/* ---- going through the records of a vehicle ---- */

enum { MAX_KEYS = 64, MAX_DEPTH = 6, N_MODEL = CZ_MODEL_FIXED + 1 };
typedef enum { UNSEEN, IDLE, ACTS } Found;

typedef struct {
    const Setting *setting;
    const CzProblem *problem;
    int n_wrong;              /* warnings that are missing or wrong */
    bool (*lacked)[MAX_KEYS]; /* keys without the key they act with, of every record */
    bool is_quick;            /* looks for effects in the first scenario alone */
    Answer as_written;
    Found (*found)[MAX_KEYS][N_MODEL]; /* of every record (CZ_N_RECORD) */
} Walk;

/* Whether a line of warnings that begins like this names a key. */
static bool names_key(const char *warnings, const char *beginning, const CzKey *key) {
    for (const char *line = strstr(warnings, beginning); line != NULL;
         line = strstr(line + 1, beginning)) {
        const size_t n = strcspn(line, ";\n");
        const char *at = strstr(line, key->stem);
        if (at != NULL && at < line + n)
            return true;
    }
    return false;
}

/* Where a record is in the vehicle. */
typedef struct {
    int n;
    const char *name[MAX_DEPTH];
} Trail;

/* Whether two texts are the same but for the rounding of their numbers. */
static bool is_same_but_rounding(const char *a, const char *b) {
    static const double rounding =
        1e-6; /* of a sum of thousands of steps, relative to the result */
    while (*a != '\0' && *b != '\0') {
        char *end_a, *end_b;
        const double first = strtod(a, &end_a), second = strtod(b, &end_b);
        const bool is_number = end_a != a && end_b != b;
        if (is_number && fabs(first - second) > rounding * (1.0 + fabs(first)))
            return false;
        if (!is_number && *a != *b)
            return false;
        a = is_number ? end_a : a + 1;
        b = is_number ? end_b : b + 1;
    }
    return *a == *b;
}

/* Effect of a text that is written there. */
typedef enum { NOTHING, REFUSED, DIFFERENCE } Effect;
static Effect effect_of(const Walk *walk, const Trail *trail, const char *written,
                        const CzKey *warned_of, bool *is_warned) {
    char text[2048] = "";
    for (int i = 0; i < trail->n; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s: {", trail->name[i]);
    snprintf(text + strlen(text), sizeof text - strlen(text), "%s", written);
    for (int i = 0; i < trail->n; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "}");
    Answer answer = answer_with(walk->setting, text, walk->is_quick ? FIRST_SCENARIO : NULL);
    const Effect effect = answer.text == NULL                               ? REFUSED
                          : strcmp(answer.text, walk->as_written.text) != 0 ? DIFFERENCE
                                                                            : NOTHING;
    if (getenv("CZ_SHOW") != NULL)
        print_message("%s: %s %s\n", text, effect == NOTHING ? "the same" : "differs",
                      answer.refusal);
    const bool rounds =
        effect == DIFFERENCE && is_same_but_rounding(answer.text, walk->as_written.text);
    if (warned_of != NULL)
        *is_warned = names_key(answer.warnings, "no effect", warned_of);
    answer_free(&answer);
    return warned_of != NULL && rounds ? NOTHING : effect;
}

/* Whether the reader has warned that a key does nothing on this model. */
static bool is_warned_of(const Walk *walk, const CzKey *key) {
    static const char *const models[] = {"no effect on model: full", "no effect on model: rigid",
                                         "no effect on model: fixed"};
    return names_key(walk->as_written.warnings, models[walk->setting->model], key);
}

/* Whether another setting has shown a key without the key it acts with, and this one need not. */
static bool is_left_out(const Walk *walk, CzRecordId id, int index) {
    return walk->setting >= settings + N_WHOLE && walk->lacked[id][index];
}

/* Checks a key without the key it acts with: it has no effect, and the reader warns. */
static void look_at_lacking(Walk *walk, CzRecordId id, int index, const Changes *changes,
                            const Trail *trail) {
    const CzKey *key = &cz_records[id].key[index];
    for (int i = 0; i < changes->n && !is_left_out(walk, id, index); i++) {
        bool is_warned = false;
        const Effect effect = effect_of(walk, trail, changes->text[i], key, &is_warned);
        if (effect == DIFFERENCE)
            print_error("%s of a %s acts where acts.def excludes it: %s\n", key->stem,
                        cz_records[id].name, changes->text[i]);
        if (effect == NOTHING && !is_warned)
            print_error("nothing warns of %s of a %s\n", key->stem, cz_records[id].name);
        walk->n_wrong += effect == DIFFERENCE || (effect == NOTHING && !is_warned);
        walk->lacked[id][index] |= effect == NOTHING && is_warned;
    }
}

static void look_at_key(Walk *walk, CzRecordId id, int index, const char *record,
                        const Trail *trail) {
    const CzKey *key = &cz_records[id].key[index];
    Found *found = &walk->found[id][index][walk->setting->model];
    const bool acts = cz_key_acts_on(key, walk->setting->model);
    const Changes changes = changes_of(id, key, record);
    const bool is_lacking = acts && !cz_field_acts(walk->problem, key, record + key->offset);
    if (walk->is_quick && (!acts || is_lacking))
        return;
    if (is_lacking) {
        look_at_lacking(walk, id, index, &changes, trail);
        return;
    }
    if (*found == ACTS)
        return;
    Effect effect = NOTHING;
    for (int i = 0; i < changes.n && effect != DIFFERENCE; i++) {
        const Effect next = effect_of(walk, trail, changes.text[i], NULL, NULL);
        effect = next > effect ? next : effect;
    }
    if (!acts && effect == DIFFERENCE)
        print_error("%s of a %s acts on a model that acts.def excludes\n", key->stem,
                    cz_records[id].name);
    const bool is_well = acts ? effect != NOTHING : effect != DIFFERENCE && is_warned_of(walk, key);
    *found = is_well ? ACTS : IDLE;
}

/* Checks an inner record without the key it acts with: it can be removed. */
static void look_at_child(Walk *walk, CzRecordId id, int index, const Trail *trail) {
    char gone[64];
    const CzKey *key = &cz_records[id].key[index];
    if (walk->is_quick || is_left_out(walk, id, index))
        return;
    snprintf(gone, sizeof gone, "%s: null", key->stem);
    const Effect effect = effect_of(walk, trail, gone, NULL, NULL);
    if (effect != NOTHING)
        print_error("%s of a %s acts where acts.def excludes it\n", key->stem, cz_records[id].name);
    walk->n_wrong += effect != NOTHING;
    walk->lacked[id][index] = true;
}

/* Stages are written as a list: all of them again, and one with the change. */
static void look_at_stages(Walk *walk, const CzStage *stage, int n_stage, const Trail *trail) {
    const CzRecord *record = &cz_records[CZ_RECORD_CzStage];
    for (int index = 0; index < record->n_key; index++) {
        Found *found = &walk->found[CZ_RECORD_CzStage][index][walk->setting->model];
        for (int of = 0; of < n_stage; of++) {
            const char *memory = (const char *)&stage[of];
            const Changes changes = changes_of(CZ_RECORD_CzStage, &record->key[index], memory);
            const bool acts = cz_field_acts(walk->problem, &record->key[index],
                                            memory + record->key[index].offset);
            const Found before = *found;
            if (acts ? before == ACTS : walk->is_quick)
                continue;
            *found = IDLE;
            for (int i = 0; i < changes.n && *found != ACTS; i++) {
                char text[1024] = "stages: [";
                for (int k = 0; k < n_stage; k++) {
                    char zone[32], end[48] = "";
                    snprintf(zone, sizeof zone, ", zone: %s",
                             cz_word_sets[CZ_WORDS_ZONE].word[stage[k].zone].word);
                    if (isfinite(stage[k].end_force))
                        snprintf(end, sizeof end, ", end_force_N: %.9g", stage[k].end_force);
                    const bool own[] = {of == k && index == 0, of == k && index == 1,
                                        of == k && index == 2, of == k && index == 3};
                    snprintf(text + strlen(text), sizeof text - strlen(text), "%s{",
                             k > 0 ? ", " : "");
                    if (!own[0])
                        snprintf(text + strlen(text), sizeof text - strlen(text), "stroke_m: %.9g",
                                 stage[k].stroke);
                    if (!own[1])
                        snprintf(text + strlen(text), sizeof text - strlen(text), "%sforce_N: %.9g",
                                 own[0] ? "" : ", ", stage[k].force);
                    snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s%s%s}",
                             own[2] ? "" : end, own[3] ? "" : zone, of == k ? ", " : "",
                             of == k ? changes.text[i] : "");
                }
                snprintf(text + strlen(text), sizeof text - strlen(text), "]");
                *found = effect_of(walk, trail, text, NULL, NULL) != NOTHING ? ACTS : IDLE;
            }
            if (acts)
                continue;
            if (*found == ACTS)
                print_error("%s of a stage acts where acts.def excludes it\n",
                            record->key[index].stem);
            walk->n_wrong += *found == ACTS;
            walk->lacked[CZ_RECORD_CzStage][index] = true;
            *found = before;
        }
    }
}

static void look_at_record(Walk *walk, CzRecordId id, const char *memory, const Trail *trail) {
    const CzRecord *record = &cz_records[id];
    assert_in_range(record->n_key, 1, MAX_KEYS);
    for (int index = 0; index < record->n_key; index++) {
        const CzKey *key = &record->key[index];
        Trail inside = *trail;
        if (key->kind == CZ_KEY_CHILD && cz_key_acts_on(key, walk->setting->model) &&
            !cz_field_acts(walk->problem, key, memory + key->offset)) {
            look_at_child(walk, id, index, trail);
        } else if (key->kind == CZ_KEY_CHILD && cz_key_acts_on(key, walk->setting->model)) {
            inside.name[inside.n++] = key->stem;
            if (*(const bool *)(memory + key->offset)) /* given */
                look_at_record(walk, (CzRecordId)(key->child - cz_records), memory + key->offset,
                               &inside);
            walk->found[id][index][walk->setting->model] = ACTS; /* by the keys inside */
        } else if (key->kind == CZ_KEY_STAGES) {
            look_at_stages(walk, (const CzStage *)(const void *)(memory + key->offset),
                           *(const int *)(memory + key->n_offset), trail);
            walk->found[id][index][walk->setting->model] = ACTS; /* likewise */
        } else
            look_at_key(walk, id, index, memory, trail);
    }
}

/* ---- exceptions ---- */

static const struct {
    CzRecordId record;
    const char *stem, *reason;
} exceptions[] = {
#define CZ_VALUE(type, stem, value)
#define CZ_CHANGE(type, stem, from, to)
#define CZ_EXCEPTION(type, stem, reason) {CZ_RECORD_##type, #stem, reason},
#include "problem/every_key.def"
#undef CZ_VALUE
#undef CZ_CHANGE
#undef CZ_EXCEPTION
};
enum { N_EXCEPTION = sizeof exceptions / sizeof exceptions[0] };

static bool is_excepted(CzRecordId id, const CzKey *key) {
    for (int i = 0; i < N_EXCEPTION; i++)
        if (exceptions[i].record == id && strcmp(exceptions[i].stem, key->stem) == 0)
            return true;
    return false;
}

static bool is_of_vehicles(CzRecordId id, CzRecordId in) {
    bool is_in = id == in;
    for (int i = 0; i < cz_records[in].n_key && !is_in; i++) {
        const CzKey *key = &cz_records[in].key[i];
        if (key->kind == CZ_KEY_CHILD || key->kind == CZ_KEY_STAGES)
            is_in = is_of_vehicles(id, (CzRecordId)(key->child - cz_records));
    }
    return is_in;
}

/* Number of conditions of acts.def that no setting shows. */
static int count_conditions_without_case(bool lacked[CZ_N_RECORD][MAX_KEYS]) {
    int n = 0;
    for (CzRecordId id = 0; id < CZ_N_RECORD; id++)
        for (int index = 0; index < cz_records[id].n_key; index++) {
            const CzKey *key = &cz_records[id].key[index];
            if (!cz_key_is_conditional(key) || lacked[id][index] ||
                !is_of_vehicles(id, CZ_RECORD_CzVehicle))
                continue;
            print_error("no setting lacks what %s of a %s acts with\n", key->stem,
                        cz_records[id].name);
            n++;
        }
    return n;
}

static int look_at_setting(Walk *walk) {
    CzProblem *problem = NULL;
    const CzVehicle *vehicle = read_tested(walk->setting, &problem);
    walk->problem = problem;
    walk->as_written = answer_with(walk->setting, "", walk->is_quick ? FIRST_SCENARIO : NULL);
    if (walk->as_written.text == NULL)
        fail_msg("setting %d: %s", (int)(walk->setting - settings), walk->as_written.refusal);
    look_at_record(walk, CZ_RECORD_CzVehicle, (const char *)vehicle, &(Trail){0});
    answer_free(&walk->as_written);
    cz_problem_free(problem);
    return walk->n_wrong;
}

static void every_key_of_a_vehicle_acts_or_is_warned_of(void **state) {
    (void)state;
    static Found found[CZ_N_RECORD][MAX_KEYS][N_MODEL];
    static bool lacked[CZ_N_RECORD][MAX_KEYS];
    int n_wrong = 0;
    read_base();
    /* Most effects show in the first scenario of some setting, which takes a quarter of the time of
     * all; all scenarios are run for the other keys, and for those that must not act. */
    for (int i = 0; i < 2 * N_SETTING; i++) {
        Walk walk = {.setting = &settings[i % N_SETTING],
                     .is_quick = i < N_SETTING,
                     .found = found,
                     .lacked = lacked};
        n_wrong += look_at_setting(&walk);
    }
    assert_int_equal(n_wrong, 0);
    assert_int_equal(count_conditions_without_case(lacked), 0);
    int n_idle = 0;
    for (int id = 0; id < CZ_N_RECORD; id++)
        for (int index = 0; index < cz_records[id].n_key; index++)
            for (int model = 0; model < N_MODEL; model++) {
                const CzKey *key = &cz_records[id].key[index];
                if (found[id][index][model] != IDLE || is_excepted((CzRecordId)id, key))
                    continue;
                n_idle++;
                print_error("%s of a %s does nothing on model: %s\n", key->stem,
                            cz_records[id].name, cz_word_sets[CZ_WORDS_MODEL].word[model].word);
            }
    assert_int_equal(n_idle, 0);
}

/* ---- everything else ---- */

static const struct {
    CzRecordId record;
    const char *stem, *from, *to;
} changes[] = {
#define CZ_VALUE(type, stem, value)
#define CZ_CHANGE(type, stem, from, to) {CZ_RECORD_##type, #stem, from, to},
#define CZ_EXCEPTION(type, stem, reason)
#include "problem/every_key.def"
#undef CZ_VALUE
#undef CZ_CHANGE
#undef CZ_EXCEPTION
};
enum { N_CHANGE = sizeof changes / sizeof changes[0] };

static char *file_text(const char *name) {
    char path[512];
    snprintf(path, sizeof path, "%s/tests/problem/cases/%s", CZ_SOURCE_FOLDER, name);
    FILE *file = fopen(path, "r");
    char *text = calloc(1, LONGEST);
    assert_non_null(file);
    assert_non_null(text);
    assert_in_range(fread(text, 1, LONGEST - 1, file), 1, LONGEST - 2);
    fclose(file);
    return text;
}

/* The problem in which a record's keys are changed. */
static char *text_for(CzRecordId id) {
    if (id == CZ_RECORD_CzRail || id == CZ_RECORD_CzRoadbed)
        return file_text("every-key-of-the-track.yaml");
    if (id == CZ_RECORD_CzVariable || id == CZ_RECORD_CzMatch || id == CZ_RECORD_CzOptimise)
        return file_text("every-key-of-a-search.yaml");
    return file_text("every-key-of-a-problem.yaml");
}

static bool change_differs(int change, const char *text, const Answer *as_written) {
    const char *at = strstr(text, changes[change].from);
    char *changed = NULL;
    size_t n = 0;
    if (at == NULL)
        fail_msg("no '%s' to change", changes[change].from);
    FILE *stream = open_memstream(&changed, &n);
    assert_non_null(stream);
    fprintf(stream, "%.*s%s%s", (int)(at - text), text, changes[change].to,
            at + strlen(changes[change].from));
    fclose(stream);
    Answer answer = answer_of(changed);
    const bool differs = answer.text == NULL || answer.n_warning > as_written->n_warning ||
                         strcmp(answer.text, as_written->text) != 0;
    if (getenv("CZ_SHOW") != NULL)
        print_message("%s: %s %s\n", changes[change].to, differs ? "differs" : "the same",
                      answer.refusal);
    answer_free(&answer);
    free(changed);
    return differs;
}

static int count_idle(CzRecordId id) {
    char *text = text_for(id);
    Answer as_written = answer_of(text);
    if (as_written.text == NULL)
        fail_msg("%s: %s", cz_records[id].name, as_written.refusal);
    int n_idle = 0;
    for (int index = 0; index < cz_records[id].n_key; index++) {
        const CzKey *key = &cz_records[id].key[index];
        const bool is_inside = key->kind == CZ_KEY_CHILD || key->kind == CZ_KEY_LIST;
        bool acts = is_inside || is_excepted(id, key); /* by the keys inside */
        for (int i = 0; i < N_CHANGE && !acts; i++)
            if (changes[i].record == id && strcmp(changes[i].stem, key->stem) == 0)
                acts = change_differs(i, text, &as_written);
        if (!acts)
            print_error("%s of a %s does nothing, or has no case\n", key->stem,
                        cz_records[id].name);
        n_idle += !acts;
    }
    answer_free(&as_written);
    free(text);
    return n_idle;
}

/* Records that no run shows, but the samples of tests/evaluate/test_sample.c. */
static bool is_of_samples(int id) {
    return id == CZ_RECORD_CzUncertainty || id == CZ_RECORD_CzScatter || id == CZ_RECORD_CzSpan;
}

/* Records of a profile's own file, which are those of tests/problem/test_profile.c. */
static bool is_of_profiles(int id) {
    return id == CZ_RECORD_CzProfile || id == CZ_RECORD_CzProfileScenario ||
           id == CZ_RECORD_CzCategory || id == CZ_RECORD_CzOverride;
}

static void every_other_key_acts(void **state) {
    (void)state;
    int n_idle = 0;
    for (int id = 0; id < CZ_N_RECORD; id++)
        if (!is_of_vehicles((CzRecordId)id, CZ_RECORD_CzVehicle) && !is_of_samples(id) &&
            !is_of_profiles(id))
            n_idle += count_idle((CzRecordId)id);
    assert_int_equal(n_idle, 0);
}

static void the_exceptions_are_few(void **state) {
    (void)state;
    assert_in_range(N_EXCEPTION, 1, 12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_key_of_a_vehicle_acts_or_is_warned_of),
        cmocka_unit_test(every_other_key_acts),
        cmocka_unit_test(the_exceptions_are_few),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
