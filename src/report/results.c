/* Values of results, and the one writer of JSON. */
#include "report/results.h"

#include "report/figure.h"
#include "report/json.h"

#include <math.h>
#include <string.h>

/* ---- values ---- */

static const void *stored(const CzResult *result, const void *record) {
    return (const char *)record + result->member.offset;
}

static long whole_of(const CzResult *result, CzResultContext *context, const void *record) {
    if (result->by.whole != NULL)
        return result->by.whole(context, record);
    return result->member.stored == CZ_STORED_INT ? *(const int *)stored(result, record)
                                                  : *(const long *)stored(result, record);
}

/* The n-th number of a result, in its unit. */
static double number_at(const CzResult *result, CzResultContext *context, const void *record,
                        int n) {
    if (result->form == CZ_FORM_WHOLE)
        return (double)whole_of(result, context, record);
    double value = result->by.real != NULL ? result->by.real(context, record)
                                           : ((const double *)stored(result, record))[n];
    if (result->is_total)
        value = cz_run_total(context->run, value);
    return result->is_exact ? value : cz_result_in_unit(result->unit, value);
}

bool cz_result_flag(const CzResult *result, CzResultContext *context, const void *record) {
    return result->by.flag != NULL ? result->by.flag(context, record)
                                   : *(const bool *)stored(result, record);
}

const char *cz_result_words(const CzResult *result, CzResultContext *context, const void *record) {
    if (result->by.text != NULL)
        return result->by.text(context, record);
    if (result->form == CZ_FORM_VERDICT)
        return cz_verdict_text(*(const CzVerdict *)stored(result, record));
    return result->member.stored == CZ_STORED_LETTERS
               ? stored(result, record)
               : *(const char *const *)stored(result, record);
}

const char *cz_closed_verdict(CzVerdict verdict) {
    return cz_verdict_text(verdict == CZ_VERDICT_PROVISIONAL ? CZ_VERDICT_PASS : verdict);
}

double cz_result_number(const CzResult *result, CzResultContext *context, const void *record) {
    return number_at(result, context, record, 0);
}

