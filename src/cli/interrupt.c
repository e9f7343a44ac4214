/* Signals that end a long command. */
#include "cli/interrupt.h"

#include "crushzone/status.h"

#include <math.h>
#include <stddef.h>
#include <sys/time.h>
#include <unistd.h>

/* The signal that was received, 0 for none. */
static volatile sig_atomic_t stop_signal;

/* The current run is completed, which takes time, so the user gets a message that the signal
 * arrived. */
static void on_signal(int signal_number) {
    static const char text[] =
        "\ncrushzone: stopping after the current run; press Ctrl-C again to stop at once\n";
    if (stop_signal != 0 && stop_signal != SIGALRM)
        _exit(128 + signal_number);
    stop_signal = signal_number;
    const ssize_t n_written = write(STDERR_FILENO, text, sizeof text - 1);
    (void)n_written; /* a failure of this message is ignored */
}

void cz_interrupt_catch(void) {
    struct sigaction action = {.sa_handler = on_signal};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

/* A signal of the user that came first remains. */
static void on_limit(int signal_number) {
    if (stop_signal == 0)
        stop_signal = signal_number;
}

void cz_interrupt_after(double limit) {
    struct sigaction action = {.sa_handler = on_limit};
    const struct itimerval timer = {
        .it_value = {(time_t)limit, (suseconds_t)(1e6 * (limit - floor(limit)))}};
    sigemptyset(&action.sa_mask);
    sigaction(SIGALRM, &action, NULL);
    setitimer(ITIMER_REAL, &timer, NULL);
}

bool cz_interrupt_is_limit(void) {
    return stop_signal == SIGALRM;
}

const volatile sig_atomic_t *cz_interrupt_flag(void) {
    return &stop_signal;
}

int cz_interrupt_code(void) {
    if (cz_interrupt_is_limit())
        return cz_status_exit_code(CZ_STATUS_RUN_FAILED);
    return 128 + (stop_signal != 0 ? (int)stop_signal : SIGINT);
}
