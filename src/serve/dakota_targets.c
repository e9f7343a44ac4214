/* What the descriptors of a parameters file mean. */
#include "base/error.h"
#include "base/number.h"
#include "evaluate/evaluator.h"
#include "serve/dakota_study.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The meaning of a descriptor: that of an analysis component DESCRIPTOR=MEANING, else itself. */
static const char *meaning_of(const CzDakota *dakota, const char *label) {
    const size_t n = strlen(label);
    for (int i = 0; i < dakota->parameters.component.n; i++) {
        const char *text = dakota->parameters.component.entry[i].text;
        if (strncmp(text, label, n) == 0 && text[n] == '=')
            return text + n + 1;
    }
    return label;
}

CzStatus cz_dakota_place(const CzDakota *dakota, const CzDakotaEntry *entry, CzStatus status,
                         CzError *error) {
    if (status != CZ_OK && error != NULL) {
        snprintf(error->file, sizeof error->file, "%.255s", dakota->parameters.source->name);
        error->line = entry->line;
        error->column = entry->column;
    }
    return status;
}

/* A component that gives no descriptor of the file a meaning is a mistake. */
static CzStatus check_components(const CzDakota *dakota, CzError *error) {
    const CzDakotaList *lists[] = {&dakota->parameters.variable, &dakota->parameters.response};
    for (int i = 0; i < dakota->parameters.component.n; i++) {
        const CzDakotaEntry *entry = &dakota->parameters.component.entry[i];
        const size_t n = strcspn(entry->text, "=");
        bool is_known = false;
        for (int k = 0; k < 2; k++)
            for (int j = 0; j < lists[k]->n; j++) {
                const char *label = lists[k]->entry[j].label;
                is_known |= strlen(label) == n && strncmp(label, entry->text, n) == 0;
            }
        if (entry->text[n] == '\0' || !is_known)
            return cz_dakota_place(
                dakota, entry,
                cz_fail(error, CZ_STATUS_INPUT,
                        "the analysis component '%.100s' is not DESCRIPTOR=MEANING of a "
                        "variable or a response",
                        entry->text),
                error);
    }
    return CZ_OK;
}

/* The number of a design variable by its name; CZ_DAKOTA_PATH when there is none. */
static int find_design(const CzEvaluator *evaluator, const char *name) {
    for (int i = 0; i < cz_evaluator_n_variable(evaluator); i++)
        if (strcmp(cz_evaluator_variable(evaluator, i)->name, name) == 0)
            return i;
    return CZ_DAKOTA_PATH;
}

/* Reads the value of a design variable: a number within its bounds, or the name of a choice. */
static CzStatus read_design_value(const CzVariableInfo *info, CzDakotaTarget *target,
                                  CzError *error) {
    for (int i = 0; i < info->n_choice && !target->is_number; i++)
        if (strcmp(info->choice[i], target->entry->text) == 0) {
            target->value = i;
            return CZ_OK;
        }
    if (!target->is_number)
        return cz_fail(error, CZ_STATUS_INPUT,
                       info->n_choice > 0 ? "'%.60s' is not a choice of '%.100s'"
                                          : "'%.60s' is not a number for '%.100s'",
                       target->entry->text, info->name);
    if (target->value >= info->min && target->value <= info->max &&
        (info->n_choice == 0 || target->value == (double)(int)target->value))
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_INPUT,
                   "%s is not within the bounds of '%.100s', %s to %s%s%.20s", target->entry->text,
                   info->name, CZ_SHORT(info->min), CZ_SHORT(info->max),
                   info->unit[0] != '\0' ? " " : "", info->unit);
}

