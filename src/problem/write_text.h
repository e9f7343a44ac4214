/* Texts in YAML files that this program writes. */
#ifndef CZ_PROBLEM_WRITE_TEXT_H
#define CZ_PROBLEM_WRITE_TEXT_H

#include <stdio.h>

/* Writes a text as a value of YAML, in quotes where it needs them. */
void cz_write_yaml_text(FILE *stream, const char *text);

#endif
