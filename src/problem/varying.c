/* Numbers of a problem that a search may change: every number with such a key that is written in a
 * vehicle or in a part that a vehicle uses, under the path of the place where it is written. */
#include "problem/varying.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "problem/changes.h"
#include "tree/write_node.h"

#define SIZE_OF_ZERO 0.1 /* change of 100 % of a length that is 0 [m] (ours) */

typedef struct Search {
    const CzProblem *problem;
    const bool *is_left_out; /* vehicles; NULL for none */
    int room, n;
    CzVaryingNumber *number; /* (room) */
    CzStatus status;
} Search;

/* Whether any record has a key of this name that a search may change. */
static bool may_vary(const char *typed) {
    for (int i = 0; i < CZ_N_RECORD; i++) {
        const CzUnit *unit = NULL;
        const CzKey *key = cz_record_match(&cz_records[i], typed, &unit);
        if (key != NULL && key->kind == CZ_KEY_NUMBER && key->variation == CZ_VARIATION_VARIES)
            return true;
    }
    return false;
}

/* Whether a number belongs to a vehicle that is not left out. */
static bool is_wanted(const Search *search, const CzTargets *targets) {
    bool is = search->is_left_out == NULL;
    for (int i = 0; i < targets->n && !is; i++)
        is = targets->target[i].vehicle >= 0 && !search->is_left_out[targets->target[i].vehicle];
    return is;
}

/* Adds the number at a path when it is one of vehicles and may vary there. */
static void add_number(Search *search, const char *path) {
    CzTargets targets = {0};
    const CzStatus status = cz_problem_find(search->problem, path, &targets, NULL);
    if (status == CZ_STATUS_NO_MEMORY)
        search->status = status;
    const CzTarget *target = targets.target;
    const CzPlace *place = status == CZ_OK && targets.n > 0 && target->may_vary &&
                                   target->vehicle >= 0 && is_wanted(search, &targets)
                               ? cz_places_find(&search->problem->places, target->field)
                               : NULL;
    if (place != NULL && place->key != NULL && search->n < search->room) {
        const double value = target->value / target->unit;
        CzVaryingNumber *number = &search->number[search->n];
        *number = (CzVaryingNumber){.value = value,
                                    .min = place->key->lo / target->unit,
                                    .max = place->key->hi / target->unit,
                                    .size = fabs(value)};
        if (value == 0 && place->key->dimension == CZ_DIMENSION_LENGTH)
            number->size = SIZE_OF_ZERO / target->unit;
        snprintf(number->path, sizeof number->path, "%s", path);
        search->n += number->size > 0;
    }
    free(targets.target);
}

/* Follows the numbers that are written under a node. */
static void follow(Search *search, const CzNode *node, const char *path) {
    for (int i = 0; node->kind != CZ_NODE_TEXT && i < node->n_entry; i++) {
        const CzEntry *entry = &node->entry[i];
        const char *name = cz_node_find_text(entry->value, "name");
        char inside[CZ_PATH_SIZE];
        int n;
        if (entry->key != NULL)
            n = snprintf(inside, sizeof inside, "%s.%s", path, entry->key->text);
        else if (name != NULL)
            n = snprintf(inside, sizeof inside, "%s.%s", path, name);
        else
            n = snprintf(inside, sizeof inside, "%s[%d]", path, i);
        if (n < 0 || n >= (int)sizeof inside || search->status != CZ_OK)
            return;
        if (entry->value->kind != CZ_NODE_TEXT)
            follow(search, entry->value, inside);
        else if (entry->key != NULL && may_vary(entry->key->text))
            add_number(search, inside);
    }
}

CzStatus cz_problem_find_varying(const CzProblem *problem, const bool *is_left_out, int room,
                                 CzVaryingNumber *number, int *n, CzError *error) {
    Search search = {.problem = problem,
                     .is_left_out = is_left_out,
                     .room = room,
                     .number = number,
                     .status = CZ_OK};
    const CzEntry *trains = cz_node_find(problem->tree.root, "trains");
    for (int i = 0; i < problem->tree.n_part; i++) {
        char path[CZ_PATH_SIZE];
        snprintf(path, sizeof path, "parts.%.200s", problem->tree.part[i].name);
        follow(&search, problem->tree.part[i].node, path);
    }
    if (trains != NULL)
        follow(&search, trains->value, "trains");
    *n = search.n;
    return search.status == CZ_OK ? CZ_OK : cz_no_memory(error, "the numbers that may vary");
}

/* ---- the problem with these variables ---- */

static const CzNode *make_variable(const CzNodeWriter *writer, const CzVaryingNumber *number) {
    const double min = fmax(number->value - number->size, number->min);
    const double max = fmin(number->value + number->size, number->max);
    CzNode *node = cz_write_node(writer, CZ_NODE_MAPPING, 3);
    const bool is_made =
        cz_write_entry(writer, node, "path", cz_write_name(writer, number->path)) &&
        cz_write_entry(writer, node, "min", cz_write_number(writer, min)) &&
        cz_write_entry(writer, node, "max", cz_write_number(writer, max));
    return is_made ? node : NULL;
}

/* Gives the tree an optimisation with these variables only; false without memory. */
static bool set_variables(CzProblem *made, int n, const CzVaryingNumber *number) {
    const CzNodeWriter writer = cz_node_writer(&made->reader, "(variables)");
    CzNode *list = writer.place.source != NULL ? cz_write_node(&writer, CZ_NODE_LIST, n) : NULL;
    CzNode *optimise = cz_write_node(&writer, CZ_NODE_MAPPING, 1);
    for (int i = 0; list != NULL && i < n; i++)
        if (!cz_write_item(list, make_variable(&writer, &number[i])))
            return false;
    CzNode *root = cz_node_without(writer.arena, made->tree.root, "optimise", 1);
    made->tree.root = root;
    return list != NULL && cz_write_entry(&writer, optimise, "variables", list) &&
           cz_write_entry(&writer, root, "optimise", optimise);
}

CzStatus cz_problem_read_varying(const CzProblem *problem, int n, const CzVaryingNumber *number,
                                 CzProblem **made, CzError *error) {
    CzSetting *none = NULL;
    CzProblem *varying = cz_problem_create_again(problem, CZ_STEP_VARYING, 0, &none);
    *made = NULL;
    if (varying == NULL)
        return cz_no_memory(error, "the numbers that may vary");
    CzReader *reader = &varying->reader;
    const void *field = NULL;
    CzStatus status = CZ_STATUS_NO_MEMORY;
    cz_problem_take_files(varying, problem);
    if (set_variables(varying, n, number))
        cz_problem_bind(varying, &varying->tree);
    varying->targets = cz_arena_allocate(&reader->arena, (size_t)n + 1, sizeof *varying->targets);
    if (!reader->arena.out_of_memory) {
        const CzRules rules = cz_rules_of(varying);
        cz_rules_check_collision(&rules);
        cz_rules_check_design(&rules, varying->targets);
        cz_mistakes_finish(&reader->mistakes);
        status = cz_mistakes_status(&reader->mistakes, "the numbers that may vary", error);
    }
    if (status == CZ_OK)
        status = cz_changes_read(varying, &field, error);
    if (status == CZ_OK)
        *made = varying;
    else
        cz_problem_free(varying);
    return status == CZ_STATUS_NO_MEMORY ? cz_no_memory(error, "the numbers that may vary")
                                         : status;
}
