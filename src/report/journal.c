/* The text of a journal. Keys are written and read in a fixed order, so that reading is fast. */
#include "report/journal.h"

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"
#include "evaluate/evaluator.h"
#include "problem/problem.h"
#include "report/lines.h"
#include "report/options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool cz_journal_start(const CzReport *report, const CzOptimiseOptions *options, CzArena *arena,
                      CzJournalStart *start) {
    const CzReportOptions *given = cz_report_options_of(report);
    char nlopt[32];
    cz_nlopt_version(nlopt, sizeof nlopt);
    *start = (CzJournalStart){.command = report->kind == CZ_REPORT_PARETO ? "pareto" : "optimise",
                              .version = cz_version(),
                              .nlopt = cz_arena_copy_text(arena, nlopt, strlen(nlopt)),
                              .problem = cz_problem_hash(report->problem),
                              .n_variable = cz_evaluator_n_variable(report->evaluator),
                              .n_constraint = cz_evaluator_n_constraint(report->evaluator),
                              .n_detail = cz_evaluator_n_detail(report->evaluator),
                              .head = {.algorithm = options->algorithm,
                                       .seed = options->seed,
                                       .evaluations = options->evaluations,
                                       .width = options->width,
                                       .set = given->set,
                                       .n_set = given->n_set,
                                       .word = given->word,
                                       .n_word = given->n_word}};
    return start->nlopt != NULL;
}

/* ---- writing ---- */

/* Names of variables, constraints and checks, for other programs that read the journal. */
static CzStatus write_names(const CzReport *report, FILE *stream, CzError *error) {
    const CzEvaluator *evaluator = report->evaluator;
    const size_t n_variable = (size_t)cz_evaluator_n_variable(evaluator);
    const size_t n_constraint = (size_t)cz_evaluator_n_constraint(evaluator);
    const size_t n_check = (size_t)cz_evaluator_n_check(evaluator);
    const char **name = calloc(n_variable + n_constraint + 2 * n_check + 1, sizeof *name);
    if (name == NULL)
        return cz_no_memory(error, "the journal");
    const char **constraint = name + n_variable, **check = constraint + n_constraint;
    for (size_t i = 0; i < n_variable; i++)
        name[i] = cz_evaluator_variable(evaluator, (int)i)->name;
    for (size_t j = 0; j < n_constraint; j++)
        constraint[j] = cz_evaluator_constraint_name(evaluator, (int)j);
    cz_evaluator_name_checks(evaluator, check, check + n_check);
    cz_line_write_texts("variables", (int)n_variable, name, stream);
    cz_line_write_texts("constraint_names", (int)n_constraint, constraint, stream);
    cz_line_write_texts("checks", (int)n_check, check, stream);
    cz_line_write_texts("check_scenarios", (int)n_check, check + n_check, stream);
    free(name);
    return CZ_OK;
}

CzStatus cz_journal_write_head(const CzJournalStart *start, const CzReport *report, FILE *stream,
                               CzError *error) {
    fprintf(stream, "{\"format\": \"crushzone.history\", \"command\": \"%s\", \"version\": ",
            start->command);
    cz_line_write_text(start->version, stream);
    fputs(", \"nlopt\": ", stream);
    cz_line_write_text(start->nlopt, stream);
    fputs(", \"problem\": ", stream);
    cz_line_write_text(start->problem, stream);
    fputs(", \"algorithm\": ", stream);
    cz_line_write_text(start->head.algorithm, stream);
    fprintf(stream,
            ", \"seed\": %ld, \"evaluations\": %ld, \"width\": %ld, \"earlier\": %ld, "
            "\"n_variable\": %d, "
            "\"n_constraint\": %d, \"n_detail\": %d",
            start->head.seed, start->head.evaluations, start->head.width, start->n_earlier,
            start->n_variable, start->n_constraint, start->n_detail);
    cz_line_write_texts("set", start->head.n_set, start->head.set, stream);
    cz_line_write_texts("options", start->head.n_word, start->head.word, stream);
    CZ_TRY(write_names(report, stream, error));
    fputs("}\n", stream);
    return CZ_OK;
}

/* Verdicts of the scenarios, that of the checks of each. */
static void write_scenarios(const CzEvaluation *evaluation, FILE *stream) {
    fputs("\"scenarios\": {", stream);
    for (int i = 0, n = 0; i < evaluation->n_check; i++) {
        const char *scenario = evaluation->check[i].scenario;
        CzVerdict worst = CZ_VERDICT_PASS;
        bool is_first = true;
        for (int k = 0; k < evaluation->n_check; k++) {
            const CzVerdict verdict = evaluation->check[k].verdict;
            if (strcmp(evaluation->check[k].scenario, scenario) != 0)
                continue;
            is_first &= k >= i;
            if (worst == CZ_VERDICT_PASS || verdict == CZ_VERDICT_FAIL ||
                (verdict == CZ_VERDICT_NOT_CHECKED && worst == CZ_VERDICT_PROVISIONAL))
                worst = verdict;
        }
        if (!is_first)
            continue;
        fputs(n++ > 0 ? ", " : "", stream);
        cz_line_write_text(scenario, stream);
        fputs(": ", stream);
        cz_line_write_text(cz_verdict_text(worst), stream);
    }
    fputs("}, ", stream);
}

