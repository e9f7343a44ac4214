/* Lines of standard input, each as soon as it is there, until its end or a signal. */
#ifndef CZ_CLI_LINES_H
#define CZ_CLI_LINES_H

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise it, set `most`. */
typedef struct CzLines {
    size_t most; /* longest line that is kept [byte] */
    char *text;  /* bytes that were read (n) */
    size_t n, room;
    size_t at;   /* the next line begins here */
    size_t seen; /* bytes from there without an end of line */
    bool is_at_end;
} CzLines;

typedef enum CzLineEvent {
    CZ_LINE,          /* a line, without its end; the last one may lack it */
    CZ_LINE_TOO_LONG, /* its bytes are dropped */
    CZ_LINES_END,
    CZ_LINES_STOPPED, /* a signal of cz_interrupt_catch */
    CZ_LINES_FAILED   /* standard input cannot be read, or without memory */
} CzLineEvent;

/* Waits for the next line; *line is valid until the next call. */
CzLineEvent cz_lines_next(CzLines *lines, const char **line, size_t *n_byte);
void cz_lines_free(CzLines *lines);

#endif
