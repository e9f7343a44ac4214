/* Counter-based random numbers: Philox4x32-10. */
#include "statistics/random.h"

enum { N_ROUND = 10 };

void cz_random_words(const uint32_t key[2], uint32_t counter[4]) {
    uint32_t key0 = key[0], key1 = key[1];
    for (int round = 0; round < N_ROUND; round++) {
        const uint64_t product0 = UINT64_C(0xD2511F53) * counter[0];
        const uint64_t product1 = UINT64_C(0xCD9E8D57) * counter[2];
        const uint32_t second = counter[1], fourth = counter[3];
        counter[0] = (uint32_t)(product1 >> 32) ^ second ^ key0;
        counter[1] = (uint32_t)product1;
        counter[2] = (uint32_t)(product0 >> 32) ^ fourth ^ key1;
        counter[3] = (uint32_t)product0;
        key0 += UINT32_C(0x9E3779B9);
        key1 += UINT32_C(0xBB67AE85);
    }
}

static void words_at(uint64_t seed, CzRandomPurpose purpose, int draw, int sample,
                     uint32_t word[4]) {
    const uint32_t key[2] = {(uint32_t)seed, (uint32_t)(seed >> 32)};
    word[0] = (uint32_t)sample;
    word[1] = (uint32_t)draw;
    word[2] = (uint32_t)purpose;
    word[3] = 0;
    cz_random_words(key, word);
}

double cz_random_unit(uint64_t seed, CzRandomPurpose purpose, int draw, int sample) {
    uint32_t word[4];
    words_at(seed, purpose, draw, sample, word);
    const uint64_t bits = (uint64_t)word[0] << 32 | word[1];
    return ((double)(bits >> 12) + 0.5) * 0x1p-52;
}

uint32_t cz_random_bits(uint64_t seed, CzRandomPurpose purpose, int draw, int sample) {
    uint32_t word[4];
    words_at(seed, purpose, draw, sample, word);
    return word[0];
}
