/* Words of the causes of climbing. */
#include "crushzone/explain.h"

const char *cz_cause_text(CzCause cause) {
    static const char *const text[] = {
#define CZ_CAUSE(constant, text, doc) text,
#include "crushzone/causes.def"
#undef CZ_CAUSE
    };
    return text[cause];
}

const char *cz_cause_doc(CzCause cause) {
    static const char *const doc[] = {
#define CZ_CAUSE(constant, text, doc) doc,
#include "crushzone/causes.def"
#undef CZ_CAUSE
    };
    return doc[cause];
}
