/* The summary of a design: energy, interfaces, vehicles, how it ended. */
#include "simulate/run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "model/own_design.h"
#include "simulate/filter.h"
#include "simulate/reference.h"

#define FORCE_CLASS 180.0 /* channel frequency class of interface forces (SAE J211) [Hz] */

/* Sum of the rows of a ledger class or list over all cars. */
static double work_of(const CzBatch *batch, int design, int row) {
    double work = 0.0;
    for (int car = 0; car < batch->n_car; ++car)
        work += cz_work(batch, row, cz_lane(batch, car, design));
    return work;
}

/* Elastic energy in elements that store and dissipate. */
static double stored_in_mixed(const CzBatch *batch, int design) {
    double stored = 0.0;
    for (int car = 0; car < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        stored += cz_chains_account(batch, lane).stored + cz_springs_account(batch, lane).stored +
                  cz_gear_account(batch, lane).stored;
        for (int end = 0; end < 2; ++end)
            stored += cz_crush_account(batch, lane, end).stored +
                      cz_guide_account(batch, lane, end).stored;
    }
    return stored;
}

double cz_dissipated_above_track(const CzBatch *batch, int design) {
    return batch->design[design].work - stored_in_mixed(batch, design) -
           work_of(batch, design, CZ_LEDGER(moving_load)) -
           work_of(batch, design, CZ_LEDGER(track));
}

CzEnergy cz_energy_fill(const CzBatch *batch, int design) {
    static const int running_gear[] = {CZ_LEDGER(secondary_damping), CZ_LEDGER(primary_damping),
                                       CZ_LEDGER(link_damping), CZ_LEDGER(axle_guidance_damping)};
    const CzProgressOfDesign *progress = &batch->design[design];
    CzEnergy energy = {0};
    double in_track = 0.0;
    energy.initial = progress->initial_energy;
    energy.final_kinetic = progress->kinetic;
    for (int car = 0; car < batch->n_car; ++car)
        in_track += cz_track_account(batch, cz_lane(batch, car, design));
    energy.stored += stored_in_mixed(batch, design) + in_track;
    energy.moving_load = work_of(batch, design, CZ_LEDGER(moving_load));
    energy.dissipated = progress->work - energy.stored - energy.moving_load;
    energy.wheel_rail = cz_wheel_rail_work(batch, design);
    for (size_t k = 0; k < sizeof running_gear / sizeof running_gear[0]; ++k)
        energy.running_gear += work_of(batch, design, running_gear[k]);
    energy.track = work_of(batch, design, CZ_LEDGER(track)) - in_track;
    energy.absorbers = energy.dissipated - energy.wheel_rail - energy.running_gear - energy.track;
    energy.balance_error = energy.initial > 0.0 ? progress->balance / energy.initial : 0.0;
    return energy;
}

/* Energy that a perfectly plastic collision of the two trains dissipates: mu dv^2 / 2. */
static double plastic_energy(const CzBatch *batch, int design) {
    double mass[2] = {0.0, 0.0}, speed[2] = {0.0, 0.0};
    bool fixed[2] = {false, false};
    for (int car = 0; car < batch->n_car; ++car) {
        const int train = cz_car(batch, car, design)->train;
        const size_t lane = cz_lane(batch, car, design);
        for (int dof = 0; dof < CZ_N_DOF; ++dof) {
            const double m = *cz_lane_mass(batch->lanes, dof, lane);
            mass[train] += cz_axis_of(dof) == CZ_AXIS_ALONG ? m : 0.0;
        }
        speed[train] = *cz_lane_velocity(batch->lanes, CZ_DOF(body.x), lane);
        fixed[train] |= cz_car(batch, car, design)->model == CZ_MODEL_FIXED;
    }
    const double dv = speed[0] - speed[1];
    const double reduced = fixed[0]   ? mass[1]
                           : fixed[1] ? mass[0]
                                      : mass[0] * mass[1] / (mass[0] + mass[1]);
    return 0.5 * reduced * dv * dv;
}

/* Ratio of an energy to the dissipated energy; NaN where that is nearly 0. */
static double share_of(double part, double dissipated) {
    const double nothing = 100; /* [J] */
    return dissipated > nothing ? part / dissipated : NAN;
}

/* Series chains: largest deviation of a member from its law, and number of searches.
 */
