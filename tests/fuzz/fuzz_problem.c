/* Any bytes as a problem file: it is read, or every mistake has a place and a sentence. */
#include "fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_byte) {
    CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzError error = {0};
    options.share_folder = FUZZ_SHARE_FOLDER;
    const CzStatus status = cz_problem_read_text((const char *)data, n_byte, "input.yaml",
                                                 FUZZ_SHARE_FOLDER, &options, &problem, &error);
    fuzz_check_told(problem, status, &error);
    cz_problem_free(problem);
    return 0;
}
