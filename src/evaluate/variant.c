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

static CzStatus build(const CzProblem *problem, const CzScene *scene, const char *only, int first,
                      CzVariant *variant, CzError *error) {
    CZ_TRY(copy_vehicles(problem, variant, scene, error));
    const size_t n_scene = variant->n_scene > 0 ? (size_t)variant->n_scene : 0;
    variant->model = calloc(n_scene + 1, sizeof(CzModel *));
    if (variant->model == NULL)
        return cz_no_memory(error, "the models");
    for (int s = first; s < variant->n_scene; s++)
        if (only == NULL || cz_scene_is(&scene[s], only))
            CZ_TRY(cz_model_build_beside(problem, s, s, variant->model, &variant->model[s], error));
    return CZ_OK;
}

CzStatus cz_variant_build(const CzProblem *problem, const CzVariantSettings *settings, int n_scene,
                          const CzScene *scene, const char *only, int first, CzVariant *variant,
                          CzError *error) {
    *variant = (CzVariant){.n_scene = n_scene};
    if (settings != NULL) {
        CZ_TRY(cz_problem_read_again(problem, settings->n, settings->path, settings->value,
                                     &variant->owned, error));
        problem = variant->owned;
    }
    const CzStatus status = build(problem, scene, only, first, variant, error);
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