static void fill_chains(const CzBatch *batch, int design, CzRunSummary *summary) {
    double searched = 0.0;
    for (int car = 0; car + 1 < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        summary->law_error = fmax(summary->law_error, cz_law_error(batch, lane));
        searched += cz_extreme(batch, CZ_EXTREME(searched), lane);
    }
    summary->n_searched = lround(searched);
}

/* Results that a failed run does not have. */
static void blank_element(CzElementResult *element) {
    element->energy = element->stored = element->stroke = element->stroke_used = NAN;
    element->peak_force = element->tube_energy = element->early_energy = NAN;
    element->zone_energy[0] = element->zone_energy[1] = element->zone_energy[2] = NAN;
}

static void blank_interface(CzInterfaceResult *result) {
    result->peak_force = result->peak_time = result->shortening = result->energy =
        result->energy_share = NAN;
    result->peak_force_cfc180 = NAN;
    result->section_force[0] = result->section_force[1] = NAN;
    result->min_overlap = result->vertical_demand = result->vertical_margin = NAN;
    result->overlap_time = result->margin_time = result->ramp = result->underframe_rise = NAN;
    result->swing[0] = result->swing[1] = NAN;
    for (int k = 0; k < result->n_element; ++k)
        blank_element(&result->element[k]);
}

static void blank_vehicle(CzVehicleResult *result) {
    result->final_speed = result->peak_deceleration = NAN;
    result->mean_deceleration_contact = result->mean_deceleration_120ms = NAN;
    result->peak_deceleration_cfc60 = NAN;
    for (int i = 0; i < CZ_N_FREE_FLIGHT; ++i)
        result->secondary_impact[i] = NAN;
    for (int axle = 0; axle < 4; ++axle)
        result->wheel_lift[axle] = result->wheel_lift_time[axle] = NAN;
    result->bogie_lift = result->bogie_lift_time = result->max_pitch = result->link_force =
        result->survival_shortening = NAN;
    result->link_travel = result->bogie_acceleration = NAN;
    result->survival_loss[0] = result->survival_loss[1] = NAN;
}

static CzStatus fill_critical_forces(const CzBatch *batch, int design, CzRun *run,
                                     CzInterfaceResult *interface) {
    const int n_interface = batch->n_car - 1;
    double *force = cz_arena_allocate(&run->arena, (size_t)n_interface, sizeof *force);
    if (force == NULL)
        return CZ_STATUS_NO_MEMORY;
    CZ_TRY(cz_critical_forces(batch->design[design].model, batch->lanes, design, force, NULL));
    for (int i = 0; i < n_interface; ++i)
        interface[i].critical_force = force[i];
    return CZ_OK;
}

/* What an incomplete run still waits for, and the interface that closes fastest. */
static CzStatus fill_awaited(const CzBatch *batch, int design, CzRun *run) {
    enum { TEXT_SIZE = 160 };
    const CzProgressOfDesign *progress = &batch->design[design];
    const char *awaited = progress->awaited != NULL
                              ? progress->awaited
                              : "the end criterion must be met for one body pitch period";
    int fastest = 0;
    run->summary.awaited = awaited;
    for (int i = 1; i + 1 < batch->n_car; ++i)
        if (cz_closing_speed(batch, i, design) > cz_closing_speed(batch, fastest, design))
            fastest = i;
    const double speed = cz_closing_speed(batch, fastest, design);
    if (progress->ended != CZ_ENDED_INCOMPLETE || !(speed > CZ_CLOSING_SPEED))
        return CZ_OK;
    char *text = cz_arena_allocate(&run->arena, 1, TEXT_SIZE);
    if (text == NULL)
        return CZ_STATUS_NO_MEMORY;
    snprintf(text, TEXT_SIZE, "%s; %s closes at %.2g m/s", awaited,
             progress->model->interface_name[fastest], speed);
    run->summary.awaited = text;
    return CZ_OK;
}

