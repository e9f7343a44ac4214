/* YAML or JSON text to a tree of nodes. */
#ifndef CZ_TEXT_YAML_H
#define CZ_TEXT_YAML_H

#include "text/mistakes.h"

/* Reads one document whose top is a mapping. Only what JSON and plain YAML share is taken: anchors,
 * aliases, tags, merge keys, duplicate keys and further documents are mistakes. Returns NULL when
 * the text cannot be read (the mistakes say why) or memory is short (the arena knows). */
const CzNode *cz_yaml_document(CzMistakes *mistakes, const CzSource *source, const char *text,
                               size_t n_byte);

#endif
