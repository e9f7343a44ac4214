/* Lack of memory in the whole program: every request of run, check, optimise, pareto, sweep,
 * sample, merge, explain, report, plot and compare fails once, also those of libraries and stdio.
 * Either the program reports that there is no memory, ends with exit code 5 and leaves nothing
 * incomplete, or its output equals that with enough memory to the last byte.
 *
 * The program runs in a process of its own each time. With an argument a command is tried at every
 * request: test_memory long. Otherwise at every n-th, so that all together take some seconds. */
#define _GNU_SOURCE /* dladdr, mkdtemp, nftw */
#include "support/check.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdbool.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

int program_main(int argc, char **argv);

/* ---- requests ---- */

static long n_request;          /* so far */
static long first_failing = -1; /* number of the request that fails; -1: none */
static bool fails_on;           /* so do all later ones */

/* SUNDIALS ends the program when it gets no memory for a vector, so its requests succeed: the
 * adapter checks beforehand whether there is enough. */
static bool is_of_sundials(const void *caller) {
    Dl_info info;
    return dladdr(caller, &info) != 0 && info.dli_fname != NULL &&
           strstr(info.dli_fname, "sundials") != NULL;
}

static bool is_failing(const void *caller) {
    const long number = n_request++;
    return first_failing >= 0 &&
           (number == first_failing || (fails_on && number > first_failing)) &&
           !is_of_sundials(caller);
}

/* The system's own functions, found without allocating memory. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

/* Seen by the libraries too. */
#define SEEN __attribute__((visibility("default")))

static void *without_memory(void) {
    errno = ENOMEM;
    return NULL;
}

SEEN void *malloc(size_t size) {
    return is_failing(__builtin_return_address(0)) ? without_memory() : __libc_malloc(size);
}

SEEN void *calloc(size_t n, size_t size) {
    return is_failing(__builtin_return_address(0)) ? without_memory() : __libc_calloc(n, size);
}

SEEN void *realloc(void *memory, size_t size) {
    return is_failing(__builtin_return_address(0)) ? without_memory()
                                                   : __libc_realloc(memory, size);
}

SEEN void *aligned_alloc(size_t alignment, size_t size) {
    return is_failing(__builtin_return_address(0)) ? without_memory()
                                                   : __libc_memalign(alignment, size);
}

/* ---- one try ---- */

enum { MAX_WORDS = 16, NO_MEMORY = 5, LAST = 10 /* requests that fail always */ };

typedef struct Try {
    int code;        /* exit code; 256 + signal when it was killed */
    bool says;       /* the program reports that there is no memory */
    bool is_left;    /* a partly written file remains */
    bool is_search;  /* the folder has the result of a search, which is kept */
    uint64_t answer; /* of all output */
} Try;

static char work_folder[64], problem[128], sampled[128], made[128], shard[128], swept[128];

/* FNV-1a over a text, without the parts that differ from run to run. */
static uint64_t hash_text(uint64_t hash, const char *text, size_t n) {
    static const char timed[] = "\"run_info\"";
    for (size_t i = 0; i < n; i++) {
        if (n - i > sizeof timed && memcmp(text + i, timed, sizeof timed - 1) == 0)
            while (i < n && text[i] != '}')
                i++;
        hash = (hash ^ (unsigned char)text[i]) * UINT64_C(1099511628211);
    }
    return hash;
}

static uint64_t hash_file(const char *path) {
    static char text[1 << 22];
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    const size_t n = fread(text, 1, sizeof text, stream);
    fclose(stream);
    return hash_text(UINT64_C(14695981039346656037), text, n);
}

static uint64_t sum;  /* of the files of a folder, whatever their order */
static int n_visited; /* temporary files and folders in it */
static bool has_search;

static int visit(const char *path, const struct stat *info, int type, struct FTW *place) {
    (void)info;
    if (place->level == 0)
        return 0;
    n_visited += strncmp(path + place->base, ".crushzone-", 11) ==
                 0; /* complete output has its final name */
    has_search |= strcmp(path + place->base, "optimised.yaml") == 0;
    if (type == FTW_F && strcmp(path + place->base, "stderr") != 0)
        sum += hash_text(hash_file(path), path + place->base, strlen(path + place->base));
    return 0;
}

static int erase(const char *path, const struct stat *info, int type, struct FTW *place) {
    (void)info;
    (void)type;
    (void)place;
    return remove(path);
}