/* Fills the filtered peak of an interface of a run that keeps pulses. */
static CzStatus fill_filtered_peak(const CzBatch *batch, int index, int design,
                                   CzInterfaceResult *interface) {
    const int n = batch->design[design].history.n_step;
    interface->peak_force_cfc180 = NAN;
    if (!batch->keeps_pulses || n < 2 || !cz_filter_fits(FORCE_CLASS, batch->step))
        return CZ_OK;
    double *force = malloc((size_t)n * sizeof *force);
    if (force == NULL)
        return CZ_STATUS_NO_MEMORY;
    cz_history_forces(batch, index, design, force);
    const CzStatus status = cz_filter_cfc(FORCE_CLASS, batch->step, n, force, force);
    interface->peak_force_cfc180 = 0.0;
    for (int i = 0; i < n; ++i)
        interface->peak_force_cfc180 = fmax(interface->peak_force_cfc180, fabs(force[i]));
    free(force);
    return status;
}

CzStatus cz_summary_fill(const CzBatch *batch, int design, CzRun *run) {
    const CzModel *model = batch->design[design].model;
    const CzProgressOfDesign *progress = &batch->design[design];
    const int n_interface = model->n_car - 1;
    CzInterfaceResult *interface =
        cz_arena_allocate(&run->arena, (size_t)n_interface, sizeof *interface);
    CzVehicleResult *vehicle =
        cz_arena_allocate(&run->arena, (size_t)model->n_car, sizeof *vehicle);
    if (interface == NULL || vehicle == NULL)
        return CZ_STATUS_NO_MEMORY;
    CzPulse *pulse = NULL;
    if (batch->keeps_pulses) {
        pulse = cz_arena_allocate(&run->arena, (size_t)model->n_car, sizeof *pulse);
        if (pulse == NULL)
            return CZ_STATUS_NO_MEMORY;
    }
    const bool failed = progress->failure[0] != '\0';
    cz_accounts_take(batch, design);
    CzRunSummary *summary = &run->summary;
    summary->scenario = model->scenario->name;
    summary->status = failed ? CZ_STATUS_RUN_FAILED : CZ_OK;
    memcpy(summary->failure, progress->failure, sizeof summary->failure);
    summary->ended = progress->ended;
    CZ_TRY(fill_awaited(batch, design, run));
    summary->simulated = batch->time;
    summary->integrator = batch->integrator;
    summary->time_step = batch->step;
    summary->n_step =
        batch->reference != NULL ? cz_reference_n_step(batch->reference) : batch->n_step;
    summary->energy = cz_energy_fill(batch, design);
    summary->momentum_error = cz_momentum_error(batch, design);
    fill_chains(batch, design, summary);
    summary->rest_residual = NAN; /* only for recorded runs */
    summary->closing_speed = cz_largest_closing_speed(batch, design);
    const double wheel_rail =
        isnan(progress->wheel_rail) ? summary->energy.wheel_rail : progress->wheel_rail;
    summary->plastic_energy = plastic_energy(batch, design) - wheel_rail;
    summary->beyond_validity = !isnan(progress->override_time);
    summary->beyond_validity_time = progress->override_time;
    CZ_TRY(fill_critical_forces(batch, design, run, interface));
    for (int side = 1; side >= 0; --side)
        summary->n_outer_end +=
            cz_outer_end_fill(batch, design, side, &summary->outer_end[summary->n_outer_end]);
    for (int i = 0; i < n_interface; ++i) {
        cz_interface_fill(batch, i, design, &interface[i]);
        CZ_TRY(fill_filtered_peak(batch, i, design, &interface[i]));
        interface[i].energy_share = share_of(interface[i].energy, summary->energy.dissipated);
        for (int k = 0; k < interface[i].n_element; ++k)
            summary->energy.survival += interface[i].element[k].zone_energy[CZ_ZONE_SURVIVAL];
        if (failed)
            blank_interface(&interface[i]);
    }
    for (int i = 0; i < model->n_car; ++i) {
        CZ_TRY(cz_vehicle_fill(batch, i, design, &run->arena, pulse != NULL ? &pulse[i] : NULL,
                               &vehicle[i]));
        if (failed)
            blank_vehicle(&vehicle[i]);
    }
    for (int i = 0; failed && i < summary->n_outer_end; ++i)
        blank_element(&summary->outer_end[i]);
    if (failed) {
        summary->energy = (CzEnergy){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
        summary->momentum_error = summary->closing_speed = summary->plastic_energy = NAN;
        summary->law_error = NAN;
    }
    summary->n_interface = n_interface;
    summary->interface = interface;
    summary->n_vehicle = model->n_car;
    summary->vehicle = vehicle;
    summary->pulse = pulse;
    return CZ_OK;
}
