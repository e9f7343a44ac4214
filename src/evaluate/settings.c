/* Settings of a file as the values of a design. */
#include "evaluate/evaluator_parts.h"
#include "model/build.h"

#include <stdlib.h>
#include <string.h>

/* The variable whose only place has this path, -1 for none. A stroke that a full car must be drawn
 * with is another one: a file with that stroke alone has the car redrawn. */
static int variable_at(const CzDesign *design, const char *path) {
    for (int i = 0; i < design->n_variable; i++) {
        const CzVariableInfo *info = &design->variable[i].info;
        if (info->n_choice == 0 && info->n_place == 1 && isnan(info->place->drawn_stroke) &&
            strcmp(info->place->path, path) == 0)
            return i;
    }
    return -1;
}

/* Whether a variable has the value of the file at all its places. */
static bool is_of_file(const CzEvaluator *evaluator, const CzDesignVariable *variable, double x) {
    for (int k = 0; k < variable->n_place && variable->info.n_choice == 0; k++) {
        const CzDesignPlace *place = &variable->place[k];
        double value;
        memcpy(&value, (const char *)&evaluator->vehicles[place->vehicle] + place->offset,
               sizeof value);
        if (x * place->scale != value)
            return false;
    }
    return true;
}

/* Fills x; false when the settings are not those of variables within their bounds. */
static bool read_settings(const CzEvaluator *evaluator, int n, const char *const *path,
                          const double *number, double *x) {
    const CzDesign *design = &evaluator->design;
    for (int i = 0; i < design->n_variable; i++)
        x[i] = design->variable[i].info.start;
    for (int k = 0; k < n; k++) {
        const int i = variable_at(design, path[k]);
        if (i < 0 || !(number[k] >= design->variable[i].info.min) ||
            !(number[k] <= design->variable[i].info.max))
            return false;
        x[i] = number[k];
    }
    for (int i = 0; i < design->n_variable; i++) {
        bool is_set = false;
        for (int k = 0; k < n; k++)
            is_set |= variable_at(design, path[k]) == i;
        if (!is_set && !is_of_file(evaluator, &design->variable[i], x[i]))
            return false;
    }
    return true;
}

/* Whether a file with a design's values could be read, and its models are those of the evaluator
 * but for the values of the vehicles. */
static bool has_same_models(const CzEvaluator *evaluator, const double *x, CzVehicle *vehicles) {
    const size_t n_vehicle = (size_t)evaluator->n_vehicle;
    for (int s = 0; s < evaluator->n_scene; s++) {
        const CzScene *scene = &evaluator->scene[s];
        const CzVehicle *own = cz_vehicles_in(evaluator, evaluator->vehicles, s);
        memcpy(vehicles, own, n_vehicle * sizeof *vehicles);
        cz_design_apply(&evaluator->design, scene->variation, x, vehicles);
        const CzProblem *problem = cz_problem_in_scenario(evaluator->problem, s);
        if (cz_problem_check_vehicles(problem, vehicles, NULL) != CZ_OK)
            return false;
        if (evaluator->model[s] != NULL && !cz_model_is_same_with(evaluator->model[s], vehicles))
            return false;
    }
    return true;
}

bool cz_evaluator_take_settings(const CzEvaluator *evaluator, int n, const char *const *path,
                                const double *number, double *x) {
    if (evaluator->design.is_fit || !read_settings(evaluator, n, path, number, x))
        return false;
    CzVehicle *vehicles = malloc(((size_t)evaluator->n_vehicle + 1) * sizeof *vehicles);
    const bool is_same = vehicles != NULL && has_same_models(evaluator, x, vehicles);
    free(vehicles);
    return is_same;
}
