/* Studies in several processes: a worker makes a study again from its description, and then runs
 * tasks of it.
 *
 *   here     study --describe--> bytes --broadcast--> every worker: open
 *            task --request--> bytes --executor--> a worker: answer --> bytes --take--> results
 */
#ifndef CZ_EVALUATE_STUDY_H
#define CZ_EVALUATE_STUDY_H

#include "base/bytes.h"
#include "crushzone/executor.h"

/* In place of the status of an answer: the owner of the study runs the task itself. */
enum { CZ_RUN_HERE = -1 };

/* What a worker does with a study of one kind. Its failures become those of the study. */
typedef struct CzStudyKind {
    /* Makes the study from its description; closed also after a failure. */
    CzStatus (*open)(CzReading *description, void **study, CzError *error);
    /* Runs a task and appends its results. After CZ_STATUS_INPUT the owner runs the task itself,
     * for its message about a design, sample or point that the reader refuses. */
    CzStatus (*answer)(void *study, CzReading *request, CzMemoryText *answer, CzError *error);
    void (*close)(void *study); /* NULL is allowed */
} CzStudyKind;

/* The kinds, in the order in which a worker has them. */
typedef enum CzStudyNumber {
    CZ_STUDY_OF_RUNS,
    CZ_STUDY_OF_SAMPLES,
    CZ_STUDY_OF_POINTS,
    CZ_STUDY_OF_CANDIDATES,
    CZ_STUDY_OF_CHALLENGE,
    CZ_STUDY_OF_CORRIDOR,
    CZ_N_STUDY_KIND
} CzStudyNumber;
extern const CzStudyKind cz_study_of_runs;       /* run_blocks.c */
extern const CzStudyKind cz_study_of_samples;    /* sampling.c */
extern const CzStudyKind cz_study_of_points;     /* sweep.c */
extern const CzStudyKind cz_study_of_candidates; /* candidate_runs.c */
extern const CzStudyKind cz_study_of_challenge;  /* optimise/challenge_study.c */
extern const CzStudyKind cz_study_of_corridor;   /* optimise/corridor_study.c */

/* A study of this process, which the workers of its executor get to know with its first batch. */
typedef struct CzStudy {
    CzExecutor executor;
    CzStudyNumber kind;
    void (*describe)(const void *data, CzMemoryText *description);
    const void *data;
    bool is_known; /* to the workers */
} CzStudy;

/* Describes the study to the workers unless they know it. `is_known` remains false without workers,
 * and without memory for the description. Status: a failure of the executor. */
CZ_MUST_CHECK CzStatus cz_study_begin(CzStudy *study, CzError *error);

/* Lets the workers forget the study. */
void cz_study_end(CzStudy *study);

/* Head of a request, which names the study. */
void cz_study_put(CzMemoryText *request, const CzStudy *study);

#endif
