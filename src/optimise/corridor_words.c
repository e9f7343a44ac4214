/* Words for the curves of a corridor, and the one that decides. */
#include "crushzone/corridor.h"

#include <stdio.h>

const char *cz_curve_words(const CzTriedCurve *curve, char words[CZ_CURVE_WORDS]) {
    static const char *const shapes[] = {[CZ_CURVE_NOMINAL] = "nominal curve",
                                         [CZ_CURVE_LOWER] = "lower edge",
                                         [CZ_CURVE_UPPER] = "upper edge",
                                         [CZ_CURVE_LOWER_PEAKED] = "lower edge with the upper peak",
                                         [CZ_CURVE_UPPER_FLAT] = "upper edge with the lower peak",
                                         [CZ_CURVE_RISING] = "rising curve",
                                         [CZ_CURVE_FALLING] = "falling curve",
                                         [CZ_CURVE_ALTERNATING] = "alternating curve",
                                         [CZ_CURVE_ALTERNATING_HIGH] =
                                             "alternating curve that begins high",
                                         [CZ_CURVE_RANDOM] = "quasi-random curve",
                                         [CZ_CURVE_ADVERSARY] = "adversary's curve"};
    int n = snprintf(words, CZ_CURVE_WORDS, "%s", shapes[curve->shape]);
    if (curve->number > 0)
        n += snprintf(words + n, (size_t)(CZ_CURVE_WORDS - n), " %d", curve->number);
    if (curve->sample >= 0)
        snprintf(words + n, (size_t)(CZ_CURVE_WORDS - n), " in sample %d", curve->sample + 1);
    return words;
}

const CzTriedCurve *cz_corridor_failure(const CzCorridor *corridor) {
    for (int i = 0; !corridor->exists && i < corridor->n_curve; i++)
        if (corridor->curve[i].state != CZ_SAMPLE_DONE ||
            !cz_verdict_passes(corridor->curve[i].verdict))
            return &corridor->curve[i];
    return NULL;
}
