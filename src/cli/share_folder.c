/* Folder of shipped data. This source alone is compiled twice: for the program in the build tree,
 * and for the installed program. */
#include "cli/session.h"

const char *const cz_share_folder = CZ_SHARE_FOLDER;
