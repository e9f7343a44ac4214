/* Cases: scenarios of a problem once more, with values of the uncertain numbers and the envelope.
 *
 *   values of draws --> changes --problem/cases.c--> problem with further scenarios --> evaluator
 */
#ifndef CZ_EVALUATE_CASES_H
#define CZ_EVALUATE_CASES_H

#include "crushzone/sample.h"
#include "evaluate/evaluator_parts.h"

/* What the cases of a problem have in common. Borrowed. */
typedef struct CzCases {
    const CzProblem *problem;
    int n_scenario;
    const int *scenario; /* scenarios that are changed (n_scenario) */
    int n_draw;
    const CzDraw *draw;        /* (n_draw) */
    const char *word;          /* in the names of cases, such as "sample" */
    int n_earlier;             /* cases of this word among the scenarios of the problem */
    const CzEvaluator *beside; /* whose tracks the cases use where they are the same; NULL for
                                  none */
} CzCases;

/* Lists the scenarios of these names or families; where there are no names all but overload cases
 * and those without reserves, which are cases themselves;
 * `field` is the place of the names in the input. Memory comes from the arena. Statuses: CZ_OK,
 * CZ_STATUS_INPUT when there is none, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_cases_scenarios(const CzProblem *problem, const CzTexts *names,
                                          CzArena *arena, int *n_scenario, const int **scenario,
                                          CzError *error);

/* The largest number of a case of this word among the scenarios of a problem; 0 without any. */
int cz_cases_n_earlier(const CzProblem *problem, const char *word);

/* Name of a scenario of the list in a case, which is counted from 0, behind earlier ones. */
void cz_case_name(const CzCases *cases, int scenario, int number, char name[CZ_NAME_SIZE]);

/* The change that sets the value of a draw at one of its paths. */
static inline CzCaseChange cz_case_change(const CzDraw *draw, int path, double value) {
    static const CzCaseKind kinds[] = {[CZ_DRAW_VALUE] = CZ_CASE_VALUE,
                                       [CZ_DRAW_FACTOR] = CZ_CASE_FACTOR,
                                       [CZ_DRAW_ADD] = CZ_CASE_ADD};
    return (CzCaseChange){.path = draw->path[path], .kind = kinds[draw->effect], .number = value};
}

/* Number of changes of a case, and the changes that set these values (n_draw) of its draws. */
int cz_cases_n_change(const CzCases *cases);
void cz_case_changes(const CzCases *cases, const double *value, CzCaseChange *change);

/* A problem with some cases, and its evaluator, which runs nothing else, in one thread. The
 * scenarios of a case follow one another, behind those of the file. */
typedef struct CzCaseBench {
    CzProblem *problem;
    CzEvaluator *evaluator;
} CzCaseBench;

/* Number of the case without changes. */
enum { CZ_UNCHANGED_CASE = -1 };

/* Builds the bench of n cases, or of CZ_UNCHANGED_CASE alone; case number k has the values from
 * value[k n_draw] on. Freed also after a failure. Statuses: CZ_OK, CZ_STATUS_INPUT when the reader
 * refuses the values of a case, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_case_bench_build(const CzCases *cases, int n, const int *number,
                                           const double *value, CzCaseBench *bench, CzError *error);
void cz_case_bench_free(CzCaseBench *bench);

/* ---- checks ---- */

/* A check of a scenario of the list. */
typedef struct CzCaseCheck {
    const char *name;
    int scenario; /* its place in the list */
    bool is_flag; /* a yes or no, without margins */
} CzCaseCheck;

typedef struct CzCaseChecks {
    int n;
    CzCaseCheck *check; /* (n) */
} CzCaseChecks;

/* Adds the checks of the first case of a bench that are not listed yet: a rule of the design is
 * judged only where values are changed, and a changed speed may change the rules of a scenario.
 * Memory comes from the arena. Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_case_checks_add(const CzCases *cases, const CzCaseBench *bench,
                                          CzArena *arena, CzCaseChecks *checks, CzError *error);

/* The check of the list that the i-th result of an evaluation belongs to, where the result is of
 * the scenario of that name, which is a scenario of the list; else -1. */
int cz_case_check_of(const CzCaseChecks *checks, const CzEvaluation *evaluation, int i,
                     int scenario, const char *scenario_name);

/* Why a run failed or is incomplete, with the name of a scenario, to be freed; NULL without memory.
 */
char *cz_case_failure(const CzRunSummary *run, const char *scenario);

#endif
