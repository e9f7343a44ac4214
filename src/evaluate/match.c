/* Matches: their metrics, events and channels, and the residuals of a run. */
#include "evaluate/match.h"
#include "base/error.h"
#include "base/suggest.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Residual of a value that a run does not have (ours). */
static const double not_shown = 10;

/* ---- building -------------------------------------------------------------------------------- */

static CzStatus find_event(const char *text, CzEventKind *event, CzError *error) {
    static const char *const words[] = {
#define CZ_EVENT(constant, word, doc) word,
#include "crushzone/events.def"
#undef CZ_EVENT
    };
    CzSuggestion nearest = {0};
    const int found = CZ_FIND_TEXT(text, words, sizeof words / sizeof words[0], &nearest);
    *event = (CzEventKind)found;
    if (found >= 0)
        return CZ_OK;
    const CzStatus status = cz_fail(error, CZ_STATUS_INPUT, "there is no event '%.60s'", text);
    cz_suggest_help(&nearest, error);
    return status;
}

/* Finds the channel that a text names among those of a scenario's vehicles. */
static CzStatus find_channel(const char *text, const CzScene *scene, CzArena *arena,
                             CzColumn *column, CzError *error) {
    char nearest[CZ_CHANNEL_SIZE];
    const char **name = cz_arena_allocate(arena, (size_t)scene->n_vehicle, sizeof *name);
    if (name == NULL)
        return cz_no_memory(error, "the matches");
    for (int i = 0; i < scene->n_vehicle; i++)
        name[i] = scene->vehicle[i]->name;
    if (cz_column_find(text, scene->n_vehicle, name, column, nearest))
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT, "there is no channel '%.127s'", text);
    if (nearest[0] != '\0' && error != NULL)
        cz_error_help(error, "did you mean '%s'?", nearest);
    return CZ_STATUS_INPUT;
}

static CzStatus build_item(const CzProblem *problem, int index, int n_scene, const CzScene *scene,
                           CzArena *arena, CzMatchItem *item, CzError *error) {
    const CzMatch *written = &cz_problem_input(problem)->optimise.match[index];
    *item = (CzMatchItem){.written = written, .unit = "ms"};
    for (int s = 0; written->scenario != NULL && s < n_scene; s++)
        if (strcmp(scene[s].name, written->scenario) == 0)
            item->scenario = s;
    if (written->metric != NULL) {
        CZ_TRY(cz_problem_place_failure(problem, &written->metric,
                                        cz_metric_parse(written->metric, &item->metric, error),
                                        error));
        item->unit = item->metric.kind->unit->text;
        if (!cz_metric_picks(&item->metric, &scene[item->scenario]))
            return cz_problem_fail(problem, &written->metric, error,
                                   "'%s' matches no place in scenario '%s'", written->metric,
                                   scene[item->scenario].name);
    } else if (written->event != NULL) {
        CZ_TRY(cz_problem_place_failure(problem, &written->event,
                                        find_event(written->event, &item->event, error), error));
    } else {
        CZ_TRY(cz_problem_place_failure(
            problem, &written->channel,
            find_channel(written->channel, &scene[item->scenario], arena, &item->column, error),
            error));
        item->unit = cz_channel_info(item->column.channel)->unit;
        if (written->file != NULL)
            item->measured = cz_problem_measured(problem, index);
    }
    return CZ_OK;
}

CzStatus cz_matches_build(const CzProblem *problem, int n_scene, const CzScene *scene,
                          CzArena *arena, CzMatchList *list, CzError *error) {
    const CzOptimise *optimise = &cz_problem_input(problem)->optimise;
    *list = (CzMatchList){0};
    if (!optimise->given || optimise->n_match == 0)
        return CZ_OK;
    list->item = cz_arena_allocate(arena, (size_t)optimise->n_match, sizeof *list->item);
    if (list->item == NULL)
        return cz_no_memory(error, "the matches");
    for (int i = 0; i < optimise->n_match; i++) {
        CZ_TRY(build_item(problem, i, n_scene, scene, arena, &list->item[i], error));
        list->needs_record |= list->item[i].metric.kind == NULL;
        list->n_item++;
    }
    return CZ_OK;
}

/* ---- judging --------------------------------------------------------------------------------- */

static CzStatus read_channel(const CzMatchItem *item, const CzSubject *subject, const CzRun *run,
                             const double **values, CzError *error) {
    *values = cz_run_channel(run, item->column.channel, item->column.place);
    if (*values != NULL)
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT, "a run of scenario '%s' does not record '%.127s'",
            subject->scene->name, item->written->channel);
    if (error != NULL)
        snprintf(error->help, sizeof error->help,
                 "its vehicles or interface do not have this quantity; channels.csv has the "
                 "recorded columns");
    return cz_problem_place_failure(subject->problem, &item->written->channel, CZ_STATUS_INPUT,
                                    error);
}

