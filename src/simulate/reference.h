/* The run of one design by an adaptive solver instead of the fixed-step scheme: the same laws, the
 * same ledger, the same extremes, an independent integration.
 *
 *   y = (x, v) of every degree of freedom that moves, y' = (v, a), and the modes of the track
 *
 * A trial state is evaluated from the committed memory, with the time since the commit as the step
 * of the laws; memory is committed when a step is accepted. The laws use return mapping, so force
 * and next memory are continuous in the state. Variables that depend on that step (creep, hydraulic
 * stroke, crush rate) are advanced implicitly over it and converge with decreasing steps to the
 * same limit as in the fixed-step scheme.
 */
#ifndef CZ_SIMULATE_REFERENCE_H
#define CZ_SIMULATE_REFERENCE_H

#include "integrate/integrator.h"
#include "simulate/run.h"

typedef struct CzReference CzReference;

/* A reference for a batch of one design that is at t = 0, allocated in its arena; free with
 * cz_reference_free. `tolerance` scales what cz_reference_step allows as local error: 1 m/s and 1
 * rad/s times it in velocities, 10 mm and 10 mrad in displacements. A modal track was laid for a
 * step of 0. Statuses: CZ_OK, CZ_STATUS_INPUT for a track that it does not support,
 * CZ_STATUS_NO_MEMORY, CZ_STATUS_RUN_FAILED. */
CZ_MUST_CHECK CzStatus cz_reference_create(CzBatch *batch, CzMethod method, double tolerance,
                                           CzReference **reference, CzError *error);
void cz_reference_free(CzReference *reference);

/* Takes one accepted step that does not go beyond `until`, commits it and sets the batch's time.
 * Statuses: CZ_OK, CZ_STATUS_RUN_FAILED. */
CZ_MUST_CHECK CzStatus cz_reference_step(CzReference *reference, double until, CzError *error);

/* Steps taken so far. */
long cz_reference_n_step(const CzReference *reference);

#endif
