/* Verdicts in words. */
#include "report/verdict_words.h"

#include "evaluate/not_covered.h"

static const struct {
    const char *word, *title, *class_name;
    CzStyle style;
} looks[] = {
    [CZ_VERDICT_PASS] = {"pass", "PASS", "pass", CZ_STYLE_GOOD},
    [CZ_VERDICT_PROVISIONAL] = {"PROVISIONAL", "PROVISIONAL PASS", "careful", CZ_STYLE_CAREFUL},
    [CZ_VERDICT_FAIL] = {"FAIL", "FAIL", "fail", CZ_STYLE_BAD},
    [CZ_VERDICT_NOT_CHECKED] = {"NOT CHECKED", "NOT CHECKED", "careful", CZ_STYLE_CAREFUL}};

const char *cz_verdict_word(CzVerdict verdict) {
    return looks[verdict].word;
}

CzStyle cz_verdict_style(CzVerdict verdict) {
    return looks[verdict].style;
}

const char *cz_verdict_title(CzVerdict verdict) {
    return looks[verdict].title;
}

const char *cz_verdict_class(CzVerdict verdict) {
    return looks[verdict].class_name;
}

const char *cz_screening_remark(CzVerdict verdict, int n_not_covered,
                                char text[CZ_SCREENING_SIZE]) {
    if (!cz_verdict_is_screening(verdict, n_not_covered))
        return "";
    const bool one = n_not_covered == 1;
    snprintf(text, CZ_SCREENING_SIZE,
             " (screening): %d requirement%s of the profile %s not covered", n_not_covered,
             one ? "" : "s", one ? "is" : "are");
    return text;
}

#define SCREENING "A pass is one by screening: %d requirement%s of the profile %s not covered.\n"

static const char not_covered[] = "Not covered by this program, to be shown by other means";
static const char not_applicable[] = "Scenarios of the profile that do not apply";
static const char changed_scenario[] =
    "Scenarios of the profile that this problem replaces or changes";

/* A sentence that lists texts. */
static void print_list(const char *title, int n, const char *const *text, CzTerminal *terminal) {
    for (int i = 0; i < n; i++)
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s%s%s", i > 0 ? "; " : title,
                          i > 0 ? "" : ": ", text[i]);
    if (n > 0)
        fputs(".\n", terminal->stream);
}

static void write_list(const char *title, int n, const char *const *text, CzMarkup *markup) {
    for (int i = 0; i < n; i++)
        if (i == 0)
            cz_markup_write(markup, "<p>%s: %s", title, text[i]);
        else
            cz_markup_write(markup, "; %s", text[i]);
    if (n > 0)
        cz_markup_write(markup, ".</p>\n");
}

void cz_not_checked_print(const CzEvaluation *evaluation, CzTerminal *terminal) {
    for (int i = 0; i < evaluation->n_not_judged; i++) {
        fputs("Not judged: ", terminal->stream);
        cz_terminal_print(terminal, CZ_STYLE_CAREFUL, "%s", evaluation->not_judged[i].train);
        fprintf(terminal->stream, ", %s.\n", evaluation->not_judged[i].why);
    }
    print_list(changed_scenario, evaluation->n_changed_scenario, evaluation->changed_scenario,
               terminal);
    print_list(not_applicable, evaluation->n_not_applicable, evaluation->not_applicable, terminal);
    print_list(not_covered, evaluation->n_not_covered, evaluation->not_covered, terminal);
}

void cz_not_checked_write(const CzEvaluation *evaluation, CzMarkup *markup) {
    for (int i = 0; i < evaluation->n_not_judged; i++)
        cz_markup_write(markup, "<p>Not judged: %s, %s.</p>\n", evaluation->not_judged[i].train,
                        evaluation->not_judged[i].why);
    write_list(changed_scenario, evaluation->n_changed_scenario, evaluation->changed_scenario,
               markup);
    write_list(not_applicable, evaluation->n_not_applicable, evaluation->not_applicable, markup);
    write_list(not_covered, evaluation->n_not_covered, evaluation->not_covered, markup);
}

void cz_screening_print(const CzProblem *problem, CzTerminal *terminal) {
    int n;
    const char *const *requirement = cz_not_covered(problem, &n);
    if (n > 0)
        fprintf(terminal->stream, SCREENING, n, n == 1 ? "" : "s", n == 1 ? "is" : "are");
    print_list(not_covered, n, requirement, terminal);
}

void cz_screening_write(const CzProblem *problem, CzMarkup *markup) {
    int n;
    const char *const *requirement = cz_not_covered(problem, &n);
    if (n > 0)
        cz_markup_write(markup, "<p>" SCREENING "</p>", n, n == 1 ? "" : "s",
                        n == 1 ? "is" : "are");
    write_list(not_covered, n, requirement, markup);
}
