/* Reads a problem again with further scenarios, or with other stages of a device. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "problem/changes.h"
#include "problem/keys.h"
#include "tree/write_node.h"

static const CzNode *make_change(const CzNodeWriter *writer, const CzCaseChange *change) {
    static const char *const keys[] = {
        [CZ_CASE_VALUE] = "value", [CZ_CASE_FACTOR] = "factor", [CZ_CASE_ADD] = "add"};
    CzNode *node = cz_write_node(writer, CZ_NODE_MAPPING, 2);
    const bool is_made =
        cz_write_entry(writer, node, "path", cz_write_name(writer, change->path)) &&
        cz_write_entry(writer, node, keys[change->kind], cz_write_number(writer, change->number));
    return is_made ? node : NULL;
}

static const CzNode *make_scenario(const CzNodeWriter *writer, const CzProblem *problem,
                                   const CzCase *made) {
    CzNode *node = cz_write_node(writer, CZ_NODE_MAPPING, 4);
    CzNode *changes = cz_write_node(writer, CZ_NODE_LIST, made->n_change);
    for (int i = 0; changes != NULL && i < made->n_change; i++) {
        if (!cz_write_item(changes, make_change(writer, &made->change[i])))
            return NULL;
    }
    const char *like = problem->input.scenarios[made->scenario].name;
    const bool is_made =
        cz_write_entry(writer, node, "name", cz_write_name(writer, made->name)) &&
        cz_write_entry(writer, node, "like", cz_write_name(writer, like)) &&
        cz_write_entry(
            writer, node, "reserves",
            cz_node_text(writer->arena, made->reserves ? "true" : "false", &writer->place)) &&
        cz_write_entry(writer, node, "changes", changes);
    return is_made ? node : NULL;
}

/* The list of scenarios of a tree with further ones; NULL without memory. */
static const CzNode *add_scenarios(const CzNodeWriter *writer, const CzProblem *problem, int n_case,
                                   const CzCase *cases) {
    const CzEntry *own = cz_node_find_list(problem->tree.root, "scenarios");
    CzNode *list = own != NULL ? cz_node_copy(writer->arena, own->value, n_case)
                               : cz_write_node(writer, CZ_NODE_LIST, n_case + 1);
    if (own == NULL && list != NULL) { /* the trains as written */
        CzNode *first = cz_write_node(writer, CZ_NODE_MAPPING, 1);
        if (!cz_write_entry(writer, first, "name",
                            cz_write_name(writer, problem->input.scenarios[0].name)))
            return NULL;
        cz_write_item(list, first);
    }
    for (int i = 0; list != NULL && i < n_case; i++) {
        if (!cz_write_item(list, make_scenario(writer, problem, &cases[i])))
            return NULL;
    }
    return list;
}

/* The tree of a problem with further scenarios; false without memory. */
static bool extend_tree(CzProblem *made, const CzProblem *problem, int n_case,
                        const CzCase *cases) {
    CzReader *reader = &made->reader;
    const CzNodeWriter writer = cz_node_writer(reader, "(cases)");
    const CzNode *list =
        writer.place.source != NULL ? add_scenarios(&writer, problem, n_case, cases) : NULL;
    CzNode *root =
        list != NULL ? cz_node_without(&reader->arena, made->tree.root, "scenarios", 1) : NULL;
    made->tree.root = root;
    return root != NULL && cz_write_entry(&writer, root, "scenarios", list);
}

bool cz_problem_take_targets(CzProblem *made, const CzProblem *problem) {
    const int n_variable = problem->input.optimise.n_variables;
    if (problem->targets == NULL)
        return true;
    made->targets =
        cz_arena_allocate(&made->reader.arena, (size_t)n_variable, sizeof *made->targets);
    for (int i = 0; made->targets != NULL && i < n_variable; i++)
        if (!cz_targets_copy(made, problem, &problem->targets[i], &made->targets[i]))
            return false;
    return made->targets != NULL;
}

