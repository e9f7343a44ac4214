/* The run of an evaluation that decides its verdict. */
#ifndef CZ_EVALUATE_DECIDING_RUN_H
#define CZ_EVALUATE_DECIDING_RUN_H

#include "crushzone/evaluate.h"

/* Number of the deciding one of the kept runs: one that failed, else the one with the worst check,
 * else the first; -1 when none was kept. */
int cz_deciding_run(const CzEvaluation *evaluation);

#endif
