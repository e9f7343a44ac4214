/* Values of results, and the one writer of JSON. */
#include "report/results.h"

#include "report/figure.h"
#include "report/json.h"

#include <math.h>

/* ---- values ---- */

static const void *stored(const CzResult *result, const void *record) {
    return (const char *)record + result->member.offset;
}

bool cz_result_is_exact(const CzResult *result) {
    return result->form == CZ_FORM_EXACT || result->form == CZ_FORM_EXACT_BY ||
           result->form == CZ_FORM_EXACTS || result->form == CZ_FORM_NAMED_EXACTS;
}

/* Its n-th number in its unit. */
static double number_at(const CzResult *result, CzResultContext *context, const void *record,
                        int n) {
    if (result->by.real == NULL && result->member.stored != CZ_STORED_DOUBLE)
        return NAN;
    double value = result->by.real != NULL ? result->by.real(context, record)
                                           : ((const double *)stored(result, record))[n];
    if (result->form == CZ_FORM_TOTAL)
        value = cz_run_total(context->run, value);
    return cz_result_is_exact(result) ? value : cz_result_in_unit(result->unit, value);
}

static long whole_of(const CzResult *result, CzResultContext *context, const void *record) {
    if (result->form == CZ_FORM_WHOLE_BY)
        return result->by.whole(context, record);
    return result->member.stored == CZ_STORED_INT ? *(const int *)stored(result, record)
                                                  : *(const long *)stored(result, record);
}

bool cz_result_flag(const CzResult *result, CzResultContext *context, const void *record) {
    if (result->form == CZ_FORM_FLAG_BY)
        return result->by.flag(context, record);
    if (result->form == CZ_FORM_PROVISIONAL)
        return *(const CzVerdict *)stored(result, record) == CZ_VERDICT_PROVISIONAL;
    return *(const bool *)stored(result, record);
}

const char *cz_result_words(const CzResult *result, CzResultContext *context, const void *record) {
    if (result->form == CZ_FORM_TEXT_BY || result->form == CZ_FORM_TEXT_IF_BY)
        return result->by.text(context, record);
    if (result->form == CZ_FORM_VERDICT)
        return cz_verdict_text(*(const CzVerdict *)stored(result, record));
    const char *text = result->member.stored == CZ_STORED_LETTERS
                           ? stored(result, record)
                           : *(const char *const *)stored(result, record);
    return result->form == CZ_FORM_TEXT_OR_NULL && text[0] == '\0' ? NULL : text;
}

const char *cz_closed_verdict(CzVerdict verdict) {
    return cz_verdict_text(verdict == CZ_VERDICT_PROVISIONAL ? CZ_VERDICT_PASS : verdict);
}

double cz_result_number(const CzResult *result, CzResultContext *context, const void *record) {
    return number_at(result, context, record, 0);
}

const char *cz_result_text(char text[CZ_FIGURE_ROOM], const CzResult *result,
                           CzResultContext *context, const void *record) {
    const double number = cz_result_number(result, context, record);
    switch (result->format) {
    case CZ_FORMAT_ROUND:
        return cz_figure_fixed(text, 0, number);
    case CZ_FORMAT_PERCENT:
        return cz_figure_percent(text, number);
    case CZ_FORMAT_PLAIN:
        break;
    }
    return cz_figure_plain(text, number);
}

/* ---- JSON ---- */

static void put_number(CzJson *json, const CzResult *result, const char *key, double number) {
    if (cz_result_is_exact(result))
        cz_json_exact(json, key, number);
    else
        cz_json_real(json, key, number);
}

static void put_numbers(CzJson *json, const CzResult *result, CzResultContext *context,
                        const void *record) {
    if (result->member.n == 0) {
        put_number(json, result, result->key, number_at(result, context, record, 0));
        return;
    }
    cz_json_open_list(json, result->key);
    for (int i = 0; i < result->member.n; i++)
        put_number(json, result, NULL, number_at(result, context, record, i));
    cz_json_close(json);
}

static void put_results(CzJson *json, CzRecord record, CzResultContext *context, const void *data);

static void put_record(CzJson *json, const char *key, CzRecord record, CzResultContext *context,
                       const void *data) {
    cz_json_open_object(json, key);
    put_results(json, record, context, data);
    cz_json_close(json);
}

static void put_records(CzJson *json, const CzResult *result, CzResultContext *context,
                        const void *record) {
    if (result->form == CZ_FORM_LIST_IF && !result->is_there(context, record))
        return;
    const void *item = result->by.item(context, record, 0);
    cz_json_open_list(json, result->key);
    for (int i = 0; item != NULL; item = result->by.item(context, record, ++i))
        put_record(json, NULL, result->of, context, item);
    cz_json_close(json);
}

