/* Limits of one core: additions and multiplications, and reading from the first cache, by vectors
 * as wide as those of the kernel. */
#include "bench/cases.h"

#include <stdint.h>
#include <string.h>

enum { CHAINS = 12, TURNS = 1000000, LINES = 128 };

/* A function of vectors of `bytes` bytes for processors with `instructions`. Twelve independent
 * chains of a product and a sum hide the time that each takes. */
#define ARITHMETIC(name, instructions, bytes)                                                      \
    typedef double name##_vector __attribute__((vector_size(bytes)));                              \
    __attribute__((target(instructions))) static double name(void) {                               \
        name##_vector chain[CHAINS], factor, term;                                                 \
        double sum = 0.0;                                                                          \
        for (size_t i = 0; i < sizeof term / sizeof(double); i++)                                  \
            factor[i] = 0.5, term[i] = 1.0;                                                        \
        for (int c = 0; c < CHAINS; c++)                                                           \
            chain[c] = term;                                                                       \
        for (int turn = 0; turn < TURNS; turn++)                                                   \
            for (int c = 0; c < CHAINS; c++)                                                       \
                chain[c] = chain[c] * factor + term;                                               \
        for (int c = 0; c < CHAINS; c++)                                                           \
            sum += chain[c][0];                                                                    \
        return sum;                                                                                \
    }
/* Reads 8 kB again and again. */
#define READING(name, instructions, bytes)                                                         \
    typedef int64_t name##_vector __attribute__((vector_size(bytes)));                             \
    __attribute__((target(instructions))) static double name(void) {                               \
        static name##_vector memory[LINES * 64 / (bytes)];                                         \
        name##_vector all[4];                                                                      \
        memset(all, 0, sizeof all);                                                                \
        for (int turn = 0; turn < TURNS / 50; turn++) {                                            \
            for (size_t i = 0; i < sizeof memory / sizeof *memory; i += 4)                         \
                for (size_t k = 0; k < 4; k++)                                                     \
                    all[k] |= memory[i + k];                                                       \
            __asm__ volatile("" : : "r"(memory) : "memory");                                       \
        }                                                                                          \
        return (double)(all[0] | all[1] | all[2] | all[3])[0];                                     \
    }
#define BYTES_READ ((double)LINES * 64 * (TURNS / 50))

#ifdef __x86_64__
ARITHMETIC(compute_v4, "avx512f", 64)
READING(read_v4, "avx512f", 64)
ARITHMETIC(compute_v3, "avx2", 32)
READING(read_v3, "avx2", 32)
#endif
ARITHMETIC(compute_baseline, "sse2", 16)
READING(read_baseline, "sse2", 16)

typedef struct Limit {
    const char *isa;
    double (*compute)(void), (*read)(void);
    int lanes;
} Limit;

static const Limit limits[] = {
#ifdef __x86_64__
    {"v4", compute_v4, read_v4, 8},
    {"v3", compute_v3, read_v3, 4},
#endif
    {"baseline", compute_baseline, read_baseline, 2}};

static volatile double kept; /* so that nothing is left out */

static double time_of(double (*function)(void)) {
    const double start = cz_processor_clock();
    kept = function();
    return cz_processor_clock() - start;
}

static double compute(void *limit) {
    return time_of(((const Limit *)limit)->compute);
}

static double read_cache(void *limit) {
    return time_of(((const Limit *)limit)->read);
}

void bench_add_machine(Bench *bench) {
    const Limit *limit = limits;
    while (strcmp(limit->isa, cz_isa_name()) != 0)
        limit++;
    bench_add(bench, "machine.arithmetic", "1e9 additions and multiplications at most", compute,
              (void *)limit)
        ->per = 2.0 * CHAINS * TURNS * limit->lanes / 1e9;
    bench_add(bench, "machine.reading", "1e9 bytes from the first cache at most", read_cache,
              (void *)limit)
        ->per = BYTES_READ / 1e9;
}
