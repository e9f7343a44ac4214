/* The first SIGINT or SIGTERM raises a flag, so that what was done is kept; the second ends at
 * once. */
#ifndef CZ_CLI_INTERRUPT_H
#define CZ_CLI_INTERRUPT_H

#include <signal.h>

void cz_interrupt_catch(void);

/* The flag that the library looks at. */
const volatile sig_atomic_t *cz_interrupt_flag(void);

/* The signal that came, SIGINT when none did. */
int cz_interrupt_signal(void);

#endif
