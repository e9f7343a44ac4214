/* Values set by path: `set:` of the file and --set of the command line.
 *
 * A setting has the same effect as typing the value at that place. So settings of parts are applied
 * first, those of a part before those of the parts that use it, and the values of a vehicle
 * override those of its part, whatever the order of the settings; of several settings at one place
 * the last applies.
 */
#ifndef CZ_TREE_SETTINGS_H
#define CZ_TREE_SETTINGS_H

#include "tree/path.h"

typedef struct CzSetting {
    const char *path;
    const CzNode *place; /* of the path */
    CzPut put;
    bool is_late; /* applied when the trains have been written out */
} CzSetting;

/* Settings of the file's `set:`, then those of the command line, "path=value" (n_set). */
const CzSetting *cz_settings_gather(CzReader *reader, const CzNode *root, int n_set,
                                    const char *const *set, int *n_setting);

/* Settings of the command line alone, with paths of files relative to a folder; `setting` has room
 * for them. Returns their number. */
int cz_settings_gather_options(CzReader *reader, const char *folder, int n_set,
                               const char *const *set, CzSetting *setting);

/* The tree with the settings applied whose paths begin with `beginning`, outside of parts; one that
 * names nothing is reported when all are applied. */
CzTree cz_settings_apply_first(CzReader *reader, const CzTree *tree, const CzSetting *setting,
                               int n_setting, const char *beginning);

/* The tree with all settings applied, except those that are late. */
CzTree cz_settings_apply(CzReader *reader, const CzTree *tree, const CzSetting *setting,
                         int n_setting);

/* Applies the late ones in their order to a tree whose trains have been written out. */
void cz_settings_apply_late(CzReader *reader, CzTree *tree, const CzSetting *setting,
                            int n_setting);

#endif
