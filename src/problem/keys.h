/* The keys of keys.def as tables: for reading, schema, help and reference. */
#ifndef CZ_PROBLEM_KEYS_H
#define CZ_PROBLEM_KEYS_H

#include "tree/record.h"

/* ---- closed sets of words (choices.def) ---- */

#define CZ_WORDS(set, type, words) CZ_WORDS_##set,
enum {
#include "problem/choices.def"
    CZ_N_WORDS
};

extern const CzWordSet cz_word_sets[CZ_N_WORDS];

/* ---- records (keys.def) ---- */

#define CZ_RECORD(type, name, doc, keys) CZ_RECORD_##type,
typedef enum CzRecordId {
#include "problem/keys.def"
    CZ_N_RECORD
} CzRecordId;

extern const CzRecord cz_records[CZ_N_RECORD];

/* ---- keys that reuse (reuse.def) ---- */

typedef struct CzReuseKey {
    const char *record; /* name of its record; "" for any */
    const char *key;
    const char *schema; /* JSON schema of its value, without the braces */
    const char *doc;
} CzReuseKey;

extern const CzReuseKey cz_reuse_keys[];
extern const int cz_n_reuse_key;

#endif
