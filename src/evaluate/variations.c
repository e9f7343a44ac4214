/* Changes that scenarios make to the places of design variables. */
#include "base/error.h"
#include "evaluate/design.h"

#include <stdlib.h>
#include <string.h>

/* The places of one path of a change. */
typedef struct Found {
    const char *path;
    CzTargets targets;
} Found;

/* Context for collecting the changes. */
typedef struct Collector {
    const CzProblem *problem;
    CzArena *arena;
    CzDesign *design;
    int n_found;
    Found *found; /* each path once (n_found) */
    CzError *error;
} Collector;

/* The places of a path, found once for all scenarios. */
static CzStatus find_places(Collector *collector, int scenario, const char *path,
                            const CzTargets **targets) {
    for (int i = 0; i < collector->n_found; i++)
        if (strcmp(collector->found[i].path, path) == 0) {
            *targets = &collector->found[i].targets;
            return CZ_OK;
        }
    Found *found =
        cz_arena_grow(collector->arena, collector->found, collector->n_found, sizeof *found);
    if (found == NULL)
        return cz_no_memory(collector->error, "the changes");
    collector->found = found;
    Found *last = &found[collector->n_found];
    *last = (Found){.path = path};
    const CzStatus status = cz_problem_find_changed(collector->problem, scenario, path,
                                                    &last->targets, collector->error);
    collector->n_found++;
    *targets = &last->targets;
    return status;
}

/* Adds the change of one place of a variable, behind those of the same place. */
static CzStatus add_change(Collector *collector, CzDesignChange added) {
    CzDesign *design = collector->design;
    CzDesignChange *change =
        cz_arena_grow(collector->arena, design->change, design->n_change, sizeof *change);
    if (change == NULL)
        return cz_no_memory(collector->error, "the changes");
    design->change = change;
    int at = design->n_change++;
    for (int i = 0; i < at; i++)
        if (change[i].variation == added.variation && change[i].variable == added.variable &&
            change[i].place == added.place &&
            (i + 1 == at || change[i + 1].place != added.place ||
             change[i + 1].variable != added.variable)) {
            memmove(&change[i + 2], &change[i + 1], (size_t)(at - i - 1) * sizeof *change);
            at = i + 1;
            break;
        }
    change[at] = added;
    return CZ_OK;
}

static CzStatus add_target(Collector *collector, const CzTarget *target, CzDesignChange change) {
    change.unit = target->unit;
    for (int i = 0; i < collector->design->n_variable; i++)
        for (int k = 0; k < collector->design->variable[i].n_place; k++) {
            const CzDesignPlace *place = &collector->design->variable[i].place[k];
            change.variable = i;
            change.place = k;
            if (place->vehicle == target->vehicle && place->offset == target->offset)
                CZ_TRY(add_change(collector, change));
        }
    return CZ_OK;
}

static CzStatus add_scenario(Collector *collector, int s, int variation) {
    const CzScenario *scenario = &cz_problem_input(collector->problem)->scenarios[s];
    for (int i = 0; i < scenario->n_changes; i++) {
        const CzChange *written = &scenario->changes[i];
        const CzTargets *targets = NULL;
        CzDesignChange change = {.variation = variation};
        change.kind = cz_change_kind(written, &change.number);
        CZ_TRY(find_places(collector, s, written->path, &targets));
        for (int k = 0; k < targets->n; k++)
            if (targets->target[k].vehicle >= 0)
                CZ_TRY(add_target(collector, &targets->target[k], change));
    }
    return CZ_OK;
}

CzStatus cz_variations_build(const CzProblem *problem, int n_scene, const CzScene *scene,
                             CzArena *arena, CzDesign *design, CzError *error) {
    Collector collector = {.problem = problem, .arena = arena, .design = design, .error = error};
    CzStatus status = CZ_OK;
    for (int s = 0, last = 0; s < n_scene && design->n_variable > 0 && status == CZ_OK; s++)
        if (scene[s].variation > last) {
            last = scene[s].variation;
            status = add_scenario(&collector, s, last);
        }
    for (int i = 0; i < collector.n_found; i++)
        free(collector.found[i].targets.target);
    return status;
}
