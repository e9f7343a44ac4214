/* `fit`: a measured curve as a staged law. */
#include "base/error.h"
#include "base/number.h"
#include "base/suggest.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "cli/result.h"
#include "crushzone/report.h"

#include <stdio.h>
#include <string.h>

static CzStatus read_kind(const CzArguments *arguments, CzFitOptions *options, CzError *error) {
    const char *word = arguments->text[CZ_OPTION_AS];
    CzSuggestion suggestion = {0};
    for (int kind = 0; word != NULL && kind < CZ_N_FIT; kind++) {
        cz_suggest(&suggestion, word, cz_fit_kind_word((CzFitKind)kind));
        options->kind = (CzFitKind)kind;
        if (strcmp(word, cz_fit_kind_word((CzFitKind)kind)) == 0)
            return CZ_OK;
    }
    static const char known[] = "KIND is coupler, anti-climber or end";
    if (word == NULL)
        return cz_fail(error, CZ_STATUS_INPUT, "'crushzone fit' needs '--as KIND'" CZ_HELP "%s",
                       known);
    cz_fail(error, CZ_STATUS_INPUT, "'--as %.40s' is not known" CZ_HELP "%s", word, known);
    cz_suggest_help(&suggestion, error);
    return CZ_STATUS_INPUT;
}

/* Reads the number of an option, if it is given. */
static CzStatus read_number(const CzArguments *arguments, CzOption option, double *number,
                            const char *help, CzError *error) {
    const char *text = arguments->text[option];
    if (text == NULL || cz_number_parse(text, number) == NULL)
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_INPUT, "'--%s %.40s' is not a number" CZ_HELP "%s",
                   cz_options[option].name, text, help);
}

static CzStatus read_zero(const CzArguments *arguments, CzFitOptions *options, CzError *error) {
    const char *zero = arguments->text[CZ_OPTION_ZERO];
    if (zero == NULL)
        return CZ_OK;
    const bool at_start = strcmp(zero, "start") == 0, at_contact = strcmp(zero, "contact") == 0;
    options->zero = at_start     ? CZ_FIT_ZERO_START
                    : at_contact ? CZ_FIT_ZERO_CONTACT
                                 : CZ_FIT_ZERO_STROKE;
    if (at_start || at_contact)
        return CZ_OK;
    return read_number(arguments, CZ_OPTION_ZERO, &options->zero_stroke,
                       "--zero takes start, contact or a stroke in the unit of the file", error);
}

/* Reads the part of the curve to fit, its signs and its zero. */
static CzStatus read_shape(const CzArguments *arguments, CzFitOptions *options, CzError *error) {
    CZ_TRY(read_zero(arguments, options, error));
    CZ_TRY(read_number(arguments, CZ_OPTION_SCALE, &options->scale, "", error));
    CZ_TRY(read_number(arguments, CZ_OPTION_FROM, &options->from, "", error));
    CZ_TRY(read_number(arguments, CZ_OPTION_TO, &options->to, "", error));
    if (!(options->scale > 0.0))
        return cz_fail(error, CZ_STATUS_INPUT,
                       "'--scale' must be greater than 0" CZ_HELP "--flip force changes the sign");
    options->flips_stroke = arguments->flip == 0 || arguments->flip == 2;
    options->flips_force = arguments->flip == 1 || arguments->flip == 2;
    return CZ_OK;
}

static CzStatus read_options(const CzArguments *arguments, CzFitOptions *options, CzError *error) {
    CZ_TRY(read_kind(arguments, options, error));
    options->is_dynamic = arguments->basis == 1;
    if (arguments->basis < 0)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "'crushzone fit' needs '--basis static' or '--basis dynamic'" CZ_HELP
                       "a dynamic curve was measured at speed and already contains the rise with "
                       "the rate");
    options->n_stage = arguments->n_stage;
    options->name = arguments->text[CZ_OPTION_NAME];
    options->stroke = arguments->text[CZ_OPTION_STROKE];
    options->force = arguments->text[CZ_OPTION_FORCE];
    options->stroke_unit = arguments->text[CZ_OPTION_STROKE_UNIT];
    options->force_unit = arguments->text[CZ_OPTION_FORCE_UNIT];
    if (arguments->text[CZ_OPTION_CSV_SEP] != NULL)
        options->separator = arguments->csv_separator;
    if (arguments->text[CZ_OPTION_CSV_DECIMAL] != NULL)
        options->decimal = arguments->csv_decimal;
    return read_shape(arguments, options, error);
}

static CzStatus write_figure(const void *data, FILE *stream, CzError *error) {
    return cz_report_write_fit_figure(data, stream, error);
}

/* Reports doubts about the law on standard error, or why nothing was written. */
static void report_doubts(const CzFit *fit) {
    const CzFitSummary *summary = cz_fit_summary(fit);
    for (int i = 0; i < summary->n_doubt; i++)
        fprintf(stderr, "%s: %s: %s\n", summary->file,
                summary->verdict == CZ_FIT_REFUSED ? "error" : "warning", summary->doubt[i]);
    if (summary->verdict == CZ_FIT_REFUSED)
        fprintf(stderr,
                "  help: no law of kind %s fits this curve, so none is written; try another --as, "
                "--from or --to; --svg FILE draws curve and law\n",
                cz_fit_kind_word(summary->kind));
}

/* Writes the law; a refused one only with --json, where its verdict is given. Returns the exit
 * code. */
static int write_fit(const CzArguments *arguments, const CzFit *fit) {
    const char *svg = arguments->text[CZ_OPTION_SVG];
    CzError error = {0};
    int code = cz_fit_summary(fit)->verdict == CZ_FIT_REFUSED ? 1 : 0;
    if (arguments->text[CZ_OPTION_JSON] != NULL) {
        const CzReport report = {.kind = CZ_REPORT_FIT, .fit = fit};
        if (cz_report_write_json(&report, stdout, &error) != CZ_OK)
            return cz_print_error(arguments, &error);
    } else {
        report_doubts(fit);
        cz_fit_write_yaml(fit, stdout);
    }
    if (svg == NULL)
        return code;
    const int written = cz_result_write(arguments, svg, write_figure, fit);
    return written != 0 ? written : code;
}

int cz_command_fit(const CzArguments *arguments) {
    CzFitOptions options = cz_fit_options_default();
    const char *svg = arguments->text[CZ_OPTION_SVG];
    CzError error = {0};
    CzFit *fit = NULL;
    if (svg != NULL && strcmp(svg, "-") == 0) {
        cz_fail(&error, CZ_STATUS_INPUT,
                "'--svg -' and the law cannot both be written to standard output" CZ_HELP
                "name a file, such as --svg fit.svg");
        return cz_print_error(arguments, &error);
    }
    const int unwritable = cz_result_check(arguments, NULL, svg);
    if (unwritable != 0)
        return unwritable;
    if (read_options(arguments, &options, &error) != CZ_OK ||
        cz_fit_read(arguments->operand[0], &options, &fit, &error) != CZ_OK)
        return cz_print_error(arguments, &error);
    const int code = write_fit(arguments, fit);
    cz_fit_free(fit);
    return code;
}