void cz_journal_write_entry(const CzJournalStart *start, const CzNews *news, int design,
                            FILE *stream) {
    const CzAnswer *answer = &news->answer[design];
    const CzEvaluation *evaluation = &news->evaluation[design];
    fputc('{', stream);
    cz_line_write_numbers("x", start->n_variable, answer->x, stream);
    fputs("\"objective\": ", stream);
    cz_line_write_number(answer->objective, stream);
    fputs(", ", stream);
    cz_line_write_numbers("constraints", answer->n_constraint, answer->constraint, stream);
    cz_line_write_numbers("details", answer->n_detail, answer->detail, stream);
    fputs("\"violation\": ", stream);
    cz_line_write_number(evaluation->violation, stream);
    fputs(", \"margins\": [", stream); /* nothing is computed from them */
    for (int i = 0; i < evaluation->n_check; i++) {
        const double margin = evaluation->check[i].margin;
        char text[CZ_NUMBER_TEXT];
        fprintf(stream, "%s%s", i > 0 ? ", " : "",
                isfinite(margin) ? cz_number_print_short(text, margin) : "null");
    }
    fputs("], ", stream);
    write_scenarios(evaluation, stream);
    fputs("\"phase\": ", stream);
    cz_line_write_text(news->phase, stream);
    fputs(", \"failure\": ", stream);
    if (evaluation->failure[0] != '\0')
        cz_line_write_text(evaluation->failure, stream);
    else
        fputs("null", stream);
    fputs("}\n", stream);
}

/* ---- reading ---- */

static bool read_head(char *line, CzArena *arena, CzJournalStart *start) {
    CzLineCursor cursor = {.at = line, .arena = arena};
    cz_line_expect(&cursor, "{\"format\": \"crushzone.history\", \"command\": ");
    start->command = cz_line_text(&cursor);
    cz_line_expect(&cursor, ", \"version\": ");
    start->version = cz_line_text(&cursor);
    cz_line_expect(&cursor, ", \"nlopt\": ");
    start->nlopt = cz_line_text(&cursor);
    cz_line_expect(&cursor, ", \"problem\": ");
    start->problem = cz_line_text(&cursor);
    cz_line_expect(&cursor, ", \"algorithm\": ");
    start->head.algorithm = cz_line_text(&cursor);
    start->head.seed = cz_line_integer(&cursor, ", \"seed\": ");
    start->head.evaluations = cz_line_integer(&cursor, ", \"evaluations\": ");
    start->head.width = cz_line_integer(&cursor, ", \"width\": ");
    start->n_earlier = cz_line_integer(&cursor, ", \"earlier\": ");
    start->n_variable = (int)cz_line_integer(&cursor, ", \"n_variable\": ");
    start->n_constraint = (int)cz_line_integer(&cursor, ", \"n_constraint\": ");
    start->n_detail = (int)cz_line_integer(&cursor, ", \"n_detail\": ");
    start->head.set = cz_line_texts(&cursor, ", \"set\": [", &start->head.n_set);
    start->head.word = cz_line_texts(&cursor, ", \"options\": [", &start->head.n_word);
    return !cursor.failed && start->head.seed >= 0 && start->head.evaluations > 0 &&
           start->head.width > 0 && start->head.width <= CZ_MAX_WIDTH && start->n_earlier >= 0 &&
           start->n_variable >= 0 && start->n_constraint >= 0 && start->n_detail >= 0;
}

/* Reads an evaluation; false when the line is damaged, or without memory. */
static bool read_entry(char *line, size_t n_line, const CzJournalStart *start, CzArena *arena,
                       CzAnswer *answer) {
    int n_variable;
    CzLineCursor cursor = {.at = line, .arena = arena};
    answer->x = cz_line_numbers(&cursor, "{\"x\": [", &n_variable);
    cz_line_expect(&cursor, "\"objective\": ");
    answer->objective = cz_line_number(&cursor);
    cz_line_expect(&cursor, ", ");
    answer->constraint = cz_line_numbers(&cursor, "\"constraints\": [", &answer->n_constraint);
    answer->detail = cz_line_numbers(&cursor, "\"details\": [", &answer->n_detail);
    return !cursor.failed && n_variable == start->n_variable && line[n_line - 1] == '}';
}

static CzStatus damaged(const char *name, long number, const CzArena *arena, CzError *error) {
    if (arena->out_of_memory)
        return cz_no_memory(error, "the journal");
    return cz_fail(error, CZ_STATUS_INPUT, "line %ld of %.300s cannot be read as one of a journal",
                   number, name);
}

CzStatus cz_journal_read(const char *name, FILE *stream, CzArena *arena, CzJournalText *text,
                         CzError *error) {
    char *line = NULL;
    size_t room = 0;
    ssize_t n_read;
    long number = 0, n_byte = 0;
    CzStatus status = CZ_OK;
    *text = (CzJournalText){0};
    CzJournalStart *start = &text->start;
    while (status == CZ_OK && (n_read = getline(&line, &room, stream)) > 0) {
        start->head.was_torn = line[n_read - 1] != '\n';
        if (start->head.was_torn) /* the process was killed while it wrote this line */
            break;
        line[--n_read] = '\0';
        number++;
        n_byte += n_read + 1;
        long *n_answer = &start->head.n_answer;
        if (number > 1)
            text->answer = cz_arena_grow(arena, text->answer, (int)*n_answer, sizeof *text->answer);
        const bool is_read = number == 1 ? read_head(line, arena, start)
                                         : text->answer != NULL && n_read > 0 &&
                                               read_entry(line, (size_t)n_read, start, arena,
                                                          &text->answer[(*n_answer)++]);
        if (!is_read)
            status = damaged(name, number, arena, error);
        text->n_head = number == 1 ? n_byte : text->n_head;
        text->n_whole = n_byte;
    }
    free(line);
    if (status == CZ_OK && (number == 0 || start->n_earlier > start->head.n_answer))
        status = damaged(name, number == 0 ? 1 : number, arena, error);
    return status;
}
