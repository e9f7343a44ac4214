/* Combines files to one tree: the base files of `extends`, the parts of `catalogue`. */
#ifndef CZ_TREE_LOAD_H
#define CZ_TREE_LOAD_H

#include "tree/parts.h"

/* Reads one further YAML file that `place` names; NULL when it cannot be read. */
const CzNode *cz_load_file(CzReader *reader, const char *path, const CzNode *place);

/* Reads the base files and catalogues that the top file names. The tree's root is NULL on failure.
 */
CzTree cz_load_tree(CzReader *reader, const CzNode *top);

/* The parts of the catalogues that a file names, and of those that they name, without a root. */
CzTree cz_load_parts(CzReader *reader, const CzNode *top);

/* The file `name` in the folder of the file of `place`, else in the share folder under `subfolder`
 * (may be NULL); a mistake and NULL when there is none. */
const char *cz_load_locate(CzReader *reader, const char *name, const CzNode *place,
                           const char *subfolder);

#endif
