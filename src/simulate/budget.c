/* Budgets: impulses on the bodies by source, up to the largest wheel lift or pitch.
 *
 *   J omega = sum of the moment impulses,   m v_z = sum of the vertical impulses
 *
 * both over the sources that act on the body itself, with an error of the order of the step.
 */
#include <math.h>

#include "dynamics/face_moment.h"
#include "simulate/run.h"

#define SMALLEST_LIFT 1e-4 /* from this lift on a wheel counts as lifted [m] (ours) */

struct CzBudget {
    int n_car;
    const CzBlock *block;  /* with the impulses of the forces that the kernel records (n_block) */
    CzFacePush (*face)[2]; /* impulses of the faces on the rear and the front of a car (n_car) */
    CzVehicleBudget *kept; /* budget at the largest lift or pitch (n_car) */
    double *lift, *pitch;  /* largest so far [m], [rad] (n_car) */
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
    const size_t n = (size_t)batch->n_car, n_block = (size_t)batch->dynamics->n_block;
    CzBudget *budget = cz_arena_allocate(arena, 1, sizeof *budget);
    if (budget == NULL)
        return NULL;
    budget->n_car = batch->n_car;
    budget->kept = cz_arena_allocate(arena, n, sizeof *budget->kept);
    budget->block = batch->dynamics->block;
    budget->face = cz_arena_allocate(&batch->arena, n, sizeof *budget->face);
    budget->lift = cz_arena_allocate(&batch->arena, n, sizeof *budget->lift);
    budget->pitch = cz_arena_allocate(&batch->arena, n, sizeof *budget->pitch);
    CzBudgetRows *rows = cz_arena_allocate(&batch->arena, n_block, sizeof *rows);
    if (budget->kept == NULL || budget->face == NULL || budget->lift == NULL ||
        budget->pitch == NULL || rows == NULL)
        return NULL;
    for (size_t i = 0; i < n_block; ++i)
        batch->dynamics->block[i].budget = &rows[i];
    return budget;
}

/* Adds the force of the faces of an interface, side A on the front of the car behind them. */
static void add_faces(CzBudget *budget, const CzBatch *batch, int interface) {
    for (int side = 0; side < 2; ++side) {
        CzFacePush *sum = &budget->face[interface + side][1 - side];
        const CzFacePush push = cz_face_push(batch->dynamics, cz_lane(batch, interface, 0),
                                             cz_lane(batch, interface + side, 0), side);
        sum->lift += batch->step * push.lift;
        sum->moment += batch->step * push.moment;
    }
}

/* Adds the forces of the faces that push, few of them at a time. */
static void add_pushing_faces(CzBudget *budget, const CzBatch *batch) {
    for (int block = 0; block < batch->dynamics->n_block; ++block) {
        const CzBudgetRows *rows = batch->dynamics->block[block].budget;
        for (int i = 0; i < CZ_LANE_BLOCK; ++i)
            if (rows->face.x[i] != 0.0 || rows->face.z[i] != 0.0)
                add_faces(budget, batch, block * CZ_LANE_BLOCK + i);
    }
}

/* The impulses of all sources on the body of a car so far. */
static void fill_sums(const CzBudget *budget, int car, double lift[CZ_N_BUDGET],
                      double moment[CZ_N_BUDGET]) {
    const CzBudgetRows *own = budget->block[car / CZ_LANE_BLOCK].budget;
    const int i = car % CZ_LANE_BLOCK;
    for (int end = 0; end < 2; ++end) {
        lift[CZ_BUDGET_END_REAR + end] = own->end_lift[end][i];
        moment[CZ_BUDGET_END_REAR + end] = own->end_moment[end][i];
        lift[CZ_BUDGET_GUIDE_REAR + end] = own->guide_lift[end][i];
        moment[CZ_BUDGET_GUIDE_REAR + end] = own->guide_moment[end][i];
        lift[CZ_BUDGET_FACE_REAR + end] = budget->face[car][end].lift;
        moment[CZ_BUDGET_FACE_REAR + end] = budget->face[car][end].moment;
    }
    moment[CZ_BUDGET_LINKS] = own->link_moment[i];
    lift[CZ_BUDGET_SUSPENSION] = own->suspension_lift[i];
    moment[CZ_BUDGET_SUSPENSION] = own->suspension_moment[i];
    lift[CZ_BUDGET_STOPS] = own->stop_lift[i];
    moment[CZ_BUDGET_STOPS] = own->stop_moment[i];
    for (int side = 0; side < 2; ++side) {
        const int interface = side == 0 ? car : car - 1, end = 1 - side;
        if (interface < 0 || interface >= budget->n_car - 1)
            continue;
        const CzBudgetRows *rows = budget->block[interface / CZ_LANE_BLOCK].budget;
        const int k = interface % CZ_LANE_BLOCK;
        lift[CZ_BUDGET_COUPLER_REAR + end] = rows->coupler_lift[side][k];
        moment[CZ_BUDGET_COUPLER_REAR + end] = rows->coupler_moment[side][k];
        lift[CZ_BUDGET_HINGE_REAR + end] = rows->hinge_lift[side][k];
        moment[CZ_BUDGET_HINGE_REAR + end] = rows->hinge_moment[side][k];
    }
}

static double lift_of_wheels(const CzBatch *batch, size_t lane) {
    const CzBlock *block = cz_block_of(batch->dynamics, lane);
    double largest = 0.0;
    for (int axle = 0; axle < 4; ++axle) {
        const double lift = -block->published.wheel[axle].approach[lane % CZ_LANE_BLOCK];
        largest = lift > largest ? lift : largest;
    }
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
    fill_sums(budget, car, budget->kept[car].lift, budget->kept[car].moment);
    budget->kept[car].of_lift = lifts;
    budget->kept[car].time = batch->time;
    budget->kept[car].spin = momentum(batch, CZ_DOF(body.pitch), lane);
    budget->kept[car].rise = momentum(batch, CZ_DOF(body.z), lane);
}

void cz_budget_add(CzBudget *budget, const CzBatch *batch) {
    if (!isnan(batch->design[0].override_time))
        return; /* later motion is beyond the model */
    add_pushing_faces(budget, batch);
    for (int car = 0; car < budget->n_car; ++car)
        if (cz_car(batch, car, 0)->model == CZ_MODEL_FULL)
            keep(budget, batch, car);
}

const CzVehicleBudget *cz_budget_result(const CzBudget *budget) {
    return budget->kept;
}
