/* request_lines N SEED FILE: N lines for the command serve, those of a file with random changes.
 * request_lines check: reads answers, and prints their number when every line is one.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

enum { MAX_SEEDS = 100, LINE_SIZE = 4096 };

static uint64_t state;

/* A random number below n. */
static size_t below(size_t n) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (size_t)((state >> 11) % n);
}

/* One random change of a line of n bytes; returns its new length. */
static size_t change(char *line, size_t n, const char *other) {
    static const char *const words[] = {"{",
                                        "}",
                                        "[",
                                        "]",
                                        "\"",
                                        ":",
                                        ",",
                                        "null",
                                        "true",
                                        "1e308",
                                        "-1e-308",
                                        "1e999",
                                        "\\u0000",
                                        "\\ud83d",
                                        "\"id\":",
                                        "\"set\":",
                                        "\"op\":",
                                        "\"want\":",
                                        "\xc3\xa9",
                                        "\xff",
                                        "\t",
                                        "[*]",
                                        "parts.",
                                        "0.1",
                                        "\"variables\":",
                                        "\"scenarios\":",
                                        "\"step\":",
                                        "-",
                                        "99999999999999999999",
                                        "{}"};
    const size_t at = n > 0 ? below(n) : 0, n_other = strlen(other);
    const char *word = words[below(sizeof words / sizeof *words)];
    const size_t n_word = strlen(word), n_cut = n - at < 40 ? below(n - at + 1) : below(40);
    switch (below(6)) {
    case 0: /* another byte */
        if (n > 0)
            line[at] = (char)below(256);
        return n;
    case 1: /* a piece is missing */
        memmove(line + at, line + at + n_cut, n - at - n_cut);
        return n - n_cut;
    case 2: /* the end is missing */
        return at;
    case 3: /* a word more */
        if (n + n_word >= LINE_SIZE)
            return n;
        memmove(line + at + n_word, line + at, n - at);
        memcpy(line + at, word, n_word);
        return n + n_word;
    case 4: { /* the end of another line */
        const size_t from = below(n_other + 1), n_end = n_other - from;
        if (at + n_end >= LINE_SIZE)
            return n;
        memcpy(line + at, other + from, n_end);
        return at + n_end;
    }
    default: { /* a piece twice */
        if (n + n_cut >= LINE_SIZE)
            return n;
        memmove(line + at + n_cut, line + at, n - at);
        return n + n_cut;
    }
    }
}

static int write_lines(long n_line, const char *file) {
    static char seed[MAX_SEEDS][LINE_SIZE];
    size_t n_seed = 0;
    FILE *stream = fopen(file, "r");
    while (stream != NULL && n_seed < MAX_SEEDS && fgets(seed[n_seed], LINE_SIZE, stream) != NULL) {
        seed[n_seed][strcspn(seed[n_seed], "\n")] = '\0';
        n_seed++;
    }
    if (stream == NULL || n_seed == 0)
        return 1;
    fclose(stream);
    for (long i = 0; i < n_line; i++) {
        char line[LINE_SIZE];
        const char *first = seed[below(n_seed)];
        size_t n = strlen(first);
        memcpy(line, first, n);
        for (size_t k = below(4); k > 0; k--)
            n = change(line, n, seed[below(n_seed)]);
        for (size_t k = 0; k < n; k++)
            if (line[k] == '\n')
                line[k] = ' ';
        fwrite(line, 1, n, stdout);
        putchar('\n');
    }
    return fflush(stdout) != 0;
}

static int check(void) {
    char *line = NULL;
    size_t room = 0;
    ssize_t n;
    long n_line = 0, n_error = 0;
    while ((n = getline(&line, &room, stdin)) > 0) {
        json_error_t mistake;
        json_t *json = json_loadb(line, (size_t)n, JSON_REJECT_DUPLICATES, &mistake);
        if (json == NULL || line[n - 1] != '\n') {
            printf("line %ld is no answer: %s: %.*s\n", n_line + 1, mistake.text, (int)n, line);
            return 1;
        }
        const char *status = json_string_value(json_object_get(json, "status"));
        n_error += status != NULL && strcmp(status, "error") == 0;
        json_decref(json);
        n_line++;
    }
    free(line);
    printf("%ld answers, of which %s are errors\n", n_line,
           n_error == 0        ? "none"
           : n_error == n_line ? "all"
                               : "some");
    return 0;
}

int main(int argc, char **argv) {
    if (argc == 2 && strcmp(argv[1], "check") == 0)
        return check();
    if (argc != 4)
        return 2;
    state = strtoull(argv[2], NULL, 10) * 2654435761U + 88172645463325252U;
    return write_lines(strtol(argv[1], NULL, 10), argv[3]);
}
