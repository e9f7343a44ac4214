/* properties PROGRAM CATALOGUE FIRST COUNT: properties of every run, tried on COUNT random designs
 * that the reader accepts, from number FIRST on. Prints one line `ok - sentence` or `not ok -
 * sentence` per property; each violation names the number of its design, whose file stays in the
 * current folder as design-NUMBER.yaml. Exit code 1 when a property is violated.
 */
#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>

#include "crushzone/crushzone.h"
#include "property/random_design.h"

/* CZ_PROPERTY(constant, sentence) */
#define PROPERTIES                                                                                 \
    CZ_PROPERTY(READS, "a file that validate accepts is run, one that it refuses ends with 2")     \
    CZ_PROPERTY(CODES, "every exit code is a documented one, and no run ends by a signal")         \
    CZ_PROPERTY(NUMBERS, "a completed run has a number for every key")                             \
    CZ_PROPERTY(VERDICTS, "table, JSON and exit code give one verdict")                            \
    CZ_PROPERTY(FAILED, "a run fails only where a strut has no length left")                       \
    CZ_PROPERTY(BALANCE, "energy and momentum balance, or the run has a warning")                  \
    CZ_PROPERTY(PASSIVE, "no element creates energy, all dissipate at most the initial energy")    \
    CZ_PROPERTY(SUMS, "the energies of the elements add up to that of the absorbers")              \
    CZ_PROPERTY(STROKES, "no stroke exceeds the closure of its interface")                         \
    CZ_PROPERTY(BOTTOMED, "devices beyond their stroke have bottomed out, and no others")          \
    CZ_PROPERTY(ENDED, "after the end criterion no force pushes cars apart")

typedef enum {
#define CZ_PROPERTY(constant, sentence) constant,
    PROPERTIES
#undef CZ_PROPERTY
        N_PROPERTY
} Property;

static const char *const sentence_of[N_PROPERTY] = {
#define CZ_PROPERTY(constant, sentence) sentence,
    PROPERTIES
#undef CZ_PROPERTY
};

typedef struct {
    const char *program;
    char file[64];
    unsigned long long number; /* of the design */
    long n_broken[N_PROPERTY];
    long n_tried[N_PROPERTY];
    bool is_poor; /* the program warns of its energy balance */
    bool keep;    /* the design violates a property: its file stays */
} Trial;

/* Records whether a property is satisfied; prints a violation. */
static void expect(Trial *trial, Property property, bool holds, const char *what, double value,
                   double limit) {
    trial->n_tried[property]++;
    if (holds)
        return;
    trial->n_broken[property]++;
    trial->keep = true;
    printf("    design %llu: %s: %s: %.6g, allowed %.6g\n", trial->number, sentence_of[property],
           what, value, limit);
}

/* Standard output of a command, and its exit code, or minus the number of the signal. The caller
 * frees the text. */
static char *output_of(const Trial *trial, const char *words, int *code) {
    char command[1200];
    snprintf(command, sizeof command, "'%s' %s %s 2>/dev/null", trial->program, words, trial->file);
    FILE *pipe = popen(command, "r");
    size_t n = 0, room = 1 << 16;
    char *text = malloc(room);
    if (pipe == NULL || text == NULL)
        exit(2);
    for (size_t got; (got = fread(text + n, 1, room - n - 1, pipe)) > 0;) {
        n += got;
        if (room - n < 2 && (text = realloc(text, room *= 2)) == NULL)
            exit(2);
    }
    text[n] = '\0';
    const int status = pclose(pipe);
    *code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return text;
}

/* Names that have a number in every document of a completed run. */
static bool has_number(const char *key) {
    static const char *const keys[] = {"initial_kJ",
                                       "final_kinetic_kJ",
                                       "dissipated_kJ",
                                       "stored_kJ",
                                       "wheel_rail_kJ",
                                       "running_gear_kJ",
                                       "track_kJ",
                                       "moving_load_kJ",
                                       "absorbers_kJ",
                                       "survival_kJ",
                                       "balance_error",
                                       "momentum_error",
                                       "simulated_s",
                                       "time_step_s",
                                       "steps",
                                       "closing_speed_km_h",
                                       "peak_force_kN",
                                       "peak_time_ms",
                                       "shortening_mm",
                                       "energy_kJ",
                                       "energy_share",
                                       "section_force_kN",
                                       "stroke_mm",
                                       "stroke_used",
                                       "tube_energy_kJ",
                                       "plastic_energy_kJ",
                                       "crush",
                                       "survival",
                                       "temporary",
                                       "final_speed_km_h",
                                       "peak_deceleration_g",
                                       "mean_deceleration_contact_g",
                                       "mean_deceleration_120ms_g"};
    for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++)
        if (strcmp(keys[k], key) == 0)
            return true;
    return false;
}

