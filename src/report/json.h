/* A JSON document, written from top to bottom, two blanks a level or on one line. */
#ifndef CZ_REPORT_JSON_H
#define CZ_REPORT_JSON_H

#include <stdbool.h>
#include <stdio.h>

#include "crushzone/status.h"

typedef struct CzJson {
    FILE *stream;
    int depth;     /* records and lists that are open */
    char end[16];  /* the sign that closes each, outermost first; no document is that deep */
    bool has_item; /* the innermost has an item already */
    bool is_line;  /* the document is one line */
} CzJson;

/* Opens a record or a list; the key is NULL inside a list and for the document. */
void cz_json_open_object(CzJson *json, const char *key);
void cz_json_open_list(CzJson *json, const char *key);
void cz_json_close(CzJson *json);

/* Values; key is NULL inside a list. A NULL text and a number that is not finite become null; bytes
 * that are not UTF-8 become question marks. Reals have the fewest digits that are read back as the
 * same double.
 */
void cz_json_text(CzJson *json, const char *key, const char *text);
void cz_json_real(CzJson *json, const char *key, double value);  /* a quantity: figure.h */
void cz_json_exact(CzJson *json, const char *key, double value); /* typed, or measures an error */
void cz_json_integer(CzJson *json, const char *key, long value);
void cz_json_flag(CzJson *json, const char *key, bool value);

/* Ends a document that is closed. Status: CZ_STATUS_OUTPUT. */
CZ_MUST_CHECK CzStatus cz_json_finish(CzJson *json, CzError *error);

#endif