const char *cz_result_text(char text[CZ_FIGURE_SIZE], const CzResult *result,
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

void cz_table_head_results(CzReportTable *table, int n, const CzResult *const *result) {
    for (int i = 0; i < n; i++) {
        char head[64];
        snprintf(head, sizeof head, ">%s", result[i]->heading);
        cz_table_head(table, head);
    }
}

void cz_table_put_results(CzReportTable *table, int n, const CzResult *const *result,
                          CzResultContext *context, const void *record, bool is_marked) {
    for (int i = 0; i < n; i++) {
        char text[CZ_FIGURE_SIZE];
        cz_result_text(text, result[i], context, record);
        cz_table_put(table, cz_figure_mark(text, is_marked));
    }
}

/* ---- JSON ---- */

static void put_number(CzJson *json, const CzResult *result, const char *key, double number) {
    if (result->is_exact)
        cz_json_exact(json, key, number);
    else
        cz_json_real(json, key, number);
}

static void put_array(CzJson *json, const CzResult *result, CzResultContext *context,
                      const void *record) {
    cz_json_open_list(json, result->key);
    for (int i = 0; i < result->member.n; i++)
        put_number(json, result, NULL, number_at(result, context, record, i));
    cz_json_close(json);
}

static void put_whole(CzJson *json, const CzResult *result, const char *key, long whole) {
    if (result->is_null_below_0 && whole < 0)
        cz_json_text(json, key, NULL);
    else
        cz_json_integer(json, key, whole);
}

static void put_results(CzJson *json, CzRecord record, CzResultContext *context, const void *data);

static void put_record(CzJson *json, const char *key, CzRecord record, CzResultContext *context,
                       const void *data) {
    cz_json_open_object(json, key);
    put_results(json, record, context, data);
    cz_json_close(json);
}

/* A value, or the current item of a list. */
static void put_value(CzJson *json, const CzResult *result, const char *key,
                      CzResultContext *context, const void *record) {
    switch (result->form) {
    case CZ_FORM_NUMBER:
        put_number(json, result, key, number_at(result, context, record, 0));
        break;
    case CZ_FORM_FLAG:
        cz_json_flag(json, key, cz_result_flag(result, context, record));
        break;
    case CZ_FORM_WHOLE:
        put_whole(json, result, key, whole_of(result, context, record));
        break;
    case CZ_FORM_TEXT:
        cz_json_text(json, key, cz_result_words(result, context, record));
        break;
    case CZ_FORM_VERDICT:
        cz_json_text(json, key, cz_closed_verdict(*(const CzVerdict *)stored(result, record)));
        break;
    case CZ_FORM_RECORD:
        put_record(json, key, result->of, context, result->by.part(context, record));
        break;
    case CZ_FORM_UNWRITTEN:
        break;
    }
}

static void put_list(CzJson *json, const CzResult *result, CzResultContext *context,
                     const void *record) {
    const int outer = context->index;
    const long n = result->number(context, record);
    if (result->name != NULL && !result->is_spread)
        cz_json_open_object(json, result->key);
    else if (!result->is_spread)
        cz_json_open_list(json, result->key);
    for (context->index = 0; context->index < n; context->index++)
        put_value(json, result, result->name != NULL ? result->name(context, record) : NULL,
                  context, record);
    if (!result->is_spread)
        cz_json_close(json);
    context->index = outer;
}

static void put_result(CzJson *json, const CzResult *result, CzResultContext *context,
                       const void *record) {
    if (result->is_there != NULL && !result->is_there(context, record))
        return;
    if (result->number != NULL)
        put_list(json, result, context, record);
    else if (result->member.n > 0)
        put_array(json, result, context, record);
    else
        put_value(json, result, result->key, context, record);
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
    CzJson json = {.stream = stream};
    put_record(&json, NULL, record, context, data);
    return cz_json_finish(&json, error);
}

void cz_results_write_line(CzRecord record, CzResultContext *context, const void *data,
                           FILE *stream) {
    CzJson json = {.stream = stream, .is_line = true};
    put_record(&json, NULL, record, context, data);
}

/* ---- all numbers ---- */

typedef struct Visit {
    CzResultContext *context;
    CzNumberVisitor *visit;
    void *data;
} Visit;

static void visit_results(const Visit *visit, const char *path, CzRecord record, const void *data);

/* The name of an item of a list, NULL for one without. */
static const char *name_of_item(const CzResult *result, CzResultContext *context,
                                const void *item) {
    for (int i = 0; i < CZ_N_RESULT; i++)
        if (cz_results[i].record == result->of && strcmp(cz_results[i].key, "name") == 0)
            return cz_result_words(&cz_results[i], context, item);
    return NULL;
}

static void visit_list(const Visit *visit, const char *path, const CzResult *result,
                       const void *record) {
    CzResultContext *context = visit->context;
    const int outer = context->index;
    const long n = result->number(context, record);
    for (context->index = 0; context->index < n; context->index++) {
        char inside[2 * CZ_PATH_SIZE];
        const bool is_record = result->form == CZ_FORM_RECORD;
        const void *item = is_record ? result->by.part(context, record) : NULL;
        const char *name = result->name != NULL ? result->name(context, record)
                           : is_record          ? name_of_item(result, context, item)
                                                : NULL;
        if (name != NULL)
            snprintf(inside, sizeof inside, "%.380s.%.100s", path, name);
        else
            snprintf(inside, sizeof inside, "%.380s[%d]", path, context->index);
        if (is_record)
            visit_results(visit, inside, result->of, item);
        else if (result->form == CZ_FORM_NUMBER)
            visit->visit(inside, result, number_at(result, context, record, 0), visit->data);
    }
    context->index = outer;
}

static void visit_result(const Visit *visit, const char *path, const CzResult *result,
                         const void *record) {
    CzResultContext *context = visit->context;
    char inside[2 * CZ_PATH_SIZE];
    const bool is_number = result->form == CZ_FORM_NUMBER || result->form == CZ_FORM_WHOLE;
    if (result->is_there != NULL && !result->is_there(context, record))
        return;
    snprintf(inside, sizeof inside, "%.380s%s%.100s", path, path[0] != '\0' ? "." : "",
             result->key);
    if (result->number != NULL) {
        visit_list(visit, result->is_spread ? path : inside, result, record);
    } else if (result->form == CZ_FORM_RECORD) {
        visit_results(visit, inside, result->of, result->by.part(context, record));
    } else if (is_number && result->member.n > 0) {
        for (int i = 0; i < result->member.n; i++) {
            char item[2 * CZ_PATH_SIZE + 16];
            snprintf(item, sizeof item, "%s[%d]", inside, i);
            visit->visit(item, result, number_at(result, context, record, i), visit->data);
        }
    } else if (is_number) {
        visit->visit(inside, result, number_at(result, context, record, 0), visit->data);
    }
}

static void visit_results(const Visit *visit, const char *path, CzRecord record, const void *data) {
    for (int i = 0; i < CZ_N_RESULT; i++) {
        const CzRecord of = cz_results[i].of;
        const bool is_left_out = cz_results[i].form == CZ_FORM_RECORD &&
                                 (of == CZ_RECORD_RUN_INFO || of == CZ_RECORD_EVENT);
        if (cz_results[i].record == record && !is_left_out)
            visit_result(visit, path, &cz_results[i], data);
    }
}

void cz_results_visit(CzRecord record, CzResultContext *context, const void *data,
                      CzNumberVisitor *visit, void *visitor) {
    const Visit all = {context, visit, visitor};
    visit_results(&all, "", record, data);
}
