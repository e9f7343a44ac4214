/* The list of results as a table, and its values that are computed and not stored in a record. */
#include "report/results.h"

#include "evaluate/evaluator.h"
#include "evaluate/metric.h"
#include "evaluate/not_covered.h"
#include "problem/problem.h"
#include "report/compare.h"
#include "report/runs.h"
#include "report/sample_values.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

/* The struct of each record. */
#define CZ_RECORD(record, type, doc) typedef type Of_##record;
#include "evaluate/result_records.def"
#include "report/document_records.def"
#undef CZ_RECORD

const CzRecordInfo cz_result_records[CZ_N_RECORD] = {
#define CZ_RECORD(record, type, doc) {#record, doc},
#include "evaluate/result_records.def"
#include "report/document_records.def"
#undef CZ_RECORD
};

/* ---- documents ---- */

static const char *or_null(const char *text) {
    return text[0] != '\0' ? text : NULL;
}

/* Word for the status of a run, an evaluation or a verification. */
static const char *status_word(CzStatus status) {
    return status == CZ_OK ? "completed" : "failed";
}

static long n_not_covered(const CzResultContext *context) {
    int n;
    cz_not_covered(context->problem, &n);
    return n;
}

static const char *not_covered(const CzResultContext *context, long index) {
    int n;
    return cz_not_covered(context->problem, &n)[index];
}

static bool is_screening(const CzResultContext *context, CzVerdict verdict) {
    return cz_verdict_is_screening(verdict, (int)n_not_covered(context));
}

/* The profile of a problem; an empty one for none. */
static const CzProfile *profile_of(const CzProblem *problem) {
    static const CzProfile none;
    const CzProfile *profile = cz_problem_profile(problem);
    return profile != NULL ? profile : &none;
}

static const char *limit_word(bool is_minimum) {
    return is_minimum ? "min" : "max";
}

static const char *version_of(CzResultContext *context, void (*read)(char *text, size_t n)) {
    context->text[0] = '\0';
    read(context->text, sizeof context->text);
    return context->text;
}

static const CzRunInfo *run_info(CzResultContext *context, double wall_s, double setup_s) {
    context->info =
        (CzRunInfo){.wall_s = wall_s, .setup_s = setup_s, .n_job = context->options->n_job};
    return &context->info;
}

/* The n-th of the two warnings about a run that apply; NULL beyond. */
static const char *warning_of_run(const CzRunSummary *run, int n) {
    if (cz_run_is_unbalanced(run) && n-- == 0)
        return "the error of the energy balance is above 0.1 %";
    if (cz_run_misses_laws(run) && n == 0)
        return "the force of a series chain differs from the law of a member by more than 0.1 % of "
               "the largest force of its interface";
    return NULL;
}

/* Warnings of the problem file, then those of the runs. */
static const CzError *warning(CzResultContext *context, int index) {
    const CzEvaluation *evaluation = context->evaluation;
    if (index < cz_problem_n_warning(context->problem))
        return cz_problem_warning(context->problem, index);
    index -= cz_problem_n_warning(context->problem);
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(evaluation, i);
        for (int n = 0; run != NULL && warning_of_run(run, n) != NULL; n++) {
            if (index-- > 0)
                continue;
            CzError *warning = &context->warning;
            *warning = (CzError){0};
            snprintf(warning->message, sizeof warning->message, "scenario '%s': %s", run->scenario,
                     warning_of_run(run, n));
            snprintf(warning->help, sizeof warning->help, "reduce the time step");
            return warning;
        }
    }
    return NULL;
}

static int n_warning(CzResultContext *context) {
    int n = 0;
    while (warning(context, n) != NULL)
        n++;
    return n;
}

/* ---- answers ---- */

static bool is_evaluated(const CzReply *answer) {
    return answer->evaluation != NULL;
}

static bool is_description(const CzReply *answer) {
    return answer->evaluation == NULL && answer->error.status == CZ_OK;
}

