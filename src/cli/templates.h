/* Examples that `new` writes, from files that the build made texts. */
#ifndef CZ_CLI_TEMPLATES_H
#define CZ_CLI_TEMPLATES_H

#define CZ_TEMPLATE(constant, name, doc) extern const char cz_template_##constant[];
#include "cli/templates.def"
#undef CZ_TEMPLATE

typedef struct CzTemplate {
    const char *name, *doc, *text;
} CzTemplate;

static const CzTemplate cz_templates[] = {
#define CZ_TEMPLATE(constant, name, doc) {name, doc, cz_template_##constant},
#include "cli/templates.def"
#undef CZ_TEMPLATE
};
enum { CZ_N_TEMPLATE = sizeof cz_templates / sizeof cz_templates[0] };

#endif
