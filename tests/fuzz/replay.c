/* Tries files with a fuzz target, without libFuzzer: replay FILE|FOLDER... */
#include <dirent.h>
#include <string.h>
#include <sys/stat.h>

#include "fuzz/fuzz.h"

static int n_input;

static void try_file(const char *path) {
    FILE *file = fopen(path, "rb");
    FUZZ_DEMAND(file != NULL);
    FUZZ_DEMAND(fseek(file, 0, SEEK_END) == 0);
    const long n_byte = ftell(file);
    FUZZ_DEMAND(n_byte >= 0);
    rewind(file);
    /* Exactly as large as the input, so that reading beyond it is detected. */
    uint8_t *data = malloc(n_byte > 0 ? (size_t)n_byte : 1);
    FUZZ_DEMAND(data != NULL);
    FUZZ_DEMAND(fread(data, 1, (size_t)n_byte, file) == (size_t)n_byte);
    fclose(file);
    fprintf(stderr, "%s\n", path); /* the last file named is the one that ended the program */
    LLVMFuzzerTestOneInput(data, (size_t)n_byte);
    free(data);
    n_input++;
}

static void try_folder(const char *path) {
    char inside[1024];
    DIR *folder = opendir(path);
    FUZZ_DEMAND(folder != NULL);
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        snprintf(inside, sizeof inside, "%s/%s", path, entry->d_name);
        if (entry->d_name[0] != '.')
            try_file(inside);
    }
    closedir(folder);
}

int main(int argc, char **argv) {
    struct stat status;
    for (int i = 1; i < argc; i++) {
        FUZZ_DEMAND(stat(argv[i], &status) == 0);
        if (S_ISDIR(status.st_mode))
            try_folder(argv[i]);
        else
            try_file(argv[i]);
    }
    printf("%d inputs\n", n_input);
    return n_input > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
