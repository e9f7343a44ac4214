/* Builds and frees a variant of a problem. */
#include "evaluate/variant.h"
#include "base/error.h"

#include <stdlib.h>

static CzStatus build(const CzProblem *problem, const CzScene *scene, const char *only,
                      CzVariant *variant, CzError *error) {
    int n_vehicle;
    variant->vehicles = cz_problem_vehicles(problem, &n_vehicle);
    variant->model = calloc((size_t)variant->n_scene, sizeof(CzModel *));
    if (variant->model == NULL)
        return cz_no_memory(error, "the models");
    for (int s = 0; s < variant->n_scene; s++)
        if (only == NULL || cz_scene_is(&scene[s], only))
            CZ_TRY(cz_model_build(problem, s, &variant->model[s], error));
    return CZ_OK;
}

CzStatus cz_variant_build(const CzProblem *problem, const CzVariantSettings *settings, int n_scene,
                          const CzScene *scene, const char *only, CzVariant *variant,
                          CzError *error) {
    *variant = (CzVariant){.n_scene = n_scene};
    if (settings != NULL) {
        CZ_TRY(cz_problem_read_again(problem, settings->n, settings->path, settings->value,
                                     &variant->owned, error));
        problem = variant->owned;
    }
    const CzStatus status = build(problem, scene, only, variant, error);
    if (status != CZ_OK)
        cz_variant_free(variant);
    return status;
}

void cz_variant_free(CzVariant *variant) {
    for (int s = 0; variant->model != NULL && s < variant->n_scene; s++)
        cz_model_free(variant->model[s]);
    free(variant->model);
    cz_problem_free(variant->owned);
    *variant = (CzVariant){0};
}