static void put_entries(CzJson *json, const CzResult *result, CzResultContext *context,
                        const void *record) {
    const char *name = NULL;
    const void *item = result->by.entry(context, record, 0, &name);
    const bool is_map = result->form == CZ_FORM_MAP && item != NULL;
    if (is_map)
        cz_json_open_object(json, result->key);
    for (int i = 0; item != NULL; item = result->by.entry(context, record, ++i, &name))
        put_record(json, name, result->of, context, item);
    if (is_map)
        cz_json_close(json);
}

static void put_texts(CzJson *json, const CzResult *result, CzResultContext *context,
                      const void *record) {
    const char *text;
    cz_json_open_list(json, result->key);
    for (int i = 0; (text = result->by.nth_text(context, record, i)) != NULL; i++)
        cz_json_text(json, NULL, text);
    cz_json_close(json);
}

/* Numbers of which the program knows how many only when it runs. */
static void put_series(CzJson *json, const CzResult *result, CzResultContext *context,
                       const void *record) {
    const bool is_named =
        result->form == CZ_FORM_NAMED_REALS || result->form == CZ_FORM_NAMED_EXACTS;
    CzNamedNumber number = {0};
    context->at = result;
    if (is_named)
        cz_json_open_object(json, result->key);
    else
        cz_json_open_list(json, result->key);
    for (int i = 0; result->by.nth_number(context, record, i, &number); i++)
        put_number(json, result, is_named ? number.name : NULL, number.value);
    cz_json_close(json);
}

static void put_whole(CzJson *json, const CzResult *result, long whole) {
    if (result->form == CZ_FORM_WHOLE_BY && whole < 0)
        cz_json_text(json, result->key, NULL);
    else
        cz_json_whole(json, result->key, whole);
}

static void put_text(CzJson *json, const CzResult *result, CzResultContext *context,
                     const void *record) {
    const char *text = cz_result_words(result, context, record);
    const bool may_lack = result->form == CZ_FORM_TEXT_IF || result->form == CZ_FORM_TEXT_IF_BY;
    if (text != NULL || !may_lack)
        cz_json_text(json, result->key, text);
}

static void put_result(CzJson *json, const CzResult *result, CzResultContext *context,
                       const void *record) {
    switch (result->form) {
    case CZ_FORM_REAL:
    case CZ_FORM_REAL_BY:
    case CZ_FORM_EXACT:
    case CZ_FORM_EXACT_BY:
    case CZ_FORM_TOTAL:
        put_numbers(json, result, context, record);
        break;
    case CZ_FORM_REAL_IF_BY:
        if (!isnan(number_at(result, context, record, 0)))
            put_numbers(json, result, context, record);
        break;
    case CZ_FORM_FLAG:
    case CZ_FORM_FLAG_BY:
    case CZ_FORM_PROVISIONAL:
        cz_json_flag(json, result->key, cz_result_flag(result, context, record));
        break;
    case CZ_FORM_FLAG_IF_BY:
        if (result->by.whole(context, record) >= 0)
            cz_json_flag(json, result->key, result->by.whole(context, record) > 0);
        break;
    case CZ_FORM_WHOLE:
    case CZ_FORM_WHOLE_BY:
        put_whole(json, result, whole_of(result, context, record));
        break;
    case CZ_FORM_TEXT:
    case CZ_FORM_TEXT_OR_NULL:
    case CZ_FORM_TEXT_BY:
    case CZ_FORM_TEXT_IF:
    case CZ_FORM_TEXT_IF_BY:
        put_text(json, result, context, record);
        break;
    case CZ_FORM_VERDICT:
        cz_json_text(json, result->key,
                     cz_closed_verdict(*(const CzVerdict *)stored(result, record)));
        break;
    case CZ_FORM_PART:
    case CZ_FORM_PART_IF:
        if (result->by.part(context, record) != NULL)
            put_record(json, result->key, result->of, context, result->by.part(context, record));
        break;
    case CZ_FORM_LIST:
    case CZ_FORM_LIST_IF:
        put_records(json, result, context, record);
        break;
    case CZ_FORM_MAP:
    case CZ_FORM_SPREAD:
        put_entries(json, result, context, record);
        break;
    case CZ_FORM_TEXTS:
        put_texts(json, result, context, record);
        break;
    case CZ_FORM_REALS:
    case CZ_FORM_EXACTS:
    case CZ_FORM_NAMED_REALS:
    case CZ_FORM_NAMED_EXACTS:
        put_series(json, result, context, record);
        break;
    case CZ_FORM_SHOWN_BY:
    case CZ_FORM_METRIC:
    case CZ_FORM_METRIC_TOTAL:
        break;
    }
}

static void put_results(CzJson *json, CzRecord record, CzResultContext *context, const void *data) {
    if (record == CZ_RECORD_RUN)
        context->run = data;
    for (int i = 0; i < CZ_N_RESULT; i++)
        if (cz_results[i].record == record)
            put_result(json, &cz_results[i], context, data);
}

CzStatus cz_results_write(CzRecord record, CzResultContext *context, const void *data, FILE *stream,
                          CzError *error) {
    CzJson *json = cz_json_create();
    put_results(json, record, context, data);
    return cz_json_finish(json, stream, error);
}
