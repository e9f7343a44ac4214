/* Keys that a mapping may have: the types of the tables of keys, and functions to look up keys. The
 * tables themselves are in problem/keys.h. */
#ifndef CZ_TREE_RECORD_H
#define CZ_TREE_RECORD_H

#include "text/units.h"

typedef struct CzWord {
    const char *word, *doc;
} CzWord;

typedef struct CzWordSet {
    const char *name; /* such as "ZONE" */
    int n_word;
    const CzWord *word; /* the index of a word is its enum's value */
} CzWordSet;

/* Index of the word nearest to a typed one; -1 when none is near. */
int cz_word_nearest(const CzWordSet *set, const char *typed);

typedef enum CzKeyKind {
    CZ_KEY_NUMBER,
    CZ_KEY_COUNT,
    CZ_KEY_CHOICE,
    CZ_KEY_FLAG,
    CZ_KEY_TEXT,
    CZ_KEY_CHILD,
    CZ_KEY_STAGES,
    CZ_KEY_TABLE,
    CZ_KEY_LIST,
    CZ_KEY_NAMED,
    CZ_KEY_TEXTS
} CzKeyKind;

typedef enum CzPresence {
    CZ_PRESENCE_REQUIRED,
    CZ_PRESENCE_REQUIRED_FULL,
    CZ_PRESENCE_OPTIONAL,
    CZ_PRESENCE_DEFAULT
} CzPresence;

/* Whether a search may change a number: never, only in a fit to measurements, or also in a
 * design. */
typedef enum CzVariation { CZ_VARIATION_DATA, CZ_VARIATION_FITS, CZ_VARIATION_VARIES } CzVariation;

/* Usual range of a number. */
typedef struct CzUsual {
    const char *unit; /* suffix; NULL for no range */
    double lo, hi;    /* in that unit */
    bool is_typed;    /* applies only to numbers that are typed in that unit */
} CzUsual;

/* One key of a record. */
typedef struct CzKey {
    CzKeyKind kind;
    const char *stem;
    CzPresence presence;
    const char *doc;
    size_t offset;                /* of the field in its record [byte] */
    CzDimension dimension;        /* number: its own; table: of x */
    double lo, hi;                /* number and count: range [SI] */
    CzUsual usual[2];             /* number: the second is optional */
    double absent;                /* number, count, choice, flag: value when absent */
    CzVariation variation;        /* number: whether a search may change it */
    const CzWordSet *words;       /* choice: its words */
    const struct CzRecord *child; /* child, list, named, stages: record inside */
    size_t n_offset;              /* list, named, stages: of the count of items [byte] */
    const char *x, *y;            /* table: stems of the columns */
    CzDimension y_dimension;
} CzKey;

typedef struct CzRecord {
    const char *name, *doc;
    size_t size; /* [byte] */
    int n_key;
    const CzKey *key;
} CzRecord;

/* Key of a record by its stem; NULL when there is none. */
const CzKey *cz_record_key(const CzRecord *record, const char *stem);
/* The key for a typed one, with its unit for numbers; NULL when there is none. */
const CzKey *cz_record_match(const CzRecord *record, const char *typed, const CzUnit **unit);

#endif
