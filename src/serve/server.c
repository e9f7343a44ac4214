/* Answers requests in their order.
 *
 *   line --request.c--> requests --> designs of an evaluator, up to 64 side by side --> answers
 *
 * Values of design variables are designs of one evaluator. Other settings are those of a problem
 * that is read again from the tree in memory; the last one is kept for the next request.
 */
#include "crushzone/serve.h"

#include "base/error.h"
#include "base/suggest.h"
#include "crushzone/report.h"
#include "evaluate/evaluator.h"
#include "serve/gradient.h"
#include "serve/request.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GROUP = 64 }; /* designs that are evaluated at a time */

struct CzServer {
    const CzProblem *problem;
    CzServerOptions options;
    CzEvaluator *evaluator;
    char *settings; /* of the problem that was read again, one a line; NULL for none */
    CzProblem *other;
    CzEvaluator *other_evaluator;
};

/* Requests that are evaluated together. */
typedef struct Group {
    CzServer *server;
    CzArena *arena;
    FILE *stream;
    bool is_batch;
    int n_answered;
    CzEvaluator *evaluator;
    bool has_x;
    int n;
    const CzRequest *request[GROUP]; /* (n) */
    double *x;                       /* (n x n_variable), with room for GROUP designs */
} Group;

/* ---- building ---- */

static CzStatus build_evaluator(const CzServer *server, const CzProblem *problem,
                                CzEvaluator **evaluator, CzError *error) {
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.n_job = server->options.n_job;
    options.scenario = server->options.scenario;
    options.beside = server->evaluator;
    CZ_TRY(cz_evaluator_build(problem, &options, evaluator, error));
    cz_evaluator_set_stop(*evaluator, server->options.stop);
    return CZ_OK;
}

CzStatus cz_server_build(const CzProblem *problem, const CzServerOptions *options,
                         CzServer **server, CzError *error) {
    CzServer *built = calloc(1, sizeof *built);
    *server = NULL;
    if (built == NULL)
        return cz_no_memory(error, "the server");
    built->problem = problem;
    if (options != NULL)
        built->options = *options;
    const CzStatus status = build_evaluator(built, problem, &built->evaluator, error);
    if (status == CZ_OK)
        *server = built;
    else
        cz_server_free(built);
    return status;
}

static void free_other(CzServer *server) {
    cz_evaluator_free(server->other_evaluator);
    cz_problem_free(server->other);
    free(server->settings);
    server->other_evaluator = NULL;
    server->other = NULL;
    server->settings = NULL;
}

void cz_server_free(CzServer *server) {
    if (server == NULL)
        return;
    free_other(server);
    cz_evaluator_free(server->evaluator);
    free(server);
}

/* ---- answers ---- */

static void write_reply(Group *group, const CzReply *reply) {
    const bool is_other = group->evaluator == group->server->other_evaluator;
    const CzReport report = {.kind = CZ_REPORT_ANSWER,
                             .problem = is_other ? group->server->other : group->server->problem,
                             .evaluator = group->evaluator,
                             .reply = reply};
    if (group->n_answered++ > 0)
        fputs(", ", group->stream);
    cz_report_write_answer(&report, group->stream);
}

static void write_error(Group *group, const CzRequest *request, const CzError *error) {
    write_reply(group, &(CzReply){.has_id = request->has_id, .id = request->id, .error = *error});
}

/* Whether a request wants a word that is not a metric. */
static bool wants(const CzRequest *request, const char *word) {
    for (int i = 0; i < request->want.n; i++)
        if (strcmp(request->want.text[i], word) == 0)
            return true;
    return false;
}

static unsigned parts_of(const CzRequest *request) {
    return (wants(request, "checks") ? CZ_REPLY_CHECKS : 0U) |
           (wants(request, "constraints") ? CZ_REPLY_CONSTRAINTS : 0U);
}

