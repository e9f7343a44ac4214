/* Converts YAML or JSON text to a tree of nodes. */
#ifndef CZ_TEXT_YAML_H
#define CZ_TEXT_YAML_H

#include "text/mistakes.h"

/* Reads one document whose top is a mapping. Only the common features of JSON and plain YAML are
 * accepted: anchors, aliases, tags, merge keys, duplicate keys and further documents are mistakes.
 * Returns NULL when the text cannot be read (with a mistake) or without memory (reported by the
 * arena). */
const CzNode *cz_yaml_document(CzMistakes *mistakes, const CzSource *source, const char *text,
                               size_t n_byte);

#endif
