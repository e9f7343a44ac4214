/* The immutable model of one scenario: masses, geometry, connections, step bounds. */
#ifndef CRUSHZONE_MODEL_H
#define CRUSHZONE_MODEL_H

#include "crushzone/names.h"
#include "crushzone/problem.h"

CZ_BEGIN_DECLARATIONS

typedef struct CzModel CzModel;

/* Builds the model of one scenario of a problem. The problem must outlive the model. The caller
 * frees it. Statuses: CZ_OK, CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_model_build(const CzProblem *problem, int scenario,
                                             CzModel **model, CzError *error);
CZ_API void cz_model_free(CzModel *model);

/* Sizes and names; names are borrowed. Interface i lies between vehicle i and vehicle i + 1,
 * counted along +x. */
CZ_API int cz_model_n_vehicle(const CzModel *model);
CZ_API const char *cz_model_vehicle_name(const CzModel *model, int vehicle);
CZ_API int cz_model_n_interface(const CzModel *model);
CZ_API const char *cz_model_interface_name(const CzModel *model, int interface);
CZ_API int cz_model_colliding_interface(const CzModel *model);

/* Properties of a full vehicle before a run. */
typedef struct CzVehicleProperties {
    double mass;                    /* total with payload and absorbers [kg] */
    double axle_load[4];            /* static wheelset loads on the rail, rear to front [N] */
    double secondary_deflection[2]; /* static deflection, rear and front [m] */
    double primary_deflection[4];   /* [m] */
    double bounce_frequency;        /* lowest body bounce, wheels fixed [Hz] */
    double pitch_frequency;         /* lowest body pitch, wheels fixed [Hz] */
} CzVehicleProperties;
/* Properties of a vehicle; all NaN for rigid and fixed ones. */
CZ_API CzVehicleProperties cz_model_vehicle_properties(const CzModel *model, int vehicle);

/* Properties of an interface before a run. */
typedef struct CzInterfaceProperties {
    double strut_length;   /* pivot to pivot at rest [m]; NaN without couplers */
    double critical_force; /* F_crit, the axial force at which both trains, a chain of coupler
                              struts, fold in the lowest shape that belongs to this interface [N];
                              NaN without couplers or full vehicles */
    double tube_force;     /* largest plastic force of the weaker coupler before shear-off [N]; NaN
                              without tubes */
    double anti_climber_gap; /* closure at which the anti-climbers touch [m]; NaN without */
} CzInterfaceProperties;
CZ_API CzInterfaceProperties cz_model_interface_properties(const CzModel *model, int interface);

/* Time step and the bounds that it was chosen from, smallest first. */
typedef struct CzStepBound {
    char element[CZ_WHERE_SIZE]; /* such as "wheel-rail contact B1" */
    double bound;                /* largest stable step [s] */
} CzStepBound;
CZ_API double cz_model_time_step(const CzModel *model);
CZ_API int cz_model_n_step_bound(const CzModel *model);
CZ_API const CzStepBound *cz_model_step_bound(const CzModel *model, int index);

CZ_END_DECLARATIONS
#endif
