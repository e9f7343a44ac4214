/* Help topics other than commands: lists of checks, metrics, channels and so on, made from the
 * program's own tables. */
#include "cli/help.h"

#include "crushzone/optimise.h"
#include "crushzone/problem.h"
#include "crushzone/report.h"
#include "cli/session.h"

#include "evaluate/results.h"
#include "simulate/pulse.h"
#include "text/units.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const CzHelpEntry cz_topics[CZ_N_TOPIC] = {
#define CZ_TOPIC(constant, name, doc) {name, doc},
#include "cli/topics.def"
#undef CZ_TOPIC
};

/* ---- exit codes ---- */

const CzHelpEntry cz_exit_codes[] = {
    {"0", "done"},
    {"1", "a check fails or could not be made, no feasible design was found, the required "
          "statistic of a check is violated (sample), a law is refused (fit)"},
    {"2", "error in the command line or a problem file"},
    {"3", "a run failed or is incomplete; the time limit of a search (--max-time) was reached, the "
          "best design so far is written"},
    {"4", "results cannot be written"},
    {"5", "internal error, or no memory"},
    {"130", "interrupted (143 by SIGTERM); the best design so far is written"},
    {NULL, NULL}};

/* ---- verdicts ---- */

/* The rule of cz_verdict_over. */
const CzHelpEntry cz_verdict_rules[] = {
    {"FAIL", "a check fails, or a vehicle climbed: later results are beyond the model"},
    {"NOT CHECKED",
     "else: a run failed or is incomplete, a check could not be made, or there is no "
     "check at all"},
    {"PROVISIONAL", "else: a check satisfies a limit, or is of a scenario of the profile, that is "
                    "not confirmed, that is, of a "
                    "confidence other than S1 (read in the primary text) and user (set by you)"},
    {"pass", "else: every check is satisfied"},
    {NULL, NULL}};

const char cz_verdict_remark[] =
    "The same rule applies to a scenario, a problem, a point of a sweep, an optimum and compared "
    "runs, in tables, JSON, JUnit, reports and exit codes: check, run --strict, sweep --strict, "
    "sample, challenge, optimise, pareto and corridor end with 0 for pass and PROVISIONAL only. "
    "JSON has PROVISIONAL as \"verdict\": "
    "\"pass\" with \"provisional\": true. Requirements of a profile that this program cannot check "
    "are listed as not covered and never counted as passed: a pass is then one by screening and "
    "gives their number, and JSON has \"screening\": true. A yes or no has no margin. Design rules "
    "are limits of this program and not provisional. The constraints of a search are the checks "
    "that can be made, with the "
    "required margin, and the targets: FEASIBLE means that they are satisfied; the verdict covers "
    "all checks, so that optimise ends with 1 where the best design is FEASIBLE and NOT CHECKED. "
    "Of a "
    "fit (match) the tolerances decide alone.";

/* ---- lists ---- */

enum { WIDTH = 100 }; /* of help on a terminal [characters] */

void cz_help_write_wrapped(const char *text, int indent) {
    int column = indent;
    while (*text != '\0') {
        const int n = (int)strcspn(text, " ");
        if (column > indent && column + 1 + n > WIDTH) {
            printf("\n%*s", indent, "");
            column = indent;
        }
        if (column > indent) {
            putchar(' ');
            column++;
        }
        printf("%.*s", n, text);
        column += n;
        text += n;
        text += strspn(text, " ");
    }
    putchar('\n');
}

static void write_entries(int n, const CzHelpEntry *entries, int width) {
    for (int i = 0; i < n && entries[i].name != NULL; i++) {
        printf("  %-*s ", width, entries[i].name);
        cz_help_write_wrapped(entries[i].doc, width + 3);
    }
}

static void write_verdicts(void) {
    write_entries(INT_MAX, cz_verdict_rules, 12);
    putchar('\n');
    cz_help_write_wrapped(cz_verdict_remark, 0);
}