static const char *answer_word(const CzReply *answer) {
    if (answer->error.status != CZ_OK)
        return "error";
    return is_evaluated(answer) && answer->evaluation->status != CZ_OK ? "failed" : "ok";
}

/* NaN when no check has a margin. */
static double smallest_margin(const CzEvaluation *evaluation) {
    double smallest = NAN;
    for (int i = 0; i < evaluation->n_check; i++) /* fmin ignores NaN */
        smallest = fmin(smallest, evaluation->check[i].margin);
    return smallest;
}

/* ---- runs ---- */

static const CzRunSummary *nth_kept_run(const CzEvaluation *evaluation, int index) {
    for (int i = 0; i < evaluation->n_run; i++)
        if (cz_kept_run(evaluation, i) != NULL && index-- == 0)
            return cz_kept_run(evaluation, i);
    return NULL;
}

static double largest_stroke_used(const CzInterfaceResult *interface) {
    double used = 0;
    for (int i = 0; i < interface->n_element; i++)
        used = fmax(used, interface->element[i].stroke_used);
    return used;
}

static double largest_wheel_lift(const CzVehicleResult *vehicle) {
    double lift = NAN;
    for (int i = 0; i < 4; i++)
        lift = fmax(lift, vehicle->wheel_lift[i]);
    return lift;
}

static const char *lifted_bogie(const CzVehicleResult *vehicle) {
    if (!(vehicle->bogie_lift > 0))
        return NULL;
    return vehicle->lifted_bogie == 0 ? "rear" : "front";
}

/* The pulse of a vehicle of the run that is being written. */
static const CzPulse *pulse_of(const CzResultContext *context, const CzVehicleResult *vehicle) {
    return &context->run->pulse[vehicle - context->run->vehicle];
}

/* The source of the impulse that is being written. */
static CzBudgetSource source_of(const CzResultContext *context) {
    return (CzBudgetSource)(context->order != NULL ? context->order[context->index]
                                                   : context->index);
}

/* ---- searches, verifications, comparisons ---- */

/* Replaces the check of a constraint that is a target, and a check that a run does not have.
 */
static const CzCheckResult no_check = {
    .limit = NAN, .value = NAN, .margin = NAN, .verdict = CZ_VERDICT_PASS};

static const CzVerification not_verified = {
    .verdict = CZ_VERDICT_NOT_CHECKED,
    .largest_change = {
        [CZ_METHOD_HALF_STEP] = NAN, [CZ_METHOD_ERK] = NAN, [CZ_METHOD_TRACK] = NAN}};

static bool is_feasible(const CzEvaluation *best) {
    return best->status == CZ_OK && best->violation <= 0 && isfinite(best->objective);
}

/* The check of a constraint. */
static const CzCheckResult *check_of(const CzEvaluation *evaluation, int constraint) {
    const bool is_judged =
        evaluation->constraint_check != NULL && constraint < evaluation->n_constraint;
    return is_judged ? &evaluation->constraint_check[constraint] : &no_check;
}

static const char *where_of(const CzCheckResult *check) {
    return check != &no_check ? check->where : NULL;
}

/* Values of a further parameter set, given by the address of its objective. */
static const double *alternative_of(const CzOutcome *outcome, const double *objective) {
    return &outcome
                ->alternative[(objective - outcome->alternative_objective) * outcome->n_variable];
}

/* The n-th of the variables that were varied; the number of variables beyond the last. */
static int nth_varied(const CzOutcome *outcome, int n) {
    int variable = 0;
    while (variable < outcome->n_variable &&
           (outcome->sensitivity_increment[variable] == 0 || n-- > 0))
        variable++;
    return variable;
}

static int n_varied(const CzOutcome *outcome) {
    int n = 0;
    while (nth_varied(outcome, n) < outcome->n_variable)
        n++;
    return n;
}

