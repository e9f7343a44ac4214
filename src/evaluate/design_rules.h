/* The design rules as checks, with the numbers that the problem gives them. */
#ifndef CZ_EVALUATE_DESIGN_RULES_H
#define CZ_EVALUATE_DESIGN_RULES_H

#include "base/suggest.h"
#include "evaluate/checklist_parts.h"

/* Whether there is a design rule of this name. */
bool cz_design_rule_is(const char *name, CzSuggestion *nearest);

/* Adds them in their scenarios, and as not checked those whose scenario is missing. Statuses:
 * CZ_OK, CZ_STATUS_INPUT with the place in the file, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_design_rules_append(CzChecklistBuilder *builder);

#endif
