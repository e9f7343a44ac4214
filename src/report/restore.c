/* Restores the result folder of a process that died while replacing it. */
#include "report/folder.h"

#include "crushzone/report.h"
#include "report/temporary.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Folders of a dead process; paths are empty when there is none. */
typedef struct Left {
    char made[PATH_MAX];  /* the new results, whole */
    char moved[PATH_MAX]; /* the results before them */
} Left;

static void look_at(const char *parent, const char *entry, const char *name, Left *left) {
    char path[PATH_MAX];
    struct stat info;
    if (!cz_is_temporary(entry) || cz_path_in(path, parent, entry, NULL) != CZ_OK ||
        lstat(path, &info) != 0 || !S_ISDIR(info.st_mode) || info.st_uid != geteuid())
        return;
    char *marker = cz_marker_read(path);
    if (marker != NULL && cz_marker_is_whole(marker)) {
        if (cz_marker_says(marker, CZ_MARKER_MOVED, name))
            memcpy(left->moved, path, sizeof path);
        else if (cz_marker_says(marker, CZ_MARKER_MADE_FOR, name))
            memcpy(left->made, path, sizeof path);
    }
    free(marker);
}

/* Renames a folder unless a process is using it. */
static bool put_back(const char *from, const char *to) {
    char marker[PATH_MAX];
    if (from[0] == '\0' || cz_path_in(marker, from, CZ_MARKER_NAME, NULL) != CZ_OK)
        return false;
    const int lock = cz_temporary_take(marker);
    const bool is_back = lock >= 0 && rename(from, to) == 0;
    if (lock >= 0)
        close(lock);
    return is_back;
}

bool cz_report_restore_folder(const char *path) {
    char parent[PATH_MAX], clean[PATH_MAX];
    struct stat info;
    Left left = {"", ""};
    if (strlen(path) >= PATH_MAX || lstat(path, &info) == 0)
        return false;
    snprintf(clean, sizeof clean, "%s", path);
    for (size_t n = strlen(clean); n > 1 && clean[n - 1] == '/'; n--)
        clean[n - 1] = '\0';
    const char *slash = strrchr(clean, '/'), *name = slash != NULL ? slash + 1 : clean;
    cz_parent_of(clean, parent);
    DIR *entries = opendir(parent);
    struct dirent *entry;
    while (entries != NULL && (entry = readdir(entries)) != NULL)
        look_at(parent, entry->d_name, name, &left);
    if (entries != NULL)
        closedir(entries);
    if (left.made[0] == '\0')
        return put_back(left.moved, clean);
    const bool is_back = put_back(left.made, clean); /* fails while its maker lives */
    if (is_back && left.moved[0] != '\0')
        cz_remove_listed(left.moved);
    return is_back;
}
