/* Rules between values, by what they look at; the header of all rules_*.c. Values that could not
 * be read are NaN and break no rule, so that the rules hold even for a problem with other mistakes.
 */
#ifndef CZ_PROBLEM_RULES_H
#define CZ_PROBLEM_RULES_H

#include "problem/rule.h"

void cz_rules_check_end(const CzRules *rules, const CzVehicle *vehicle, const CzEnd *end);
void cz_rules_check_vehicle(const CzRules *rules, const CzVehicle *vehicle);
void cz_rules_check_names(const CzRules *rules);
void cz_rules_check_trains(const CzRules *rules);
void cz_rules_check_scenarios(const CzRules *rules);
/* Fills the targets of each variable (n_variables), which are allocated with malloc. */
void cz_rules_check_design(const CzRules *rules, CzTargets *targets);
void cz_rules_check_fit(const CzRules *rules);

/* All rules but those on limits and variables. */
void cz_rules_check_collision(const CzRules *rules);

#endif
