/* Designs that are run in all scenarios, in blocks. */
#ifndef CZ_EVALUATE_RUN_BLOCKS_H
#define CZ_EVALUATE_RUN_BLOCKS_H

#include "evaluate/evaluator_parts.h"
#include "evaluate/run_plan.h"

/* Number of designs whose vehicle records are in memory at a time. */
enum { CZ_BLOCK_DESIGNS = 64 };

/* One block of designs in all scenarios. */
typedef struct CzRunBlock {
    const CzEvaluator *evaluator;
    int n_point;
    const double *x;                   /* (n_point x n_variable); NULL: the file's own values */
    int combination[CZ_BLOCK_DESIGNS]; /* of each design (n_point) */
    /* the vehicles of each design in all variations (n_point) */
    const CzVehicle *vehicle[CZ_BLOCK_DESIGNS];
    CzVariant own[CZ_BLOCK_DESIGNS];   /* variants of designs that are read again (n_point) */
    bool is_refused[CZ_BLOCK_DESIGNS]; /* designs that break a rule of files (n_point) */
    CzVehicle *copies;                 /* with the designs applied */
    CzRun **run;                       /* (n_point x n_scene) */
    const bool *some;                  /* the only scenarios that are run; NULL for all (n_scene) */
    CzEvaluation *begun; /* evaluation of the only design in these scenarios, whose runs are taken
                            over; NULL for none */
    bool record, keep;   /* channels are recorded, runs are kept */
    bool keep_pulses;    /* those of the vehicles */
    CzManner manner;
    CzRunPlan plan;
    CzEvaluation *evaluation; /* results (n_point) */
    double *detail;           /* (n_point x n_detail); NULL: not requested */
} CzRunBlock;

/* Blocks whose chunks are one batch of tasks, numbered from one block to the next. */
typedef struct CzRunBlocks {
    int n;
    CzRunBlock *block; /* (n) */
} CzRunBlocks;

/* Evaluates the designs of all blocks, which contain the settings of the runs, the results to keep
 * and where they are written, and are ended. Status: the first failure, after which the caller
 * frees the evaluations. */
CZ_MUST_CHECK CzStatus cz_run_blocks_evaluate(const CzRunBlocks *blocks, CzError *error);

#endif
