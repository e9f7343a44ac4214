/* Beginning to read. */
#include "tree/reader.h"

void cz_reader_begin(CzReader *reader, const CzRecord *top, const char *share_folder) {
    CzArena *arena = &reader->arena;
    reader->mistakes.arena = reader->warnings.arena = reader->sources.arena = arena;
    reader->sources.hash = CZ_HASH_START;
    reader->top = top;
    reader->share_folder = share_folder;
}

CzValue cz_reader_value(CzReader *reader, const char *key, const CzNode *node,
                        const CzTrail *trail) {
    return (CzValue){&reader->mistakes, key, node, trail};
}
