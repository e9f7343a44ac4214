/* Places: the interfaces, elements, vehicles, sections and ends at which a metric may be read. */
#ifndef CZ_EVALUATE_PLACE_H
#define CZ_EVALUATE_PLACE_H

#include <string.h>

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

/* Place at which a metric is read. Only the members of its level are set. */
typedef struct CzPlace {
    const CzScene *scene; /* NULL for the design itself */
    const CzRunSummary *run;
    const CzInterfaceResult *interface;
    int interface_index;
    const CzElementResult *element;
    const CzVehicleResult *vehicle;
    const CzProblem *problem;  /* whose rules a design must satisfy */
    const CzVehicle *vehicles; /* the vehicle array with the design's values */
    const CzVehicle *record;   /* of the vehicle or end; the first of n_record for DESIGN */
    int n_record;
    const CzEnd *end;
    double section_force;    /* [N] */
    double rate;             /* crush rate for tube forces [m/s] */
    const double *parameter; /* of the metric that is read, SI */
    bool must_declare; /* a full vehicle: values that it does not declare are unknown, not absent */
    char name[CZ_WHERE_SIZE];
} CzPlace;

/* Source of metrics: one run of a scenario, or the design alone. */
typedef struct CzSubject {
    const CzScene *scene;    /* NULL: the design alone */
    const CzRunSummary *run; /* of that scenario; NULL: the design alone */
    const CzProblem *problem;
    const CzVehicle
        *vehicles; /* the problem's vehicle array with the design's values (n_vehicle) */
    int n_vehicle;
    int n_first_train;       /* the first n vehicles of the array are the first train */
    double rate;             /* crush rate for tube forces [m/s] */
    const bool *is_obstacle; /* whether a vehicle is part of an obstacle (n_vehicle); NULL: none */
} CzSubject;

/* Whether the name of a place begins with a name, such as "A4 front" with A4. */
static inline bool cz_where_begins(const char *where, const char *name) {
    const size_t n = strlen(name);
    return strncmp(where, name, n) == 0 && (where[n] == '\0' || where[n] == ' ');
}

/* Number of the vehicle with whose name that of a place begins; -1 for none. */
static inline int cz_where_vehicle(const CzRunSummary *run, const char *where) {
    for (int i = 0; i < run->n_vehicle; i++)
        if (cz_where_begins(where, run->vehicle[i].name))
            return i;
    return -1;
}

/* What the name of a place leads to in a run. */
typedef struct CzWhere {
    int vehicle;      /* of a vehicle, a section or a part of one; -1 for none */
    int interface[2]; /* behind and ahead of a vehicle; else the first one only; -1 for none */
    const CzElementResult *element; /* of the equal couplers at both ends of a vehicle the one with
                                       the larger force; NULL for none */
} CzWhere;

/* A vehicle at the rear has the interface ahead of it first; the run as a whole has none. */
CzWhere cz_where_find(const CzRunSummary *run, const char *where);

/* Whether a text matches a pattern in which `*` stands for any text and `?` for any letter. */
bool cz_matches(const char *pattern, const char *text);

/* Calls `visit` for each place of a level that a selector picks, in a fixed order. */
typedef void (*CzPlaceVisitor)(const CzPlace *place, void *data);
void cz_places_visit(const CzSubject *subject, CzLevel level, const char *selector,
                     CzPlaceVisitor visit, void *data);

/* Number of places that the selector picks in a scene as written, before any run. */
int cz_places_count(const CzScene *scene, CzLevel level, const char *selector);

#endif