static void write_exit_codes(void) {
    write_entries(INT_MAX, cz_exit_codes, 4);
}

static void write_keys(void) {
    cz_keys_write_help(stdout);
}

static void write_units(void) {
    static const struct {
        const char *text, *suffixes;
    } dimensions[] = {
#define CZ_DIMENSION(dimension, text, units) {text, units},
#define CZ_UNIT(dimension, suffix, symbol, value) " _" suffix
#include "text/units.def"
    };
    puts("Every key with a dimension ends in one of its units, such as force_kN or stroke_mm:\n");
    for (size_t i = 0; i < sizeof dimensions / sizeof *dimensions; i++)
        if (i != CZ_DIMENSION_NONE)
            printf("  %-20s%s\n", dimensions[i].text, dimensions[i].suffixes);
}

static void write_keys_of(const char *record) {
    for (int i = 0; cz_key_name(record, i) != NULL; i++) {
        const CzHelpEntry key = {cz_key_name(record, i), cz_key_doc(record, i)};
        write_entries(1, &key, 14);
    }
}

static void write_design_rules(void) {
    static const struct {
        const char *name, *metric, *bound;
        double limit;
        const char *doc;
    } rules[] = {
#define MAX "at most"
#define MIN "at least"
#define CZ_RULE(name, metric, bound, limit, bare, speeds, needs, doc)                              \
    {name, metric, bound, limit, doc},
#include "evaluate/design_rules.def"
#undef CZ_RULE
#undef MIN
#undef MAX
    };
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        printf("  %s: %s %s %.3g\n      ", rules[i].name, rules[i].metric, rules[i].bound,
               rules[i].limit);
        cz_help_write_wrapped(rules[i].doc, 6);
    }
}

