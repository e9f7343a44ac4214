/* A variant: the problem with other settings, ready to run.
 *
 * Numbers of absorbers are written into copies of the vehicle array, so that many designs of one
 * variant run side by side. Other changes, such as another buffer or a fitted mass, are settings of
 * a problem that is reread from the file's tree, so that the variant is the same, to the last bit,
 * as that of a file with these settings.
 */
#ifndef CZ_EVALUATE_VARIANT_H
#define CZ_EVALUATE_VARIANT_H

#include "crushzone/evaluate.h"
#include "evaluate/scene.h"

typedef struct CzVariant {
    CzProblem *owned;    /* NULL for the problem as written */
    CzVehicle *vehicles; /* those of each variation (n_variation x n_vehicle) */
    int n_scene;
    CzModel **model; /* NULL for scenarios that are left out (n_scene) */
} CzVariant;

/* Settings "path" = "value" of a variant. */
typedef struct CzVariantSettings {
    int n;
    const char *const *path, *const *value;
} CzVariantSettings;

/* Scenarios of a variant, and those of them that are run. */
typedef struct CzVariantScenes {
    const CzProblem *problem;
    int n;
    const CzScene *scene;    /* (n) */
    const char *only;        /* the only scenario or family; NULL for all */
    int first;               /* scenarios before this one are left out */
    const CzVariant *beside; /* whose tracks are used where they are the same; it must live longer;
                                NULL for none */
} CzVariantScenes;

/* Builds a variant; `settings` NULL for the problem as written. A variant that failed need not be
 * freed. Statuses: CZ_OK, CZ_STATUS_INPUT with the rule that the settings violate,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_variant_build(const CzVariantScenes *scenes,
                                        const CzVariantSettings *settings, CzVariant *variant,
                                        CzError *error);
void cz_variant_free(CzVariant *variant);

#endif
