/* Places: the interfaces, elements, vehicles, sections and ends that a metric may be read at. */
#ifndef CZ_EVALUATE_PLACE_H
#define CZ_EVALUATE_PLACE_H

#include "crushzone/simulate.h"
#include "evaluate/scene.h"

typedef enum CzLevel {
    CZ_LEVEL_RUN,
    CZ_LEVEL_INTERFACE,
    CZ_LEVEL_ELEMENT,
    CZ_LEVEL_VEHICLE,
    CZ_LEVEL_SECTION,
    CZ_LEVEL_END,   /* of the design as written */
    CZ_LEVEL_DESIGN /* likewise */
} CzLevel;

/* Whether a level is that of the design as written, without a run. */
static inline bool cz_level_is_of_design(CzLevel level) {
    return level == CZ_LEVEL_END || level == CZ_LEVEL_DESIGN;
}

/* Where a metric is read. Only what its level has is filled. */
typedef struct CzPlace {
    const CzScene *scene; /* NULL for the design itself */
    const CzRunSummary *run;
    const CzInterfaceResult *interface;
    int interface_index;
    const CzElementResult *element;
    const CzVehicleResult *vehicle;
    const CzProblem *problem;  /* whose rules a design is held to */
    const CzVehicle *vehicles; /* the vehicle array with the design's values */
    const CzVehicle *record;   /* of the vehicle or end; the first of n_record for DESIGN */
    int n_record;
    const CzEnd *end;
    double section_force; /* [N] */
    double rate;          /* crush rate that tube forces are taken at [m/s] */
    bool must_declare;    /* a full vehicle: what it does not declare is unknown, not absent */
    char name[CZ_WHERE_ROOM];
} CzPlace;

/* What a metric is read from: one run of a scenario, or the design alone. */
typedef struct CzSubject {
    const CzScene *scene;    /* NULL: the design alone */
    const CzRunSummary *run; /* of that scenario; NULL: the design alone */
    const CzProblem *problem;
    const CzVehicle
        *vehicles; /* the problem's vehicle array with the design's values (n_vehicle) */
    int n_vehicle;
    int n_first_train;       /* the first n vehicles of the array are the first train */
    double rate;             /* crush rate that tube forces are taken at [m/s] */
    const bool *is_obstacle; /* whether a vehicle is part of an obstacle (n_vehicle); NULL: none */
} CzSubject;

/* Whether a text matches a pattern in which `*` stands for any text and `?` for any letter. */
bool cz_matches(const char *pattern, const char *text);

/* Walks the places of a level that a selector picks. `visit` gets each in a fixed order. */
typedef void (*CzPlaceVisitor)(const CzPlace *place, void *data);
void cz_places_visit(const CzSubject *subject, CzLevel level, const char *selector,
                     CzPlaceVisitor visit, void *data);

/* How many places the selector picks in a scene as written, before any run. */
int cz_places_count(const CzScene *scene, CzLevel level, const char *selector);

#endif
