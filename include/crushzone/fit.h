/* Measured or computed force-stroke curves as staged laws of equal energy.
 *
 * The stages are those of the problem file. Their breakpoints and forces are the least squares of
 * the force over the stroke, under the condition that the law absorbs exactly the energy of the
 * curve over its stroke. A trigger peak is not a plateau: its height is a key of its own.
 */
#ifndef CRUSHZONE_FIT_H
#define CRUSHZONE_FIT_H

#include <stddef.h>
#include <stdio.h>

#include "crushzone/status.h"

CZ_BEGIN_DECLARATIONS

/* Kind of law for a curve. */
typedef enum CzFitKind {
#define CZ_FIT(constant, word, record, doc) constant,
#include "crushzone/fits.def"
#undef CZ_FIT
    CZ_N_FIT
} CzFitKind;

/* Word of a kind, such as "anti-climber". */
CZ_API const char *cz_fit_kind_word(CzFitKind kind);

/* Where stroke 0 of a curve is. */
typedef enum CzFitZero {
    CZ_FIT_ZERO_AUTO,    /* as in the file, or at the first point when that has no force */
    CZ_FIT_ZERO_START,   /* at the first point */
    CZ_FIT_ZERO_CONTACT, /* where the force begins */
    CZ_FIT_ZERO_STROKE   /* at a stroke of the file */
} CzFitZero;

/* How a curve is read and fitted; texts are borrowed. */
typedef struct CzFitOptions {
    CzFitKind kind;
    int is_dynamic;     /* 1: measured at speed, with the rate effect; 0: static */
    int n_stage;        /* stages of the end, or plateaus of the tube or anti-climber; 0 for none
                           (a coupler without a tube); -1: as many as the curve requires */
    const char *name;   /* of the part; NULL: from the file's name */
    const char *stroke; /* column of the stroke by its title or its number from 1; NULL: the one
                           named stroke_mm or in another unit of length */
    const char *force;  /* column of the force; NULL: the one named force_kN or similar */
    const char *stroke_unit; /* such as "mm"; NULL: from the column's title or a row of units */
    const char *force_unit;  /* such as "kN"; NULL: the same */
    char separator;          /* between fields, ' ' for spaces; 0: found from the lines */
    char decimal;            /* decimal sign, '.' or ','; 0: found from the numbers */
    int flips_stroke, flips_force; /* 1: the sign of the column is changed */
    double scale;                  /* of the forces, such as 0.5 for one of two devices */
    CzFitZero zero;
    double zero_stroke; /* with CZ_FIT_ZERO_STROKE; in the file's unit of strokes (SI of points) */
    double from, to;    /* strokes of the file that count, in the same unit; NaN: all */
} CzFitOptions;
CZ_API CzFitOptions cz_fit_options_default(void);

/* Quality of a law. The levels are ours: see docs/fitting-curves.md. */
typedef enum CzFitVerdict { CZ_FIT_GOOD, CZ_FIT_DOUBTFUL, CZ_FIT_REFUSED } CzFitVerdict;

/* "good", "doubtful" or "refused". */
CZ_API const char *cz_fit_verdict_word(CzFitVerdict verdict);

/* A value of the law: the path inside its record, such as "tube.stages[0].force_kN", and the number
 * in the unit that the path names. */
typedef struct CzFitValue {
    char path[64];
    double value;
} CzFitValue;

/* Points of a loading; strokes do not fall. */
typedef struct CzFitLoading {
    int n;
    const double *stroke, *force; /* [m], [N] (n) */
} CzFitLoading;

enum { CZ_FIT_MAX_NOTES = 12, CZ_FIT_MAX_DOUBTS = 6 };

/* The fitted law. Energies are work on the device [J]. Arrays and texts are borrowed from the fit.
 */
