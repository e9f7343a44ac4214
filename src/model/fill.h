/* Common declarations for filling the lanes of one design. */
#ifndef CZ_MODEL_FILL_H
#define CZ_MODEL_FILL_H

#include "model/breakpoints.h"
#include "model/model.h"
#include "problem/meeting.h"

/* The two ends of a car; also the two sides of an interface: side A is a front end, B a rear end.
 */
enum { CZ_REAR, CZ_FRONT };
enum { CZ_SIDE_A, CZ_SIDE_B };

static inline const CzEnd *cz_end_of(const CzVehicle *vehicle, int end) {
    return end == CZ_REAR ? &vehicle->rear : &vehicle->front;
}

/* Masses and static loads of one car of a design, and the places of its foremost planes. */
typedef struct CzStatics {
    double mass;              /* total with payload and absorbers [kg] */
    double weight;            /* of it [N] */
    double body_mass;         /* between the crush zones; all of it for a rigid car [kg] */
    double body_inertia;      /* [kg m2] */
    double plane[2];          /* foremost planes from the body's centre of gravity [m] */
    double secondary_load[2]; /* static load of the rear and front secondary suspension [N] */
    double primary_load[4];   /* per axle, rear to front [N] */
    double wheel_load[4];     /* of the wheelsets on the rail [N] */
} CzStatics;

/* Context of one call of cz_model_fill. */
typedef struct CzFill {
    const CzModel *model;
    const CzVehicle *vehicles; /* the candidate's */
    const CzVehicle *baseline; /* the problem's own */
    CzLanes *lanes;
    int design;
    CzError *error;
} CzFill;

/* Name of a part in a message: "car A1, front coupler tube". */
typedef struct CzPartName {
    int car;
    int end;  /* -1: the car as a whole */
    int lane; /* car in whose lane its parameters are: at interfaces the one behind */
    const char *what;
} CzPartName;

static inline const CzVehicle *cz_fill_vehicle(const CzFill *fill, int car) {
    return &fill->vehicles[fill->model->car[car].vehicle];
}

static inline size_t cz_fill_lane(const CzFill *fill, int car) {
    return (size_t)car * (size_t)fill->lanes->n_design + (size_t)fill->design;
}

/* Writes "<part>: <sentence>" with the place of `field`, an address inside the vehicle array. */
CzStatus cz_fill_refuse(const CzFill *fill, CzPartName part, const void *field, const char *format,
                        ...) __attribute__((format(printf, 4, 5)));

/* Curves of devices, checked; forces of all `count` devices together. */
CZ_MUST_CHECK CzStatus cz_fill_buffer(const CzFill *fill, CzPartName part, const CzBuffer *buffer,
                                      int count, CzCurveId id);
CZ_MUST_CHECK CzStatus cz_fill_tube(const CzFill *fill, CzPartName part, const CzTube *tube,
                                    int count, CzCurveId id);
CZ_MUST_CHECK CzStatus cz_fill_anti_climber(const CzFill *fill, CzPartName part,
                                            const CzAntiClimber *anti_climber, CzCurveId id);
CZ_MUST_CHECK CzStatus cz_fill_end(const CzFill *fill, CzPartName part, const CzEnd *end,
                                   CzCurveId id);

/* Parameters of a crush zone in addition to its curve. */
void cz_fill_crush(CzCrushRows *rows, size_t i, const CzEnd *end);

/* statics.c */
CZ_MUST_CHECK CzStatus cz_fill_statics(const CzFill *fill, int car, CzStatics *statics);

/* fill_car.c, fill_interface.c */
CZ_MUST_CHECK CzStatus cz_fill_car(const CzFill *fill, int car, const CzStatics *statics);
CZ_MUST_CHECK CzStatus cz_fill_interface(const CzFill *fill, int interface, const CzStatics *behind,
                                         const CzStatics *ahead);

/* Heights by which the scenario raises the two cars of an interface [m]. */
typedef struct CzOffsets {
    double side[2];
} CzOffsets;
CzOffsets cz_fill_offsets(const CzModel *model, int interface);

/* Mass in front of the crush zone of an end of a car, on which its parts act [kg]; 0: it moves with
 * the body. */
double cz_fill_end_mass(const CzFill *fill, int car, int which);

static inline double cz_second_unloading(const CzEnd *end) {
    return isnan(end->second_unloading_stiffness) ? end->unloading_stiffness
                                                  : end->second_unloading_stiffness;
}

/* Friction jaws of a buffer stop; NULL for other vehicles. */
static inline const CzSlide *cz_slide_of(const CzVehicle *vehicle) {
    if (vehicle->rear.given && vehicle->rear.slide.given)
        return &vehicle->rear.slide;
    return vehicle->front.given && vehicle->front.slide.given ? &vehicle->front.slide : NULL;
}

/* True when an end has loading stages or a curve of its own. */
static inline bool cz_end_crushes(const CzEnd *end) {
    return end->given && (end->curve.given || end->n_stages > 0);
}

#endif
