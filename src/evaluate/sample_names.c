/* Words for samples. */
#include "crushzone/sample.h"

const char *cz_sample_state_text(CzSampleState state) {
    static const char *const texts[] = {[CZ_SAMPLE_DONE] = "done",
                                        [CZ_SAMPLE_RUN_FAILED] = "run failed",
                                        [CZ_SAMPLE_INVALID] = "invalid",
                                        [CZ_SAMPLE_NOT_RUN] = "not run"};
    return texts[state];
}
