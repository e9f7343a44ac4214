/* Budgets: impulses on the bodies by source, up to the largest wheel lift or pitch.
 *
 *   J omega = sum of the moment impulses,   m v_z = sum of the vertical impulses
 *
 * both over the sources that act on the body itself, to the order of the step.
 */
#include <math.h>

#include "dynamics/face_moment.h"
#include "simulate/run.h"

#define SMALLEST_LIFT 1e-4 /* of a wheel that counts as lifting [m] (ours) */

struct CzBudget {
    int n_car;
    CzVehicleBudget *running; /* (n_car) */
    CzVehicleBudget *kept;    /* as it was at the largest lift or pitch (n_car) */
    double *lift, *pitch;     /* largest so far [m], [rad] (n_car) */
};

static const struct {
    const char *text;
    bool counts;
} sources[CZ_N_BUDGET] = {
#define CZ_BUDGET(constant, text, counts, doc) [constant] = {text, counts},
#include "crushzone/budget.def"
#undef CZ_BUDGET
};

const char *cz_budget_text(CzBudgetSource source) {
    return sources[source].text;
}

bool cz_budget_counts(CzBudgetSource source) {
    return sources[source].counts;
}

int cz_budget_order(const CzVehicleBudget *budget, int order[CZ_N_BUDGET]) {
    int n = 0;
    for (int source = 0; source < CZ_N_BUDGET; source++) {
        if (budget->moment[source] == 0 && budget->lift[source] == 0)
            continue;
        int k = n++;
        for (; k > 0 && fabs(budget->moment[order[k - 1]]) < fabs(budget->moment[source]); k--)
            order[k] = order[k - 1];
        order[k] = source;
    }
    return n;
}

CzBudget *cz_budget_begin(CzBatch *batch, CzArena *arena) {
    const size_t n = (size_t)batch->model->n_car;
    CzBudget *budget = cz_arena_allocate(arena, 1, sizeof *budget);
    if (budget == NULL)
        return NULL;
    budget->n_car = batch->model->n_car;
    budget->running = cz_arena_allocate(arena, n, sizeof *budget->running);
    budget->kept = cz_arena_allocate(arena, n, sizeof *budget->kept);
    budget->lift = cz_arena_allocate(&batch->arena, n, sizeof *budget->lift);
    budget->pitch = cz_arena_allocate(&batch->arena, n, sizeof *budget->pitch);
    CzBudgetRows *rows =
        cz_arena_allocate(&batch->arena, (size_t)batch->dynamics->n_block, sizeof *rows);
    if (budget->running == NULL || budget->kept == NULL || budget->lift == NULL ||
        budget->pitch == NULL || rows == NULL)
        return NULL;
    for (int i = 0; i < batch->dynamics->n_block; ++i)
        batch->dynamics->block[i].budget = &rows[i];
    return budget;
}

/* Values of a lane. */
static const CzBudgetRows *rows_of(const CzBatch *batch, size_t lane, size_t *place) {
    *place = lane % CZ_LANE_BLOCK;
    return cz_block_of(batch->dynamics, lane)->budget;
}

/* Forces and moments of all sources on the body of a car, now. */
static void look(const CzBatch *batch, int car, double lift[CZ_N_BUDGET],
                 double moment[CZ_N_BUDGET]) {
    const CzModel *model = batch->model;
    size_t i;
    const CzBudgetRows *own = rows_of(batch, cz_lane(batch, car, 0), &i);
    for (int end = 0; end < 2; ++end) {
        lift[CZ_BUDGET_END_REAR + end] = own->end_lift[end][i];
        moment[CZ_BUDGET_END_REAR + end] = own->end_moment[end][i];
        lift[CZ_BUDGET_GUIDE_REAR + end] = own->guide_lift[end][i];
        moment[CZ_BUDGET_GUIDE_REAR + end] = own->guide_moment[end][i];
    }
    moment[CZ_BUDGET_LINKS] = own->link_moment[i];
    lift[CZ_BUDGET_SUSPENSION] = own->suspension_lift[i];
    moment[CZ_BUDGET_SUSPENSION] = own->suspension_moment[i];
    lift[CZ_BUDGET_STOPS] = own->stop_lift[i];
    moment[CZ_BUDGET_STOPS] = own->stop_moment[i];
    for (int side = 0; side < 2; ++side) {
        const int interface = side == 0 ? car : car - 1, end = side == 0 ? 1 : 0;
        if (interface < 0 || interface >= model->n_car - 1)
            continue;
        size_t k;
        const CzBudgetRows *rows = rows_of(batch, cz_lane(batch, interface, 0), &k);
        lift[CZ_BUDGET_COUPLER_REAR + end] = rows->coupler_lift[side][k];
        moment[CZ_BUDGET_COUPLER_REAR + end] = rows->coupler_moment[side][k];
        lift[CZ_BUDGET_HINGE_REAR + end] = rows->hinge_lift[side][k];
        moment[CZ_BUDGET_HINGE_REAR + end] = rows->hinge_moment[side][k];
        const CzFacePush face = cz_face_push(batch->dynamics, cz_lane(batch, interface, 0),
                                             cz_lane(batch, car, 0), side);
        lift[CZ_BUDGET_FACE_REAR + end] = face.lift;
        moment[CZ_BUDGET_FACE_REAR + end] = face.moment;
    }
}

static double lift_of_wheels(const CzBatch *batch, size_t lane) {
    double largest = 0.0;
    for (int axle = 0; axle < 4; ++axle)
        largest = fmax(largest, -cz_published(batch, CZ_PUBLISHED(wheel[axle].approach), lane));
    return largest;
}

static double momentum(const CzBatch *batch, int dof, size_t lane) {
    return *cz_lane_mass(batch->lanes, dof, lane) * cz_velocity(batch, dof, lane);
}

/* Keeps the budget of a car where its lift, or its pitch before any lift, is the largest so far. */
static void keep(CzBudget *budget, const CzBatch *batch, int car) {
    const size_t lane = cz_lane(batch, car, 0);
    const double lift = lift_of_wheels(batch, lane);
    const double pitch = fabs(cz_position(batch, CZ_DOF(body.pitch), lane));
    const bool lifts = lift > SMALLEST_LIFT && lift > budget->lift[car];
    const bool pitches = budget->lift[car] == 0.0 && pitch > budget->pitch[car];
    if (!lifts && !pitches)
        return;
    budget->lift[car] = lifts ? lift : 0.0;
    budget->pitch[car] = pitch;
    budget->kept[car] = budget->running[car];
    budget->kept[car].of_lift = lifts;
    budget->kept[car].time = batch->time;
    budget->kept[car].spin = momentum(batch, CZ_DOF(body.pitch), lane);
    budget->kept[car].rise = momentum(batch, CZ_DOF(body.z), lane);
}

void cz_budget_add(CzBudget *budget, const CzBatch *batch) {
    if (!isnan(batch->design[0].override_time))
        return; /* later motion is beyond the model */
    for (int car = 0; car < budget->n_car; ++car) {
        if (batch->model->car[car].model != CZ_MODEL_FULL)
            continue;
        double lift[CZ_N_BUDGET] = {0.0}, moment[CZ_N_BUDGET] = {0.0};
        look(batch, car, lift, moment);
        for (int source = 0; source < CZ_N_BUDGET; ++source) {
            budget->running[car].lift[source] += batch->step * lift[source];
            budget->running[car].moment[source] += batch->step * moment[source];
        }
        keep(budget, batch, car);
    }
}

const CzVehicleBudget *cz_budget_result(const CzBudget *budget) {
    return budget->kept;
}
