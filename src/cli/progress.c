/* Progress of a search, on standard error. */
#include "cli/progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"

static const double terminal_interval = 0.2, log_interval = 10; /* [s] */

void cz_progress_begin(CzProgressLine *line, const CzArguments *arguments, bool is_margin,
                       const char *unit) {
    const char *term = getenv("TERM");
    const bool is_watched = isatty(STDERR_FILENO);
    line->is_silent = arguments->text[CZ_OPTION_QUIET] != NULL ||
                      (!is_watched && arguments->text[CZ_OPTION_VERBOSE] == NULL);
    line->is_terminal = is_watched && term != NULL && term[0] != '\0' && strcmp(term, "dumb") != 0;
    line->is_margin = is_margin;
    line->unit = unit != NULL ? unit : "";
    line->started = line->shown = cz_clock();
}

/* A number with groups of thousands, such as "1 432". */
static void group_thousands(double value, char text[32]) {
    if (!(fabs(value) < 1e9)) {
        snprintf(text, 32, "%.4g", value);
        return;
    }
    if (fabs(value) < 1000) {
        snprintf(text, 32, "%.3g", value);
        return;
    }
    const long whole = lround(fabs(value));
    const char *sign = value < 0 ? "-" : "";
    if (whole < 1000000)
        snprintf(text, 32, "%s%ld %03ld", sign, whole / 1000, whole % 1000);
    else
        snprintf(text, 32, "%s%ld %03ld %03ld", sign, whole / 1000000, whole / 1000 % 1000,
                 whole % 1000);
}

static void describe(const CzProgress *progress, const CzProgressLine *line, double now,
                     size_t room, char *text) {
    char best[80], number[32];
    const double elapsed = now - line->started;
    const double rate = elapsed > 0 ? (double)progress->n_evaluation / elapsed : 0;
    const double left =
        rate > 0 ? (double)(progress->most_evaluations - progress->n_evaluation) / rate : 0;
    const long eta = left > 0 ? lround(fmin(left, 359999)) : 0;
    group_thousands(progress->best_objective, number);
    if (progress->feasible && line->is_margin)
        snprintf(best, sizeof best, "best margin %+.3g %% feasible",
                 -100 * progress->best_objective);
    else if (progress->feasible)
        snprintf(best, sizeof best, "best %s%s%s feasible", number,
                 line->unit[0] != '\0' ? " " : "", line->unit);
    else if (progress->best_fails_a_flag)
        snprintf(best, sizeof best, "best violates a yes-or-no check");
    else if (isfinite(progress->best_violation))
        snprintf(best, sizeof best, "best violates by %.3g %%", 100 * progress->best_violation);
    else
        snprintf(best, sizeof best, "none yet");
    snprintf(text, room, "eval %ld | %s | %.3g/s | ETA %ld:%02ld | %s", progress->n_evaluation,
             best, rate, eta / 60, eta % 60, progress->phase != NULL ? progress->phase : "");
}

void cz_progress_show(const CzProgress *progress, void *data) {
    CzProgressLine *line = data;
    const double now = cz_clock();
    const double interval = line->is_terminal ? terminal_interval : log_interval;
    if (line->is_silent || now - line->shown < interval)
        return;
    char text[200];
    line->shown = now;
    describe(progress, line, now, sizeof text, text);
    if (line->is_terminal)
        fprintf(stderr, "\r%s\033[K", text);
    else
        fprintf(stderr, "%s\n", text);
    fflush(stderr);
}

void cz_progress_end(CzProgressLine *line) {
    if (!line->is_silent && line->is_terminal && line->shown > line->started) {
        fputs("\r\033[K", stderr);
        fflush(stderr);
    }
}

void cz_progress_count(int n_done, int n_all, void *data) {
    const CzArguments *arguments = data;
    if (isatty(STDERR_FILENO) && arguments->text[CZ_OPTION_QUIET] == NULL)
        fprintf(stderr, "\r%d of %d%s", n_done, n_all, n_done >= n_all ? "\r\033[K" : "");
}
