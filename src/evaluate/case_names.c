/* Names of cases: of the scenario, with a word and a number. */
#include "evaluate/cases.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"

int cz_cases_n_earlier(const CzProblem *problem, const char *word) {
    const size_t n = strlen(word);
    int most = 0;
    for (int s = 0; s < cz_problem_n_scenario(problem); s++) {
        const char *name = cz_problem_scenario_name(problem, s), *dash = strrchr(name, '-');
        int number;
        if (dash != NULL && (size_t)(dash - name) > n && strncmp(dash - n, word, n) == 0 &&
            sscanf(dash, "-%9d", &number) == 1 && number > most)
            most = number;
    }
    return most;
}

void cz_case_name(const CzCases *cases, int scenario, int number, char name[CZ_NAME_SIZE]) {
    char end[CZ_NAME_SIZE];
    const char *own = cz_problem_scenario_name(cases->problem, cases->scenario[scenario]);
    number = cases->n_earlier + 1 + (number < 0 ? 0 : number);
    snprintf(end, sizeof end, "-%.12s-%d", cases->word, number);
    if (strlen(own) + strlen(end) > CZ_MAX_NAME) /* unlike that of another that is cut */
        snprintf(end, sizeof end, "-%d-%.12s-%d", cases->scenario[scenario] + 1, cases->word,
                 number);
    cz_text_copy(name, CZ_NAME_SIZE - strlen(end), own);
    strcat(name, end);
}
