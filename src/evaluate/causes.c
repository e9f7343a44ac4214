/* Words of the causes of climbing. */
#include "crushzone/explain.h"

static const struct {
    const char *text, *doc;
} causes[CZ_N_CAUSE] = {
#define CZ_CAUSE(constant, text, doc) [constant] = {text, doc},
#include "crushzone/causes.def"
#undef CZ_CAUSE
};

const char *cz_cause_text(CzCause cause) {
    return causes[cause].text;
}

const char *cz_cause_doc(CzCause cause) {
    return causes[cause].doc;
}
