/* SHA-256 after FIPS 180-4. The constants are the first 32 bits of the fractional parts of the cube
 * roots of the first 64 primes, and of the square roots of the first 8; they are found by whole
 * numbers, so that no table can hold a slip of the pen.
 */
#include "report/sha256.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

typedef struct Hash {
    uint32_t constant[64];
    uint32_t state[8];
} Hash;

static bool is_prime(uint32_t n) {
    for (uint32_t d = 2; d * d <= n; d++)
        if (n % d == 0)
            return false;
    return true;
}

/* Whether root^power <= n * 2^(32 power): by schoolbook products in 32-bit digits. */
static bool is_below(uint64_t root, int power, uint32_t n) {
    uint64_t product[6] = {1}; /* digits, lowest first */
    for (int i = 0; i < power; i++) {
        uint64_t next[6] = {0};
        for (int k = 0; k < 4; k++)
            for (int half = 0; half < 2; half++) {
                const uint64_t part = product[k] * (half == 0 ? root & 0xffffffff : root >> 32);
                next[k + half] += part & 0xffffffff;
                next[k + half + 1] += part >> 32;
            }
        for (int k = 0; k < 5; k++) {
            next[k + 1] += next[k] >> 32;
            product[k] = next[k] & 0xffffffff;
        }
    }
    uint64_t whole = 0, rest = 0; /* the product over 2^(32 power), and whether anything is left */
    for (int k = 4; k >= power; k--)
        whole = (whole << 32) + product[k];
    for (int k = 0; k < power; k++)
        rest |= product[k];
    return whole < n || (whole == n && rest == 0);
}

/* First 32 bits of the fractional part of the root. */
static uint32_t root_fraction(uint32_t n, int power) {
    uint64_t root = 0;
    for (int bit = 36; bit >= 0; bit--)
        if (is_below(root | (UINT64_C(1) << bit), power, n))
            root |= UINT64_C(1) << bit;
    return (uint32_t)root;
}

static void begin(Hash *hash) {
    uint32_t prime = 1;
    for (int i = 0; i < 64; i++) {
        do
            prime++;
        while (!is_prime(prime));
        hash->constant[i] = root_fraction(prime, 3);
        if (i < 8)
            hash->state[i] = root_fraction(prime, 2);
    }
}

static uint32_t turn(uint32_t x, int n) {
    return x >> n | x << (32 - n);
}

static void mix(Hash *hash, const unsigned char block[64]) {
    uint32_t w[64], s[8];
    for (int i = 0; i < 16; i++)
        w[i] = (uint32_t)block[4 * i] << 24 | (uint32_t)block[4 * i + 1] << 16 |
               (uint32_t)block[4 * i + 2] << 8 | block[4 * i + 3];
    for (int i = 16; i < 64; i++) {
        const uint32_t a = turn(w[i - 15], 7) ^ turn(w[i - 15], 18) ^ w[i - 15] >> 3;
        const uint32_t b = turn(w[i - 2], 17) ^ turn(w[i - 2], 19) ^ w[i - 2] >> 10;
        w[i] = w[i - 16] + a + w[i - 7] + b;
    }
    memcpy(s, hash->state, sizeof s);
    for (int i = 0; i < 64; i++) {
        const uint32_t e = turn(s[4], 6) ^ turn(s[4], 11) ^ turn(s[4], 25);
        const uint32_t choice = (s[4] & s[5]) ^ (~s[4] & s[6]);
        const uint32_t a = turn(s[0], 2) ^ turn(s[0], 13) ^ turn(s[0], 22);
        const uint32_t majority = (s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]);
        const uint32_t first = s[7] + e + choice + hash->constant[i] + w[i];
        memmove(s + 1, s, 7 * sizeof *s);
        s[4] += first;
        s[0] = first + a + majority;
    }
    for (int i = 0; i < 8; i++)
        hash->state[i] += s[i];
}

/* The last bytes, a one, zeros and the length in bits. */
static void finish(Hash *hash, const char *bytes, size_t n, size_t n_left) {
    unsigned char last[128] = {0};
    const size_t room = n_left < 56 ? 64 : 128;
    memcpy(last, bytes, n_left);
    last[n_left] = 0x80;
    for (int i = 0; i < 8; i++)
        last[room - 1 - (size_t)i] = (unsigned char)((uint64_t)n * 8 >> 8 * i);
    mix(hash, last);
    if (room == 128)
        mix(hash, last + 64);
}

const char *cz_sha256_base64(const char *bytes, size_t n, char text[CZ_SHA256_ROOM]) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    Hash hash;
    unsigned char digest[33] = {0}; /* one byte more fills the last three */
    begin(&hash);
    size_t done = 0;
    for (; n - done >= 64; done += 64)
        mix(&hash, (const unsigned char *)bytes + done);
    finish(&hash, bytes + done, n, n - done);
    for (int i = 0; i < 32; i++)
        digest[i] = (unsigned char)(hash.state[i / 4] >> (24 - 8 * (i % 4)));
    for (int i = 0; i < 11; i++) {
        const unsigned char *three = digest + 3 * i;
        text[4 * i] = digits[three[0] >> 2];
        text[4 * i + 1] = digits[(three[0] & 3) << 4 | three[1] >> 4];
        text[4 * i + 2] = digits[(three[1] & 15) << 2 | three[2] >> 6];
        text[4 * i + 3] = digits[three[2] & 63];
    }
    text[43] = '=';
    text[44] = '\0';
    return text;
}
