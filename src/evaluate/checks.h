/* Checks: limits on metrics from the profile, the user, and the design rules, one per scenario.
 *
 *   margin     = (limit - value) / max(|limit|, scale), sign turned for a lower limit
 *   constraint = -(margin - required margin)
 */
#ifndef CZ_EVALUATE_CHECKS_H
#define CZ_EVALUATE_CHECKS_H

#include "base/arena.h"
#include "crushzone/evaluate.h"
#include "evaluate/metric.h"

/* Scenario number of a check of the design itself. */
enum { CZ_NO_SCENARIO = -1 };

/* Margins of a yes or no in a search. A step has no slope for a search; the continuous checks next
 * to it have. */
#define CZ_SATISFIED_FLAG 1.0
#define CZ_BROKEN_FLAG (-0.01)

typedef struct CzCheck {
    const char *name;
    int scenario;          /* or CZ_NO_SCENARIO */
    int scene_of_vehicles; /* of a check of the design: a scene whose vehicles it judges; 0, or one
                              that changes values */
    CzMetric metric;       /* unset when `missing` */
    double limit;          /* in the metric's unit */
    bool is_minimum;
    double scale; /* smallest scale of the margin */
    const char *profile, *clause, *source, *confidence;
    const char *missing; /* reason why it cannot be checked in this problem; NULL otherwise */
    bool is_target;      /* a constraint of the optimiser only, not listed */
    bool is_rule;        /* a rule of problem files, for any design */
    bool is_provisional; /* the limit, or the scenario of the profile, is unconfirmed */
    bool is_bare;        /* without the reserves of the file */
    bool is_bound;       /* of the caller's aim: it has no margin to keep */
    bool is_constraint;
} CzCheck;

typedef struct CzChecklist {
    int n_check;
    CzCheck *check; /* (n_check), of the arena; scenarios in order within each limit */
    int n_constraint;
    double required_margin; /* by the file or the caller's aim */
    double aimed_margin;    /* by the aim alone, also where the file has no reserves */
    int n_not_covered;
    const char *const *not_covered; /* of the profile (n_not_covered) */
    int n_not_applicable;
    const char *const *not_applicable; /* scenarios of the profile, with the reason (n) */
    int n_changed_scenario;
    const char *const *changed_scenario; /* of the profile, replaced or changed (n) */
} CzChecklist;

/* Lists all checks and targets of a problem. Memory comes from the arena. Statuses: CZ_OK,
 * CZ_STATUS_INPUT with the place in the file, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_checklist_build(const CzProblem *problem, int n_scene,
                                          const CzScene *scene, CzArena *arena,
                                          CzChecklist *checklist, CzError *error);

/* Margin that a search requires of a check. */
static inline double cz_checklist_required(const CzChecklist *list, const CzCheck *check) {
    return check->is_rule || check->is_bound ? 0
           : check->is_bare                  ? list->aimed_margin
                                             : list->required_margin;
}

/* Name of the scenario of a check: "design" for a check of the design as written. */
const char *cz_check_scenario(const CzCheck *check, const CzScene *scene);

/* Adds the margin and the upper limit of an aim to the constraints of a list. Statuses as above. */
CZ_MUST_CHECK CzStatus cz_checklist_aim(const CzProblem *problem, const CzAim *aim, int n_scene,
                                        const CzScene *scene, CzArena *arena,
                                        CzChecklist *checklist, CzError *error);

/* Evaluates one check. `subject` has the run of the check's scenario, NULL when there is none;
 * `failure` is then the reason, NULL otherwise. */
CzCheckResult cz_check_judge(const CzCheck *check, const CzSubject *subject, const char *failure);

/* Blanks the value of a check of a total, in a run beyond model validity. */
void cz_check_blank_total(const CzCheck *check, CzCheckResult *result);

/* Constraint of a judged check: at most 0 when satisfied; NaN when it could not be checked. */
double cz_check_constraint(const CzCheckResult *result, double required_margin);

/* A check place by place. n_detail returns the number of its places in a scene, 0 for a yes or no,
 * 1 for a sum or mean; details writes as many constraints, -1 where the check does not apply, and
 * returns their number.
 *
 * An energy that is zero before an activation (activation.h) is continued below zero, where a limit
 * allows some of it, by the energy that is missing to it. Where a limit allows next to none, the
 * detail is the distance to the activation instead, and the excess above the limit as a share of
 * the same size; is_activation returns whether it is. Such a distance is not a margin. */
bool cz_check_is_activation(const CzCheck *check);
int cz_check_n_detail(const CzCheck *check, const CzScene *scene);
int cz_check_details(const CzCheck *check, const CzSubject *subject, double required_margin,
                     double *detail);

#endif
