/* A stand-in for model and simulator with a closed form. */
#include "support/check.h"

#include "evaluate/stand_in.h"
#include "model/build.h"
#include "problem/problem.h"
#include "simulate/batch.h"

StandIn stand_in;

void stand_in_reset(void) {
    stand_in = (StandIn){.failing_above = INFINITY, .incomplete_above = INFINITY, .batch_width = 4};
}

struct CzModel {
    const CzProblem *problem;
    int scenario;
};

struct CzRun {
    CzRunSummary summary;
    CzInterfaceResult interface;
    CzVehicleResult vehicle[2];
};

const char *cz_element_text(CzElementKind kind) {
    static const char *const texts[] = {
#define CZ_ELEMENT(constant, text) text,
#include "crushzone/elements.def"
#undef CZ_ELEMENT
    };
    return texts[kind];
}

CzStatus cz_model_build(const CzProblem *problem, int scenario, CzModel **model, CzError *error) {
    (void)error;
    *model = calloc(1, sizeof **model);
    **model = (CzModel){.problem = problem, .scenario = scenario};
    return CZ_OK;
}

CzStatus cz_model_build_beside(const CzProblem *problem, int scenario, int n, CzModel *const *made,
                               CzModel **model, CzError *error) {
    (void)n;
    (void)made;
    return cz_model_build(problem, scenario, model, error);
}

void cz_model_free(CzModel *model) {
    free(model);
}

double cz_model_time_step(const CzModel *model) {
    (void)model;
    return 1e-4;
}

CzSimulateOptions cz_simulate_options_default(void) {
    return (CzSimulateOptions){.isa = "auto"};
}

int cz_simulate_batch_width(const CzModel *model) {
    (void)model;
    return stand_in.batch_width;
}

void cz_run_free(CzRun *run) {
    free(run);
}

const CzRunSummary *cz_run_summary(const CzRun *run) {
    return &run->summary;
}

/* No channels. */
int cz_run_n_column(const CzRun *run) {
    (void)run;
    return 0;
}

int cz_run_n_sample(const CzRun *run) {
    (void)run;
    return 0;
}

const double *cz_run_channel(const CzRun *run, CzChannel channel, int place) {
    (void)run;
    (void)channel;
    (void)place;
    return NULL;
}

/* Takes energy from `rest` along a plateau and fills in the element. */
static void absorb(CzElementResult *element, double force, double stroke, double *rest) {
    element->energy = fmin(*rest, force * stroke);
    element->tube_energy = element->energy;
    element->stroke = force > 0 ? element->energy / force : 0;
    element->stroke_used = stroke > 0 ? *rest / (force * stroke) : 0;
    element->bottomed_out = *rest > force * stroke * (1 + 1e-12);
    element->peak_force = *rest > 0 ? force : 0;
    element->zone_energy[CZ_ZONE_CRUSH] = element->energy;
    *rest -= element->energy;
}

static CzElementResult *add_element(CzInterfaceResult *interface, CzElementKind kind, int vehicle,
                                    const char *name) {
    CzElementResult *element = &interface->element[interface->n_element++];
    element->kind = kind;
    element->vehicle = vehicle;
    snprintf(element->name, sizeof element->name, "%s %s", cz_element_text(kind), name);
    return element;
}

static void crush_side(CzInterfaceResult *interface, const CzVehicle *vehicle, int index,
                       double rest) {
    const CzEnd *end = index == 0 ? &vehicle->front : &vehicle->rear;
    const CzTube *tube = &end->coupler.tube;
    const CzAntiClimber *climber = &end->anti_climber;
    const double shear = end->coupler.shear_off.force;
    CzElementResult *coupler = add_element(interface, CZ_ELEMENT_COUPLER, index, vehicle->name);
    if (tube->stages[0].force < shear)
        absorb(coupler, tube->stages[0].force, tube->stages[0].stroke, &rest);
    coupler->sheared = rest > 0;
    if (coupler->sheared) {
        coupler->peak_force = shear;
        coupler->bottomed_out = false; /* the shear-off ends the collapse of a tube */
        coupler->stroke_used = 0;
    }
    CzElementResult *face = add_element(interface, CZ_ELEMENT_ANTI_CLIMBER, index, vehicle->name);
    absorb(face, climber->count * climber->stages[0].force, climber->stages[0].stroke, &rest);
    CzElementResult *structure = add_element(interface, CZ_ELEMENT_END, index, vehicle->name);
    absorb(structure, end->stages[0].force, end->stages[0].stroke, &rest);
    structure->zone_energy[CZ_ZONE_CRUSH] = 0;
    structure->zone_energy[end->stages[0].zone] = structure->energy;
    const double peak = fmax(coupler->peak_force, fmax(face->peak_force, structure->peak_force));
    interface->section_force[index] = peak;
    interface->peak_force = fmax(interface->peak_force, peak);
    interface->shortening += coupler->stroke + face->stroke + structure->stroke;
}

