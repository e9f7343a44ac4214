/* Prints the words of problem files as a dictionary of libFuzzer: keys with their units, words of
 * closed sets, keys that reuse. */
#include <stdio.h>

#include "problem/keys.h"

static void print_key(const CzKey *key) {
    const bool has_unit = key->kind == CZ_KEY_NUMBER && key->dimension != CZ_DIMENSION_NONE;
    for (int i = 0; has_unit && i < cz_n_unit; i++)
        if (cz_units[i].dimension == key->dimension)
            printf("\"%s_%s: \"\n", key->stem, cz_units[i].suffix);
    if (!has_unit)
        printf("\"%s: \"\n", key->stem);
    if (key->kind == CZ_KEY_TABLE)
        printf("\"%s_mm\"\n\"%s_kN\"\n", key->x, key->y);
}

int main(void) {
    for (int i = 0; i < CZ_N_RECORD; i++)
        for (int k = 0; k < cz_records[i].n_key; k++)
            print_key(&cz_records[i].key[k]);
    for (int i = 0; i < CZ_N_WORDS; i++)
        for (int k = 0; k < cz_word_sets[i].n_word; k++)
            printf("\"%s\"\n", cz_word_sets[i].word[k].word);
    for (int i = 0; i < cz_n_reuse_key; i++)
        printf("\"%s: \"\n", cz_reuse_keys[i].key);
    static const char *const other[] = {"columns: [",
                                        "points: [[",
                                        "file: ",
                                        "basis: static",
                                        "[*]",
                                        "parts.",
                                        "trains.A.vehicles.A1.front.",
                                        "scenarios: ",
                                        "1e308",
                                        "-0",
                                        ".nan",
                                        "5:40:8",
                                        "1,5",
                                        "sep=;",
                                        "*DEFINE_CURVE",
                                        " derivative_variables",
                                        "{ DAKOTA_FNS = ",
                                        " ASV_1:",
                                        " DVV_1:",
                                        " AC_1:",
                                        "Name of channel 001 :",
                                        "Sampling interval :",
                                        "Time of first sample :",
                                        "Reference channel :implicit",
                                        "NOVALUE",
                                        "_TITLE",
                                        "lcid ",
                                        "$ t_ms,force_kN",
                                        "\\xef\\xbb\\xbf"};
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        printf("\"%s\"\n", other[i]);
    return 0;
}
