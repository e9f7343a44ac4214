/* Stand-ins for the input of a report: only the values matter here, not their origin. */
#include "report/stand_in.h"

#include "evaluate/deciding_run.h"
#include "evaluate/evaluator.h"
#include "evaluate/metric.h"
#include "text/node.h"
#include "problem/problem.h"
#include "report/page.h"

#include <math.h>
#include <string.h>

struct CzProblem {
    int nothing;
};
struct CzEvaluator {
    int nothing;
};
static const CzProblem the_problem;
static const CzEvaluator the_evaluator;
const CzProblem *stand_in_problem = &the_problem;
const CzEvaluator *stand_in_evaluator = &the_evaluator;
const char *stand_in_file = "two \"trains\".yaml";

static CzVariablePlace places[STAND_IN_VARIABLES] = {
    {"trains.A.vehicles.A1.front.coupler.tube.stages[0].force_kN", 1, NAN},
    {"trains.A.vehicles.A1.front.coupler.tube.stages[0].stroke_m", 1e-3, NAN}};
static const CzVariableInfo variables[STAND_IN_VARIABLES] = {{.name = "tube force",
                                                              .unit = "kN",
                                                              .min = 500,
                                                              .max = 900,
                                                              .start = 700,
                                                              .increment = 50,
                                                              .n_place = 1,
                                                              .place = &places[0]},
                                                             {.name = "tube stroke",
                                                              .unit = "mm",
                                                              .min = 100,
                                                              .max = 300,
                                                              .start = 250,
                                                              .n_place = 1,
                                                              .place = &places[1]}};

const char *cz_problem_title(const CzProblem *problem) {
    (void)problem;
    return "Zwei Züge, 36 km/h";
}
const CzProblem *cz_problem_in_scenario(const CzProblem *problem, int scenario) {
    (void)scenario;
    return problem;
}
const char *cz_problem_share_folder(const CzProblem *problem) {
    (void)problem;
    return NULL;
}

const char *cz_problem_file(const CzProblem *problem) {
    (void)problem;
    return stand_in_file;
}
const char *cz_problem_hash(const CzProblem *problem) {
    (void)problem;
    return "0123456789abcdef";
}
/* Read from a file and a profile. */
const CzSource *cz_problem_first_source(const CzProblem *problem) {
    static const char *const lines[] = {"name: limits", "limits: []"};
    static const CzSource profile = {
        .name = "lib/profiles/limits.yaml", .n_line = 2, .line = lines};
    static const CzSource file = {.name = "two.yaml", .next = (CzSource *)&profile};
    (void)problem;
    return &file;
}
int cz_problem_n_scenario(const CzProblem *problem) {
    (void)problem;
    return 1;
}
const char *cz_problem_scenario_name(const CzProblem *problem, int scenario) {
    (void)problem;
    (void)scenario;
    return "25kmh";
}
int cz_problem_n_warning(const CzProblem *problem) {
    (void)problem;
    return 1;
}
const CzError *cz_problem_warning(const CzProblem *problem, int index) {
    static const CzError warning = {
        .file = "two.yaml", .line = 3, .column = 7, .message = "mind the gap"};
    (void)problem;
    (void)index;
    return &warning;
}
/* The problem remembers with how many settings it was read last, and shows it when resolved. */
static int n_setting_read;
CzProblemOptions cz_problem_options_default(void) {
    return (CzProblemOptions){0};
}
CzStatus cz_problem_read(const char *path, const CzProblemOptions *options, CzProblem **problem,
                         CzError *error) {
    (void)path;
    (void)problem;
    (void)error;
    n_setting_read = options->n_set;
    return CZ_OK;
}
CzStatus cz_problem_read_text(const char *text, size_t n_byte, const char *name, const char *folder,
                              const CzProblemOptions *options, CzProblem **problem,
                              CzError *error) {
    (void)n_byte;
    (void)folder;
    if (strcmp(text, "broken") != 0)
        return cz_problem_read(name, options, problem, error);
    snprintf(error->message, sizeof error->message, "it is broken");
    return CZ_STATUS_INPUT;
}
void cz_problem_free(CzProblem *problem) {
    (void)problem;
}
const CzSource *cz_problem_measured_file(const CzProblem *problem, int number, size_t room,
                                         char *name) {
    (void)problem, (void)number, (void)room, (void)name;
    return NULL;
}
void cz_problem_write_resolved_in_folder(const CzProblem *problem, FILE *stream) {
    cz_problem_write_resolved(problem, stream);
}
void cz_problem_write_resolved(const CzProblem *problem, FILE *stream) {
    (void)problem;
    fprintf(stream, "schema: 1 # %d settings\n", n_setting_read);
}
const CzInput *cz_problem_input(const CzProblem *problem) {
    static CzTrain trains[2] = {{.name = "A", .speed = 10}, {.name = "B", .speed = 0}};
    static CzScenario scenarios[2] = {{.name = "36", .speed = 10, .partner_speed = NAN},
                                      {.name = "18/low", .speed = 5, .partner_speed = 0}};
    static CzInput input = {
        .trains = trains, .n_trains = 2, .scenarios = scenarios, .n_scenarios = 2};
    (void)problem;
    return &input;
}

