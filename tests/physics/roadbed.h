/* The default track of a problem file. */
#ifndef CZ_TESTS_PHYSICS_ROADBED_H
#define CZ_TESTS_PHYSICS_ROADBED_H

#include "support/check.h"

#include "model/track.h"
#include "problem/problem.h"

static inline CzRoadbed usual_roadbed(void) {
    char path[512];
    snprintf(path, sizeof path, "%s/tests/physics/cases/standing.yaml", CZ_SOURCE_FOLDER);
    const CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzError error = {0};
    if (cz_problem_read(path, &options, &problem, &error) != CZ_OK)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    const CzRoadbed roadbed = cz_problem_input(problem)->track;
    cz_problem_free(problem);
    return roadbed;
}

/* The modes for cars of a length between the outer wheels; n_seat = 0 takes the usual window. */
static inline CzTrackModes *usual_modes(double span, int n_seat, double cut, CzArena *arena) {
    const CzRoadbed roadbed = usual_roadbed();
    CzTrackOptions options = cz_track_options_default(span);
    options.n_seat = n_seat;
    options.cut = cut > 0.0 ? cut : options.cut;
    CzTrackModes *modes = NULL;
    CzError error = {0};
    if (cz_track_build(&roadbed, &options, arena, &modes, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return modes;
}

#endif
