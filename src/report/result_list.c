/* The list of results as a table. */
#include "report/result_values.h"

#include <stddef.h>

/* Of a run, an evaluation or a verification. */
static const char *status_word(CzStatus status) {
    return status == CZ_OK ? "completed" : "failed";
}

/* The struct of each record. */
#define CZ_RECORD(record, type, doc) typedef type Of_##record;
#include "evaluate/result_records.def"
#include "report/document_records.def"
#undef CZ_RECORD

const char *const cz_record_names[CZ_N_RECORD] = {
#define CZ_RECORD(record, type, doc) #record,
#include "evaluate/result_records.def"
#include "report/document_records.def"
#undef CZ_RECORD
};

const char *const cz_record_docs[CZ_N_RECORD] = {
#define CZ_RECORD(record, type, doc) doc,
#include "evaluate/result_records.def"
#include "report/document_records.def"
#undef CZ_RECORD
};

/* What lists and words of members are read by. */
#define CZ_RESULT_ITEMS(record_of, key, of, array, number, doc)                                    \
    static const void *items_##record_of##_##key(CzResultContext *context, const void *record,     \
                                                 int index) {                                      \
        (void)context;                                                                             \
        return index < ((const Of_##record_of *)record)->number                                    \
                   ? &((const Of_##record_of *)record)->array[index]                               \
                   : NULL;                                                                         \
    }
#define CZ_RESULT_WORD(record_of, key, member, function, doc)                                      \
    static const char *word_##record_of##_##key(CzResultContext *context, const void *record) {    \
        (void)context;                                                                             \
        return function(((const Of_##record_of *)record)->member);                                 \
    }
#include "report/documents.def"

#define STORED(place)                                                                              \
    _Generic((place), double: CZ_STORED_DOUBLE, double *: CZ_STORED_DOUBLE, bool: CZ_STORED_BOOL,  \
             int: CZ_STORED_INT, long: CZ_STORED_LONG, char *: CZ_STORED_LETTERS,                  \
             const char *: CZ_STORED_TEXT, default: CZ_STORED_ENUM)
#define LENGTH(place) _Generic((place), double * : sizeof(place) / sizeof(double), default : 0)
#define MEMBER(record, source)                                                                     \
    .member = {STORED(((Of_##record *)0)->source), offsetof(Of_##record, source),                  \
               LENGTH(((Of_##record *)0)->source)}

#define HOW_REAL MEMBER
#define HOW_EXACT MEMBER
#define HOW_TOTAL MEMBER
#define HOW_FLAG MEMBER
#define HOW_WHOLE MEMBER
#define HOW_TEXT MEMBER
#define HOW_TEXT_OR_NULL MEMBER
#define HOW_TEXT_IF MEMBER
#define HOW_VERDICT MEMBER
#define HOW_PROVISIONAL MEMBER
#define HOW_REAL_BY(record, source) .by.real = cz_value_##source
#define HOW_EXACT_BY HOW_REAL_BY
#define HOW_REAL_IF_BY HOW_REAL_BY
#define HOW_SHOWN_BY HOW_REAL_BY
#define HOW_FLAG_BY(record, source) .by.flag = cz_value_##source
#define HOW_WHOLE_BY(record, source) .by.whole = cz_value_##source
#define HOW_TEXT_BY(record, source) .by.text = cz_value_##source
#define HOW_TEXT_IF_BY HOW_TEXT_BY
#define HOW_FLAG_IF_BY HOW_WHOLE_BY
#define HOW_METRIC(record, source) .by.real = NULL
#define HOW_METRIC_TOTAL HOW_METRIC

#define UNTITLED .title = NULL
#define TITLE(in_comparisons, in_tables, how)                                                      \
    .title = in_comparisons, .heading = in_tables, .format = CZ_FORMAT_##how

/* One row of the table; what it is made of is in the same order in every kind of line. */
#define ENTRY(record_of, key_of, form_of, text)                                                    \
    .record = CZ_RECORD_##record_of, .key = #key_of, .form = CZ_FORM_##form_of, .doc = text
#define NUMBER(unit_of, dimension_of)                                                              \
    .unit = &cz_result_units[CZ_UNIT_OF_##unit_of], .dimension = CZ_DIMENSION_##dimension_of

#define CZ_RESULT(record, key, form, source, unit, dimension, heading, doc)                        \
    {ENTRY(record, key, form, doc), HOW_##form(record, source), NUMBER(unit, dimension), heading},
#define CZ_METRIC(record, key, form, source, unit, dimension, heading, scale, absent, when, doc)   \
    {ENTRY(record, key, form, doc), HOW_##form(record, source), NUMBER(unit, dimension), heading},
#define CZ_METRIC_BY(record, key, form, source, unit, dimension, heading, judge, scale, absent,    \
                     when, doc)                                                                    \
    {ENTRY(record, key, form, doc), HOW_##form(record, source), NUMBER(unit, dimension), heading},
#define CZ_RESULT_PART(record, key, whose, source, doc)                                            \
    {ENTRY(record, key, PART, doc), .by.part = cz_value_##source, .of = CZ_RECORD_##whose},
#define CZ_RESULT_PART_IF(record, key, whose, source, doc)                                         \
    {ENTRY(record, key, PART_IF, doc), .by.part = cz_value_##source, .of = CZ_RECORD_##whose},
#define CZ_RESULT_LIST(record, key, whose, source, doc)                                            \
    {ENTRY(record, key, LIST, doc), .by.item = cz_value_##source, .of = CZ_RECORD_##whose},
#define CZ_RESULT_ITEMS(record, key, whose, array, number, doc)                                    \
    {ENTRY(record, key, LIST, doc), .by.item = items_##record##_##key, .of = CZ_RECORD_##whose},
#define CZ_RESULT_WORD(record, key, member, function, doc)                                         \
    {ENTRY(record, key, TEXT_BY, doc), .by.text = word_##record##_##key,                           \
     .unit = &cz_result_units[CZ_UNIT_OF_NONE]},
#define CZ_RESULT_LIST_IF(record, key, whose, source, there, doc)                                  \
    {ENTRY(record, key, LIST_IF, doc), .by.item = cz_value_##source, .of = CZ_RECORD_##whose,      \
     .is_there = cz_value_##there},
#define CZ_RESULT_MAP(record, key, form, whose, source, doc)                                       \
    {ENTRY(record, key, form, doc), .by.entry = cz_value_##source, .of = CZ_RECORD_##whose},
#define CZ_RESULT_NUMBERS(record, key, form, source, doc)                                          \
    {ENTRY(record, key, form, doc), .by.nth_number = cz_value_##source},
#define CZ_RESULT_TEXTS(record, key, source, doc)                                                  \
    {ENTRY(record, key, TEXTS, doc), .by.nth_text = cz_value_##source},

const CzResult cz_results[CZ_N_RESULT] = {
#include "report/documents.def"
};
