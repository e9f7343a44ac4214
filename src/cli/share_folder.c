/* Where the program finds shipped data. The only source of the program that is compiled twice: for
 * the one that runs from its build tree, and for the one that is installed. */
#include "cli/session.h"

const char *const cz_share_folder = CZ_SHARE_FOLDER;
