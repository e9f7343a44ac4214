/* Help: topics in addition to the commands, and pages for other programs. */
#ifndef CZ_CLI_HELP_H
#define CZ_CLI_HELP_H

#include "cli/arguments.h"

typedef enum CzTopic {
#define CZ_TOPIC(constant, name, doc) CZ_TOPIC_##constant,
#include "cli/topics.def"
#undef CZ_TOPIC
    CZ_N_TOPIC
} CzTopic;

/* A word and what it means. */
typedef struct CzHelpEntry {
    const char *name, *doc;
} CzHelpEntry;

extern const CzHelpEntry cz_topics[CZ_N_TOPIC];

void cz_help_write_topic(CzTopic topic);

/* The parts of a file, or of all shipped catalogues when it is NULL, with their numbers. Reports a
 * failure and returns its exit code, 0 without. */
int cz_help_write_parts(const CzArguments *arguments, const char *file);

/* Rules for the verdict over checks: the words in the order in which they are tried, up to one
 * without a name, and a remark. */
extern const CzHelpEntry cz_verdict_rules[];
extern const char cz_verdict_remark[];

/* Exit codes of commands, up to one without a name. */
extern const CzHelpEntry cz_exit_codes[];

/* Writes a text from column `indent` on, broken between words; the line is at that column. */
void cz_help_write_wrapped(const char *text, int indent);

/* The command line as a page in Markdown, as a manual page for man, and as completion for bash. */
void cz_help_write_markdown(void);
void cz_help_write_channels_markdown(void);
void cz_help_write_man(void);
void cz_help_write_bash(void);

#endif
