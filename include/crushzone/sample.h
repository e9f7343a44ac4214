/* Samples: the scatter of `uncertainty:` is drawn many times, and every sample is judged.
 *
 * A sample is every scenario of the problem once more, with the values drawn; overload cases stand
 * in for scatter and are left out. In a sample the bare physical limits hold, unless the file says
 * otherwise; the nominal design is judged beside it with its reserves.
 *
 * The numbers of sample k depend on the seed, k and the number of samples alone: neither on the
 * design nor on threads and shards.
 */
#ifndef CRUSHZONE_SAMPLE_H
#define CRUSHZONE_SAMPLE_H

#include <signal.h>

#include "crushzone/evaluate.h"

CZ_BEGIN_DECLARATIONS

/* Effect of a draw on the values of its places. */
typedef enum CzDrawEffect {
    CZ_DRAW_VALUE, /* replaces them, in the unit of the path's key */
    CZ_DRAW_FACTOR,
    CZ_DRAW_ADD /* is added, in that unit */
} CzDrawEffect;

/* One random number of each sample: of a parameter, or of one of its parts or places. Texts are
 * borrowed from the sampling. */
typedef struct CzDraw {
    const char *name; /* of the parameter, with its part or place where it has several */
    int n_path;
    const char *const *path; /* as `changes:` takes them (n_path) */
    CzDrawEffect effect;
    const char *unit;         /* of its values; "" for a factor */
    const char *distribution; /* as in the file, or "values" for a list; static */
    double low, high;         /* smallest and largest value */
    int n_value;
    const double *value; /* of a list, equally probable (n_value) */
    int n_place;         /* numbers of the problem that it changes */
} CzDraw;

enum { CZ_N_SAMPLE_QUANTILE = 3 };
/* Shares of the quantiles: 0.05, 0.5, 0.95. */
CZ_API double cz_sample_quantile_share(int index);

/* Smallest margin of many samples. Quantiles are linear between neighbours in order; a failed run
 * is the smallest of all, so that a quantile that reaches one is -infinity. NaN without margins. */
typedef struct CzSampledMargin {
    double quantile[CZ_N_SAMPLE_QUANTILE];
    double least;
    int worst; /* sample with the smallest margin, or the first that fails without one; -1: none */
} CzSampledMargin;

/* A check of a scenario, over all samples. Texts are borrowed from the sampling. */
typedef struct CzSampledCheck {
    const char *name, *scenario;
    bool is_flag;           /* a yes or no, without margins */
    double nominal;         /* margin of the nominal design, with reserves; NaN when none */
    double bare;            /* the same as samples are judged */
    CzSampledMargin margin; /* without any where the check is a yes or no */
    double required;     /* margin by the file's `judged_by`: the smallest, a quantile, or mean less
                            deviations; -infinity when that is a failed run; NaN for a yes or no */
    bool is_satisfied;   /* by that statistic, or by few enough failures of a yes or no */
    int n_fail;          /* samples that fail it, or whose run of this scenario failed */
    double *correlation; /* rank correlation of each draw with the margin, for a yes or no with
                            passing; NaN when one of them is constant (n_draw) */
    int strongest;       /* draw with the largest correlation, either sign; -1 when none */
} CzSampledCheck;

typedef enum CzSampleState {
    CZ_SAMPLE_DONE,
    CZ_SAMPLE_RUN_FAILED, /* a run failed or is incomplete */
    CZ_SAMPLE_INVALID,    /* the reader refuses the values drawn */
    CZ_SAMPLE_NOT_RUN     /* of another shard, or interrupted before */
} CzSampleState;
CZ_API const char *cz_sample_state_text(CzSampleState state);

typedef struct CzSample {
    CzSampleState state;
    CzVerdict verdict;    /* over its checks; FAIL unless done */
    double margin;        /* smallest of its checks; NaN when it has none */
    int check;            /* check with that margin, or the failing yes or no; -1 when none */
    bool beyond_validity; /* a vehicle climbed */
    char *message; /* why it is invalid or its run failed, with its scenario; NULL otherwise */
} CzSample;