CzStatus cz_problem_read_cases(const CzProblem *problem, int n_case, const CzCase *cases,
                               CzProblem **extended, CzError *error) {
    *extended = NULL;
    CzSetting *none = NULL;
    CzProblem *made = cz_problem_create_again(problem, CZ_STEP_CASES, 0, &none);
    if (made == NULL)
        return cz_no_memory(error, "the cases");
    const void *field = NULL;
    CzStatus status = CZ_STATUS_NO_MEMORY;
    made->n_added = n_case;
    if (extend_tree(made, problem, n_case, cases)) {
        cz_problem_bind(made, &made->tree);
        status = cz_rules_check_again(made, error);
    }
    cz_problem_take_files(made, problem);
    if (status == CZ_OK && !cz_problem_take_targets(made, problem))
        status = CZ_STATUS_NO_MEMORY;
    if (status == CZ_OK)
        status = cz_changes_read(made, &field, error);
    if (status == CZ_OK)
        *extended = made;
    else
        cz_problem_free(made);
    return status == CZ_STATUS_NO_MEMORY ? cz_no_memory(error, "the cases") : status;
}

/* ---- other stages of a device ---- */

static const CzNode *make_stage(const CzNodeWriter *writer, const CzStage *stage) {
    const char *zone = cz_word_sets[CZ_WORDS_ZONE].word[stage->zone].word;
    CzNode *node = cz_write_node(writer, CZ_NODE_MAPPING, 4);
    const bool is_made =
        cz_write_entry(writer, node, "stroke_m", cz_write_number(writer, stage->stroke)) &&
        cz_write_entry(writer, node, "force_N", cz_write_number(writer, stage->force)) &&
        cz_write_entry(writer, node, "zone", cz_write_name(writer, zone)) &&
        (isnan(stage->end_force) ||
         cz_write_entry(writer, node, "end_force_N", cz_write_number(writer, stage->end_force)));
    return is_made ? node : NULL;
}

/* The setting that replaces the stages at a place; false without memory. */
static bool set_stages(CzProblem *made, const char *place, int n_stage, const CzStage *stage,
                       CzSetting *setting) {
    CzReader *reader = &made->reader;
    const CzNodeWriter writer = cz_node_writer(reader, "(stages)");
    char path[CZ_PATH_SIZE + 8];
    snprintf(path, sizeof path, "%s.stages", place);
    const char *copy = cz_arena_copy_text(&reader->arena, path, strlen(path));
    CzNode *list =
        writer.place.source != NULL ? cz_write_node(&writer, CZ_NODE_LIST, n_stage) : NULL;
    if (copy == NULL || list == NULL)
        return false;
    for (int i = 0; i < n_stage; i++) {
        if (!cz_write_item(list, make_stage(&writer, &stage[i])))
            return false;
    }
    *setting = (CzSetting){.path = copy,
                           .place = cz_node_text(&reader->arena, copy, &writer.place),
                           .put = {.kind = CZ_PUT_VALUE, .value = list},
                           .is_late = cz_change_is_late(place)};
    return setting->place != NULL;
}

CzStatus cz_problem_read_stages(const CzProblem *problem, const char *place, int n_stage,
                                const CzStage *stage, CzProblem **made, CzError *error) {
    CzSetting *setting = NULL;
    const void *field = NULL;
    *made = NULL;
    CzProblem *again = cz_problem_create_again(problem, CZ_STEP_OTHER, 1, &setting);
    if (again == NULL)
        return cz_no_memory(error, "the stages of a device");
    CzStatus status = CZ_STATUS_NO_MEMORY;
    if (set_stages(again, place, n_stage, stage, setting)) {
        again->tree.root = cz_node_without(&again->reader.arena, again->tree.root, "optimise", 0);
        if (again->tree.root != NULL)
            cz_problem_bind(again, &again->tree);
        status = cz_rules_check_again(again, error);
    }
    if (status == CZ_OK)
        status = cz_changes_read(again, &field, error);
    if (status == CZ_OK) {
        cz_problem_take_files(again, problem);
        *made = again;
        return CZ_OK;
    }
    cz_problem_free(again);
    return status == CZ_STATUS_NO_MEMORY ? cz_no_memory(error, "the stages of a device") : status;
}