/* The variable of an increment. */
static int variable_of(const CzResultContext *context, const double *increment) {
    return (int)(increment - context->report->outcome->sensitivity_increment);
}

static double margin_change(const CzResultContext *context, const double *increment,
                            int constraint) {
    const int n_constraint = context->report->outcome->best_evaluation.n_constraint;
    return -context->report->outcome
                ->constraint_change[variable_of(context, increment) * n_constraint + constraint];
}

/* ---- samples ---- */

static const char *effect_word(CzDrawEffect effect) {
    return effect == CZ_DRAW_VALUE ? "value" : effect == CZ_DRAW_FACTOR ? "factor" : "add";
}

static const CzSample *nth_failed(const CzSampling *sampling, int n) {
    const CzSample *sample = sampling->sample;
    while ((sample->state != CZ_SAMPLE_RUN_FAILED && sample->state != CZ_SAMPLE_INVALID) || n-- > 0)
        sample++;
    return sample;
}

static double relative_change(double from, double to) {
    return from != 0 ? (to - from) / fabs(from) : NAN;
}

/* ---- explanations ---- */

/* The explained check that has a carrier. */
static const CzExplainedCheck *explained_of(const CzResultContext *context,
                                            const CzCarrier *carrier) {
    const CzExplanation *explanation = context->report->explanation;
    const CzExplainedCheck *explained = explanation->check;
    while (carrier < explained->carrier || carrier >= explained->carrier + explained->n_carrier)
        explained++;
    return explained;
}

/* ---- corridors ---- */

static const char *curve_words(CzResultContext *context, const CzTriedCurve *curve) {
    return cz_curve_words(curve, context->words);
}

/* Summary of the compared scenario of a run; NULL when none was kept. */
static const CzRunSummary *summary_of(const CzResultContext *context, const CzReportRun *run) {
    return cz_compared_run(context->report, (int)(run - context->report->compared));
}

static const CzCheckResult *check_in_run(const CzResultContext *context, const CzCheckResult *first,
                                         int run) {
    const CzCheckResult *check = cz_compared_check(&context->report->compared[run], first);
    return check != NULL ? check : &no_check;
}

/* ---- functions that evaluate the expression of a line ---- */

#define READER(type, what, record, key, expression)                                                \
    static type what##_##record##_##key(CzResultContext *context, const void *data) {              \
        const Of_##record *it = data;                                                              \
        const int index = context->index;                                                          \
        (void)it, (void)index;                                                                     \
        return expression;                                                                         \
    }
