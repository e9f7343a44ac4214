/* Members of a problem, and the step from its tree to its records. */
#ifndef CZ_PROBLEM_READING_H
#define CZ_PROBLEM_READING_H

#include "base/suggest.h"
#include "problem/bind.h"
#include "problem/problem.h"
#include "tree/settings.h"

/* In the first line of a resolved problem: everything is written out; keys without effect are not
 * reported, since they concern its original files. */
#define CZ_RESOLVED_MARK " resolved: parts, copies and defaults filled in"

/* How a problem is made: from a file or text, or again from another problem with further settings
 * or scenarios, or in a way that only this process needs. */
typedef enum CzReadStep {
    CZ_STEP_READ,
    CZ_STEP_SETTINGS,
    CZ_STEP_CASES,
    CZ_STEP_VARYING,
    CZ_STEP_OTHER
} CzReadStep;

/* A text in place of a file. */
typedef struct CzProblemText {
    const char *byte; /* (n) */
    size_t n;
    const char *folder;
} CzProblemText;

struct CzProblem {
    CzReader reader;
    CzTree written; /* as in the files, before settings */
    CzTree tree;    /* with the partners and scenarios of the profile, before settings */
    CzPlaces places;
    const CzReadCurve *curves; /* the curve files that were read, the last one first */
    const char *file;
    CzProblemText text;      /* that was read; without bytes for a file */
    CzProblemOptions given;  /* with which it was read */
    const CzProblem *origin; /* that was read again; NULL for one of a file or text */
    CzReadStep step;         /* from the origin to this problem */
    int n_added;             /* settings or scenarios of this step */
    char hash[17];
    int n_setting;
    const CzSetting *setting; /* of the file, then of the options (n_setting) */
    CzInput input;
    int n_vehicle;
    CzVehicle *vehicle;             /* those of all trains (n_vehicle) */
    CzProfile profile;              /* in its category, with the overrides of the file */
    const CzProfile *whole_profile; /* of all categories; NULL without a profile */
    int n_asked;
    const CzAskedScenario *asked; /* of the profile (n_asked) */
    CzMeasured *measured;         /* one per match; NULL while they are not read */
    CzTargets *targets;           /* one per variable; NULL while they are not found */
    CzProblem **changed; /* those of scenarios with changes, some of them shared with the scenario
                            before; NULL where there are none (n_scenarios) */
};

/* An empty problem; freed by cz_problem_free. NULL without memory. */
CzProblem *cz_problem_create(const char *share_folder);

/* A problem to be reread from the tree of another, which it must not outlive, with space `*more`
 * for n_more settings after its own. NULL without memory. */
CzProblem *cz_problem_create_again(const CzProblem *problem, CzReadStep step, int n_more,
                                   CzSetting **more);

/* Borrows what was read from further files: profile, time histories, the list of files. */
void cz_problem_take_files(CzProblem *again, const CzProblem *problem);

/* Copies targets of a problem to one that was read from the same trains; false without memory. */
bool cz_targets_copy(const CzProblem *to, const CzProblem *from, const CzTargets *targets,
                     CzTargets *copy);

/* Context for reading the records of a tree. */
CzBinder cz_problem_binder(CzProblem *problem, const CzTree *tree);

/* Applies the settings and reads the input of a tree. */
void cz_problem_bind(CzProblem *problem, const CzTree *tree);

/* Reads the time histories that the problem's matches name, as curve files are (measured.c). Times
 * must rise from line to line, as in the channels.csv of `run`, which can be read as well. A value
 * without a unit is in that of its channel. */
void cz_measured_read(CzProblem *problem);

/* The scenario of a name, or the first of a family of that name; -1 when there is none, with the
 * nearest word. */
int cz_input_find_scenario(const CzInput *input, const char *name, CzSuggestion *nearest);

#endif
