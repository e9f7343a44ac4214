/* Corridor: the widest range around the force-stroke curve of one device within which every curve
 * passes all checks. It says what a supplier may deliver.
 *
 * The stages of the device are divided into pieces. A curve is a factor on the force of each piece,
 * and one on its peak (trigger or preload), each between the lower and the upper edge; its strokes
 * are those of the file. Curves are judged as samples are: the bare physical limits hold, unless
 * the file says otherwise, and overload cases are left out.
 *
 * Tried at each width are the edges, rising, falling and alternating curves. In the widest corridor
 * that passes quasi-random curves follow; where there is scatter, in each sample of it one of these
 * and both edges. Those that fail are tried at each width too, which narrows the corridor. Then an
 * adversary begins with the two curves of the smallest margins. That no other curve fails is not
 * proved.
 *
 * The runs of the search end as soon as their results are final, on the track of a search. Both
 * edges, the curves of the smallest margins within them, and the failing curves just beyond them
 * are run in full at the end.
 */
#ifndef CRUSHZONE_CORRIDOR_H
#define CRUSHZONE_CORRIDOR_H

#include "crushzone/sample.h"

CZ_BEGIN_DECLARATIONS

enum {
    CZ_MAX_PIECES = 8,
    CZ_MAX_FACTORS = CZ_MAX_PIECES + 1,            /* of the pieces, then of the peak */
    CZ_MAX_CORRIDOR_POINTS = 2 * CZ_MAX_PIECES + 4 /* of a curve that is drawn */
};

/* Shape of a curve within the corridor. */
typedef enum CzCurveShape {
    CZ_CURVE_NOMINAL,
    CZ_CURVE_LOWER,
    CZ_CURVE_UPPER,
    CZ_CURVE_LOWER_PEAKED, /* the lower edge with the peak of the upper one */
    CZ_CURVE_UPPER_FLAT,   /* the upper edge with the peak of the lower one */
    CZ_CURVE_RISING,
    CZ_CURVE_FALLING,
    CZ_CURVE_ALTERNATING, /* low, high, low, ... */
    CZ_CURVE_ALTERNATING_HIGH,
    CZ_CURVE_RANDOM,
    CZ_CURVE_ADVERSARY
} CzCurveShape;

/* One curve that was tried. */
typedef struct CzTriedCurve {
    CzCurveShape shape;
    int number;                    /* of a quasi-random curve or of an adversary's, from 1 */
    int sample;                    /* of the scatter, from 0; -1: the values of the file */
    double factor[CZ_MAX_FACTORS]; /* on the forces of the pieces, then on the peak */
    bool is_whole; /* by a run in full; else one that ended as soon as its results were final */
    CzSampleState state;
    CzVerdict verdict; /* of its checks; FAIL unless done */
    double margin;     /* of the check; NaN when it has none */
    char check[CZ_LABEL_SIZE], scenario[CZ_NAME_SIZE], where[CZ_WHERE_SIZE]; /* the worst check, or
                                                                                the failing one */
    char message[256]; /* why its run failed, or why the reader refuses it; empty otherwise */
} CzTriedCurve;

/* Words for a curve, such as "rising curve", or "quasi-random curve 3 in sample 5". */
enum { CZ_CURVE_WORDS = 96 };
CZ_API const char *cz_curve_words(const CzTriedCurve *curve, char words[CZ_CURVE_WORDS]);

/* One edge: the nominal forces less or plus this share of them. */
typedef struct CzCorridorEdge {
    double width;
    int failing; /* curve that fails just beyond it; -1: none within the widest corridor */
} CzCorridorEdge;

