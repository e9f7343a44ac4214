/* Expands keys.def with CZ_RECORD alone; whoever includes it defines that one. */
#define CZ_NUMBER(type, stem, dimension, lo, hi, presence, absent, kind, doc)
#define CZ_COUNT(type, stem, lo, hi, presence, absent, doc)
#define CZ_CHOICE(type, stem, set, presence, absent, doc)
#define CZ_FLAG(type, stem, absent, doc)
#define CZ_TEXT(type, stem, presence, doc)
#define CZ_CHILD(type, stem, child, presence, doc)
#define CZ_STAGES(type, stem, presence, doc)
#define CZ_TABLE(type, stem, x, x_dimension, y, y_dimension, presence, doc)
#define CZ_LIST(type, stem, child, presence, doc)
#define CZ_TEXTS(type, stem, presence, doc)
#define CZ_RECORD_END(type)
#include "problem/keys.def"
#undef CZ_NUMBER
#undef CZ_COUNT
#undef CZ_CHOICE
#undef CZ_FLAG
#undef CZ_TEXT
#undef CZ_CHILD
#undef CZ_STAGES
#undef CZ_TABLE
#undef CZ_LIST
#undef CZ_TEXTS
#undef CZ_RECORD_END
