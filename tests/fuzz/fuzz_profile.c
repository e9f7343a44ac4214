/* Any bytes as a profile, with and without what a problem may say about it. */
#include "fuzz/fuzz.h"

#include <string.h>
#include <sys/stat.h>

#define TRAINS                                                                                     \
    "schema: 1\n"                                                                                  \
    "title: two rigid cars\n"                                                                      \
    "trains:\n"                                                                                    \
    "  - {name: A, speed_km_h: 25, vehicles: [{model: rigid, mass_t: 20, front: {face_gap_mm: 0, " \
    "unloading_stiffness_MN_m: 100, stages: [{stroke_mm: 500, force_kN: 800}]}}]}\n"               \
    "  - {name: B, vehicles: [{model: rigid, mass_t: 20}]}\n"

static void read_with(const char *checks) {
    char text[800];
    CzProblem *problem = NULL;
    CzError error = {0};
    snprintf(text, sizeof text, "%schecks: %s\n", TRAINS, checks);
    const CzStatus status =
        cz_problem_read_text(text, strlen(text), "input.yaml", ".", NULL, &problem, &error);
    fuzz_check_told(problem, status, &error);
    cz_problem_free(problem);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_byte) {
    mkdir("profiles", 0777);
    fuzz_write_file("profiles/input.yaml", data, n_byte);
    read_with("{profile: input}");
    read_with("{profile: input, category: C-I, line_speed_km_h: 160}");
    read_with("{profile: input, category: C-II, line_speed_km_h: 40, scenarios: "
              "[identical-train, obstacle-15t], override: {survival space: {max: 40}}}");
    return 0;
}
