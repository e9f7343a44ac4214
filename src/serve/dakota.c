/* An evaluation for Dakota.
 *
 *   parameters --descriptors--> design variables and settings --> design and its neighbours, by
 * which derivatives are asked for --> responses --> values and differences
 *
 * Neighbours by design variables are lanes beside the design; a neighbour by another path is a
 * problem that is read with its value.
 */
#include "crushzone/dakota.h"

#include "base/error.h"
#include "base/number.h"
#include "evaluate/evaluator.h"
#include "serve/dakota_study.h"
#include "serve/gradient.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Share of the size of a value that is no design variable: the step of its difference (ours). */
static const double share = CZ_GRADIENT_STEP;

/* A problem with the values of all paths, and its evaluator. */
typedef struct Bench {
    CzProblem *owned; /* NULL: the problem as it was read */
    CzEvaluator *evaluator;
} Bench;

static void bench_free(Bench *bench) {
    cz_evaluator_free(bench->evaluator);
    cz_problem_free(bench->owned);
    *bench = (Bench){0};
}

/* Reads the problem with the values of all paths, that of one of them changed by a step. */
static CzStatus read_paths(const CzDakota *dakota, const CzDakotaTarget *changed, double step,
                           CzProblem **problem, CzError *error) {
    CzProblemOptions with =
        dakota->options.problem != NULL ? *dakota->options.problem : cz_problem_options_default();
    const int n_variable = dakota->parameters.variable.n;
    CzArena arena = {0};
    const char **set =
        cz_arena_allocate(&arena, (size_t)with.n_set + (size_t)n_variable + 1, sizeof *set);
    CzStatus status = set != NULL ? CZ_OK : CZ_STATUS_NO_MEMORY;
    for (int i = 0; status == CZ_OK && i < with.n_set; i++)
        set[i] = with.set[i];
    for (int i = 0; status == CZ_OK && i < n_variable; i++) {
        const CzDakotaTarget *target = &dakota->target[i];
        char number[CZ_NUMBER_TEXT];
        const char *text =
            target == changed ? cz_number_print(number, target->value + step) : target->entry->text;
        const size_t size = strlen(target->meaning) + strlen(text) + 2;
        char *setting = cz_arena_allocate(&arena, size, 1);
        if (target->design != CZ_DAKOTA_PATH)
            continue;
        if (setting == NULL) {
            status = CZ_STATUS_NO_MEMORY;
            break;
        }
        snprintf(setting, size, "%s=%s", target->meaning, text);
        set[with.n_set++] = setting;
    }
    with.set = set;
    if (status == CZ_OK)
        status = cz_problem_read(cz_problem_file(dakota->problem), &with, problem, error);
    else
        cz_no_memory(error, "the settings of a design");
    cz_arena_free(&arena);
    return status;
}

static bool has_paths(const CzDakota *dakota) {
    for (int i = 0; i < dakota->parameters.variable.n; i++)
        if (dakota->target[i].design == CZ_DAKOTA_PATH)
            return true;
    return false;
}

static CzStatus build_evaluator(const CzDakota *dakota, const CzProblem *problem,
                                CzEvaluator **evaluator, CzError *error) {
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.n_job = dakota->options.n_job;
    options.scenario = dakota->options.scenario;
    CZ_TRY(cz_evaluator_build(problem, &options, evaluator, error));
    cz_evaluator_set_stop(*evaluator, dakota->options.stop);
    return CZ_OK;
}

/* Builds the bench of the design, or of a neighbour by a path. */
static CzStatus bench_build(const CzDakota *dakota, const CzDakotaTarget *changed, double step,
                            Bench *bench, CzError *error) {
    *bench = (Bench){0};
    if (has_paths(dakota))
        CZ_TRY(read_paths(dakota, changed, step, &bench->owned, error));
    CZ_TRY(build_evaluator(dakota, bench->owned != NULL ? bench->owned : dakota->problem,
                           &bench->evaluator, error));
    return cz_evaluator_set_values(bench->evaluator, dakota->n_metric, dakota->metric, error);
}

