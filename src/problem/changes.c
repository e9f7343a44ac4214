/* Reads scenarios that change values of the problem. */
#include "problem/changes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"

/* ---- the problem of one scenario ---- */

CzCaseKind cz_change_kind(const CzChange *change, double *number) {
    *number = !isnan(change->factor) ? change->factor
              : !isnan(change->add)  ? change->add
                                     : change->value;
    return !isnan(change->factor) ? CZ_CASE_FACTOR
           : !isnan(change->add)  ? CZ_CASE_ADD
                                  : CZ_CASE_VALUE;
}

/* What a change puts at its places; false without memory. */
static bool make_put(CzArena *arena, const CzChange *change, const CzNode *place, CzPut *put) {
    static const CzPutKind kinds[] = {[CZ_CASE_VALUE] = CZ_PUT_VALUE,
                                      [CZ_CASE_FACTOR] = CZ_PUT_FACTOR,
                                      [CZ_CASE_ADD] = CZ_PUT_SUM};
    char text[CZ_NUMBER_TEXT];
    *put = (CzPut){0};
    put->kind = kinds[cz_change_kind(change, &put->number)];
    put->value = cz_node_text(arena, cz_number_print(text, put->number), place);
    return put->value != NULL;
}

const char *cz_change_path(const char *path, int scenario, char text[CZ_PATH_SIZE]) {
    static const char own[] = "scenario.";
    if (strncmp(path, own, sizeof own - 1) != 0)
        return path;
    snprintf(text, CZ_PATH_SIZE, "scenarios[%d].%.*s", scenario, CZ_PATH_SIZE - 32,
             path + sizeof own - 1);
    return text;
}

bool cz_change_is_late(const char *path) {
    return strncmp(path, "parts.", 6) != 0;
}

/* Name in messages of the changes of a scenario, whose lines are counted as they are. */
static const char source_name[] = "(changes)";

/* Converts the changes of a scenario to settings; false without memory. */
static bool make_settings(CzProblem *made, const CzScenario *scenario, int index,
                          CzSetting *setting) {
    CzReader *reader = &made->reader;
    const CzSource *source = cz_sources_add(&reader->sources, source_name, ".", "", 0);
    for (int i = 0; source != NULL && i < scenario->n_changes; i++) {
        const CzChange *change = &scenario->changes[i];
        const CzNode place = {.source = source, .line = i + 1, .column = 1};
        char text[CZ_PATH_SIZE];
        const char *path = cz_change_path(change->path, index, text);
        setting[i].place = cz_node_text(&reader->arena, path, &place);
        if (setting[i].place == NULL || !make_put(&reader->arena, change, &place, &setting[i].put))
            return false;
        setting[i].path = setting[i].place->text;
        setting[i].is_late = cz_change_is_late(change->path);
    }
    return source != NULL;
}

/* The field that a mistake in changes belongs to. */
static const void *field_of(const CzScenario *scenario, const CzError *mistake) {
    const bool is_of_change = strcmp(mistake->file, source_name) == 0 && mistake->line >= 1 &&
                              mistake->line <= scenario->n_changes;
    return is_of_change ? (const void *)&scenario->changes[mistake->line - 1].path
                        : &scenario->changes;
}

static CzStatus read_one(const CzProblem *problem, int index, CzProblem **changed,
                         const void **field, CzError *error) {
    const CzScenario *scenario = &problem->input.scenarios[index];
    CzSetting *setting = NULL;
    CzProblem *made =
        cz_problem_create_again(problem, CZ_STEP_OTHER, scenario->n_changes, &setting);
    if (made == NULL)
        return cz_no_memory(error, "the problem of a scenario");
    if (make_settings(made, scenario, index, setting))
        cz_problem_bind(made, &made->tree);
    CzError mistake = {0};
    CzStatus status = cz_rules_check_again(made, &mistake);
    *field = field_of(scenario, &mistake);
    if (status == CZ_STATUS_INPUT)
        cz_fail(error, status, "the changes of scenario '%.48s': %.400s", scenario->name,
                mistake.message);
    else if (status == CZ_STATUS_NO_MEMORY)
        status = cz_no_memory(error, "the problem of a scenario");
    if (status == CZ_OK)
        *changed = made;
    else
        cz_problem_free(made);
    return status;
}

/* ---- the problems of all scenarios ---- */

/* Whether two scenarios have the same changes, none of them of a scenario itself. */
static bool changes_are_alike(const CzScenario *first, const CzScenario *second) {
    bool are_alike = first->n_changes == second->n_changes;
    for (int i = 0; are_alike && i < first->n_changes; i++) {
        const CzChange *mine = &first->changes[i], *other = &second->changes[i];
        double a, b;
        are_alike = strncmp(mine->path, "scenario.", 9) != 0 &&
                    strcmp(mine->path, other->path) == 0 &&
                    cz_change_kind(mine, &a) == cz_change_kind(other, &b) && a == b;
    }
    return are_alike;
}

CzStatus cz_changes_read(CzProblem *problem, const void **field, CzError *error) {
    const CzInput *input = &problem->input;
    int n_changed = 0;
    for (int s = 0; s < input->n_scenarios; s++)
        n_changed += input->scenarios[s].n_changes > 0;
    if (n_changed == 0)
        return CZ_OK;
    problem->changed = calloc((size_t)input->n_scenarios, sizeof *problem->changed);
    if (problem->changed == NULL)
        return cz_no_memory(error, "the problems of scenarios");
    for (int s = 0, last = -1; s < input->n_scenarios; s++) {
        if (input->scenarios[s].n_changes == 0)
            continue;
        if (last >= 0 && changes_are_alike(&input->scenarios[last], &input->scenarios[s]))
            problem->changed[s] = problem->changed[last];
        else
            CZ_TRY(read_one(problem, s, &problem->changed[s], field, error));
        last = s;
    }
    return CZ_OK;
}

const CzProblem *cz_problem_in_scenario(const CzProblem *problem, int scenario) {
    const bool is_changed = problem->changed != NULL && scenario >= 0 &&
                            scenario < problem->input.n_scenarios &&
                            problem->changed[scenario] != NULL;
    return is_changed ? problem->changed[scenario] : problem;
}
