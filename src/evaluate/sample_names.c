/* Words for samples, and names of their scenarios. */
#include "evaluate/sampling.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"

const char *cz_sample_state_text(CzSampleState state) {
    static const char *const texts[] = {[CZ_SAMPLE_DONE] = "done",
                                        [CZ_SAMPLE_RUN_FAILED] = "run failed",
                                        [CZ_SAMPLE_INVALID] = "invalid",
                                        [CZ_SAMPLE_NOT_RUN] = "not run"};
    return texts[state];
}

void cz_sample_case_name(const CzSampling *sampling, int scenario, int sample,
                         char name[CZ_NAME_ROOM]) {
    const char *own = cz_problem_scenario_name(sampling->problem, scenario);
    char end[32]; /* with the number of a scenario whose name is cut */
    snprintf(end, sizeof end, "-sample-%d", sample + 1);
    if (strlen(own) + strlen(end) > CZ_MOST_NAME)
        snprintf(end, sizeof end, "-%d-sample-%d", scenario + 1, sample + 1);
    cz_text_copy(name, CZ_NAME_ROOM - strlen(end), own);
    strcat(name, end);
}
