/* The tables of keys, expanded from the lists. */
#include "problem/keys.h"

#include <math.h>

#include "problem/input.h"
#include "problem/problem.h"

/* ---- words ---- */

#define CZ_WORDS(set, type, words) static const CzWord words_##set[] = {words};
#define CZ_WORD(constant, word, doc) {word, doc},
#include "problem/choices.def"

#define CZ_WORDS(set, type, words) {#set, sizeof words_##set / sizeof words_##set[0], words_##set},
const CzWordSet cz_word_sets[CZ_N_WORDS] = {
#include "problem/choices.def"
};

const char *cz_track_word(CzTrack track) {
    return cz_word_sets[CZ_WORDS_TRACK].word[track].word;
}

/* ---- records ---- */

#define CZ_RECORD(type, record, text, keys) static const CzKey type##_keys[] = {keys};
#define FIELD(key_kind, type, field, required, text)                                               \
    .kind = key_kind, .stem = #field, .presence = CZ_PRESENCE_##required, .doc = text,             \
    .offset = offsetof(type, field)
#define ANY
#define USUAL(suffix, from, to) .usual[0] = {#suffix, from, to, false},
#define OR(suffix, from, to) .usual[1] = {#suffix, from, to, true},
#define CZ_NUMBER(type, stem, of, from, to, most_often, presence, without, kind, doc)              \
    {FIELD(CZ_KEY_NUMBER, type, stem, presence, doc),                                              \
     .dimension = CZ_DIMENSION_##of,                                                               \
     .lo = from,                                                                                   \
     .hi = to,                                                                                     \
     .absent = CZ_PRESENCE_##presence == CZ_PRESENCE_DEFAULT ? (without) : NAN,                    \
     .variation = CZ_VARIATION_##kind,                                                             \
     most_often},
#define CZ_COUNT(type, stem, from, to, presence, without, doc)                                     \
    {FIELD(CZ_KEY_COUNT, type, stem, presence, doc), .lo = from, .hi = to, .absent = without},
#define CZ_CHOICE(type, stem, set, presence, without, doc)                                         \
    {FIELD(CZ_KEY_CHOICE, type, stem, presence, doc), .words = &cz_word_sets[CZ_WORDS_##set],      \
     .absent = without},
#define CZ_FLAG(type, stem, without, doc)                                                          \
    {FIELD(CZ_KEY_FLAG, type, stem, DEFAULT, doc), .absent = without},
#define CZ_TEXT(type, stem, presence, doc) {FIELD(CZ_KEY_TEXT, type, stem, presence, doc)},
#define CZ_CHILD(type, stem, inside, presence, doc)                                                \
    {FIELD(CZ_KEY_CHILD, type, stem, presence, doc), .child = &cz_records[CZ_RECORD_##inside]},
#define CZ_STAGES(type, stem, presence, doc)                                                       \
    {FIELD(CZ_KEY_STAGES, type, stem, presence, doc), .child = &cz_records[CZ_RECORD_CzStage],     \
     .n_offset = offsetof(type, n_##stem)},
#define CZ_TABLE(type, stem, x_stem, x_dimension, y_stem, of_y, presence, doc)                     \
    {FIELD(CZ_KEY_TABLE, type, stem, presence, doc), .dimension = CZ_DIMENSION_##x_dimension,      \
     .x = #x_stem, .y = #y_stem, .y_dimension = CZ_DIMENSION_##of_y},
#define CZ_LIST(type, stem, inside, presence, doc)                                                 \
    {FIELD(CZ_KEY_LIST, type, stem, presence, doc), .child = &cz_records[CZ_RECORD_##inside],      \
     .n_offset = offsetof(type, n_##stem)},
#define CZ_NAMED(type, stem, inside, presence, doc)                                                \
    {FIELD(CZ_KEY_NAMED, type, stem, presence, doc), .child = &cz_records[CZ_RECORD_##inside],     \
     .n_offset = offsetof(type, n_##stem)},
#define CZ_TEXTS(type, stem, presence, doc) {FIELD(CZ_KEY_TEXTS, type, stem, presence, doc)},
#include "problem/keys.def"
#undef FIELD
#undef ANY
#undef USUAL
#undef OR

#define CZ_RECORD(type, record, text, keys)                                                        \
    {.name = #record,                                                                              \
     .doc = text,                                                                                  \
     .size = sizeof(type),                                                                         \
     .n_key = sizeof type##_keys / sizeof type##_keys[0],                                          \
     .key = type##_keys},
const CzRecord cz_records[CZ_N_RECORD] = {
#include "problem/keys.def"
};

/* ---- reuse ---- */

#define CZ_REUSE(record, key, schema, doc) {record, #key, schema, doc},
const CzReuseKey cz_reuse_keys[] = {
#include "problem/reuse.def"
};
#undef CZ_REUSE
const int cz_n_reuse_key = sizeof cz_reuse_keys / sizeof cz_reuse_keys[0];
