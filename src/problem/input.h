/* Typed records of a problem file, in SI.
 *
 * The records are expanded from keys.def: a number is a double (NaN when optional and absent), a
 * choice its enum, a child record is embedded by value, a list is a pointer and a count. `given` is
 * true when the file has the record. Vehicles of all trains lie in one array so that a candidate
 * design is a copy of that array (input_copy).
 */
#ifndef CZ_PROBLEM_INPUT_H
#define CZ_PROBLEM_INPUT_H

#include <math.h>
#include <stdbool.h>

enum {
    CZ_MAX_STAGES = 8,       /* stages of one curve */
    CZ_MAX_END_STAGES = 4,   /* of that of an end */
    CZ_MAX_CURVE_POINTS = 64 /* points of one table after reading */
};

#define CZ_WORDS(set, type, words) typedef enum type { words } type;
#define CZ_WORD(constant, word, doc) constant,
#include "problem/choices.def"

/* Basis of a measured curve: a dynamic one already contains the rate effect. */
typedef enum CzBasis { CZ_BASIS_STATIC, CZ_BASIS_DYNAMIC } CzBasis;

/* Meaning of the strokes of a curve: permanent shortening alone, or including the elastic one. */
typedef enum CzStrokes { CZ_STROKES_UNSAID, CZ_STROKES_PLASTIC, CZ_STROKES_TOTAL } CzStrokes;

/* Curve given by points; x increases. */
typedef struct CzTable {
    bool given;
    int n_point;
    CzBasis basis;
    CzStrokes strokes;
    bool converted; /* its strokes were converted with the stiffnesses of the device */
    double x[CZ_MAX_CURVE_POINTS]; /* [SI] */
    double y[CZ_MAX_CURVE_POINTS]; /* [SI] */
} CzTable;

typedef struct CzTexts {
    int n_text;
    const char *const *text;
} CzTexts;

/* Names of the types that the macros paste. */
#define CZ_RECORD(type, name, doc, keys)                                                           \
    typedef struct type {                                                                          \
        bool given;                                                                                \
        keys                                                                                       \
    } type;
#define CZ_NUMBER(type, stem, dimension, lo, hi, usual, presence, absent, kind, doc) double stem;
#define CZ_COUNT(type, stem, lo, hi, presence, absent, doc) int stem;
#define CZ_CHOICE(type, stem, set, presence, absent, doc) int stem;
#define CZ_FLAG(type, stem, absent, doc) bool stem;
#define CZ_TEXT(type, stem, presence, doc) const char *stem;
#define CZ_CHILD(type, stem, child, presence, doc) child stem;
#define CZ_STAGES(type, stem, presence, doc)                                                       \
    CzStage stem[CZ_MAX_STAGES];                                                                   \
    int n_##stem;
#define CZ_TABLE(type, stem, x, x_dimension, y, y_dimension, presence, doc) CzTable stem;
#define CZ_LIST(type, stem, child, presence, doc)                                                  \
    child *stem;                                                                                   \
    int n_##stem;
#define CZ_NAMED(type, stem, child, presence, doc) CZ_LIST(type, stem, child, presence, doc)
#define CZ_TEXTS(type, stem, presence, doc) CzTexts stem;
#include "problem/keys.def"

#endif
