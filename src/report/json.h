/* A JSON document, written from top to bottom.
 *
 * cz_json_finish reports a failed allocation; the calls before it need no check. Keys keep their
 * order.
 */
#ifndef CZ_REPORT_JSON_H
#define CZ_REPORT_JSON_H

#include <stdbool.h>
#include <stdio.h>

#include "crushzone/status.h"

typedef struct CzJson CzJson;

/* A document with its outermost object open; NULL without memory, which every function accepts. */
CzJson *cz_json_create(void);

/* Opens a record or a list; key is NULL inside a list. */
void cz_json_open_object(CzJson *json, const char *key);
void cz_json_open_list(CzJson *json, const char *key);
void cz_json_close(CzJson *json);

/* Values; key is NULL inside a list. A NULL text and a number that is not finite become null; bytes
 * that are no UTF-8 become question marks. */
void cz_json_text(CzJson *json, const char *key, const char *text);
void cz_json_real(CzJson *json, const char *key, double value);  /* a quantity: figure.h */
void cz_json_exact(CzJson *json, const char *key, double value); /* typed, or measures an error */
void cz_json_whole(CzJson *json, const char *key, long value);
void cz_json_flag(CzJson *json, const char *key, bool value);

/* Closes what is open, writes the document and a line end, frees it. Reals get as few digits as
 * read back to the same double. Statuses: CZ_OK, CZ_STATUS_OUTPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_json_finish(CzJson *json, FILE *stream, CzError *error);

#endif