/* Whether Dakota has design variables; else the design is that of the file. */
static bool has_designs(const CzDakota *dakota) {
    for (int i = 0; i < dakota->parameters.variable.n; i++)
        if (dakota->target[i].design != CZ_DAKOTA_PATH)
            return true;
    return false;
}

/* Writes the design variables of a point: those that Dakota does not have start as in a search. */
static void write_design(const CzDakota *dakota, const CzEvaluator *evaluator, double *x) {
    for (int i = 0; i < cz_evaluator_n_variable(evaluator); i++)
        x[i] = cz_evaluator_variable(evaluator, i)->start;
    for (int i = 0; i < dakota->parameters.variable.n; i++)
        if (dakota->target[i].design != CZ_DAKOTA_PATH)
            x[dakota->target[i].design] = dakota->target[i].value;
}

/* Values of the responses that are asked for with this request. Those of a design without one are
 * NaN; the first such one is noted as the failure, unless one is noted. */
static void take_values(CzDakota *dakota, const CzEvaluation *evaluation, int request,
                        double *value) {
    for (int j = 0; j < dakota->parameters.response.n; j++) {
        const CzDakotaEntry *entry = &dakota->parameters.response.entry[j];
        const char *why = evaluation->failure[0] != '\0' ? evaluation->failure
                                                         : "the design breaks a rule of files";
        value[j] = NAN;
        if ((entry->number & request) == 0)
            continue;
        if (evaluation->status == CZ_OK)
            value[j] = cz_response_value(&dakota->response[j], evaluation, &why);
        if (!isfinite(value[j]) && dakota->failure[0] == '\0')
            snprintf(dakota->failure, sizeof dakota->failure, "%.120s has no value: %.300s",
                     entry->label, why);
    }
}

/* Whether any response asks for a request. */
static bool is_asked(const CzDakota *dakota, int request) {
    for (int j = 0; j < dakota->parameters.response.n; j++)
        if ((dakota->parameters.response.entry[j].number & request) != 0)
            return true;
    return false;
}

/* Evaluates the design and its neighbours by design variables, side by side. */
static CzStatus evaluate_design(CzDakota *dakota, CzEvaluator *evaluator, CzError *error) {
    const int n_variable = cz_evaluator_n_variable(evaluator);
    const int n_derivative =
        is_asked(dakota, CZ_DAKOTA_GRADIENT) ? dakota->parameters.derivative.n : 0;
    double *x =
        cz_arena_numbers(&dakota->arena, (size_t)(n_derivative + 1) * (size_t)n_variable + 1);
    CzEvaluation *evaluation = calloc((size_t)n_derivative + 1, sizeof *evaluation);
    int n_point = 1;
    if (x == NULL || evaluation == NULL) {
        free(evaluation);
        return cz_no_memory(error, "the designs");
    }
    write_design(dakota, evaluator, x);
    for (int i = 0; i < n_derivative; i++) {
        const int k = dakota->target[dakota->parameters.derivative.entry[i].number].design;
        if (k == CZ_DAKOTA_PATH)
            continue;
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, k);
        double *neighbour = x + n_point++ * n_variable;
        memcpy(neighbour, x, (size_t)n_variable * sizeof *x);
        neighbour[k] += cz_gradient_step(info, x[k], CZ_GRADIENT_STEP);
        dakota->step[i] = neighbour[k] - x[k];
    }
    const CzStatus status =
        cz_evaluate(evaluator, n_point, has_designs(dakota) ? x : NULL, false, evaluation, error);
    if (status == CZ_OK)
        take_values(dakota, &evaluation[0], CZ_DAKOTA_VALUE | CZ_DAKOTA_GRADIENT, dakota->value);
    for (int i = 0, point = 1; status == CZ_OK && i < n_derivative; i++)
        if (dakota->target[dakota->parameters.derivative.entry[i].number].design != CZ_DAKOTA_PATH)
            take_values(dakota, &evaluation[point++], CZ_DAKOTA_GRADIENT,
                        dakota->neighbour + i * dakota->parameters.response.n);
    for (int i = 0; i < n_point; i++)
        cz_evaluation_free(&evaluation[i]);
    free(evaluation);
    return status;
}