/* Names of sums over a whole run, which are null in a run that went beyond the model's validity. */
static bool is_total(const char *key) {
    static const char *const keys[] = {
        "final_kinetic_kJ", "dissipated_kJ", "stored_kJ",      "wheel_rail_kJ", "running_gear_kJ",
        "track_kJ",         "absorbers_kJ",  "moving_load_kJ", "survival_kJ",   "energy_kJ",
        "energy_share",     "crush",         "tube_energy_kJ", "survival",      "temporary"};
    for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++)
        if (strcmp(keys[k], key) == 0)
            return true;
    return false;
}

/* The first key below `json` that lacks its number, or has a total beyond the model's validity;
 * NULL when there is none. */
static const char *wrong_key(const json_t *json, const char *key, bool beyond) {
    const char *name, *found;
    json_t *value;
    size_t index;
    beyond |= json_is_true(json_object_get(json, "beyond_validity"));
    if (beyond && is_total(key) && json_is_number(json))
        return key;
    if (json_is_null(json))
        return has_number(key) && !(beyond && is_total(key)) ? key : NULL;
    json_object_foreach((json_t *)json, name, value) {
        if ((found = wrong_key(value, name, beyond)) != NULL)
            return found;
    }
    json_array_foreach(json, index, value) {
        if ((found = wrong_key(value, key, beyond)) != NULL)
            return found;
    }
    return NULL;
}

static bool has_text(const json_t *object, const char *key, const char *text) {
    const char *value = json_string_value(json_object_get(object, key));
    return value != NULL && strcmp(value, text) == 0;
}

/* The word after "Verdict: " in a table, "" when it has none. */
static void verdict_of_table(const char *table, char *word, size_t n) {
    const char *at = table, *last = NULL;
    while ((at = strstr(at, "Verdict: ")) != NULL)
        last = at += strlen("Verdict: ");
    snprintf(word, n, "%.*s", last == NULL ? 0 : (int)strcspn(last, ".\n"), last ? last : "");
}

/* The verdict of a document, in the words of the table. */
static const char *verdict_of_json(const json_t *json) {
    if (has_text(json, "verdict", "fail"))
        return "FAIL";
    if (has_text(json, "verdict", "not checked"))
        return "NOT CHECKED";
    return json_is_true(json_object_get(json, "provisional")) ? "PROVISIONAL" : "pass";
}

/* `check` once as a table and once as a document. */
static void try_program(Trial *trial) {
    int code_of_table, code_of_json;
    json_error_t error;
    char *table = output_of(trial, "check", &code_of_table);
    char *text = output_of(trial, "check --json", &code_of_json);
    json_t *json = json_loads(text, 0, &error);
    trial->is_poor = strstr(text, "error of the energy balance is above 0.1 %") != NULL;
    expect(trial, CODES, code_of_table >= 0 && code_of_table <= 3, "check", code_of_table, 3);
    expect(trial, CODES, code_of_json == code_of_table, "check --json", code_of_json,
           code_of_table);
    expect(trial, NUMBERS, json != NULL, error.text, error.line, 0);
    if (json != NULL && has_text(json, "status", "completed")) {
        const char *wrong = wrong_key(json, "document", false);
        expect(trial, NUMBERS, wrong == NULL, wrong ? wrong : "", NAN, 0);
        char word[64], what[160];
        verdict_of_table(table, word, sizeof word);
        const char *expected = verdict_of_json(json);
        snprintf(what, sizeof what, "table '%s', document '%s'", word, expected);
        expect(trial, VERDICTS, strncasecmp(word, expected, strlen(expected)) == 0, what,
               code_of_table, 0);
        const bool passes = strcmp(expected, "pass") == 0 || strcmp(expected, "PROVISIONAL") == 0;
        expect(trial, VERDICTS, passes == (code_of_table == 0), what, code_of_table, !passes);
    }
    json_decref(json);
    free(table);
    free(text);
}

/* Rounding of sums of some 1e4 steps, as a share of the initial energy. */
#define ROUNDING 1e-9

