/* Problem files: text to SI values, every value with its place in the file. */
#ifndef CRUSHZONE_PROBLEM_H
#define CRUSHZONE_PROBLEM_H

#include <stddef.h>
#include <stdio.h>

#include "crushzone/status.h"

CZ_BEGIN_DECLARATIONS

/* A problem file after reading. Immutable; owns all its memory. */
typedef struct CzProblem CzProblem;

typedef struct CzProblemOptions {
    const char *const *set; /* "path=value" texts applied after reading, later ones win; (n_set) */
    int n_set;
    const char *share_folder; /* folder with catalogue/ and profiles/ that is searched after the
                                 file's own; NULL: the installed one */
} CzProblemOptions;

/* Options with nothing set. */
CZ_API CzProblemOptions cz_problem_options_default(void);

/* Reads a file ("-" is standard input). *problem is created whenever memory allows, even when the
 * status is not CZ_OK: it then has the mistakes of the file and no other use. The caller frees it.
 * `error` gets the first mistake. Statuses: CZ_OK, CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_problem_read(const char *path, const CzProblemOptions *options,
                                              CzProblem **problem, CzError *error);

/* The same from a text of n_byte bytes; messages call it `name`, relative paths start at
 * `folder`. */
CZ_MUST_CHECK CZ_API CzStatus cz_problem_read_text(const char *text, size_t n_byte,
                                                   const char *name, const char *folder,
                                                   const CzProblemOptions *options,
                                                   CzProblem **problem, CzError *error);

/* Frees a problem; NULL is allowed. */
CZ_API void cz_problem_free(CzProblem *problem);

/* Mistakes and warnings in file order; the error is borrowed from the problem. */
CZ_API int cz_problem_n_mistake(const CzProblem *problem);
CZ_API const CzError *cz_problem_mistake(const CzProblem *problem, int index);
CZ_API int cz_problem_n_warning(const CzProblem *problem);
CZ_API const CzError *cz_problem_warning(const CzProblem *problem, int index);

/* Source line of an error, without its line end, or NULL; borrowed. For the caret picture. */
CZ_API const char *cz_problem_source_line(const CzProblem *problem, const CzError *error);

/* Title, file name, content hash (16 hex digits over all files read and all settings); borrowed. */
CZ_API const char *cz_problem_title(const CzProblem *problem);
CZ_API const char *cz_problem_file(const CzProblem *problem);
CZ_API const char *cz_problem_hash(const CzProblem *problem);

/* Scenarios; a problem without a list has one named "collision". */
CZ_API int cz_problem_n_scenario(const CzProblem *problem);
CZ_API const char *cz_problem_scenario_name(const CzProblem *problem, int scenario);

/* The scenario of a name, or the first of a family of that name. CZ_STATUS_INPUT when there is
 * none; the error's help names the nearest word. */
CZ_MUST_CHECK CZ_API CzStatus cz_problem_find_scenario(const CzProblem *problem, const char *name,
                                                       int *scenario, CzError *error);

/* Writes the resolved file as YAML: all parts, copies and defaults filled in, SI values and origin
 * in comments. The output is itself a problem file with the same meaning to the last bit. */
CZ_API void cz_problem_write_resolved(const CzProblem *problem, FILE *stream);

/* Name and meaning of a key of a record, such as "limit", by its number; NULL beyond the last. */
CZ_API const char *cz_key_name(const char *record, int index);
CZ_API const char *cz_key_doc(const char *record, int index);

/* Writes the JSON schema (draft-07), the key list for a terminal, and the key reference (Markdown).
 */
CZ_API void cz_keys_write_schema(FILE *stream);
CZ_API void cz_keys_write_help(FILE *stream);
CZ_API void cz_keys_write_reference(FILE *stream);

/* Writes the profiles beside the working folder and in the share folder, each with its edition,
 * categories, and numbers of limits and scenarios. Options may be NULL. */
CZ_API void cz_profiles_write_list(const CzProblemOptions *options, FILE *stream);

typedef enum CzProfileContent {
    CZ_PROFILE_LIMITS,   /* categories, limits, and what is not checked */
    CZ_PROFILE_SCENARIOS /* and those that do not apply, with the reason */
} CzProfileContent;

/* Writes what a profile has, in one category or, with NULL, in all; settings of the options are
 * ignored. Statuses: CZ_OK, CZ_STATUS_INPUT with the place of a mistake or a did-you-mean,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_profile_write(const char *name, CzProfileContent content,
                                               const char *category,
                                               const CzProblemOptions *options, FILE *stream,
                                               CzError *error);

CZ_END_DECLARATIONS
#endif