/* Evaluates a neighbour by a path; `is_refused` when no file may have it. */
static CzStatus evaluate_neighbour(CzDakota *dakota, int derivative, double step, bool *is_refused,
                                   CzError *error) {
    const CzDakotaTarget *target =
        &dakota->target[dakota->parameters.derivative.entry[derivative].number];
    Bench bench;
    CzEvaluation evaluation = {0};
    CzStatus status = bench_build(dakota, target, step, &bench, error);
    *is_refused = status == CZ_STATUS_INPUT;
    double *x = NULL;
    if (status == CZ_OK) {
        const int n = cz_evaluator_n_variable(bench.evaluator);
        x = cz_arena_numbers(&dakota->arena, (size_t)n + 1);
        if (x == NULL)
            status = cz_no_memory(error, "a design");
        if (x != NULL)
            write_design(dakota, bench.evaluator, x);
        if (status == CZ_OK)
            status = cz_evaluate(bench.evaluator, 1, has_designs(dakota) ? x : NULL, false,
                                 &evaluation, error);
    }
    if (status == CZ_OK)
        take_values(dakota, &evaluation, CZ_DAKOTA_GRADIENT,
                    dakota->neighbour + derivative * dakota->parameters.response.n);
    cz_evaluation_free(&evaluation);
    bench_free(&bench);
    /* The step is the difference of the numbers that were set. */
    dakota->step[derivative] = target->value + step - target->value;
    return *is_refused ? CZ_OK : status;
}

/* Evaluates the neighbours by paths: upwards, else downwards. */
static CzStatus evaluate_neighbours(CzDakota *dakota, CzError *error) {
    for (int i = 0; i < dakota->parameters.derivative.n; i++) {
        const CzDakotaTarget *target =
            &dakota->target[dakota->parameters.derivative.entry[i].number];
        const double step = target->value != 0 ? share * fabs(target->value) : share;
        bool is_refused;
        if (target->design != CZ_DAKOTA_PATH)
            continue;
        CZ_TRY(evaluate_neighbour(dakota, i, step, &is_refused, error));
        if (is_refused)
            CZ_TRY(evaluate_neighbour(dakota, i, -step, &is_refused, error));
        if (is_refused && dakota->failure[0] == '\0')
            snprintf(dakota->failure, sizeof dakota->failure,
                     "no value beside that of %.120s is allowed: %.300s", target->entry->label,
                     error != NULL ? error->message : "");
    }
    return CZ_OK;
}

/* ---- the evaluation ---- */

/* The variable whose path a mistake is about, and not its value; NULL when there is none. Line and
 * column of a mistake in a setting "path=value" are its number and the place in it. */
static const CzDakotaTarget *find_mistaken(const CzDakota *dakota, const CzError *mistake) {
    int line = dakota->options.problem != NULL ? dakota->options.problem->n_set : 0;
    if (strcmp(mistake->file, "--set") != 0)
        return NULL;
    for (int i = 0; i < dakota->parameters.variable.n; i++) {
        const CzDakotaTarget *target = &dakota->target[i];
        line += target->design == CZ_DAKOTA_PATH;
        if (target->design == CZ_DAKOTA_PATH && line == mistake->line)
            return mistake->column <= (int)strlen(target->meaning) ? target : NULL;
    }
    return NULL;
}

/* Settings that are refused: a path that the file does not have is a mistake, another value of a
 * design that no file may have is a failure. */
static CzStatus settle_refusal(CzDakota *dakota, const CzError *why, CzError *error) {
    const CzDakotaTarget *mistaken = find_mistaken(dakota, why);
    if (mistaken == NULL) {
        snprintf(dakota->failure, sizeof dakota->failure, "%s", why->message);
        return CZ_OK;
    }
    cz_fail(error, CZ_STATUS_INPUT,
            "'%.120s' is no design variable of the problem, nor a path: %.300s", mistaken->meaning,
            why->message);
    if (why->help[0] != '\0')
        cz_error_help(error, "%s", why->help);
    return cz_dakota_place(dakota, mistaken->entry, CZ_STATUS_INPUT, error);
}