/* Energy error at breakpoints of laws, as a share of the largest work of an element: four of them
 * passed at a hundredth of the stroke. */
#define CORNERS 1e-4

/* The same in a stop of k = 1 GN/m before an end mass of m = 1 t, at a step h of 0.1 ms:
 * h^2 k / (12 m), rounded up. */
#define STOP 1e-3

/* Energy error of a step that touches a preloaded buffer, as a share of the initial energy. The
 * program uses the preload and allows less. */
#define TOUCH 1e-5

#define END_STIFFNESS 110e6 /* no end of the designs is softer where it unloads [N/m] */

/* Every element of an interface, and all together. */
static void try_interface(Trial *trial, const CzRunSummary *summary,
                          const CzInterfaceResult *interface, double *sum) {
    const double rounding = ROUNDING * summary->energy.initial;
    /* Vehicle `side` of the interface, the strokes that lie in series on its side. */
    double coupler = 0.0, end = 0.0, buffers = 0.0, elastic = 0.0, reversible = 0.0;
    for (int k = 0; k < interface->n_element; k++) {
        const CzElementResult *element = &interface->element[k];
        *sum += element->energy;
        const double given =
            rounding + TOUCH * summary->energy.initial +
            (element->bottomed_out ? STOP : CORNERS) * element->peak_force * element->stroke;
        expect(trial, PASSIVE, element->energy >= -given, element->name, element->energy, -given);
        expect(trial, PASSIVE, element->stored >= -rounding, element->name, element->stored,
               -rounding);
        expect(trial, BOTTOMED, element->bottomed_out == (element->stroke_used > 1.0),
               element->name, element->stroke_used, 1.0);
        /* Reversible strokes are largest at their own times: only plastic ones add up. */
        double *sum_of = element->kind == CZ_ELEMENT_COUPLER        ? &coupler
                         : element->kind == CZ_ELEMENT_SIDE_BUFFERS ? &buffers
                                                                    : NULL;
        if (sum_of != NULL && element->tube_energy > 0.0)
            *sum_of += element->stroke;
        else if (sum_of != NULL)
            reversible = fmax(reversible, element->stroke);
        end += element->kind == CZ_ELEMENT_ANTI_CLIMBER || element->kind == CZ_ELEMENT_END
                   ? element->stroke
                   : 0.0;
        elastic += element->kind == CZ_ELEMENT_END ? element->peak_force / END_STIFFNESS : 0.0;
    }
    if (summary->beyond_validity) /* cars that have climbed can be anywhere */
        return;
    /* The closure is that of the bodies; pitch moves points up to 3 m above or below. The
     * stroke of an end is its largest shortening, whose elastic part other elements may absorb
     * later. */
    double turned = 0.0;
    for (int i = 0; i < summary->n_vehicle; i++)
        turned = fmax(turned, 6.0 * summary->vehicle[i].max_pitch);
    const double largest = fmax(fmax(coupler, reversible), fmax(end, buffers));
    const double most = interface->shortening + turned + elastic + 1e-6;
    expect(trial, STROKES, largest <= most, interface->name, largest, most);
}

/* Whether the closure of an interface stayed within 0.1 mm of a value for the last 0.2 s: brakes
 * hold the remaining force. */
static bool is_held(const CzRun *run, const double *closure) {
    const double *t = cz_run_channel(run, CZ_CHANNEL_TIME, 0); /* [ms] */
    const int last = cz_run_n_sample(run) - 1;
    double low = closure[last], high = closure[last];
    for (int i = last; i >= 0 && t[i] > t[last] - 200.0; i--) {
        low = fmin(low, closure[i]);
        high = fmax(high, closure[i]);
    }
    return high - low <= 0.2; /* [mm] */
}

/* No force is left: an interface is open or held, and stores at most a thousandth of the initial
 * energy. */
static void try_end(Trial *trial, const CzRun *run, const CzRunSummary *summary) {
    const int last = cz_run_n_sample(run) - 1;
    if (summary->ended != CZ_ENDED_BY_RULE || last < 0)
        return;
    for (int i = 0; i < summary->n_interface; i++) {
        const CzInterfaceResult *interface = &summary->interface[i];
        const double *force = cz_run_channel(run, CZ_CHANNEL_INTERFACE_FORCE, i); /* [kN] */
        const double *closure = cz_run_channel(run, CZ_CHANNEL_INTERFACE_CLOSURE, i);
        double stored = 0.0;
        bool opens = summary->vehicle[i].name[0] != summary->vehicle[i + 1].name[0];
        for (int k = 0; k < interface->n_element; k++) {
            stored += interface->element[k].stored;
            opens |= interface->element[k].sheared;
        }
        if (!opens || is_held(run, closure))
            continue;
        expect(trial, ENDED, fabs(force[last]) <= 1e-3, interface->name, force[last], 1e-3);
        const double most = 1e-3 * summary->energy.initial;
        expect(trial, ENDED, stored <= most, interface->name, stored, most);
    }
}

