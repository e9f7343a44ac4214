/* The first SIGINT or SIGTERM sets a flag, so that completed results are kept; the second ends the
 * program at once. */
#ifndef CZ_CLI_INTERRUPT_H
#define CZ_CLI_INTERRUPT_H

#include <signal.h>

void cz_interrupt_catch(void);

/* The flag that the library checks. */
const volatile sig_atomic_t *cz_interrupt_flag(void);

/* The signal that was received, SIGINT when there was none. */
int cz_interrupt_signal(void);

#endif