typedef struct CzFitSummary {
    CzFitKind kind;
    int is_dynamic;
    const char *file;          /* NULL when fitted from arrays */
    const char *name;          /* of the part */
    int n_point;               /* of the curve */
    double stroke;             /* largest stroke of the curve [m] */
    double peak_force;         /* largest force of the curve [N] */
    double energy;             /* under the curve up to the end of the law [J] */
    double law_energy;         /* of the law over its whole stroke [J] */
    double returned;           /* by the unloading of the curve [J]; NaN without */
    double law_returned;       /* by the unloading of the law [J]; NaN when it has none */
    double largest_difference; /* of the force between curve and law while loading, over the whole
                                  curve [N] */
    double at_stroke;          /* where that is [m] */
    double mean_square;        /* root of the mean square difference over the stroke [N] */
    double mean_force;         /* of the curve over its stroke [N] */
    double law_peak;           /* largest force of the law over that stroke [N] */
    double whole_energy;       /* under the whole loading of the curve [J] */
    double law_whole_energy;   /* of the law over the same stroke [J] */
    double stretch_difference; /* largest mean difference over a tenth of the stroke [N] */
    CzFitVerdict verdict;
    int n_doubt, n_note, n_value;
    const char *doubt[CZ_FIT_MAX_DOUBTS]; /* why it is doubtful or refused (n_doubt) */
    const char *note[CZ_FIT_MAX_NOTES];   /* notes for the user (n_note) */
    const CzFitValue *value;              /* of the law, in the order of the file (n_value) */
    CzFitLoading curve, law;              /* of the curve, and of the law over the same stroke */
} CzFitSummary;

/* A fitted law. Opaque, owns its memory. */
typedef struct CzFit CzFit;

/* Fits the curve of a file ("-" is standard input): two columns or more under a line of titles,
 * perhaps with a line of units below it and other lines above, as testing machines write them.
 * Titles may be missing when the options give columns and units; '#' begins a comment. Strokes grow
 * to their largest value and may then decrease once, while the force falls, for the unloading.
 * Statuses: CZ_OK, CZ_STATUS_INPUT with file, line and column of the first mistake,
 * CZ_STATUS_VIOLATED where no law follows the curve, CZ_STATUS_NO_MEMORY. *fit is NULL unless CZ_OK
 * is returned; NULL options are the default ones. */
CZ_MUST_CHECK CZ_API CzStatus cz_fit_read(const char *path, const CzFitOptions *options,
                                          CzFit **fit, CzError *error);

/* The same from stroke [m] and force [N] (n_point each); of the options those of files have no
 * meaning, and the line of an error counts points from 1. */
CZ_MUST_CHECK CZ_API CzStatus cz_fit_points(int n_point, const double *stroke, const double *force,
                                            const CzFitOptions *options, CzFit **fit,
                                            CzError *error);
CZ_API void cz_fit_free(CzFit *fit);
CZ_API const CzFitSummary *cz_fit_summary(const CzFit *fit);

/* Columns of a file for a curve. Texts are borrowed. */
typedef struct CzCurveColumns {
    const char *x_quantity, *y_quantity; /* quantities of the columns, such as "time", "length",
                                            "force", "speed", "acceleration", "energy", "angle" */
    const char *x, *y;                   /* a column's title, or its number from 1; NULL: the only
                                            one in a unit of the quantity */
    char separator;                      /* between fields; 0: found from the lines */
    char decimal;                        /* decimal sign, '.' or ','; 0: found from the numbers */
} CzCurveColumns;

/* A measured curve as it is in a file. Open, owns its memory. */
typedef struct CzCurve {
    int n;
    double *x, *y; /* [SI] (n) */
} CzCurve;

/* Reads two columns of a file. Their titles end in a unit, as "t_ms" or "force [kN]", or a line of
 * units is below them. Statuses: CZ_OK, CZ_STATUS_INPUT with file, line and column of the first
 * mistake, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_curve_read(const char *path, const CzCurveColumns *columns,
                                            CzCurve **curve, CzError *error);
CZ_API void cz_curve_free(CzCurve *curve);

/* Titles of the columns of such a file, out of the line above its points: *n texts in one block of
 * memory, which the caller frees with free(). Statuses as above; *title is NULL unless CZ_OK is
 * returned. */
CZ_MUST_CHECK CZ_API CzStatus cz_curve_titles(const char *path, char separator, int *n,
                                              char ***title, CzError *error);

/* Writes the law as a catalogue with one part, the summary in comments above it; a refused law is
 * not written. */
CZ_API void cz_fit_write_yaml(const CzFit *fit, FILE *stream);

CZ_END_DECLARATIONS
#endif