static void try_run(Trial *trial, const CzModel *model) {
    CzRun *run = NULL;
    CzError error = {0};
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = true;
    if (cz_simulate(model, &options, &run, &error) != CZ_OK) {
        expect(trial, FAILED, false, error.message, 0, 0);
        return;
    }
    const CzRunSummary *summary = cz_run_summary(run);
    const bool is_strut = strstr(summary->failure, "from its pivot to its face") != NULL;
    expect(trial, FAILED, summary->status == CZ_OK || is_strut, summary->failure, 0, 0);
    if (summary->status == CZ_OK) {
        const CzEnergy *energy = &summary->energy;
        const double rounding = ROUNDING * energy->initial;
        double sum = 0.0;
        expect(trial, BALANCE, energy->balance_error <= 1e-3 || trial->is_poor, "energy",
               energy->balance_error, 1e-3);
        expect(trial, BALANCE, summary->momentum_error <= 1e-9, "momentum", summary->momentum_error,
               1e-9);
        expect(trial, PASSIVE,
               energy->dissipated <= energy->initial * (1 + ROUNDING + energy->balance_error),
               "all", energy->dissipated, energy->initial);
        for (int i = 0; i < summary->n_interface; i++)
            try_interface(trial, summary, &summary->interface[i], &sum);
        for (int i = 0; i < summary->n_outer_end; i++)
            sum += summary->outer_end[i].energy;
        expect(trial, SUMS, fabs(sum - energy->absorbers) <= rounding, "all", sum,
               energy->absorbers);
        try_end(trial, run, summary);
    }
    cz_run_free(run);
}

/* One design; returns whether the reader accepts it. */
static bool try_design(Trial *trial, const char *catalogue) {
    snprintf(trial->file, sizeof trial->file, "design-%llu.yaml", trial->number);
    trial->keep = false;
    FILE *file = fopen(trial->file, "w");
    if (file == NULL)
        exit(2);
    random_design_write(trial->number, catalogue, file);
    if (fclose(file) != 0)
        exit(2);
    CzProblem *problem = NULL;
    CzModel *model = NULL;
    CzError error = {0};
    const CzStatus read = cz_problem_read(trial->file, NULL, &problem, &error);
    const bool accepted = read == CZ_OK && cz_model_build(problem, 0, &model, &error) == CZ_OK;
    int code;
    free(output_of(trial, "validate", &code));
    expect(trial, READS, code == (accepted ? 0 : 2), error.message, code, accepted ? 0 : 2);
    if (accepted) {
        try_program(trial);
        try_run(trial, model);
    } else if (getenv("SHOW_REFUSED") != NULL)
        printf("    design %llu refused: %s\n", trial->number, error.message);
    cz_model_free(model);
    cz_problem_free(problem);
    if (!trial->keep)
        remove(trial->file);
    return accepted;
}

int main(int argc, char **argv) {
    if (argc != 5) {
        fprintf(stderr, "properties PROGRAM CATALOGUE FIRST COUNT\n");
        return 2;
    }
    Trial trial = {.program = argv[1], .number = strtoull(argv[3], NULL, 10)};
    const long n_wanted = strtol(argv[4], NULL, 10);
    long n_accepted = 0, n_drawn = 0, n_broken = 0;
    for (; n_accepted < n_wanted && n_drawn < 3 * n_wanted; n_drawn++, trial.number++)
        n_accepted += try_design(&trial, argv[2]);
    printf("%ld designs drawn, %ld accepted\n", n_drawn, n_accepted);
    for (int property = 0; property < N_PROPERTY; property++) {
        const bool holds = trial.n_broken[property] == 0 && trial.n_tried[property] > 0;
        printf("%s - %s (%ld of %ld)\n", holds ? "ok" : "not ok", sentence_of[property],
               trial.n_tried[property] - trial.n_broken[property], trial.n_tried[property]);
        n_broken += !holds;
    }
    return n_broken > 0 || n_accepted < n_wanted;
}
