/* Builds and frees a variant of a problem. */
#include "evaluate/variant.h"
#include "base/error.h"
#include "model/build.h"

#include <stdlib.h>
#include <string.h>

/* Copies the vehicles of every variation. */
static CzStatus copy_vehicles(const CzProblem *problem, CzVariant *variant, const CzScene *scene,
                              CzError *error) {
    int n_vehicle;
    const CzVehicle *own = cz_problem_vehicles(problem, &n_vehicle);
    const size_t n = n_vehicle > 0 ? (size_t)n_vehicle : 0;
    const size_t n_variation = cz_scenes_n_variation(variant->n_scene, scene);
    variant->vehicles = calloc(n_variation, n * sizeof *variant->vehicles);
    if (variant->vehicles == NULL)
        return cz_no_memory(error, "the vehicles");
    memcpy(variant->vehicles, own, n * sizeof *own);
    for (int s = 0, last = 0; s < variant->n_scene; s++) {
        if (scene[s].variation <= last)
            continue;
        last = scene[s].variation;
        own = cz_problem_vehicles(cz_problem_in_scenario(problem, s), &n_vehicle);
        memcpy(variant->vehicles + (size_t)last * n, own, n * sizeof *own);
    }
    return CZ_OK;
}

/* Builds the models that are not left out, each beside the ones before and those of `beside`. */
static CzStatus build_models(const CzProblem *problem, const CzVariantScenes *scenes,
                             CzVariant *variant, CzError *error) {
    const CzVariant *beside = scenes->beside;
    const int n_beside = beside != NULL ? beside->n_scene : 0;
    CzModel **made = calloc((size_t)(n_beside + scenes->n) + 1, sizeof(CzModel *));
    if (made == NULL)
        return cz_no_memory(error, "the models");
    if (n_beside > 0)
        memcpy(made, beside->model, (size_t)n_beside * sizeof *made);
    CzStatus status = CZ_OK;
    for (int s = scenes->first; s < scenes->n && status == CZ_OK; s++) {
        CzModel **model = &variant->model[s];
        if (scenes->only == NULL || cz_scene_is(&scenes->scene[s], scenes->only))
            status = cz_model_build_beside(problem, s, n_beside + s, made, model, error);
        made[n_beside + s] = *model;
    }
    free(made);
    return status;
}

static CzStatus build(const CzProblem *problem, const CzVariantScenes *scenes, CzVariant *variant,
                      CzError *error) {
    CZ_TRY(copy_vehicles(problem, variant, scenes->scene, error));
    const size_t n_scene = variant->n_scene > 0 ? (size_t)variant->n_scene : 0;
    variant->model = calloc(n_scene + 1, sizeof(CzModel *));
    if (variant->model == NULL)
        return cz_no_memory(error, "the models");
    return build_models(problem, scenes, variant, error);
}

CzStatus cz_variant_build(const CzVariantScenes *scenes, const CzVariantSettings *settings,
                          CzVariant *variant, CzError *error) {
    const CzProblem *problem = scenes->problem;
    *variant = (CzVariant){.n_scene = scenes->n};
    if (settings != NULL) {
        CZ_TRY(cz_problem_read_again(problem, settings->n, settings->path, settings->value,
                                     &variant->owned, error));
        problem = variant->owned;
    }
    const CzStatus status = build(problem, scenes, variant, error);
    if (status != CZ_OK)
        cz_variant_free(variant);
    return status;
}

void cz_variant_free(CzVariant *variant) {
    for (int s = 0; variant->model != NULL && s < variant->n_scene; s++)
        cz_model_free(variant->model[s]);
    free(variant->model);
    free(variant->vehicles);
    cz_problem_free(variant->owned);
    *variant = (CzVariant){0};
}