/* Value of a channel at a time [s], by linear interpolation; NaN beyond the run. The search begins
 * at sample `from`, which is advanced, since times rise. */
static double value_at(const CzRun *run, const double *values, double time, int *from) {
    const double *t_ms = cz_run_channel(run, CZ_CHANNEL_TIME, 0);
    const int n = cz_run_n_sample(run);
    const double at = 1e3 * time;
    int i = *from;
    while (i + 2 < n && t_ms[i + 1] < at)
        i++;
    *from = i;
    if (n < 2 || at > t_ms[n - 1] * (1 + 1e-9) || at < t_ms[0])
        return NAN;
    const double span = t_ms[i + 1] - t_ms[i];
    const double share = span > 0 ? fmin((at - t_ms[i]) / span, 1) : 1;
    return values[i] + share * (values[i + 1] - values[i]);
}

enum { MAX_STRETCHES = 100 };

int cz_match_n_detail(const CzMatchItem *item) {
    if (item->measured == NULL)
        return 1;
    return item->measured->n_point < MAX_STRETCHES ? item->measured->n_point : MAX_STRETCHES;
}

/* The mean square difference; the mean difference of each stretch is its detail, so that for short
 * stretches the squares of the details add up to the square of the whole residual. */
static void judge_history(const CzMatchItem *item, const CzRun *run, const double *values,
                          CzMatchResult *result, double *detail) {
    const CzMeasured *measured = item->measured;
    const int n = measured->n_point, n_stretch = cz_match_n_detail(item);
    double sum = 0;
    int from = 0;
    for (int stretch = 0, i = 0; stretch < n_stretch; stretch++) {
        const int first = i, end = (int)((long)n * (stretch + 1) / n_stretch);
        double part = 0;
        for (; i < end; i++) {
            const double difference =
                value_at(run, values, measured->time[i], &from) - measured->value[i];
            sum += difference * difference;
            part += difference;
        }
        if (detail != NULL)
            detail[stretch] =
                part / sqrt((double)(i - first) * n) * sqrt(result->weight) / result->tolerance;
    }
    result->value = sqrt(sum / n); /* NaN when the run ends too early */
    snprintf(result->where, sizeof result->where, "%s", item->written->channel);
}

static void judge_event(const CzMatchItem *item, const CzRunSummary *run, CzMatchResult *result) {
    const CzMatch *written = item->written;
    for (int i = 0; i < run->n_event; i++) {
        const CzEvent *event = &run->event[i];
        if (event->what != item->event ||
            (written->where != NULL && !cz_matches(written->where, event->where)))
            continue;
        result->value = 1e3 * event->time;
        memcpy(result->where, event->where, sizeof result->where);
        return;
    }
    const double nearest = (1e3 * run->simulated - written->value) / written->tolerance;
    result->residual = fmax(not_shown, nearest);
}

CzMatchResult cz_match_begin(const CzMatchItem *item, const CzScene *scene) {
    const bool is_history = item->measured != NULL;
    return (CzMatchResult){.name = item->written->name,
                           .scenario = scene->name,
                           .unit = item->unit,
                           .target = is_history ? 0 : item->written->value,
                           .value = NAN,
                           .tolerance = item->written->tolerance,
                           .weight = item->written->weight,
                           .residual = NAN,
                           .is_history = is_history};
}

CzStatus cz_match_judge(const CzMatchItem *item, const CzSubject *subject, const CzRun *run,
                        CzMatchResult *result, double *detail, CzError *error) {
    const CzMatch *written = item->written;
    *result = cz_match_begin(item, subject->scene);
    result->residual = not_shown;
    if (item->metric.kind != NULL) {
        const CzMetricValue value = cz_metric_value(&item->metric, subject, true);
        result->value = value.value;
        memcpy(result->where, value.where, sizeof result->where);
    } else if (written->event != NULL) {
        judge_event(item, subject->run, result);
    } else {
        const double *values = NULL;
        int from = 0;
        CZ_TRY(read_channel(item, subject, run, &values, error));
        if (item->measured != NULL) {
            judge_history(item, run, values, result, detail);
        } else {
            result->value = value_at(run, values, written->time, &from);
            snprintf(result->where, sizeof result->where, "%s", written->channel);
        }
    }
    if (!isnan(result->value))
        result->residual = (result->value - result->target) / result->tolerance;
    const bool is_in_stretches = item->measured != NULL && !isnan(result->value);
    for (int k = 0; detail != NULL && !is_in_stretches && k < cz_match_n_detail(item); k++)
        detail[k] = k == 0 ? sqrt(result->weight) * result->residual : 0;
    return CZ_OK;
}
