/* Parts that the JSON documents share. */
#ifndef CZ_REPORT_DOCUMENTS_H
#define CZ_REPORT_DOCUMENTS_H

#include "crushzone/evaluate.h"
#include "crushzone/problem.h"
#include "crushzone/verify.h"
#include "report/json.h"

/* format, version, program and problem. */
void cz_document_head(CzJson *json, const char *format, const CzProblem *problem);

/* A verdict whose words are closed: a pass against a limit that nobody has confirmed is "pass" with
 * "provisional" beside it. */
void cz_document_verdict(CzJson *json, CzVerdict verdict);

/* The one place for timing, host and instruction set; n_job is 0 when unknown. */
void cz_document_run_info(CzJson *json, double wall_s, double setup_s, int n_job);

/* List of the warnings of the problem and of the kept runs. */
void cz_document_warnings(CzJson *json, const CzProblem *problem, const CzEvaluation *evaluation);

/* Where the turning and lifting of a body came from, into an open record: the n sources in `order`,
 * or all of them with NULL. */
void cz_document_budget(CzJson *json, const CzVehicleBudget *budget, int n, const int *order);

/* What each way of a verification changes most, as an object "ways". */
void cz_document_verified_ways(CzJson *json, const CzVerification *verification);

/* One mistake or warning with its place; key is NULL inside a list. */
void cz_document_mistake(CzJson *json, const char *key, const CzError *mistake);

#endif
