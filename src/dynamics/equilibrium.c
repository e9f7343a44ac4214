/* Static equilibrium:
 *
 *   body:   sum F_s = (m_body + m_ends) g          sum x_b F_s = sum x_e m_e g
 *   bogie:  sum F_p - F_s = m_bogie g              sum x_a F_p = 0
 *   wheel:  N - F_p = m_wheelset g                 N = Hertz's law on the rail, under the approach
 *
 * with F_s, F_p from the suspension's law and the rail's deflection from the track at rest under
 * all four N. The unknowns are the ten displacements and the four forces N.
 */
#include "dynamics/equilibrium.h"

#include <math.h>
#include <stdio.h>

#include "base/error.h"
#include "base/gravity.h"
#include "dynamics/track.h"
#include "integrate/integrator.h"
#include "laws/suspension.h"
#include "laws/wheel_rail.h"

#define TOLERANCE 1e-11 /* largest residual over the weight; rounding leaves about 1e-14 (ours) */
#define FIRST_SAG 0.02  /* of every spring in the first guess, so that all carry load [m] (ours) */
#define FIRST_DENT 1e-3 /* indentation of every wheel in the first guess [m] (ours) */

enum { BODY_Z, BODY_PITCH, BOGIE_Z, BOGIE_PITCH = BOGIE_Z + 2, WHEEL_Z = BOGIE_PITCH + 2 };
enum { LOAD = WHEEL_Z + 4, N_UNKNOWN = LOAD + 4 };

typedef struct Car {
    CzEquations equations; /* must be first: the solver passes its address back */
    double bogie_x, axle_x;
    double end_x[2], end_mass[2], body_mass, bogie_mass, wheelset_mass;
    CzSuspensionLaw secondary, primary;
    double hertz;
    double influence[4][4]; /* rail's deflection upwards at i per force downwards at j [m/N] */
    double flexibility[4];  /* in addition, under the wheel itself [m/N] */
} Car;

/* A spring measured from its unloaded length; at rest it does not reach its stops. */
static CzSuspensionLaw unloaded_spring(double stiffness, bool pulls) {
    return (CzSuspensionLaw){.stiffness = stiffness,
                             .preload = pulls ? CZ_NEVER : 0.0,
                             .bump_gap = CZ_NEVER,
                             .lift_gap = CZ_NEVER};
}

static Car car_of(const CzLanes *lanes, size_t lane) {
    const CzParameters *rows = &cz_lane_block(lanes, lane)->parameter;
    const CzState *mass = &cz_lane_block(lanes, lane)->mass;
    const size_t i = lane % CZ_LANE_BLOCK;
    return (Car){.bogie_x = rows->bogie_x[i],
                 .axle_x = rows->axle_x[i],
                 .end_x = {rows->end[0].x[i], rows->end[1].x[i]},
                 .end_mass = {mass->end[0].x[i], mass->end[1].x[i]},
                 .body_mass = mass->body.z[i],
                 .bogie_mass = mass->bogie[0].z[i],
                 .wheelset_mass = mass->wheelset[0].z[i],
                 .secondary = unloaded_spring(rows->secondary.stiffness[i],
                                              rows->secondary_preload[0][i] >= CZ_NEVER),
                 .primary = unloaded_spring(rows->primary.stiffness[i],
                                            rows->primary_preload[0][i] >= CZ_NEVER),
                 .hertz = rows->wheel.hertz[i]};
}

/* Deflection of the rail under each wheel per force at each wheel. */
static bool find_influence(Car *car, CzTrackMotion *track, CzArena *arena) {
    double place[4];
    for (int axle = 0; axle < 4; axle++)
        place[axle] = cz_wheel_place(car->bogie_x, car->axle_x, axle);
    for (size_t j = 0; j < 4; j++) {
        double load[4] = {0.0}, deflection[4];
        load[j] = 1.0;
        if (!cz_track_lay(track, j, place, load, arena))
            return false;
        cz_track_deflection(track, j, place, deflection, car->flexibility);
        for (int i = 0; i < 4; i++)
            car->influence[i][j] = deflection[i];
    }
    return true;
}

/* ---- the equations --------------------------------------------------------------------------- */

static double side_of(int index) {
    return index % 2 == 0 ? -1.0 : 1.0;
}

static double secondary_compression(const Car *car, const double *q, int bogie) {
    return q[BOGIE_Z + bogie] - (q[BODY_Z] + side_of(bogie) * car->bogie_x * q[BODY_PITCH]);
}

static double primary_compression(const Car *car, const double *q, int axle) {
    const int bogie = axle / 2;
    return q[WHEEL_Z + axle] -
           (q[BOGIE_Z + bogie] + side_of(axle) * car->axle_x * q[BOGIE_PITCH + bogie]);
}

static double rail_deflection(const Car *car, const double *q, int axle) {
    double z = 0.0;
    for (int j = 0; j < 4; j++)
        z += car->influence[axle][j] * q[LOAD + j];
    return z;
}

