/* The segments of a path: names, [3], [*]. */
#ifndef CZ_TREE_SEGMENTS_H
#define CZ_TREE_SEGMENTS_H

#include "crushzone/names.h"

enum { CZ_MAX_SEGMENTS = 24 };

typedef enum CzSegmentKind { CZ_SEGMENT_NAME, CZ_SEGMENT_INDEX, CZ_SEGMENT_ALL } CzSegmentKind;

typedef struct CzSegment {
    CzSegmentKind kind;
    char name[CZ_LABEL_SIZE];
    int index;
    int offset; /* in the path [byte] */
} CzSegment;

/* Reads the segments of a path; returns their number, 0 when it is not a path. */
int cz_segments_read(const char *path, CzSegment segment[CZ_MAX_SEGMENTS]);

#endif
