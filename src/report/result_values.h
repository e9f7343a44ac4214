/* The functions that results.def and documents.def name: values that are no member of a record. */
#ifndef CZ_REPORT_RESULT_VALUES_H
#define CZ_REPORT_RESULT_VALUES_H

#include "report/results.h"

#define DECLARE_REAL(source)
#define DECLARE_EXACT(source)
#define DECLARE_TOTAL(source)
#define DECLARE_FLAG(source)
#define DECLARE_WHOLE(source)
#define DECLARE_TEXT(source)
#define DECLARE_TEXT_OR_NULL(source)
#define DECLARE_TEXT_IF(source)
#define DECLARE_VERDICT(source)
#define DECLARE_PROVISIONAL(source)
#define DECLARE_METRIC(source)
#define DECLARE_METRIC_TOTAL(source)
#define DECLARE_REAL_BY(source)                                                                    \
    double cz_value_##source(CzResultContext *context, const void *record);
#define DECLARE_EXACT_BY DECLARE_REAL_BY
#define DECLARE_REAL_IF_BY DECLARE_REAL_BY
#define DECLARE_SHOWN_BY DECLARE_REAL_BY
#define DECLARE_FLAG_BY(source)                                                                    \
    bool cz_value_##source(CzResultContext *context, const void *record);
#define DECLARE_WHOLE_BY(source)                                                                   \
    long cz_value_##source(CzResultContext *context, const void *record);
#define DECLARE_TEXT_BY(source)                                                                    \
    const char *cz_value_##source(CzResultContext *context, const void *record);
#define DECLARE_TEXT_IF_BY DECLARE_TEXT_BY
#define DECLARE_FLAG_IF_BY DECLARE_WHOLE_BY
#define CZ_RESULT(record, key, form, source, ...) DECLARE_##form(source)
#define CZ_METRIC(record, key, form, source, ...) DECLARE_##form(source)
#define CZ_METRIC_BY(record, key, form, source, ...) DECLARE_##form(source)
#define CZ_RESULT_PART(record, key, of, source, doc)                                               \
    const void *cz_value_##source(CzResultContext *context, const void *record);
#define CZ_RESULT_PART_IF(record, key, of, source, doc)                                            \
    const void *cz_value_##source(CzResultContext *context, const void *record);
#define CZ_RESULT_LIST(record, key, of, source, doc)                                               \
    const void *cz_value_##source(CzResultContext *context, const void *record, int index);
#define CZ_RESULT_TEXTS(record, key, source, doc)                                                  \
    const char *cz_value_##source(CzResultContext *context, const void *record, int index);
#define CZ_RESULT_LIST_IF(record, key, of, source, there, doc)                                     \
    bool cz_value_##there(CzResultContext *context, const void *record);                           \
    const void *cz_value_##source(CzResultContext *context, const void *record, int index);
#define CZ_RESULT_MAP(record, key, form, of, source, doc)                                          \
    const void *cz_value_##source(CzResultContext *context, const void *record, int index,         \
                                  const char **name);
#define CZ_RESULT_NUMBERS(record, key, form, source, doc)                                          \
    bool cz_value_##source(CzResultContext *context, const void *record, int index,                \
                           CzNamedNumber *number);
#include "report/documents.def"

#endif