/* Finds what a variable sets. A path is found when the file is read with it. */
static CzStatus find_target(const CzDakota *dakota, const CzEvaluator *evaluator,
                            CzDakotaTarget *target, CzError *error) {
    const char *label = target->entry->label;
    target->meaning = meaning_of(dakota, label);
    target->design = find_design(evaluator, target->meaning);
    target->is_number = cz_number_scan(target->entry->text, &target->value);
    for (const CzDakotaTarget *other = dakota->target; other != target; other++)
        if (strcmp(other->meaning, target->meaning) == 0)
            return cz_fail(error, CZ_STATUS_INPUT, "'%.100s' is set by '%.60s' already",
                           target->meaning, other->entry->label);
    if (target->design != CZ_DAKOTA_PATH)
        return read_design_value(cz_evaluator_variable(evaluator, target->design), target, error);
    return CZ_OK;
}

static CzStatus find_targets(CzDakota *dakota, const CzEvaluator *evaluator, CzError *error) {
    const CzDakotaList *list = &dakota->parameters.variable;
    dakota->target = cz_arena_allocate(&dakota->arena, (size_t)list->n + 1, sizeof *dakota->target);
    if (dakota->target == NULL)
        return cz_no_memory(error, "the variables");
    for (int i = 0; i < list->n; i++) {
        dakota->target[i].entry = &list->entry[i];
        CZ_TRY(cz_dakota_place(dakota, &list->entry[i],
                               find_target(dakota, evaluator, &dakota->target[i], error), error));
    }
    return CZ_OK;
}

static CzStatus find_responses(CzDakota *dakota, CzEvaluator *evaluator, CzError *error) {
    const CzDakotaList *list = &dakota->parameters.response;
    const size_t n = (size_t)list->n + 1;
    dakota->response = cz_arena_allocate(&dakota->arena, n, sizeof *dakota->response);
    dakota->metric = cz_arena_allocate(&dakota->arena, n, sizeof *dakota->metric);
    if (dakota->response == NULL || dakota->metric == NULL)
        return cz_no_memory(error, "the responses");
    for (int j = 0; j < list->n; j++) {
        const CzDakotaEntry *entry = &list->entry[j];
        CzResponse *response = &dakota->response[j];
        CzStatus status = cz_response_read(evaluator, &dakota->arena,
                                           meaning_of(dakota, entry->label), response, error);
        if (status == CZ_OK && response->kind == CZ_RESPONSE_METRIC) {
            response->metric = dakota->n_metric;
            dakota->metric[dakota->n_metric++] = response->name;
            status = cz_evaluator_set_values(evaluator, 1, &response->name, error);
            if (status == CZ_OK && !cz_evaluator_has_metric(evaluator, 0))
                status = cz_fail(error, CZ_STATUS_INPUT, "no place of the problem has '%.200s'",
                                 response->name);
        }
        CZ_TRY(cz_dakota_place(dakota, entry, status, error));
    }
    return CZ_OK;
}

/* Derivatives are by numbers that can vary. */
static CzStatus check_derivatives(const CzDakota *dakota, const CzEvaluator *evaluator,
                                  CzError *error) {
    for (int i = 0; i < dakota->parameters.derivative.n; i++) {
        const CzDakotaEntry *entry = &dakota->parameters.derivative.entry[i];
        const CzDakotaTarget *target = &dakota->target[entry->number];
        const CzVariableInfo *info = target->design != CZ_DAKOTA_PATH
                                         ? cz_evaluator_variable(evaluator, target->design)
                                         : NULL;
        if (target->is_number && (info == NULL || (info->n_choice == 0 && !info->is_fixed)))
            continue;
        return cz_dakota_place(
            dakota, entry,
            cz_fail(error, CZ_STATUS_INPUT,
                    "there is no derivative by '%.100s', which chooses or is fixed",
                    target->entry->label),
            error);
    }
    return CZ_OK;
}

CzStatus cz_dakota_find(CzDakota *dakota, CzEvaluator *evaluator, CzError *error) {
    CZ_TRY(check_components(dakota, error));
    CZ_TRY(find_targets(dakota, evaluator, error));
    CZ_TRY(find_responses(dakota, evaluator, error));
    return check_derivatives(dakota, evaluator, error);
}