const CzProfile *cz_problem_profile(const CzProblem *problem) {
    (void)problem;
    return NULL;
}

CzTrack cz_problem_track(const CzProblem *problem) {
    return (CzTrack)cz_problem_input(problem)->simulation.track;
}

/* The content of figures is tested elsewhere; here a report only has to exist. */
int cz_deciding_run(const CzEvaluation *evaluation) {
    return evaluation->n_run > 0 ? 0 : -1;
}
void cz_page_folder_name(const char *scenario, char name[CZ_NAME_SIZE]) {
    snprintf(name, 128, "%s", scenario);
    for (char *c = name; *c != '\0'; c++)
        *c = *c == '/' ? '_' : *c;
}
const char *cz_pareto_state_text(CzParetoState state) {
    return state == CZ_PARETO_VERIFIED ? "verified" : "infeasible";
}

CzStatus cz_report_write_front(const CzPareto *pareto, FILE *stream, CzError *error) {
    (void)pareto;
    (void)error;
    fputs("figure of a front\n", stream);
    return CZ_OK;
}

int cz_evaluator_n_variable(const CzEvaluator *evaluator) {
    (void)evaluator;
    return STAND_IN_VARIABLES;
}
const CzVariableInfo *cz_evaluator_variable(const CzEvaluator *evaluator, int variable) {
    (void)evaluator;
    return &variables[variable];
}
int cz_evaluator_n_constraint(const CzEvaluator *evaluator) {
    (void)evaluator;
    return 0;
}

int cz_n_metric_kind(void) {
    return 0;
}

const CzMetricKind *cz_metric_kind(int index) {
    (void)index;
    return NULL;
}

const char *cz_evaluator_constraint_name(const CzEvaluator *evaluator, int constraint) {
    static const char *const names[STAND_IN_CHECKS] = {"interface force, 36", "deceleration, 36",
                                                       "lift, 36", "override, 36", "ribs, 36"};
    (void)evaluator;
    return names[constraint];
}
const char *cz_evaluator_objective_name(const CzEvaluator *evaluator) {
    (void)evaluator;
    return "interfaces.peak_force_kN";
}
const char *cz_evaluator_objective_unit(const CzEvaluator *evaluator) {
    (void)evaluator;
    return "kN";
}

bool cz_evaluator_is_fit(const CzEvaluator *evaluator) {
    (void)evaluator;
    return false;
}

bool cz_evaluator_maximises_margin(const CzEvaluator *evaluator) {
    (void)evaluator;
    return false;
}

const CzRunSummary *cz_run_summary(const CzRun *run) {
    return &run->summary;
}
int cz_run_n_column(const CzRun *run) {
    (void)run;
    return 2;
}
int cz_run_n_sample(const CzRun *run) {
    return run->n_sample;
}
CzColumn cz_run_column(const CzRun *run, int column) {
    (void)run;
    return (CzColumn){column == 0 ? CZ_CHANNEL_TIME : CZ_CHANNEL_BODY_SPEED, 0};
}
const double *cz_run_channel(const CzRun *run, CzChannel channel, int place) {
    (void)place;
    return channel == CZ_CHANNEL_TIME         ? run->channel[0]
           : channel == CZ_CHANNEL_BODY_SPEED ? run->channel[1]
                                              : NULL;
}
const char *cz_run_place_name(const CzRunSummary *run, CzChannelAt at, int place) {
    return at == CZ_AT_RUN ? "" : run->vehicle[place].name;
}
const char *cz_isa_name(void) {
    return "baseline";
}
void cz_sundials_version(char *text, size_t n) {
    snprintf(text, n, "6.4.1");
}
const char *cz_integrator_text(CzIntegrator integrator) {
    static const char *const texts[] = {
#define CZ_INTEGRATOR(constant, text, doc) text,
#include "crushzone/integrators.def"
#undef CZ_INTEGRATOR
    };
    return texts[integrator];
}
void cz_nlopt_version(char *text, size_t n) {
    snprintf(text, n, "2.7.1");
}

