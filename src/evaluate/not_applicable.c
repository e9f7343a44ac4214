/* Lists scenarios of the profile that do not apply to a problem. */
#include "evaluate/not_applicable.h"

#include <stdio.h>

#include "base/error.h"

CzStatus cz_not_applicable_list(const CzProblem *problem, CzArena *arena, CzChecklist *list,
                                CzError *error) {
    int n_asked;
    const CzAskedScenario *asked = cz_problem_asked(problem, &n_asked);
    const char **text = cz_arena_allocate(arena, (size_t)n_asked + 1, sizeof *text);
    list->not_applicable = text;
    for (int i = 0; text != NULL && i < n_asked; i++) {
        char line[400];
        if (asked[i].standing != CZ_STANDING_NOT_APPLICABLE)
            continue;
        const int n =
            snprintf(line, sizeof line, "%.60s: %.300s", asked[i].scenario->name, asked[i].why);
        text[list->n_not_applicable++] = cz_arena_copy_text(arena, line, (size_t)n);
    }
    return arena->out_of_memory ? cz_no_memory(error, "the checks") : CZ_OK;
}
