/* What the energies of a run must hold, looked at while it runs.
 *
 *   sums      the elements, the running gear, wheels and brakes and the track make up the ledger
 *   passive   no element has dissipated less than nothing, all together no more than there was
 *   agreed    what the bodies gave to the chains of an interface, or to a crush zone, is what these
 *             received: the integral of the force over the closure
 */
#include "simulate/run.h"

#include <math.h>
#include <stdio.h>

#define SUM_SHARE 1e-9 /* of the initial energy: rounding of some hundred thousand sums */
/* Of the initial energy, what an element may seem to give by the quadrature of the steps, and by
 * what it may differ from what the bodies gave: the levels at which the balance warns and fails
 * (ours).
 */
#define PASSIVE_SHARE 1e-3
#define AGREED_SHARE 1e-2

/* What is wrong. */
typedef struct Fault {
    char where[64], what[96];
} Fault;

/* What the hinges of faces that met at an angle gave: work of the push that the model does not
 * count.
 */
static double given_by_hinges(const CzBatch *batch, size_t lane) {
    const double work =
        cz_work(batch, CZ_LEDGER(hinge[0]), lane) + cz_work(batch, CZ_LEDGER(hinge[1]), lane);
    const bool coupled = cz_parameter(batch, CZ_PARAMETER(coupler.coupled), lane) > 0.5;
    return coupled ? 0.0 : fmax(-work, 0.0);
}

static bool gives(const CzBatch *batch, const CzElementResult *element, double allowed,
                  Fault *fault) {
    if (element->energy >= -allowed) /* not a number gives, too */
        return false;
    snprintf(fault->where, sizeof fault->where, "%s %s", batch->model->car[element->vehicle].name,
             cz_element_text(element->kind));
    snprintf(fault->what, sizeof fault->what, "gave back %.4g kJ more than it took",
             -1e-3 * element->energy);
    return true;
}

/* Adds up the elements of all interfaces and outer ends; whether one gives energy. */
static bool some_element_gives(const CzBatch *batch, int design, double allowed, double *sum,
                               Fault *fault) {
    CzElementResult element[CZ_MAX_ELEMENTS];
    bool found = false;
    for (int i = 0; i + 1 < batch->model->n_car; ++i) {
        const int n = cz_interface_elements(batch, i, design, element);
        const double of_hinges = given_by_hinges(batch, cz_lane(batch, i, design));
        for (int k = 0; k < n; ++k) {
            *sum += element[k].energy;
            found = found || gives(batch, &element[k], allowed + of_hinges, fault);
        }
    }
    for (int side = 0; side < 2; ++side)
        if (cz_outer_end_fill(batch, design, side, element)) {
            *sum += element[0].energy;
            found = found || gives(batch, element, allowed, fault);
        }
    return found;
}

/* Springs of the running gear against their potentials. */
static bool running_gear_gives(const CzBatch *batch, int design, double allowed, Fault *fault) {
    static const struct {
        const char *what;
        int row;
        double (*stored)(const CzDynamics *dynamics, size_t lane);
    } springs[] = {{"secondary suspension", CZ_LEDGER(secondary), cz_secondary_stored},
                   {"primary suspension", CZ_LEDGER(primary), cz_primary_stored},
                   {"traction links", CZ_LEDGER(link), cz_link_stored},
                   {"axle guidance", CZ_LEDGER(axle_guidance), cz_axle_guidance_stored}};
    for (int car = 0; car < batch->model->n_car; ++car) {
        if (batch->model->car[car].model != CZ_MODEL_FULL)
            continue;
        const size_t lane = cz_lane(batch, car, design);
        for (size_t k = 0; k < sizeof springs / sizeof springs[0]; ++k) {
            const double given =
                springs[k].stored(batch->dynamics, lane) - cz_work(batch, springs[k].row, lane);
            if (given <= allowed)
                continue;
            snprintf(fault->where, sizeof fault->where, "%s %s", batch->model->car[car].name,
                     springs[k].what);
            snprintf(fault->what, sizeof fault->what, "gave back %.4g kJ more than it took",
                     1e-3 * given);
            return true;
        }
    }
    return false;
}

/* What the bodies gave to an element against what it received. */
static bool differs(const char *name, const char *kind, double given, double received,
                    double allowed, Fault *fault) {
    if (fabs(given - received) <= allowed)
        return false;
    snprintf(fault->where, sizeof fault->where, "%s %s", name, kind);
    snprintf(fault->what, sizeof fault->what, "took %.4g kJ where its force did %.4g kJ of work",
             1e-3 * received, 1e-3 * given);
    return true;
}

static bool bodies_differ(const CzBatch *batch, int design, double allowed, Fault *fault) {
    const CzModel *model = batch->model;
    for (int car = 0; car < model->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        const double given = cz_work(batch, CZ_LEDGER(coupler), lane) +
                             cz_work(batch, CZ_LEDGER(face), lane) +
                             cz_work(batch, CZ_LEDGER(side_buffers), lane);
        if (car + 1 < model->n_car &&
            differs(model->interface_name[car], "chains", given,
                    cz_chains_account(batch, lane).received, allowed, fault))
            return true;
        for (int end = 0; end < 2; ++end)
            if (differs(model->car[car].name, end == 0 ? "rear end" : "front end",
                        cz_work(batch, CZ_LEDGER(end[end]), lane),
                        cz_crush_account(batch, lane, end).received, allowed, fault))
                return true;
    }
    return false;
}

bool cz_books_are_wrong(const CzBatch *batch, int design, char *where, char *what) {
    const CzEnergy energy = cz_energy_fill(batch, design);
    const double allowed = PASSIVE_SHARE * energy.initial;
    Fault fault = {"", ""};
    double sum = 0.0;
    bool wrong = some_element_gives(batch, design, allowed, &sum, &fault) ||
                 running_gear_gives(batch, design, allowed, &fault) ||
                 bodies_differ(batch, design, AGREED_SHARE * energy.initial, &fault);
    if (!wrong && !(fabs(sum - energy.absorbers) <= SUM_SHARE * energy.initial)) {
        wrong = true;
        snprintf(fault.where, sizeof fault.where, "sum of elements");
        snprintf(fault.what, sizeof fault.what,
                 "misses the ledger by %.4g J, which is a fault of this program",
                 sum - energy.absorbers);
    }
    if (!wrong && !(energy.dissipated <= energy.initial - energy.moving_load + allowed)) {
        wrong = true;
        snprintf(fault.where, sizeof fault.where, "all elements");
        snprintf(fault.what, sizeof fault.what, "dissipated %.4g kJ of the %.4g kJ that there were",
                 1e-3 * energy.dissipated, 1e-3 * energy.initial);
    }
    snprintf(where, CZ_FAULT_ROOM, "%s", fault.where);
    snprintf(what, CZ_FAULT_ROOM, "%s", fault.what);
    return wrong;
}