static void fill_run(StandIn *s, int i) {
    s->element = (CzElementResult){.name = "coupler A1",
                                   .energy = 343e3,
                                   .stroke = 0.25,
                                   .stroke_used = 1.01,
                                   .peak_force = 1412e3,
                                   .bottomed_out = true};
    s->interface[0] = (CzInterfaceResult){.name = "A1-B1",
                                          .peak_force = 3483e3,
                                          .peak_time = 0.372,
                                          .shortening = 0.659,
                                          .energy = 689e3,
                                          .energy_share = 0.167,
                                          .bottomed_out = true,
                                          .min_overlap = NAN,
                                          .vertical_margin = NAN,
                                          .n_element = 1};
    s->interface[0].element[0] = s->element;
    s->interface[1] = s->interface[0];
    snprintf(s->interface[1].name, sizeof s->interface[1].name, "B1-B2");
    s->interface[1].peak_force = 803e3;
    s->interface[1].bottomed_out = false;
    s->interface[1].n_element = 0;
    s->vehicle[0] = (CzVehicleResult){.name = "A1",
                                      .final_speed = 5,
                                      .wheel_lift = {0.001, 0.0091, NAN, 0},
                                      .survival_shortening = NAN};
    s->vehicle[1] =
        (CzVehicleResult){.name = "B1", .final_speed = 5, .wheel_lift = {NAN, NAN, NAN, NAN}};
    s->event[0] = (CzEvent){.time = 0, .what = CZ_EVENT_CONTACT, .where = "A1-B1"};
    s->event[1] = (CzEvent){.time = 0.1, .what = CZ_EVENT_SHEAR_OFF, .where = "coupler A1"};
    s->event[2] = (CzEvent){.time = 0.372, .what = CZ_EVENT_BOTTOMED_OUT, .where = "coupler A1"};
    s->event[3] = (CzEvent){
        .time = 0.5, .what = CZ_EVENT_WHEEL_LIFT, .where = "A1 wheelset 2", .interface = -1};
    s->run[i].summary =
        (CzRunSummary){.scenario = i == 0 ? "36" : "18/low",
                       .ended = CZ_ENDED_BY_RULE,
                       .simulated = 0.62,
                       .time_step = 1e-4,
                       .n_step = 6200,
                       .energy = {.initial = 2e6, .dissipated = 1e6, .balance_error = 2e-4},
                       .beyond_validity_time = NAN,
                       .n_interface = 2,
                       .interface = s->interface,
                       .n_vehicle = 2,
                       .vehicle = s->vehicle,
                       .n_event = 4,
                       .event = s->event,
                       .setup_s = 0.125,
                       .wall_s = 0.25};
    s->run[i].n_sample = 3;
    for (int sample = 0; sample < 3; sample++) {
        s->run[i].channel[0][sample] = sample;
        s->run[i].channel[1][sample] = sample == 2 ? NAN : 10 - sample / 3.0;
    }
    s->runs[i] = &s->run[i];
}

static void fill_checks(StandIn *s) {
    s->check[0] = (CzCheckResult){.name = "interface force",
                                  .scenario = "36",
                                  .where = "A1-B1",
                                  .limit = 1500,
                                  .value = 3483,
                                  .unit = "kN",
                                  .margin = -1.322,
                                  .verdict = CZ_VERDICT_FAIL,
                                  .source = "a \"quoted\", text"};
    s->check[1] = (CzCheckResult){.name = "mean deceleration",
                                  .scenario = "36",
                                  .where = "A1",
                                  .limit = 5,
                                  .value = 2.31,
                                  .unit = "g",
                                  .margin = 0.538,
                                  .verdict = CZ_VERDICT_PROVISIONAL,
                                  .confidence = "M2"};
    s->check[2] = (CzCheckResult){.name = "wheel lift",
                                  .scenario = "36",
                                  .where = "A1",
                                  .limit = 21,
                                  .value = NAN,
                                  .unit = "mm",
                                  .margin = NAN,
                                  .verdict = CZ_VERDICT_NOT_CHECKED,
                                  .why = "no stops are declared"};
    s->check[3] = (CzCheckResult){.name = "closing speed",
                                  .scenario = "36",
                                  .limit = 0.1,
                                  .value = 0.1,
                                  .unit = "m/s",
                                  .margin = 0,
                                  .verdict = CZ_VERDICT_PASS};
    s->check[4] = (CzCheckResult){.name = "overlap",
                                  .scenario = "36",
                                  .limit = 30,
                                  .value = NAN,
                                  .unit = "mm",
                                  .margin = NAN,
                                  .is_minimum = true,
                                  .verdict = CZ_VERDICT_PASS,
                                  .why = "the anti-climbers never push"};
    memcpy(s->start_check, s->check, sizeof s->check);
}

