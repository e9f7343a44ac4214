/* The first SIGINT or SIGTERM sets a flag, so that completed results are kept; the second ends the
 * program at once. The end of a time limit sets the same flag. */
#ifndef CZ_CLI_INTERRUPT_H
#define CZ_CLI_INTERRUPT_H

#include <signal.h>
#include <stdbool.h>

void cz_interrupt_catch(void);

/* Sets the flag after this time [s]. */
void cz_interrupt_after(double limit);
bool cz_interrupt_is_limit(void);

/* The flag that the library checks. */
const volatile sig_atomic_t *cz_interrupt_flag(void);

/* The exit code of a command that was interrupted: that of the signal, SIGINT when there was none,
 * or of an incomplete run at the time limit. */
int cz_interrupt_code(void);

#endif
