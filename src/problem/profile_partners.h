/* Partners of a profile as trains of a problem. */
#ifndef CZ_PROBLEM_PROFILE_PARTNERS_H
#define CZ_PROBLEM_PROFILE_PARTNERS_H

#include "tree/parts.h"

/* The trains of a problem, with the partners that its scenarios need. */
typedef struct CzPartners {
    CzReader *reader;
    const CzNode *profile; /* tree of its file */
    const CzNode *own;     /* trains of the problem, with their parts inserted */
    CzNode *trains;        /* those, then partners */
    const char *moving;    /* name of the first train */
    const char *identical; /* name of the train that is its copy; NULL so far */
    CzTree parts;          /* of the profile's catalogues, once they are read */
    bool has_parts;
} CzPartners;

/* Begins with the trains of a problem's tree; false when there is none that has a name, or without
 * memory. */
bool cz_partners_begin(CzReader *reader, const CzTree *tree, const CzNode *profile,
                       CzPartners *partners);

/* The train that is a partner: `identical`, a train of the problem that has the partner's name, or
 * that of the profile, which is added. NULL with a mistake at `named`, where a scenario names it,
 * or without memory. */
const CzNode *cz_partners_take(CzPartners *partners, const CzNode *named);

#endif