/* Sets what the requests of a group have in common. */
static CzStatus prepare(Group *group, CzError *error) {
    const CzRequest *request = group->request[0];
    CzEvaluator *evaluator = group->evaluator;
    const char **metric =
        cz_arena_allocate(group->arena, (size_t)request->want.n + 1, sizeof *metric);
    int n_metric = 0;
    if (metric == NULL)
        return cz_no_memory(error, "the metrics of a request");
    for (int i = 0; i < request->want.n; i++)
        if (strcmp(request->want.text[i], "checks") != 0 &&
            strcmp(request->want.text[i], "constraints") != 0)
            metric[n_metric++] = request->want.text[i];
    CZ_TRY(cz_evaluator_set_scenarios(evaluator, request->scenarios.n, request->scenarios.text,
                                      error));
    CZ_TRY(cz_evaluator_set_values(evaluator, n_metric, metric, error));
    for (int i = 0; i < n_metric; i++)
        if (!cz_evaluator_has_metric(evaluator, i))
            return cz_fail(error, CZ_STATUS_INPUT, "'%.200s' names no place of the problem",
                           metric[i]);
    return CZ_OK;
}

static CzStatus evaluate(Group *group, CzError *error) {
    CzEvaluation evaluation[GROUP];
    CZ_TRY(cz_evaluate(group->evaluator, group->n, group->has_x ? group->x : NULL, false,
                       evaluation, error));
    for (int i = 0; i < group->n; i++) {
        const CzRequest *request = group->request[i];
        write_reply(group, &(CzReply){.has_id = request->has_id,
                                      .id = request->id,
                                      .evaluation = &evaluation[i],
                                      .parts = parts_of(request)});
        cz_evaluation_free(&evaluation[i]);
    }
    return CZ_OK;
}

static CzStatus differentiate(Group *group, CzError *error) {
    const CzRequest *request = group->request[0];
    const double step = isnan(request->step) ? CZ_GRADIENT_STEP : request->step;
    const unsigned parts = parts_of(request);
    CzGradient gradient;
    CZ_TRY(cz_gradient(group->evaluator, group->x, step, (parts & CZ_REPLY_CONSTRAINTS) != 0,
                       group->arena, &gradient, error));
    write_reply(group, &(CzReply){.has_id = request->has_id,
                                  .id = request->id,
                                  .evaluation = &gradient.evaluation,
                                  .parts = parts,
                                  .n_slope = gradient.n_slope,
                                  .slope = gradient.slope});
    cz_evaluation_free(&gradient.evaluation);
    return CZ_OK;
}

/* Evaluates the requests of a group and writes their answers. Status: CZ_STATUS_INTERRUPTED. */
static CzStatus flush(Group *group, CzError *error) {
    CzError failure = {0};
    if (group->n == 0)
        return CZ_OK;
    CzStatus status = prepare(group, &failure);
    if (status == CZ_OK)
        status = group->request[0]->operation == CZ_OPERATION_GRADIENT
                     ? differentiate(group, &failure)
                     : evaluate(group, &failure);
    if (status == CZ_STATUS_INTERRUPTED && error != NULL)
        *error = failure;
    if (status == CZ_STATUS_INTERRUPTED)
        return status;
    for (int i = 0; status != CZ_OK && i < group->n; i++)
        write_error(group, group->request[i], &failure);
    group->n = 0;
    return CZ_OK;
}

/* ---- designs ---- */

/* The design of the values of variables; those that are left out have their start. */
static CzStatus read_variables(const CzEvaluator *evaluator, const CzNamedValues *values, double *x,
                               CzError *error) {
    const int n = cz_evaluator_n_variable(evaluator);
    for (int i = 0; i < n; i++)
        x[i] = cz_evaluator_variable(evaluator, i)->start;
    for (int k = 0; k < values->n; k++) {
        const CzVariableInfo *info = NULL;
        CzSuggestion nearest = {0};
        int i = 0;
        for (; i < n; i++) {
            info = cz_evaluator_variable(evaluator, i);
            if (strcmp(info->name, values->name[k]) == 0)
                break;
            cz_suggest(&nearest, values->name[k], info->name);
        }
        if (i == n) {
            cz_fail(error, CZ_STATUS_INPUT, "there is no design variable '%.200s'",
                    values->name[k]);
            cz_suggest_help(&nearest, error);
            return CZ_STATUS_INPUT;
        }
        if (info->n_choice > 0) {
            const int choice =
                CZ_FIND_TEXT(values->text[k], info->choice, info->n_choice, &nearest);
            if (choice < 0)
                return cz_fail(error, CZ_STATUS_INPUT, "'%.100s' has no choice '%.100s'",
                               info->name, values->text[k]);
            x[i] = choice;
        } else if (!(values->number[k] >= info->min) || !(values->number[k] <= info->max)) {
            return cz_fail(error, CZ_STATUS_INPUT,
                           "'%.200s' is %.60s; it must be a number from %.17g to %.17g %s",
                           info->name, values->text[k], info->min, info->max, info->unit);
        } else {
            x[i] = values->number[k];
        }
    }
    return CZ_OK;
}

