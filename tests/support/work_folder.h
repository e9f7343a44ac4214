/* An empty folder of its own for a test program. Include it first: it asks for mkdtemp. */
#ifndef CZ_TESTS_WORK_FOLDER_H
#define CZ_TESTS_WORK_FOLDER_H

#define _XOPEN_SOURCE 700 /* mkdtemp */

#include "support/check.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char start_folder[PATH_MAX], work_folder[] = "/tmp/cz-test-XXXXXX";

/* Moves to the folder, and back while removing it; 0 on success. */
static inline int enter_work_folder(void) {
    return getcwd(start_folder, sizeof start_folder) == NULL || mkdtemp(work_folder) == NULL ||
           chdir(work_folder) != 0;
}

static inline int leave_work_folder(void) {
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", work_folder);
    return chdir(start_folder) != 0 || system(command) != 0;
}

#endif