/* The child process: the streams go to files and the command runs. */
static void work(int n_word, char **word, long failing) {
    if (chdir("try") != 0)
        _exit(100);
    const int out = open("stdout", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int err = open("stderr", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (dup2(out, STDOUT_FILENO) < 0 || dup2(err, STDERR_FILENO) < 0)
        _exit(100);
    n_request = 0;
    first_failing = failing;
    const int code = program_main(n_word, word);
    first_failing = -1;
    /* The parent process gets the number of requests. */
    FILE *count = fopen("../count", "w");
    fprintf(count, "%ld\n", n_request);
    fclose(count);
    _exit(code);
}

static long count_requests(void) {
    long n = -1;
    FILE *stream = fopen("count", "r");
    assert_non_null(stream);
    assert_int_equal(fscanf(stream, "%ld", &n), 1);
    fclose(stream);
    return n;
}

static Try attempt(int n_word, char **word, long failing) {
    Try result = {0};
    int status;
    nftw("try", erase, 16, FTW_DEPTH | FTW_PHYS);
    assert_int_equal(mkdir("try", 0777), 0);
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0)
        work(n_word, word, failing);
    assert_true(child > 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 256 + WTERMSIG(status);
    sum = 0;
    n_visited = 0;
    has_search = false;
    nftw("try", visit, 16, FTW_PHYS);
    result.answer = sum;
    result.is_left = n_visited > 0;
    result.is_search = has_search;
    char text[4096];
    FILE *stream = fopen("try/stderr", "r");
    assert_non_null(stream);
    text[fread(text, 1, sizeof text - 1, stream)] = '\0';
    fclose(stream);
    result.says = strstr(text, "memory") != NULL;
    stream = fopen("try/stdout", "r");
    assert_non_null(stream);
    text[fread(text, 1, sizeof text - 1, stream)] = '\0';
    fclose(stream);
    result.says |= strstr(text, "memory") != NULL; /* of --json */
    return result;
}

/* ---- all of them ---- */

static bool is_long;

static long step_from(long i, long n, long stride) {
    if (is_long || i >= n - LAST)
        return 1;
    return i + stride < n - LAST ? stride : n - LAST - i;
}

/* Every request fails in turn; when time is short, every `stride`-th and the last ones, which
 * belong to the final output on the terminal. */
static void fail_every_request(const char *line, int stride) {
    char words[256], *word[MAX_WORDS] = {"crushzone"};
    int n_word = 1, n_bad = 0;
    snprintf(words, sizeof words, "%s", line);
    for (char *w = strtok(words, " "); w != NULL && n_word < MAX_WORDS; w = strtok(NULL, " "))
        word[n_word++] = strcmp(w, "PROBLEM") == 0   ? problem
                         : strcmp(w, "SAMPLED") == 0 ? sampled
                         : strcmp(w, "MADE") == 0    ? made
                         : strcmp(w, "SHARD") == 0   ? shard
                         : strcmp(w, "SWEPT") == 0   ? swept
                                                     : w;
    const Try whole = attempt(n_word, word, -1);
    assert_in_range(whole.code, 0, 1);
    const long n = count_requests();
    assert_in_range(n, 10, 1000000);
    for (long i = 0; i < n && n_bad < 5; i += step_from(i, n, stride)) {
        const Try found = attempt(n_word, word, i);
        const bool is_told = found.code == NO_MEMORY && found.says &&
                             (fails_on || !found.is_left || found.is_search);
        const bool is_same = found.code == whole.code && found.answer == whole.answer;
        if (is_told || is_same)
            continue;
        n_bad++;
        print_error("%s: request %ld of %ld%s: exit code %d, %s, %s\n", line, i, n,
                    fails_on ? " and all later ones" : "", found.code,
                    found.says ? "told" : "NOT TOLD", found.is_left ? "something left" : "clean");
    }
    printf("%s: %ld requests\n", line, n);
    assert_int_equal(n_bad, 0);
}

static void run_reports_every_lack_of_memory(void **state) {
    (void)state;
    fail_every_request("run PROBLEM -q -j 1 -o out", 5);
    fail_every_request("check PROBLEM -q -j 1 --json", 11);
}

static void optimise_reports_every_lack_of_memory(void **state) {
    (void)state;
    fail_every_request("optimise PROBLEM -q -j 1 -o out", 37);
}

static void sweep_reports_every_lack_of_memory(void **state) {
    (void)state;
    fail_every_request("sweep PROBLEM -q -j 1 --vary trains.A.speed_km_h=14:15:2 -o out", 11);
}

static void sample_reports_every_lack_of_memory(void **state) {
    (void)state;
    fail_every_request("sample SAMPLED -q -j 1 -n 3 -o out", 23);
    fail_every_request("sample SAMPLED -q -j 1 -n 3 --json", 31);
}

static void merge_reports_every_lack_of_memory(void **state) {
    (void)state;
    fail_every_request("sample SAMPLED -q -j 1 -n 3 --shard 1/2 -o out", 61);
    fail_every_request("merge SHARD -q -j 1 -o out", 29);
    fail_every_request("merge SWEPT -q -j 1 -o out", 23);
}

static void corridor_reports_every_lack_of_memory(void **state) {
    (void)state;
    fail_every_request("corridor SAMPLED -q -j 1 -n 1 --part end.coupler.tube -o out", 23);
    fail_every_request("corridor PROBLEM -q -j 1 -n 1 --part end --json", 31);
}

static void challenge_reports_every_lack_of_memory(void **state) {
    (void)state;
    fail_every_request("challenge SAMPLED -q -j 1 --runs 6 -o out", 71);
    fail_every_request("challenge SAMPLED -q -j 1 --runs 6 --json", 83);
}

static void pareto_reports_every_lack_of_memory(void **state) {
    (void)state;
    fail_every_request("pareto PROBLEM -q -j 1 -n 3 --minimise margin --minimise "
                       "design.installed_length_mm -o out",
                       97);
}

static void report_reports_every_lack_of_memory(void **state) {
    (void)state;
    fail_every_request("report MADE -q -j 1 -o page.html", 11);
    fail_every_request("plot MADE -q -j 1 --what panels --svg figure.svg", 17);
    fail_every_request("compare MADE MADE -q -j 1 -o page.html", 41);
}

static void a_lasting_lack_of_memory_is_reported_too(void **state) {
    (void)state;
    fails_on = true;
    fail_every_request("run PROBLEM -q -j 1 -o out", 47);
    fail_every_request("optimise PROBLEM -q -j 1 -o out", 197);
    fails_on = false;
}

static void write_problem(void) {
    FILE *stream = fopen("small.yaml", "w");
    assert_non_null(stream);
    fputs("schema: 1\ntitle: small\n"
          "simulation: {output_step_ms: 10}\n"
          "parts:\n"
          "  end:\n"
          "    face_gap_mm: 900\n"
          "    stages: [{stroke_mm: 300, force_kN: 2500}]\n"
          "    unloading_stiffness_MN_m: 100\n"
          "    coupler: {length_m: 1, buffer: {stages: [{stroke_mm: 50, force_kN: 400}]},\n"
          "              tube: {stages: [{stroke_mm: 200, force_kN: 700}]}}\n"
          "  car: {model: rigid, mass_t: 40, length_m: 18, front: {use: end}, rear: {use: end}}\n"
          "trains:\n"
          "  - {name: A, speed_km_h: 15, vehicles: [{use: car}]}\n"
          "  - {name: B, vehicles: [{use: car}]}\n"
          "scenarios: [{name: one}, {name: two, speed_km_h: 14}]\n"
          "checks: {limits: [{name: force, metric: interfaces.peak_force_kN, max: 5000}]}\n"
          "optimise:\n"
          "  evaluations: 6\n"
          "  variables: [{path: \"parts.end.coupler.tube.stages[0].force_kN\", min: 500, max: "
          "900}]\n",
          stream);
    assert_int_equal(fclose(stream), 0);
}

/* The same with uncertain numbers. */
static void write_sampled(void) {
    FILE *stream = fopen("sampled.yaml", "w");
    assert_non_null(stream);
    fputs("extends: small.yaml\n"
          "uncertainty:\n"
          "  parameters:\n"
          "    - {path: \"parts.*.coupler.tube.stages[0].force_kN\", tolerance_percent: 5,\n"
          "       group: part}\n"
          "    - {path: \"trains.*.vehicles.*.mass_t\", tolerance: 1, group: each}\n"
          "    - {path: scenario.speed_km_h, values: [13, 14]}\n",
          stream);
    assert_int_equal(fclose(stream), 0);
}

static int enter_work_folder(void **state) {
    (void)state;
    snprintf(work_folder, sizeof work_folder, "/tmp/cz-memory-XXXXXX");
    if (mkdtemp(work_folder) == NULL || chdir(work_folder) != 0)
        return 1;
    snprintf(problem, sizeof problem, "%s/small.yaml", work_folder);
    snprintf(made, sizeof made, "%s/made", work_folder);
    snprintf(sampled, sizeof sampled, "%s/sampled.yaml", work_folder);
    write_problem();
    write_sampled();
    snprintf(shard, sizeof shard, "%s/shard", work_folder);
    snprintf(swept, sizeof swept, "%s/swept", work_folder);
    char *run[] = {"crushzone", "run", problem, "-q", "-o", made};
    char *sample[] = {"crushzone", "sample",  sampled,   "-q",  "-n", "3",
                      "--set",     "title=t", "--shard", "1/1", "-o", shard};
    char *sweep[] = {"crushzone", "sweep", problem, "-q", "--vary", "trains.A.speed_km_h=14:15:2",
                     "--shard",   "1/1",   "-o",    swept};
    return attempt(6, run, -1).code + (attempt(12, sample, -1).code > 1) +
           attempt(10, sweep, -1).code;
}

static int leave_work_folder(void **state) {
    (void)state;
    return chdir("/") != 0 || nftw(work_folder, erase, 16, FTW_DEPTH | FTW_PHYS) != 0;
}

int main(int argc, char **argv) {
    is_long = argc > 1 && strcmp(argv[1], "long") == 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(run_reports_every_lack_of_memory),
        cmocka_unit_test(report_reports_every_lack_of_memory),
        cmocka_unit_test(sweep_reports_every_lack_of_memory),
        cmocka_unit_test(sample_reports_every_lack_of_memory),
        cmocka_unit_test(merge_reports_every_lack_of_memory),
        cmocka_unit_test(corridor_reports_every_lack_of_memory),
        cmocka_unit_test(challenge_reports_every_lack_of_memory),
        cmocka_unit_test(optimise_reports_every_lack_of_memory),
        cmocka_unit_test(pareto_reports_every_lack_of_memory),
        cmocka_unit_test(a_lasting_lack_of_memory_is_reported_too),
    };
    return cmocka_run_group_tests(tests, enter_work_folder, leave_work_folder);
}