void stand_in_fill(StandIn *s) {
    memset(s, 0, sizeof *s);
    for (int i = 0; i < STAND_IN_RUNS; i++)
        fill_run(s, i);
    fill_checks(s);
    s->constraint[0] = 1.322;
    s->evaluation = (CzEvaluation){.status = CZ_OK,
                                   .objective = 3483,
                                   .n_constraint = STAND_IN_CHECKS,
                                   .constraint = s->constraint,
                                   .constraint_check = s->check,
                                   .violation = 1.322,
                                   .n_check = STAND_IN_CHECKS,
                                   .check = s->check,
                                   .verdict = CZ_VERDICT_FAIL,
                                   .n_run = 1,
                                   .run = s->runs};
    s->start[0] = 700;
    s->start[1] = 250;
    s->best[0] = 900;
    s->best[1] = 123.4567890123456789;
    s->at_bound[0] = true;
    s->trial[0] = (CzTrial){.objective = NAN, .violation = INFINITY, .phase = "screen"};
    s->trial[1] = (CzTrial){.objective = 1.5, .feasible = true, .phase = "polish"};
    s->trial_x[0] = 700;
    s->trial_x[1] = 250;
    s->trial_x[2] = 900;
    s->trial_x[3] = 123.5;
    s->outcome = (CzOutcome){.status = CZ_OUTCOME_FEASIBLE,
                             .why_stopped = "the evaluations are used up",
                             .n_evaluation = 214,
                             .n_variable = STAND_IN_VARIABLES,
                             .start = s->start,
                             .best = s->best,
                             .at_bound = s->at_bound,
                             .start_evaluation = s->evaluation,
                             .best_evaluation = s->evaluation,
                             .n_trial = 2,
                             .trial = s->trial,
                             .trial_x = s->trial_x,
                             .wall_s = 3};
    s->outcome.start_evaluation.check = s->outcome.start_evaluation.constraint_check =
        s->start_check;
}

const char *cz_verify_method_key(CzVerifyMethod method) {
    static const char *const keys[] = {
#define CZ_VERIFY_METHOD(constant, key, text, doc) key,
#include "crushzone/verify_methods.def"
#undef CZ_VERIFY_METHOD
    };
    return keys[method];
}
const char *cz_verify_method_text(CzVerifyMethod method) {
    return cz_verify_method_key(method);
}

const char *cz_timed_key(CzTimed timed) {
    static const char *const keys[] = {
#define CZ_TIMED(constant, key, text, doc) key,
#include "crushzone/timed.def"
#undef CZ_TIMED
    };
    return keys[timed];
}
const char *cz_timed_text(CzTimed timed) {
    return cz_timed_key(timed);
}

const char *cz_ended_key(CzEnded ended) {
    static const char *const keys[] = {
#define CZ_ENDED(constant, key, text) key,
#include "crushzone/ended.def"
#undef CZ_ENDED
    };
    return keys[ended];
}

const char *cz_ended_text(CzEnded ended) {
    static const char *const texts[] = {
#define CZ_ENDED(constant, key, text) text,
#include "crushzone/ended.def"
#undef CZ_ENDED
    };
    return texts[ended];
}
const char *cz_event_text(CzEventKind kind) {
    static const char *const texts[] = {
#define CZ_EVENT(constant, text, doc) text,
#include "crushzone/events.def"
#undef CZ_EVENT
    };
    return texts[kind];
}
const char *cz_element_text(CzElementKind kind) {
    static const char *const texts[] = {
#define CZ_ELEMENT(constant, text) text,
#include "crushzone/elements.def"
#undef CZ_ELEMENT
    };
    return texts[kind];
}
const char *cz_outcome_text(CzOutcomeStatus status) {
    static const char *const texts[] = {"feasible", "infeasible", "interrupted"};
    return texts[status];
}

CzReport stand_in_run(const StandIn *stand_in) {
    return (CzReport){
        .kind = CZ_REPORT_RUN, .problem = stand_in_problem, .evaluation = &stand_in->evaluation};
}

CzReport stand_in_search(const StandIn *stand_in) {
    return (CzReport){.kind = CZ_REPORT_SEARCH,
                      .problem = stand_in_problem,
                      .evaluator = stand_in_evaluator,
                      .outcome = &stand_in->outcome};
}