/* Open result, owns its memory. Forces are those of one device. */
typedef struct CzCorridor {
    CzProblem *problem;    /* as written */
    const char *path;      /* of the device, such as parts.front-zone; borrowed, as all texts */
    const char *what;      /* such as "anti-climber"; static */
    const char *peak_word; /* "trigger" or "preload"; static, NULL for a curve without one */
    int count;             /* devices side by side at each place */
    int n_place;
    const char *const *place; /* ends that have it, such as "A6 front" (n_place) */
    int n_piece;
    double piece_stroke[CZ_MAX_PIECES], piece_force[CZ_MAX_PIECES]; /* [m], [N] */
    double peak;                                                    /* [N]; NaN for none */
    bool exists;               /* the nominal curve passes, in every sample too */
    CzCorridorEdge edge[2];    /* lower, upper */
    double resolution, widest; /* of the widths, as shares */
    int n_point;
    double stroke[CZ_MAX_CORRIDOR_POINTS]; /* [m] (n_point) */
    double lower[CZ_MAX_CORRIDOR_POINTS], nominal[CZ_MAX_CORRIDOR_POINTS],
        upper[CZ_MAX_CORRIDOR_POINTS]; /* [N] (n_point) */
    double energy[3];                  /* of the lower, the nominal and the upper curve [J] */
    int n_curve;
    CzTriedCurve *curve; /* all that were tried, the nominal one first (n_curve) */
    int n_inside;        /* of these within the corridor; all of them pass */
    int n_refused;       /* curves that no problem may have; they count as failing */
    long seed;
    int n_random;        /* quasi-random curves in a widest corridor */
    int n_draw;          /* of the scatter; 0 when it was not sampled */
    const CzDraw *draw;  /* (n_draw) */
    const double *value; /* of the draws (n_random x n_draw) */
    int n_scenario;
    const int *scenario; /* scenarios that were run, by their numbers (n_scenario) */
    int n_check;
    const char *const *check; /* names of the checks that judge them (n_check) */
    CzEvaluation design;      /* the design as written, with its reserves */
    bool is_interrupted;      /* the widths are those that were reached so far */
    double wall_s;
    struct CzCorridorParts *parts;
} CzCorridor;

typedef struct CzCorridorOptions {
    const char *part;           /* name of the part, or a path such as
                                   trains.A.vehicles.A6.front.anti_climber */
    int n_random;               /* quasi-random curves in a widest corridor; 0: the default */
    long seed;                  /* -1: that of the file, or 1 */
    bool has_scatter;           /* whether the scatter of the file is sampled */
    int n_job;                  /* threads; 0: one per processor */
    const CzExecutor *executor; /* where its tasks run; NULL: in n_job threads */
    const char *text;           /* text that is read in place of the file; NULL for the file */
    size_t n_text;              /* [byte] */
    const volatile sig_atomic_t *stop; /* a flag that ends the search when not 0; NULL: none */
    void (*progress)(int n_done, int n_all, void *data); /* in steps of the search; NULL: none */
    void *progress_data;
} CzCorridorOptions;
CZ_API CzCorridorOptions cz_corridor_options_default(void);

/* Finds the corridor of a device. *corridor is created whenever CZ_OK is returned, also when
 * interrupted, and also when there is none. Statuses: CZ_OK, CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY.
 */
CZ_MUST_CHECK CZ_API CzStatus cz_corridor(const char *file, const CzProblemOptions *problem_options,
                                          const CzCorridorOptions *options, CzCorridor **corridor,
                                          CzError *error);
CZ_API void cz_corridor_free(CzCorridor *corridor);

/* The law of a curve by its factors: forces [N] at strokes [m]; returns their number. */
CZ_API int cz_corridor_law(const CzCorridor *corridor, const double factor[CZ_MAX_FACTORS],
                           double stroke[CZ_MAX_CORRIDOR_POINTS],
                           double force[CZ_MAX_CORRIDOR_POINTS]);

/* The first curve that fails where there is no corridor; NULL otherwise. */
CZ_API const CzTriedCurve *cz_corridor_failure(const CzCorridor *corridor);

CZ_END_DECLARATIONS
#endif