static void write_metrics(void) {
    static const CzHelpEntry metrics[] = {
#define CZ_RESULT(...)
#define CZ_QUANTITY(...)
#define CZ_METRIC_BY(record, key, form, source, unit, dimension, heading, judged, scale, absent,   \
                     when, doc)                                                                    \
    {CZ_METRIC_PREFIX_##record #key, doc},
#define CZ_METRIC(record, key, form, source, unit, dimension, heading, scale, absent, when, doc)   \
    {CZ_METRIC_PREFIX_##record #key, doc},
#include "evaluate/results.def"
    };
    write_entries((int)(sizeof metrics / sizeof *metrics), metrics, 40);
}

static void write_metric_parameters(void) {
    static const struct {
        const char *metric, *name;
        double usual;
        const char *doc;
    } parameters[] = {
#define CZ_METRIC_PARAMETER(record, key, name, in_si, lo, hi, usual, doc)                          \
    {CZ_METRIC_PREFIX_##record #key, #name, usual, doc},
#define CZ_METRIC_OF_PULSE(...)
#include "evaluate/metric_parameters.def"
    };
    for (size_t i = 0; i < sizeof parameters / sizeof *parameters; i++) {
        printf("  %s(%s", parameters[i].metric, parameters[i].name);
        if (!isnan(parameters[i].usual))
            printf("=%.3g", parameters[i].usual);
        printf(")\n      ");
        cz_help_write_wrapped(parameters[i].doc, 6);
    }
}

static void write_checks(void) {
    puts(
        "Keys of `checks:` in a problem file. The checks are the limits of the profile, the limits "
        "of the\nproblem's own, which replace those of the profile by name, and the design "
        "rules:\n");
    write_keys_of("checks");
    puts("\nKeys of a limit, which has a max, a min or both:\n");
    write_keys_of("limit");
    puts("\nDesign rules. Each applies to the devices and speeds that it names, where the problem "
         "has "
         "them:\n");
    write_design_rules();
    puts("\nMetrics for limits, targets and the objective. The worst place counts unless the name "
         "selects\none: interfaces.A4-B1.peak_force_kN, vehicles.A1.max_pitch_mrad.\n");
    write_metrics();
    puts("\nParameters of metrics, behind the name, such as vehicles.A1.siv_m_s(gap_m=0.75). One "
         "with a number\nhere has it when it is left out:\n");
    write_metric_parameters();
}

static void write_algorithms(void) {
    puts("auto: the default strategy. NLopt algorithms by name:\n");
    for (int i = 0; i < cz_n_algorithm(); i++)
        printf("  %s\n", cz_algorithm_name(i));
}

static void write_paths(void) {
    static const CzHelpEntry paths[] = {
        {"trains.A.speed_km_h", "a key of a train, by the train's name"},
        {"trains.A.vehicles.A1.mass_t", "of a vehicle, by its name"},
        {"parts.cab-end.coupler.tube.stages[0].force_kN", "of a part, wherever it is used"},
        {"parts.cab-end.stages[*].force_kN", "of every entry of a list, one variable each"},
        {"simulation.time_step_ms", "of the run itself"}};
    puts("A path names the place of a value in the file. It ends in a key with its unit,\nand the "
         "value is in that unit:\n");
    write_entries((int)(sizeof paths / sizeof *paths), paths, 46);
    puts("\nA vehicle that repeats or copies another has no values of its own; use the name of the "
         "original.\n'crushzone show FILE' prints the whole problem with its names.");
}

static void write_profiles(void) {
    const CzProblemOptions options = {.share_folder = cz_share_folder};
    puts(
        "A profile is a file of limits and scenarios, each with clause, source and confidence; a "
        "problem\ntakes it by checks: {profile: NAME, category: C-II, line_speed_km_h: 120}, where "
        "it has categories\nand where a speed depends on that of the line. It is looked for as "
        "profiles/NAME.yaml beside the\nproblem file, then where crushzone is installed. They "
        "contain no text of a standard, and a pass\nis not a certificate.\n");
    cz_profiles_write_list(&options, stdout);
    puts("\n'crushzone profile show NAME' prints limits and categories, 'crushzone profile "
         "scenarios "
         "NAME'\nthe scenarios. A scenario of the file with the name or family of one of the "
         "profile "
         "replaces it;\nchecks: {scenarios: [NAME]} selects some, checks: {override: {\"NAME\": "
         "{max: 4}}} changes a limit.");
    puts("\nA limit is confirmed by `confidence: S1`, read in the primary text, or `user`, set by "
         "you; what\nsatisfies any other is PROVISIONAL ('crushzone help verdicts').");
}

/* Example of a channel's name: A1 represents any vehicle, A4-B1 for any interface. */
static const char *channel_example(const CzChannelInfo *info, char text[CZ_CHANNEL_SIZE]) {
    const bool of_end = info->at == CZ_AT_END;
    return cz_channel_name(info, of_end ? cz_end_place(0, 1) : 0,
                           info->at == CZ_AT_INTERFACE ? "A4-B1" : "A1", text);
}

static const char channels_remark[] =
    "One row every simulation.output_step_ms. The columns depend on the vehicles; here A1 "
    "represents any vehicle, A4-B1 any interface, front either end, and w1 to w4 are the wheelsets "
    "from the rear. A missing value is blank.";
static const char beyond_doc[] =
    "1 after an override, beyond the validity of the model; energies are blank there";

static void write_channels(void) {
    cz_help_write_wrapped(channels_remark, 0);
    putchar('\n');
    for (CzChannel channel = 0; channel < CZ_N_CHANNEL; channel++) {
        char name[CZ_CHANNEL_SIZE];
        const CzChannelInfo *info = cz_channel_info(channel);
        const CzHelpEntry entry = {channel_example(info, name), info->doc};
        write_entries(1, &entry, 30);
    }
    const CzHelpEntry beyond = {"beyond_validity", beyond_doc};
    write_entries(1, &beyond, 30);
}

void cz_help_write_channels_markdown(void) {
    puts("# Channels\n\nThis page is printed by `crushzone help channels --markdown`.\n");
    puts("A run records the quantities below over time, as the columns of `channels.csv`.");
    printf("%s\n\n| column | quantity | unit | recorded for | meaning |\n|---|---|---|---|---|\n",
           channels_remark);
    static const char *const places[] = {[CZ_AT_RUN] = "the run",
                                         [CZ_AT_VEHICLE] = "a vehicle",
                                         [CZ_AT_WHEELSET] = "a wheelset",
                                         [CZ_AT_END] = "an end of a vehicle",
                                         [CZ_AT_INTERFACE] = "an interface"};
    for (CzChannel channel = 0; channel < CZ_N_CHANNEL; channel++) {
        char name[CZ_CHANNEL_SIZE], unit[16];
        const CzChannelInfo *info = cz_channel_info(channel);
        snprintf(unit, sizeof unit, "%s", info->unit);
        unit[strcspn(unit, "_")] = strchr(unit, '_') != NULL ? '/' : '\0';
        printf("| `%s` | %s | %s | %s | %s |\n", channel_example(info, name), info->title, unit,
               places[info->at], info->doc);
    }
    printf("| `beyond_validity` | flag | 1 | the run | %s |\n", beyond_doc);
}

static void write_results(void) {
    puts("Every key, its unit and meaning: docs/results.md, or 'crushzone help results "
         "--markdown'.\n'crushzone schema DOCUMENT' prints the JSON schema of a document:\n");
    for (int i = 0; cz_report_document_name(i) != NULL; i++)
        printf("  %s\n", cz_report_document_name(i));
    puts("\n'crushzone schema request' prints that of a request to serve.");
}

static void write_events(void) {
    static const CzHelpEntry events[] = {
#define CZ_EVENT(constant, text, doc) {text, doc},
#include "crushzone/events.def"
#undef CZ_EVENT
    };
    puts("Events are recorded once per place, with their time:\n");
    write_entries((int)(sizeof events / sizeof *events), events, 22);
}

static void write_figures(void) {
    static const CzHelpEntry figures[] = {
#define CZ_CHART(constant, name, title, number, axes, doc) {name, doc},
#include "crushzone/charts.def"
#undef CZ_CHART
    };
    puts("crushzone plot DIR --what NAME --svg FILE; --at names the interface or car:\n");
    write_entries((int)(sizeof figures / sizeof *figures), figures, 18);
}

static void write_files(void) {
    static const CzHelpEntry files[] = {
#define CZ_RESULT_FILE(constant, name, doc) {name, doc},
#include "crushzone/result_files.def"
#undef CZ_RESULT_FILE
    };
    puts("A result folder (-o DIR) contains:\n");
    write_entries((int)(sizeof files / sizeof *files), files, 22);
    puts("\nWith several scenarios each has a folder of its own in it. A folder that crushzone "
         "wrote "
         "is replaced\nby the next run; one with the result of a search only by another search or "
         "with --force;\nany other folder is not changed.");
}

void cz_help_write_topic(CzTopic topic) {
    static void (*const writers[CZ_N_TOPIC])(void) = {
        [CZ_TOPIC_KEYS] = write_keys,         [CZ_TOPIC_UNITS] = write_units,
        [CZ_TOPIC_CHECKS] = write_checks,     [CZ_TOPIC_PROFILES] = write_profiles,
        [CZ_TOPIC_PATHS] = write_paths,       [CZ_TOPIC_ALGORITHMS] = write_algorithms,
        [CZ_TOPIC_CHANNELS] = write_channels, [CZ_TOPIC_EVENTS] = write_events,
        [CZ_TOPIC_FIGURES] = write_figures,   [CZ_TOPIC_FILES] = write_files,
        [CZ_TOPIC_VERDICTS] = write_verdicts, [CZ_TOPIC_EXIT_CODES] = write_exit_codes,
        [CZ_TOPIC_RESULTS] = write_results};
    writers[topic]();
}
