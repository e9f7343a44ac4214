/* Values put in by path: `set:` of the file and --set of the command line.
 *
 * A setting means what typing the value at that place would mean. So settings of parts come first,
 * those of a part before those of the parts that use it, and what a vehicle says for itself goes
 * before its part, whatever the order of the settings; among settings of one place the later wins.
 */
#ifndef CZ_TREE_SETTINGS_H
#define CZ_TREE_SETTINGS_H

#include "tree/path.h"

typedef struct CzSetting {
    const char *path;
    const CzNode *place; /* of the path */
    const CzNode *value;
    CzMatches *matches; /* stand-ins for numbers are put in, and this gets their places; NULL: the
                           value is put in */
} CzSetting;

/* Settings of the file's `set:`, then those of the command line, "path=value" (n_set). */
const CzSetting *cz_settings_gather(CzReader *reader, const CzNode *root, int n_set,
                                    const char *const *set, int *n_setting);

/* The tree with all settings put in. */
CzTree cz_settings_apply(CzReader *reader, const CzTree *tree, const CzSetting *setting,
                         int n_setting);

#endif
