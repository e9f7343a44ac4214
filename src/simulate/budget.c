/* Budgets: impulses on the bodies by source, up to the time that matters.
 *
 *   J omega = sum of the moment impulses,   m v_z = sum of the vertical impulses
 *
 * both over the sources that act on the body itself, to the order of the step.
 */
#include <math.h>

#include "dynamics/face_moment.h"
#include "simulate/run.h"

#define SMALLEST_LIFT 1e-4 /* of a wheel that counts as lifting [m] (ours) */

struct CzBudgetBook {
    int n_car;
    CzVehicleBudget *running; /* (n_car) */
    CzVehicleBudget *kept;    /* as it was at the largest lift or pitch (n_car) */
    double *lift, *pitch;     /* largest so far [m], [rad] (n_car) */
};

const char *cz_budget_text(CzBudgetSource source) {
    static const char *const text[] = {
#define CZ_BUDGET(constant, text, counts, doc) text,
#include "crushzone/budget.def"
#undef CZ_BUDGET
    };
    return text[source];
}

bool cz_budget_counts(CzBudgetSource source) {
    static const bool counts[] = {
#define CZ_BUDGET(constant, text, counts, doc) counts,
#include "crushzone/budget.def"
#undef CZ_BUDGET
    };
    return counts[source];
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

CzBudgetBook *cz_budget_begin(CzBatch *batch, CzArena *arena) {
    const size_t n = (size_t)batch->model->n_car;
    CzBudgetBook *book = cz_arena_allocate(arena, 1, sizeof *book);
    if (book == NULL)
        return NULL;
    book->n_car = batch->model->n_car;
    book->running = cz_arena_allocate(arena, n, sizeof *book->running);
    book->kept = cz_arena_allocate(arena, n, sizeof *book->kept);
    book->lift = cz_arena_allocate(&batch->arena, n, sizeof *book->lift);
    book->pitch = cz_arena_allocate(&batch->arena, n, sizeof *book->pitch);
    CzBudgetRows *rows =
        cz_arena_allocate(&batch->arena, (size_t)batch->dynamics->n_block, sizeof *rows);
    if (book->running == NULL || book->kept == NULL || book->lift == NULL || book->pitch == NULL ||
        rows == NULL)
        return NULL;
    for (int i = 0; i < batch->dynamics->n_block; ++i)
        batch->dynamics->block[i].budget = &rows[i];
    return book;
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

static double mass_of(const CzBatch *batch, int dof, size_t lane) {
    return *cz_lane_mass(batch->lanes, dof, lane);
}

/* Keeps the budget of a car where its lift, or its pitch before any lift, is the largest so far. */
static void keep(CzBudgetBook *book, const CzBatch *batch, int car) {
    const size_t lane = cz_lane(batch, car, 0);
    const double lift = lift_of_wheels(batch, lane);
    const double pitch = fabs(cz_position(batch, CZ_DOF(body.pitch), lane));
    const bool lifts = lift > SMALLEST_LIFT && lift > book->lift[car];
    const bool pitches = book->lift[car] == 0.0 && pitch > book->pitch[car];
    if (!lifts && !pitches)
        return;
    book->lift[car] = lifts ? lift : 0.0;
    book->pitch[car] = pitch;
    book->kept[car] = book->running[car];
    book->kept[car].of_lift = lifts;
    book->kept[car].time = batch->time;
    book->kept[car].spin =
        mass_of(batch, CZ_DOF(body.pitch), lane) * cz_velocity(batch, CZ_DOF(body.pitch), lane);
    book->kept[car].rise =
        mass_of(batch, CZ_DOF(body.z), lane) * cz_velocity(batch, CZ_DOF(body.z), lane);
}

void cz_budget_add(CzBudgetBook *book, const CzBatch *batch) {
    if (!isnan(batch->design[0].override_time))
        return; /* what comes now is beyond the model */
    for (int car = 0; car < book->n_car; ++car) {
        if (batch->model->car[car].model != CZ_MODEL_FULL)
            continue;
        double lift[CZ_N_BUDGET] = {0.0}, moment[CZ_N_BUDGET] = {0.0};
        look(batch, car, lift, moment);
        for (int source = 0; source < CZ_N_BUDGET; ++source) {
            book->running[car].lift[source] += batch->step * lift[source];
            book->running[car].moment[source] += batch->step * moment[source];
        }
        keep(book, batch, car);
    }
}

const CzVehicleBudget *cz_budget_result(const CzBudgetBook *book) {
    return book->kept;
}