static void residuals(CzEquations *equations, const double *q, double *residual) {
    const Car *car = (const Car *)equations;
    for (int i = 0; i < N_UNKNOWN; i++)
        residual[i] = 0.0;
    residual[BODY_Z] = -car->body_mass * CZ_GRAVITY;
    for (int end = 0; end < 2; end++) {
        residual[BODY_Z] -= car->end_mass[end] * CZ_GRAVITY;
        residual[BODY_PITCH] -= car->end_x[end] * car->end_mass[end] * CZ_GRAVITY;
    }
    for (int bogie = 0; bogie < 2; bogie++) {
        const double force =
            cz_suspension_spring(&car->secondary, secondary_compression(car, q, bogie));
        residual[BODY_Z] += force;
        residual[BODY_PITCH] += side_of(bogie) * car->bogie_x * force;
        residual[BOGIE_Z + bogie] -= force + car->bogie_mass * CZ_GRAVITY;
    }
    for (int axle = 0; axle < 4; axle++) {
        const int bogie = axle / 2;
        const double force = cz_suspension_spring(&car->primary, primary_compression(car, q, axle));
        const double approach = rail_deflection(car, q, axle) - q[WHEEL_Z + axle];
        residual[BOGIE_Z + bogie] += force;
        residual[BOGIE_PITCH + bogie] += side_of(axle) * car->axle_x * force;
        residual[WHEEL_Z + axle] = q[LOAD + axle] - force - car->wheelset_mass * CZ_GRAVITY;
        residual[LOAD + axle] =
            cz_wheel_force_on_spring(car->hertz, car->flexibility[axle], approach) - q[LOAD + axle];
    }
}

/* First guess, in which every spring and wheel carries load, however the weight is distributed. */
static void guess(double weight, double *q) {
    for (int i = 0; i < N_UNKNOWN; i++)
        q[i] = 0.0;
    q[BODY_Z] = -FIRST_DENT - 2.0 * FIRST_SAG;
    for (int bogie = 0; bogie < 2; bogie++)
        q[BOGIE_Z + bogie] = -FIRST_DENT - FIRST_SAG;
    for (int axle = 0; axle < 4; axle++) {
        q[WHEEL_Z + axle] = -FIRST_DENT;
        q[LOAD + axle] = 0.25 * weight;
    }
}

static CzEquilibrium read(Car *car, const double *q, double weight) {
    CzEquilibrium found = {.body_z = q[BODY_Z], .body_pitch = q[BODY_PITCH]};
    double residual[N_UNKNOWN];
    residuals(&car->equations, q, residual);
    for (int i = 0; i < N_UNKNOWN; i++)
        found.residual = fmax(found.residual, fabs(residual[i]) / weight);
    for (int bogie = 0; bogie < 2; bogie++)
        found.secondary[bogie] = secondary_compression(car, q, bogie);
    for (int axle = 0; axle < 4; axle++) {
        const double flexible = car->flexibility[axle] * q[LOAD + axle];
        found.primary[axle] = primary_compression(car, q, axle);
        found.wheel_load[axle] = q[LOAD + axle];
        found.rail[axle] = flexible - rail_deflection(car, q, axle);
        found.indentation[axle] = -q[WHEEL_Z + axle] - found.rail[axle];
    }
    return found;
}

/* Reports the spring or contact that is furthest from equilibrium. */
static CzStatus report_unbalanced(const Car *car, const double *q, double weight, CzError *error) {
    static const char *const side[] = {"rear", "front"};
    char what[80];
    double residual[N_UNKNOWN];
    int worst = 0;
    residuals((CzEquations *)&car->equations, q, residual);
    for (int i = 0; i < N_UNKNOWN; i++)
        if (!(fabs(residual[i]) <= fabs(residual[worst])))
            worst = i;
    if (worst < BOGIE_Z)
        snprintf(what, sizeof what, "the body on its secondary suspensions");
    else if (worst < WHEEL_Z)
        snprintf(what, sizeof what, "the %s bogie on its primary suspensions",
                 side[(worst - BOGIE_Z) % 2]);
    else if (worst < LOAD)
        snprintf(what, sizeof what, "wheelset %d under its primary suspension",
                 worst - WHEEL_Z + 1);
    else
        snprintf(what, sizeof what, "the contact of wheelset %d with the rail", worst - LOAD + 1);
    CzStatus status = cz_fail(error, CZ_STATUS_RUN_FAILED,
                              "no static equilibrium: the force on %s is unbalanced by %.0f kN, of "
                              "a vehicle weight of %.0f kN",
                              what, 1e-3 * fabs(residual[worst]), 1e-3 * weight);
    if (error != NULL)
        snprintf(error->help, sizeof error->help,
                 "compare the vehicle's mass with its springs: %.0f kN/m per bogie (secondary), "
                 "%.0f kN/m per axle (primary)",
                 1e-3 * car->secondary.stiffness, 1e-3 * car->primary.stiffness);
    return status;
}

CzStatus cz_equilibrium_find(const CzLanes *lanes, size_t lane, CzTrackMotion *track,
                             CzArena *arena, CzEquilibrium *equilibrium, CzError *error) {
    Car car = car_of(lanes, lane);
    if (track != NULL && !find_influence(&car, track, arena))
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the track");
    const double weight = CZ_GRAVITY * (car.body_mass + car.end_mass[0] + car.end_mass[1] +
                                        2.0 * car.bogie_mass + 4.0 * car.wheelset_mass);
    double q[N_UNKNOWN], unknown_scale[N_UNKNOWN], residual_scale[N_UNKNOWN];
    for (int i = 0; i < N_UNKNOWN; i++) {
        unknown_scale[i] = i >= LOAD ? weight : FIRST_SAG;
        residual_scale[i] = weight;
    }
    car.equations = (CzEquations){N_UNKNOWN, unknown_scale, residual_scale, residuals};
    guess(weight, q);
    const CzStatus status = cz_equations_solve(&car.equations, TOLERANCE, q, error);
    if (status == CZ_STATUS_RUN_FAILED)
        return report_unbalanced(&car, q, weight, error);
    if (status != CZ_OK)
        return status;
    *equilibrium = read(&car, q, weight);
    return CZ_OK;
}
