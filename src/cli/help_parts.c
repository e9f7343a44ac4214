/* `help parts`: the parts of a file or of the shipped catalogues, with their numbers. */
#include "cli/help.h"

#include "base/error.h"
#include "cli/messages.h"
#include "cli/session.h"
#include "crushzone/parts.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CATALOGUES = 64, NUMBER_SIZE = 24 };

/* A number in a column; blank for none. */
static const char *number(char text[NUMBER_SIZE], double value) {
    text[0] = '\0';
    if (isfinite(value))
        snprintf(text, NUMBER_SIZE, value < 100 ? "%.3g" : "%.0f", value);
    return text;
}

/* One force, or the smallest and the largest [kN]. */
static const char *forces(char text[2 * NUMBER_SIZE], double from, double to) {
    text[0] = '\0';
    if (isfinite(to) && from < to)
        snprintf(text, 2 * NUMBER_SIZE, "%.5g-%.5g", from, to);
    else if (isfinite(to))
        snprintf(text, 2 * NUMBER_SIZE, "%.5g", to);
    return text;
}

static void write_part(const CzPartInfo *part, int width) {
    char line[256], force[2 * NUMBER_SIZE], text[4][NUMBER_SIZE];
    int n = snprintf(line, sizeof line, "  %-*s  %-14s  %13s  %5s  %6s  %6s  %5s", width,
                     part->name, part->kind != NULL ? part->kind : "?",
                     forces(force, 1e-3 * part->force_from, 1e-3 * part->force_to),
                     number(text[0], 1e3 * part->stroke), number(text[1], 1e-3 * part->energy),
                     number(text[2], 1e-3 * part->mass), number(text[3], part->length));
    n = n < (int)sizeof line ? n : (int)sizeof line - 1;
    while (n > 0 && line[n - 1] == ' ')
        n--;
    printf("%.*s\n", n, line);
}

/* The parts of an inventory, by the file in which they are written. */
static void write_inventory(const CzInventory *inventory, const char *only_file) {
    const int n = cz_inventory_n_part(inventory);
    int width = 4;
    for (int i = 0; i < n; i++) {
        const int length = (int)strlen(cz_inventory_part(inventory, i)->name);
        width = length > width ? length : width;
    }
    const char *last = NULL;
    for (int i = 0; i < n; i++) {
        const CzPartInfo *part = cz_inventory_part(inventory, i);
        if (last == NULL || strcmp(last, part->file) != 0)
            printf("\n%s\n  %-*s  %-14s  %13s  %5s  %6s  %6s  %5s\n",
                   only_file != NULL ? only_file : part->file, width, "part", "kind", "kN", "mm",
                   "kJ", "t", "m");
        last = part->file;
        write_part(part, width);
    }
}

static int write_file(const CzArguments *arguments, const char *path, const char *name) {
    CzProblemOptions options = cz_problem_options_default();
    CzInventory *inventory = NULL;
    CzError error = {0};
    options.share_folder = cz_share_folder;
    if (cz_inventory_read(path, &options, &inventory, &error) != CZ_OK)
        return cz_print_error(arguments, &error);
    write_inventory(inventory, name);
    cz_inventory_free(inventory);
    return 0;
}

static int compare_names(const void *a, const void *b) {
    return strcmp(a, b);
}

/* All catalogues of the folder of shipped data, by name. */
static int write_catalogues(const CzArguments *arguments) {
    char path[4096], name[MAX_CATALOGUES][256];
    int n = 0, code = 0;
    snprintf(path, sizeof path, "%s/catalogue", cz_share_folder);
    DIR *folder = opendir(path);
    if (folder == NULL) {
        CzError error;
        cz_fail(&error, CZ_STATUS_INPUT, "there is no folder %.300s", path);
        return cz_print_error(arguments, &error);
    }
    for (const struct dirent *file = readdir(folder); file != NULL && n < MAX_CATALOGUES;
         file = readdir(folder)) {
        const char *end = strrchr(file->d_name, '.');
        if (end != NULL && strcmp(end, ".yaml") == 0)
            snprintf(name[n++], sizeof *name, "%s", file->d_name);
    }
    closedir(folder);
    qsort(name, (size_t)n, sizeof *name, compare_names);
    for (int i = 0; i < n && code == 0; i++) {
        char shown[sizeof *name + 16];
        snprintf(path, sizeof path, "%.3800s/catalogue/%.200s", cz_share_folder, name[i]);
        snprintf(shown, sizeof shown, "catalogue/%.200s", name[i]);
        code = write_file(arguments, path, shown);
    }
    return code;
}

int cz_help_write_parts(const CzArguments *arguments, const char *file) {
    puts("A part is taken with {use: NAME}, from a file that the problem lists under catalogue:.\n"
         "kN: smallest and largest force of all devices side by side, with trigger and shear-off;\n"
         "mm and kJ: usable stroke and its energy, of an end in front of the survival space, of a\n"
         "vehicle those of its front end. Devices in series add up; beside one another the "
         "energies\n"
         "do. t and m: mass without payload, and length.");
    return file != NULL ? write_file(arguments, file, NULL) : write_catalogues(arguments);
}
