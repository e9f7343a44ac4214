/* Rules between values: their context, and the functions of rules_*.c, by the record that they
 * check. Each rule is a small function that checks one record and reports a violation. Values that
 * could not be read are NaN and violate no rule, so that the rules can be checked in a problem with
 * other mistakes. */
#ifndef CZ_PROBLEM_RULES_H
#define CZ_PROBLEM_RULES_H

#include "problem/reading.h"

typedef struct CzRules {
    const CzProblem *problem;
    const CzReader *reader;
    const CzInput *input;
    const CzVehicle *vehicle;        /* the vehicles to check: the problem's own or a candidate's */
    CzMistakes *mistakes, *warnings; /* where to report; both may be NULL */
    double *ratio; /* how close each rule is to a violation, the largest so far (CZ_N_VALUE_RULE);
                      NULL when not requested */
} CzRules;

/* Context for checking a problem as written and reporting to its reader. */
CzRules cz_rules_of(CzProblem *problem);

/* Records a number and its upper limit by a rule, in SI; returns whether it is above the limit. */
bool cz_rule_note(const CzRules *rules, CzValueRule rule, double value, double most);

/* Reports a mistake at the place where a field was written, or at its record when it was not. */
void cz_rule_broken(const CzRules *rules, const void *field, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* The same as a warning. */
void cz_rule_warning(const CzRules *rules, const void *field, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Reports that something is absent; except when it may be in a record that could not be read.
 */
void cz_rule_absent(const CzRules *rules, const void *field, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Whether a field was written in a file, rightly or not. */
bool cz_rule_is_written(const CzRules *rules, const void *field);

/* Whether a field was written in a file for more problems than this one, such as a profile. */
bool cz_rule_is_general(const CzRules *rules, const void *field);

/* Text of a number with its unit for a sentence, such as "300 mm". */
const char *cz_rule_text(char text[48], double si, const char *unit, double unit_si);
#define CZ_IN_UNIT(si, unit, unit_si) cz_rule_text((char[48]){0}, (si), (unit), (unit_si))
#define CZ_MM(si) CZ_IN_UNIT(si, "mm", 1e-3)
#define CZ_KN(si) CZ_IN_UNIT(si, "kN", 1e3)

/* ---- the rules ---- */

void cz_rules_check_end(const CzRules *rules, const CzVehicle *vehicle, const CzEnd *end);
void cz_rules_check_vehicle(const CzRules *rules, const CzVehicle *vehicle);
void cz_rules_check_names(const CzRules *rules);
void cz_rules_check_trains(const CzRules *rules);
void cz_rules_check_scenarios(const CzRules *rules);
/* Fills the targets of each variable (n_variables), which are allocated with malloc. */
void cz_rules_check_design(const CzRules *rules, CzTargets *targets);
/* A word that is not in the list makes limits PROVISIONAL; it may be a typing error of `user`,
 * which is a warning only. */
void cz_rules_check_confidence(const CzRules *rules, const char *const *confidence);
/* A profile as written, and the scenarios of one category with the values of those they are like.
 */
void cz_rules_check_profile(const CzRules *rules, const CzProfile *profile, const char *path);
void cz_rules_check_profile_scenarios(const CzRules *rules, const CzProfile *profile);
void cz_rules_check_fit(const CzRules *rules);

void cz_rules_check_scenario_names(const CzRules *rules, const CzTexts *names);
void cz_rules_check_uncertainty(const CzRules *rules);

/* All rules except those on limits, variables and uncertain numbers. */
void cz_rules_check_collision(const CzRules *rules);

/* The same for a problem that was bound again; returns its first mistake. Statuses: CZ_OK,
 * CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_rules_check_again(CzProblem *made, CzError *error);

#endif