static CzStatus run(CzDakota *dakota, CzError *error) {
    Bench bench;
    CzError why = {0};
    CzStatus status = bench_build(dakota, NULL, 0, &bench, &why);
    if (status == CZ_STATUS_INPUT) {
        status = settle_refusal(dakota, &why, error);
    } else if (status != CZ_OK) {
        if (error != NULL)
            *error = why;
    } else {
        status = evaluate_design(dakota, bench.evaluator, error);
    }
    bench_free(&bench);
    if (status == CZ_OK && dakota->failure[0] == '\0' && is_asked(dakota, CZ_DAKOTA_GRADIENT))
        status = evaluate_neighbours(dakota, error);
    return status;
}

static CzStatus evaluate(CzDakota *dakota, const char *parameters, CzError *error) {
    CzEvaluator *evaluator = NULL;
    CZ_TRY(cz_dakota_parameters_read(&dakota->arena, parameters, &dakota->parameters, error));
    CzStatus status = build_evaluator(dakota, dakota->problem, &evaluator, error);
    if (status == CZ_OK)
        status = cz_dakota_find(dakota, evaluator, error);
    cz_evaluator_free(evaluator);
    CZ_TRY(status);
    const size_t n_response = (size_t)dakota->parameters.response.n;
    const size_t n_derivative = (size_t)dakota->parameters.derivative.n;
    dakota->value = cz_arena_numbers(&dakota->arena, n_response + 1);
    dakota->neighbour = cz_arena_numbers(&dakota->arena, n_response * n_derivative + 1);
    dakota->step = cz_arena_numbers(&dakota->arena, n_derivative + 1);
    if (dakota->value == NULL || dakota->neighbour == NULL || dakota->step == NULL)
        return cz_no_memory(error, "the responses");
    if (is_asked(dakota, CZ_DAKOTA_HESSIAN)) {
        snprintf(dakota->failure, sizeof dakota->failure,
                 "second derivatives are asked for, but only values and gradients are computed: "
                 "use no_hessians or quasi_hessians");
        return CZ_OK;
    }
    return run(dakota, error);
}

CzStatus cz_dakota_evaluate(const CzProblem *problem, const char *parameters,
                            const CzDakotaOptions *options, CzDakota **dakota, CzError *error) {
    CzDakota *made = calloc(1, sizeof *made);
    *dakota = NULL;
    if (made == NULL)
        return cz_no_memory(error, "an evaluation");
    made->problem = problem;
    if (options != NULL)
        made->options = *options;
    const CzStatus status = evaluate(made, parameters, error);
    if (status == CZ_OK)
        *dakota = made;
    else
        cz_dakota_free(made);
    return status;
}

void cz_dakota_free(CzDakota *dakota) {
    if (dakota == NULL)
        return;
    cz_arena_free(&dakota->arena);
    free(dakota);
}

const char *cz_dakota_failure(const CzDakota *dakota) {
    return dakota->failure;
}

/* ---- the results file ---- */

void cz_dakota_write_failure(const char *reason, FILE *stream) {
    fprintf(stream, "fail\n%s\n", reason);
}

void cz_dakota_write(const CzDakota *dakota, FILE *stream) {
    const CzDakotaList *response = &dakota->parameters.response;
    char text[CZ_NUMBER_TEXT];
    if (dakota->failure[0] != '\0') {
        cz_dakota_write_failure(dakota->failure, stream);
        return;
    }
    for (int j = 0; j < response->n; j++)
        if ((response->entry[j].number & CZ_DAKOTA_VALUE) != 0)
            fprintf(stream, "%s %s\n", cz_number_print(text, dakota->value[j]),
                    response->entry[j].label);
    for (int j = 0; j < response->n; j++) {
        if ((response->entry[j].number & CZ_DAKOTA_GRADIENT) == 0)
            continue;
        fputs("[", stream);
        for (int i = 0; i < dakota->parameters.derivative.n; i++) {
            const double difference = dakota->neighbour[i * response->n + j] - dakota->value[j];
            fprintf(stream, " %s", cz_number_print(text, difference / dakota->step[i]));
        }
        fputs(" ]\n", stream);
    }
}
