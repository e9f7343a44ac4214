/* Allowed characters of texts and names. The same rule applies to every text: in a file, also by an
 * escape sequence, on the command line, and in names of files.
 *
 * A text is UTF-8 on one line. It contains no control characters, no marks of the writing
 * direction, no invisible characters, no line separators and no noncharacters. Joiners (U+200C,
 * U+200D) and variation selectors are allowed, because some scripts need them. It does not begin
 * with a combining mark.
 *
 * A name is a text of at most CZ_MAX_NAME bytes that also is in paths, columns, files and folders:
 * letters, digits and - _ +. Letters beyond ASCII are allowed, composed ones as one character, so
 * that names that look equal are equal.
 */
#ifndef CZ_BASE_TEXT_H
#define CZ_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Bytes of the UTF-8 character at the start of n bytes; 0 when there is none. */
size_t cz_text_character(const char *text, size_t n_byte);

enum { CZ_FAULT_SIZE = 96 };

/* Finds the first forbidden character in a text of n bytes: true, with its place in bytes and its
 * description, such as "the control character U+001B". With `is_file` the ends of lines and tabs
 * are allowed. */
bool cz_text_fault(const char *text, size_t n_byte, bool is_file, size_t *at,
                   char what[CZ_FAULT_SIZE]);

/* The same for a name: the end of a sentence that begins with the name, such as "contains '/'".
 * `further` are ASCII characters that are allowed too. */
bool cz_name_fault(const char *name, const char *further, char what[CZ_FAULT_SIZE]);

/* Whether a text is one of n. */
bool cz_text_is_among(const char *text, int n, const char *const *list);

/* Whether a text is one of several words separated by spaces. */
bool cz_text_is_word(const char *text, const char *words);

/* Makes one line of n bytes: tabs and ends of lines become spaces, and those at the end are
 * removed. Returns the number of remaining bytes. */
size_t cz_text_one_line(char *text, size_t n_byte);

/* Copies a text, cut at a character's start where it does not fit. */
void cz_text_copy(char *to, size_t size, const char *text);

/* Makes a reported text valid: forbidden characters become '?', such as half a character where a
 * quoted text was cut. */
void cz_text_repair(char *text);

#endif
