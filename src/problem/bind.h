/* Converts trees to typed records by the table of keys. */
#ifndef CZ_PROBLEM_BIND_H
#define CZ_PROBLEM_BIND_H

#include "problem/bind_curve.h"
#include "problem/keys.h"
#include "problem/places.h"
#include "tree/parts.h"

/* Context for reading records. */
typedef struct CzBinder {
    CzReader *reader;
    CzPlaces *places; /* receives the place of every record and value */
    const CzReadCurve **curves;
    const CzTree *tree;
    bool is_full;    /* inside a full vehicle */
    bool is_partial; /* inside a record whose part is missing */
} CzBinder;

/* Reads a mapping as a record. `record_memory` was zeroed. */
void cz_bind_record(CzBinder binder, const CzRecord *record, const CzNode *node,
                    const CzTrail *trail, void *record_memory);

/* Fills a record that is not in the file. */
void cz_bind_absent(const CzRecord *record, void *record_memory);

#endif
