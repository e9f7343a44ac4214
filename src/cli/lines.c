/* Reads lines from the descriptor of standard input. */
#include "cli/lines.h"

#include "cli/interrupt.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/select.h>
#include <unistd.h>

enum { READ_AT_ONCE = 1 << 16 }; /* [byte] */

/* Waits until there is something to read. Signals are let through only here, so that none is lost
 * between the look at the flag and the wait; false when one ends the program. */
static bool wait_for_input(void) {
    sigset_t blocked, before;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGINT);
    sigaddset(&blocked, SIGTERM);
    sigprocmask(SIG_BLOCK, &blocked, &before);
    bool is_ready = false;
    while (!is_ready && *cz_interrupt_flag() == 0) {
        fd_set input;
        FD_ZERO(&input);
        FD_SET(STDIN_FILENO, &input);
        is_ready = pselect(STDIN_FILENO + 1, &input, NULL, NULL, NULL, &before) > 0 ||
                   errno != EINTR; /* reading reports what is wrong */
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    return *cz_interrupt_flag() == 0;
}

/* Makes room for more input; bytes of lines that were returned are dropped. */
static bool make_room(CzLines *lines) {
    if (lines->at > 0) {
        memmove(lines->text, lines->text + lines->at, lines->n - lines->at);
        lines->n -= lines->at;
        lines->at = 0;
    }
    if (lines->room - lines->n >= READ_AT_ONCE)
        return true;
    const size_t room = 2 * lines->room + 2 * READ_AT_ONCE;
    char *text = realloc(lines->text, room);
    if (text == NULL)
        return false;
    lines->text = text;
    lines->room = room;
    return true;
}

/* Reads more input: CZ_LINE when there is some, or the reason why there is none. */
static CzLineEvent read_more(CzLines *lines) {
    if (!make_room(lines))
        return CZ_LINES_FAILED;
    for (;;) {
        if (!wait_for_input())
            return CZ_LINES_STOPPED;
        const ssize_t n = read(STDIN_FILENO, lines->text + lines->n, READ_AT_ONCE);
        if (n < 0 && (errno == EINTR || errno == EAGAIN))
            continue;
        if (n < 0)
            return CZ_LINES_FAILED;
        lines->n += (size_t)n;
        lines->is_at_end = n == 0;
        return CZ_LINE;
    }
}

CzLineEvent cz_lines_next(CzLines *lines, const char **line, size_t *n_byte) {
    bool is_too_long = false;
    for (;;) {
        const char *begin = lines->text != NULL ? lines->text + lines->at : "";
        const size_t n_left = lines->n - lines->at;
        const char *end =
            n_left > lines->seen ? memchr(begin + lines->seen, '\n', n_left - lines->seen) : NULL;
        if (end != NULL || (lines->is_at_end && n_left > 0)) {
            *line = begin;
            *n_byte = end != NULL ? (size_t)(end - begin) : n_left;
            is_too_long |= *n_byte > lines->most;
            lines->at += *n_byte + (end != NULL);
            lines->seen = 0;
            return is_too_long ? CZ_LINE_TOO_LONG : CZ_LINE;
        }
        if (lines->is_at_end)
            return is_too_long ? CZ_LINE_TOO_LONG : CZ_LINES_END;
        lines->seen = n_left;
        if (n_left > lines->most) {
            is_too_long = true;
            lines->at = lines->n;
            lines->seen = 0;
        }
        const CzLineEvent event = read_more(lines);
        if (event != CZ_LINE)
            return event;
    }
}

void cz_lines_free(CzLines *lines) {
    free(lines->text);
}