/* Share of passing samples among the first n. */
typedef struct CzSampledShare {
    int n, n_pass;
    double share, low, high; /* with its 95 % interval by Wilson; NaN when n is 0 */
    double margin;           /* 5 % quantile of the smallest margins */
} CzSampledShare;

/* Open result, owns its memory. */
typedef struct CzSampling {
    int n_sample;       /* of all shards */
    int shard, n_shard; /* this one, from 1, and their number: 1 and 1 without shards */
    int begin, end;     /* its samples, from 0, the last one excluded */
    long seed;
    const char *method;    /* as in the file; static */
    const char *judged_by; /* the statistic that the file requires, in words */
    int n_draw;
    CzDraw *draw;  /* (n_draw) */
    double *value; /* (n_sample x n_draw) */
    int n_check;
    CzSampledCheck *check; /* (n_check) */
    CzSample *sample;      /* (n_sample) */
    double *margin;        /* NaN where there is none, -infinity of a failed run
                              (n_sample x n_check) */
    CzVerdict *verdict;    /* (n_sample x n_check) */
    int n_run, n_failed;   /* samples that were run; of these with a run that failed, or invalid */
    CzSampledShare passing;
    CzSampledMargin smallest; /* of the smallest margin of each sample */
    int n_convergence;
    CzSampledShare *convergence; /* after 1, 2, 4, ... and all samples that were run */
    CzVerdict judgement;         /* whether the statistic that the file requires holds */
    CzEvaluation nominal;        /* the design as written, with reserves */
    const CzProblem *problem;    /* as written */
    CzProblem *own_problem;      /* the same, where the sampling read it; else NULL */
    bool is_interrupted;
    double wall_s;
    struct CzSamplingParts *parts; /* memory of texts */
} CzSampling;

/* Fills the samples whose results are known already (state, verdict, margins, message), such as
 * those of other shards; they are not run. `sampling` has its draws and checks. */
typedef CzStatus (*CzSampleRecall)(CzSampling *sampling, void *data, CzError *error);

typedef struct CzSampleOptions {
    int n_sample;       /* 0: that of the file */
    long seed;          /* -1: that of the file */
    int shard, n_shard; /* only these samples: the shard-th of n_shard equal runs of samples */
    int n_job;          /* threads; 0: one per processor */
    const CzExecutor *executor; /* where its tasks run; NULL: in n_job threads */
    bool brief;       /* runs of samples end as soon as their results are final, as in a search */
    const char *text; /* text that is read in place of the file; NULL for the file */
    size_t n_text;    /* [byte] */
    const volatile sig_atomic_t *stop; /* a flag that ends the sampling when not 0; NULL: none */
    void (*progress)(int n_done, int n_sample, void *data); /* NULL when none */
    CzSampleRecall recall;                                  /* NULL when none is known */
    void *recall_data;
    void *progress_data;
} CzSampleOptions;
CZ_API CzSampleOptions cz_sample_options_default(void);

/* Samples a problem file. *sampling is created whenever CZ_OK is returned, also when interrupted.
 * Statuses: CZ_OK, CZ_STATUS_INPUT for a file without `uncertainty:` or with a wrong one,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_sample(const char *file, const CzProblemOptions *problem_options,
                                        const CzSampleOptions *options, CzSampling **sampling,
                                        CzError *error);
/* The same of a problem, which must outlive the sampling; the options have no text. */
CZ_MUST_CHECK CZ_API CzStatus cz_sample_problem(const CzProblem *problem,
                                                const CzSampleOptions *options,
                                                CzSampling **sampling, CzError *error);
CZ_API void cz_sampling_free(CzSampling *sampling);

CZ_END_DECLARATIONS
#endif