static double or_else(double value, double fallback) {
    return isnan(value) ? fallback : value;
}

static CzRun *simulate(const CzModel *model, const CzVehicle *vehicles,
                       const CzSimulateOptions *options) {
    const bool is_halved = options->time_step > 0 && options->time_step < 0.9e-4;
    const CzInput *input = cz_problem_input(model->problem);
    const CzScenario *scenario = &input->scenarios[model->scenario];
    CzRun *run = calloc(1, sizeof *run);
    const double speed = or_else(scenario->speed, input->trains[0].speed);
    const double mass = vehicles[0].mass * scenario->mass_factor;
    const double energy = mass * speed * speed / 4;
    const double tube_force = vehicles[0].front.coupler.tube.stages[0].force;
    double scatter = 1;
    if (stand_in.scatter)
        scatter += 2e-3 * sin(tube_force * 1e-2);
    if (is_halved)
        scatter += stand_in.step_energy;
    if (is_halved && vehicles[0].front.anti_climber.stages[0].force < stand_in.unsteady_below)
        scatter += 0.05;

    CzInterfaceResult *interface = &run->interface;
    snprintf(interface->name, sizeof interface->name, "A1-B1");
    interface->min_overlap = interface->vertical_margin = NAN;
    for (int i = 0; i < 2; i++) {
        crush_side(interface, &vehicles[i], i, energy / 2 * scatter);
        CzVehicleResult *vehicle = &run->vehicle[i];
        snprintf(vehicle->name, sizeof vehicle->name, "%s", vehicles[i].name);
        vehicle->mean_deceleration_contact = interface->peak_force / mass;
        vehicle->mean_deceleration_120ms = 1.1 * interface->peak_force / mass;
        vehicle->survival_shortening = NAN;
    }
    double survival = 0;
    for (int i = 0; i < interface->n_element; i++) {
        interface->energy += interface->element[i].energy;
        interface->bottomed_out |= interface->element[i].bottomed_out;
        survival += interface->element[i].zone_energy[CZ_ZONE_SURVIVAL];
    }
    run->summary = (CzRunSummary){.scenario = scenario->name,
                                  .ended = CZ_ENDED_BY_RULE,
                                  .closing_speed = 0.05, /* residual */
                                  .n_interface = 1,
                                  .interface = interface,
                                  .n_vehicle = 2,
                                  .vehicle = run->vehicle,
                                  .plastic_energy = energy};
    run->summary.energy =
        (CzEnergy){.initial = 2 * energy, .dissipated = energy, .absorbers = interface->energy};
    run->summary.energy.survival = survival;
    run->summary.law_error = 2e-3;
    if (!options->brief && vehicles[0].front.anti_climber.stages[0].force < stand_in.late_below) {
        run->summary.ended = CZ_ENDED_DURATION;
        run->summary.closing_speed = 1;
    }
    if (tube_force > stand_in.failing_above) {
        run->summary.status = CZ_STATUS_RUN_FAILED;
        snprintf(run->summary.failure, sizeof run->summary.failure, "A1 coupler at 0.1 s");
    }
    if (tube_force > stand_in.incomplete_above)
        run->summary.ended = CZ_ENDED_INCOMPLETE;
    return run;
}

int cz_simulate_n_block(const CzModel *model, int n) {
    (void)model;
    return n;
}

bool cz_simulate_fits(const CzModel *a, const CzModel *b, const CzSimulateOptions *options) {
    (void)a;
    (void)b;
    (void)options;
    return true;
}

CzStatus cz_simulate_batch(int n, const CzPlannedRun *planned, const CzSimulateOptions *options,
                           CzRun **run, CzError *error) {
    (void)error;
    for (int i = 0; i < n; i++)
        run[i] = simulate(planned[i].model, planned[i].vehicles, options);
    __atomic_fetch_add(&stand_in.n_run, n, __ATOMIC_RELAXED);
    return CZ_OK;
}
