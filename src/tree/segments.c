/* Reads the segments of a path. */
#include "tree/segments.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static bool is_end(char c) {
    return c == '\0' || c == '.' || c == '[' || c == ']';
}

/* Reads one segment; returns the rest of the path, NULL when it is not a segment. */
static const char *read_segment(CzSegment *segment, const char *path, const char *start) {
    segment->offset = (int)(path - start);
    if (strncmp(path, "[*]", 3) == 0) {
        segment->kind = CZ_SEGMENT_ALL;
        return path + 3;
    }
    if (*path == '[') {
        int n_read = 0;
        segment->kind = CZ_SEGMENT_INDEX;
        if (path[1] < '0' || path[1] > '9' ||
            sscanf(path, "[%5d]%n", &segment->index, &n_read) != 1 || n_read == 0)
            return NULL;
        return path + n_read;
    }
    size_t n = 0;
    while (!is_end(path[n]))
        n++;
    if (n == 0 || n >= CZ_LABEL_SIZE)
        return NULL;
    memcpy(segment->name, path, n);
    segment->name[n] = '\0';
    segment->kind = strcmp(segment->name, "*") == 0 ? CZ_SEGMENT_ALL : CZ_SEGMENT_NAME;
    return path + n;
}

int cz_segments_read(const char *path, CzSegment segment[CZ_MAX_SEGMENTS]) {
    int n = 0;
    const char *at = *path != '\0' ? path : NULL;
    while (at != NULL && *at != '\0') {
        const bool is_first = n == 0, is_point = *at == '.' && !is_first;
        const bool is_segment = (is_first || is_point || *at == '[') && n < CZ_MAX_SEGMENTS;
        at = is_segment ? read_segment(&segment[n++], at + is_point, path) : NULL;
    }
    return at != NULL ? n : 0;
}
