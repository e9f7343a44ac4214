/* Values put in by path: `set:` of the file and --set of the command line.
 *
 * A setting means what typing the value at that place would mean. So settings of parts come first,
 * those of a part before those of the parts that use it, and what a vehicle says for itself goes
 * before its part, whatever the order of the settings; among settings of one place the later wins.
 */
#ifndef CZ_TREE_SETTINGS_H
#define CZ_TREE_SETTINGS_H

#include "tree/parts.h"

typedef struct CzSetting {
    const char *path;
    const CzNode *place; /* of the path */
    const CzNode *value;
} CzSetting;

/* Settings of the file's `set:`, then those of the command line, "path=value" (n_set). */
const CzSetting *cz_settings_gather(CzReader *reader, const CzNode *root, int n_set,
                                    const char *const *set, int *n_setting);

/* When a setting takes its turn: 0 for parts without parts in them, more the deeper parts are
 * nested in a part, CZ_LAST_RANK for what is no part. */
enum { CZ_LAST_RANK = 48 };
int cz_setting_rank(const CzTree *tree, const char *path);

/* The tree with all settings put in. */
CzTree cz_settings_apply(CzReader *reader, const CzTree *tree, const CzSetting *setting,
                         int n_setting);

#endif