#define RECORD_READER(record, key, of, pointer)                                                    \
    READER(const void *, get, record, key, ((const Of_##of *){pointer}))
#define LIST_READERS(record, key, of, count, pointer)                                              \
    READER(long, number, record, key, count)                                                       \
    RECORD_READER(record, key, of, pointer)
#define MAP_READERS(record, key, of, count, text, pointer)                                         \
    READER(const char *, name, record, key, text)                                                  \
    LIST_READERS(record, key, of, count, pointer)
#define TEXT_READERS(record, key, count, text)                                                     \
    READER(long, number, record, key, count)                                                       \
    READER(const char *, get, record, key, text)
#define NUMBER_READERS(record, key, count, value)                                                  \
    READER(long, number, record, key, count)                                                       \
    READER(double, get, record, key, value)
#define NAMED_READERS(record, key, count, text, value)                                             \
    READER(const char *, name, record, key, text)                                                  \
    NUMBER_READERS(record, key, count, value)
#define IF_READERS(record, key, condition, form, ...)                                              \
    READER(bool, there, record, key, condition)                                                    \
    GET_##form(record, key, (__VA_ARGS__))

#define UNWRAP(...) __VA_ARGS__
#define WITH(macro, ...) macro(__VA_ARGS__)
#define WITH_IF(macro, ...) macro(__VA_ARGS__)

#define GET_REAL(...)
#define GET_EXACT(...)
#define GET_TOTAL(...)
#define GET_FLAG(...)
#define GET_WHOLE(...)
#define GET_TEXT(...)
#define GET_VERDICT(...)
#define GET_METRIC(...)
#define GET_METRIC_TOTAL(...)
#define GET_REAL_BY(record, key, source) READER(double, get, record, key, source)
#define GET_EXACT_BY GET_REAL_BY
#define GET_SHOWN_BY GET_REAL_BY
#define GET_FLAG_BY(record, key, source) READER(bool, get, record, key, source)
#define GET_WHOLE_BY(record, key, source) READER(long, get, record, key, source)
#define GET_WHOLE_OR_NULL GET_WHOLE_BY
#define GET_TEXT_BY(record, key, source) READER(const char *, get, record, key, source)
#define GET_PART(record, key, source) WITH(RECORD_READER, record, key, UNWRAP source)
#define GET_LIST(record, key, source) WITH(LIST_READERS, record, key, UNWRAP source)
#define GET_MAP(record, key, source) WITH(MAP_READERS, record, key, UNWRAP source)
#define GET_SPREAD GET_MAP
#define GET_TEXTS(record, key, source) WITH(TEXT_READERS, record, key, UNWRAP source)
#define GET_REALS(record, key, source) WITH(NUMBER_READERS, record, key, UNWRAP source)
#define GET_EXACTS GET_REALS
#define GET_NAMED_REALS(record, key, source) WITH(NAMED_READERS, record, key, UNWRAP source)
#define GET_NAMED_EXACTS GET_NAMED_REALS
#define GET_IF(record, key, source) WITH_IF(IF_READERS, record, key, UNWRAP source)

#define CZ_RESULT(record, key, form, source, doc) GET_##form(record, key, source)
#define CZ_QUANTITY(record, key, form, source, ...) GET_##form(record, key, source)
#define CZ_METRIC(record, key, form, source, ...) GET_##form(record, key, source)
#define CZ_METRIC_BY(record, key, form, source, ...) GET_##form(record, key, source)
#include "report/documents.def"

/* ---- the table ---- */

/* An array of letters and a pointer to a text differ by their address only. */
#define STORED(place) _Generic(&(place), char ** : CZ_STORED_TEXT, default : STORED_VALUE(place))
#define STORED_VALUE(place)                                                                        \
    _Generic((place), double: CZ_STORED_DOUBLE, double *: CZ_STORED_DOUBLE, bool: CZ_STORED_BOOL,  \
             int: CZ_STORED_INT, long: CZ_STORED_LONG, char *: CZ_STORED_LETTERS,                  \
             const char *: CZ_STORED_TEXT, default: CZ_STORED_ENUM)
#define LENGTH(place) _Generic((place), double * : sizeof(place) / sizeof(double), default : 0)
#define MEMBER(record, source)                                                                     \
    .member = {STORED(((Of_##record *)0)->source), offsetof(Of_##record, source),                  \
               LENGTH(((Of_##record *)0)->source)}

#define HOW_REAL(record, key, source) .form = CZ_FORM_NUMBER, MEMBER(record, source)
#define HOW_EXACT(record, key, source) HOW_REAL(record, key, source), .is_exact = true
#define HOW_TOTAL(record, key, source) HOW_REAL(record, key, source), .is_total = true
#define HOW_FLAG(record, key, source) .form = CZ_FORM_FLAG, MEMBER(record, source)
#define HOW_WHOLE(record, key, source) .form = CZ_FORM_WHOLE, MEMBER(record, source)
#define HOW_TEXT(record, key, source) .form = CZ_FORM_TEXT, MEMBER(record, source)
#define HOW_VERDICT(record, key, source) .form = CZ_FORM_VERDICT, MEMBER(record, source)
#define HOW_METRIC(record, key, source) .form = CZ_FORM_UNWRITTEN
#define HOW_METRIC_TOTAL HOW_METRIC
#define HOW_REAL_BY(record, key, source) .form = CZ_FORM_NUMBER, .by.real = get_##record##_##key
#define HOW_EXACT_BY(record, key, source) HOW_REAL_BY(record, key, source), .is_exact = true
#define HOW_SHOWN_BY(record, key, source) .form = CZ_FORM_UNWRITTEN, .by.real = get_##record##_##key
#define HOW_FLAG_BY(record, key, source) .form = CZ_FORM_FLAG, .by.flag = get_##record##_##key
#define HOW_WHOLE_BY(record, key, source) .form = CZ_FORM_WHOLE, .by.whole = get_##record##_##key
#define HOW_WHOLE_OR_NULL(record, key, source)                                                     \
    HOW_WHOLE_BY(record, key, source), .is_null_below_0 = true
#define HOW_TEXT_BY(record, key, source) .form = CZ_FORM_TEXT, .by.text = get_##record##_##key
#define FIRST_RECORD(of, ...) CZ_RECORD_##of
#define HOW_PART(record_of, key, source)                                                           \
    .form = CZ_FORM_RECORD, .by.part = get_##record_of##_##key, .of = FIRST_RECORD source
#define HOW_LIST(record, key, source)                                                              \
    HOW_PART(record, key, source), .number = number_##record##_##key
#define HOW_MAP(record, key, source) HOW_LIST(record, key, source), .name = name_##record##_##key
#define HOW_SPREAD(record, key, source) HOW_MAP(record, key, source), .is_spread = true
#define HOW_TEXTS(record, key, source)                                                             \
    HOW_TEXT_BY(record, key, source), .number = number_##record##_##key
#define HOW_REALS(record, key, source)                                                             \
    HOW_REAL_BY(record, key, source), .number = number_##record##_##key
#define HOW_EXACTS(record, key, source) HOW_REALS(record, key, source), .is_exact = true
#define HOW_NAMED_REALS(record, key, source)                                                       \
    HOW_REALS(record, key, source), .name = name_##record##_##key
#define HOW_NAMED_EXACTS(record, key, source) HOW_NAMED_REALS(record, key, source), .is_exact = true
#define HOW_GIVEN(record, key, condition, form, ...)                                               \
    HOW_##form(record, key, (__VA_ARGS__)), .is_there = there_##record##_##key
#define HOW_IF(record, key, source) WITH_IF(HOW_GIVEN, record, key, UNWRAP source)

#define HEADING_UNTITLED .title = NULL
#define HEADING_TITLE(in_comparisons, in_tables, how)                                              \
    .title = in_comparisons, .heading = in_tables, .format = CZ_FORMAT_##how

#define ROW(record_of, key_of, form, source, unit_of, dimension_of, heading, text)                 \
    {.record = CZ_RECORD_##record_of,                                                              \
     .key = #key_of,                                                                               \
     .doc = text,                                                                                  \
     .unit = &cz_result_units[CZ_UNIT_OF_##unit_of],                                               \
     .dimension = CZ_DIMENSION_##dimension_of,                                                     \
     HEADING_##heading,                                                                            \
     HOW_##form(record_of, key_of, source)},
#define CZ_RESULT(record, key, form, source, doc)                                                  \
    ROW(record, key, form, source, NONE, PLANE, UNTITLED, doc)
#define CZ_QUANTITY ROW
#define CZ_METRIC(record, key, form, source, unit, dimension, heading, scale, absent, when, doc)   \
    ROW(record, key, form, source, unit, dimension, heading, doc)
#define CZ_METRIC_BY(record, key, form, source, unit, dimension, heading, judged, scale, absent,   \
                     when, doc)                                                                    \
    ROW(record, key, form, source, unit, dimension, heading, doc)

const CzResult cz_results[CZ_N_RESULT] = {
#include "report/documents.def"
};