/* The settings of a request as texts "path=value", and all of them as one text. */
static char *join_settings(const CzRequest *request, CzArena *arena, const char **setting) {
    size_t n_byte = 1;
    for (int i = 0; i < request->set.n; i++)
        n_byte += strlen(request->set.name[i]) + strlen(request->set.text[i]) + 2;
    char *all = malloc(n_byte);
    size_t at = 0;
    for (int i = 0; all != NULL && i < request->set.n; i++) {
        const size_t begin = at;
        at += (size_t)snprintf(all + at, n_byte - at, "%s=%s", request->set.name[i],
                               request->set.text[i]);
        setting[i] = cz_arena_copy_text(arena, all + begin, at - begin);
        all[at++] = '\n';
    }
    if (all != NULL)
        all[at] = '\0';
    return all;
}

/* Reads the problem with the settings of a request, unless that is the last one that was read. */
static CzStatus read_other(Group *group, const CzRequest *request, CzError *error) {
    CzServer *server = group->server;
    const char **setting =
        cz_arena_allocate(group->arena, (size_t)request->set.n + 1, sizeof *setting);
    char *settings = setting != NULL ? join_settings(request, group->arena, setting) : NULL;
    if (settings == NULL || group->arena->out_of_memory) {
        free(settings);
        return cz_no_memory(error, "the settings of a request");
    }
    if (server->settings != NULL && strcmp(settings, server->settings) == 0) {
        free(settings);
        return CZ_OK;
    }
    const CzStatus flushed = flush(group, error);
    free_other(server);
    server->settings = settings;
    CzStatus status = flushed;
    if (status == CZ_OK)
        status =
            cz_problem_read_with(server->problem, request->set.n, setting, &server->other, error);
    if (status == CZ_OK)
        status = build_evaluator(server, server->other, &server->other_evaluator, error);
    if (status != CZ_OK)
        free_other(server);
    return status;
}

static bool same_texts(const CzTextList *a, const CzTextList *b) {
    for (int i = 0; a->n == b->n && i < a->n; i++)
        if (strcmp(a->text[i], b->text[i]) != 0)
            return false;
    return a->n == b->n;
}

/* Whether a design may be evaluated with those of the group. */
static bool joins(const Group *group, const CzRequest *request, const CzEvaluator *evaluator,
                  bool has_x) {
    const CzRequest *first = group->request[0];
    return group->n > 0 && group->n < GROUP && has_x && group->has_x &&
           group->evaluator == evaluator && request->operation == CZ_OPERATION_EVALUATE &&
           first->operation == CZ_OPERATION_EVALUATE &&
           same_texts(&first->scenarios, &request->scenarios) &&
           same_texts(&first->want, &request->want);
}

/* The evaluator of a request, and the values of its design, NULL for those of the file; `x` has
 * room for them. */
static CzStatus find_design(Group *group, const CzRequest *request, CzEvaluator **evaluator,
                            const double **x, CzError *error) {
    const CzServer *server = group->server;
    const bool needs_x = request->variables.n > 0 || request->operation == CZ_OPERATION_GRADIENT;
    *evaluator = server->evaluator;
    *x = NULL;
    double *room =
        cz_arena_numbers(group->arena, (size_t)cz_evaluator_n_variable(server->evaluator) + 1);
    if (room == NULL)
        return cz_no_memory(error, "a design");
    if (request->set.n > 0 && !needs_x &&
        cz_evaluator_take_settings(server->evaluator, request->set.n, request->set.name,
                                   request->set.number, room)) {
        *x = room;
        return CZ_OK;
    }
    if (request->set.n > 0) {
        CZ_TRY(read_other(group, request, error));
        *evaluator = server->other_evaluator;
    }
    if (!needs_x)
        return CZ_OK;
    room = cz_arena_numbers(group->arena, (size_t)cz_evaluator_n_variable(*evaluator) + 1);
    if (room == NULL)
        return cz_no_memory(error, "a design");
    *x = room;
    return read_variables(*evaluator, &request->variables, room, error);
}

/* Adds a design to the group, or begins another one with it. */
static CzStatus add(Group *group, const CzRequest *request, CzEvaluator *evaluator, const double *x,
                    CzError *error) {
    const size_t n = (size_t)cz_evaluator_n_variable(evaluator);
    if (!joins(group, request, evaluator, x != NULL)) {
        CZ_TRY(flush(group, error));
        group->evaluator = evaluator;
        group->has_x = x != NULL;
        group->x = cz_arena_numbers(group->arena, GROUP * n + 1);
        if (group->x == NULL)
            return cz_no_memory(error, "a group of designs");
    }
    if (x != NULL)
        memcpy(group->x + (size_t)group->n * n, x, n * sizeof *x);
    group->request[group->n++] = request;
    return CZ_OK;
}

/* Takes one request. Status: CZ_STATUS_INTERRUPTED; everything else is an answer. */
static CzStatus take(Group *group, const CzRequest *request, CzError *error) {
    CzError failure = request->error;
    CzEvaluator *evaluator = group->server->evaluator;
    const double *x = NULL;
    CzStatus status = failure.status;
    if (status == CZ_OK && request->operation == CZ_OPERATION_DESCRIBE) {
        CZ_TRY(flush(group, error));
        group->evaluator = evaluator;
        write_reply(group, &(CzReply){.has_id = request->has_id, .id = request->id});
        return CZ_OK;
    }
    if (status == CZ_OK)
        status = find_design(group, request, &evaluator, &x, &failure);
    if (status == CZ_OK)
        status = add(group, request, evaluator, x, &failure);
    if (status == CZ_STATUS_INTERRUPTED && error != NULL)
        *error = failure;
    if (status == CZ_OK || status == CZ_STATUS_INTERRUPTED)
        return status;
    CZ_TRY(flush(group, error));
    write_error(group, request, &failure);
    return CZ_OK;
}

/* ---- lines ---- */

static CzStatus answer_all(Group *group, const char *line, size_t n_byte, CzError *error) {
    CzRequests requests;
    CzRequest none = {.error = {0}};
    if (cz_requests_read(line, n_byte, group->arena, &requests, &none.error) != CZ_OK) {
        write_error(group, &none, &none.error);
        return CZ_OK;
    }
    group->is_batch = requests.is_batch;
    if (group->is_batch)
        fputc('[', group->stream);
    for (int i = 0; i < requests.n; i++)
        CZ_TRY(take(group, &requests.request[i], error));
    CZ_TRY(flush(group, error));
    if (group->is_batch)
        fputc(']', group->stream);
    return CZ_OK;
}

static CzStatus end_line(FILE *stream, CzError *error) {
    fputc('\n', stream);
    if (fflush(stream) == 0 && !ferror(stream))
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_OUTPUT, "the answer cannot be written: %s", strerror(errno));
}

CzStatus cz_server_answer(CzServer *server, const char *line, size_t n_byte, FILE *stream,
                          CzError *error) {
    CzArena arena = {0};
    Group group = {.server = server, .arena = &arena, .stream = stream};
    const CzStatus status = answer_all(&group, line, n_byte, error);
    cz_arena_free(&arena);
    return status != CZ_OK ? status : end_line(stream, error);
}

CzStatus cz_server_refuse_line(FILE *stream, CzError *error) {
    CzServer none = {0};
    Group group = {.server = &none, .stream = stream};
    CzRequest request = {.error = {0}};
    cz_fail(&request.error, CZ_STATUS_INPUT, "the line is longer than %d MiB" CZ_HELP "%s",
            CZ_LONGEST_REQUEST >> 20, "divide the list of requests");
    write_error(&group, &request, &request.error);
    return end_line(stream, error);
}
