/* The text of a journal. Keys are written and read in a fixed order, so that reading is fast. */
#include "report/journal.h"

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"
#include "evaluate/evaluator.h"
#include "problem/problem.h"
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
                                       .set = given->set,
                                       .n_set = given->n_set,
                                       .word = given->word,
                                       .n_word = given->n_word}};
    return start->nlopt != NULL;
}

/* ---- writing ---- */

static void write_text(const char *text, FILE *stream) {
    fputc('"', stream);
    for (; *text != '\0'; text++) {
        const unsigned char byte = (unsigned char)*text;
        if (byte == '"' || byte == '\\')
            fprintf(stream, "\\%c", byte);
        else if (byte < 0x20)
            fprintf(stream, "\\u%04X", byte);
        else
            fputc(byte, stream);
    }
    fputc('"', stream);
}

static void write_texts(const char *key, int n, const char *const *text, FILE *stream) {
    fprintf(stream, ", \"%s\": [", key);
    for (int i = 0; i < n; i++) {
        fputs(i > 0 ? ", " : "", stream);
        write_text(text[i] != NULL ? text[i] : "", stream);
    }
    fputc(']', stream);
}

/* A number to the last bit. JSON has no infinities, which are texts, and no NaN, which is null. */
static void write_number(double value, FILE *stream) {
    char text[CZ_NUMBER_TEXT];
    if (isnan(value))
        fputs("null", stream);
    else if (isinf(value))
        fputs(value > 0 ? "\"inf\"" : "\"-inf\"", stream);
    else
        fputs(cz_number_print_exact(text, value), stream);
}

static void write_numbers(const char *key, int n, const double *value, FILE *stream) {
    fprintf(stream, "\"%s\": [", key);
    for (int i = 0; i < n; i++) {
        fputs(i > 0 ? ", " : "", stream);
        write_number(value[i], stream);
    }
    fputs("], ", stream);
}

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
    write_texts("variables", (int)n_variable, name, stream);
    write_texts("constraint_names", (int)n_constraint, constraint, stream);
    write_texts("checks", (int)n_check, check, stream);
    write_texts("check_scenarios", (int)n_check, check + n_check, stream);
    free(name);
    return CZ_OK;
}

CzStatus cz_journal_write_head(const CzJournalStart *start, const CzReport *report, FILE *stream,
                               CzError *error) {
    fprintf(stream, "{\"format\": \"crushzone.history\", \"command\": \"%s\", \"version\": ",
            start->command);
    write_text(start->version, stream);
    fputs(", \"nlopt\": ", stream);
    write_text(start->nlopt, stream);
    fputs(", \"problem\": ", stream);
    write_text(start->problem, stream);
    fputs(", \"algorithm\": ", stream);
    write_text(start->head.algorithm, stream);
    fprintf(stream,
            ", \"seed\": %ld, \"evaluations\": %ld, \"earlier\": %ld, \"n_variable\": %d, "
            "\"n_constraint\": %d, \"n_detail\": %d",
            start->head.seed, start->head.evaluations, start->n_earlier, start->n_variable,
            start->n_constraint, start->n_detail);
    write_texts("set", start->head.n_set, start->head.set, stream);
    write_texts("options", start->head.n_word, start->head.word, stream);
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
        write_text(scenario, stream);
        fputs(": ", stream);
        write_text(cz_verdict_text(worst), stream);
    }
    fputs("}, ", stream);
}

void cz_journal_write_entry(const CzJournalStart *start, const CzNews *news, int design,
                            FILE *stream) {
    const CzAnswer *answer = &news->answer[design];
    const CzEvaluation *evaluation = &news->evaluation[design];
    fputc('{', stream);
    write_numbers("x", start->n_variable, answer->x, stream);
    fputs("\"objective\": ", stream);
    write_number(answer->objective, stream);
    fputs(", ", stream);
    write_numbers("constraints", answer->n_constraint, answer->constraint, stream);
    write_numbers("details", answer->n_detail, answer->detail, stream);
    fputs("\"violation\": ", stream);
    write_number(evaluation->violation, stream);
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
    write_text(news->phase, stream);
    fputs(", \"failure\": ", stream);
    if (evaluation->failure[0] != '\0')
        write_text(evaluation->failure, stream);
    else
        fputs("null", stream);
    fputs("}\n", stream);
}

/* ---- reading ---- */

/* A place in a line; `failed` after the first text that is not as it is written above. */
typedef struct Cursor {
    char *at;
    bool failed;
    CzArena *arena;
} Cursor;

static void expect(Cursor *cursor, const char *text) {
    const size_t n = strlen(text);
    cursor->failed = cursor->failed || strncmp(cursor->at, text, n) != 0;
    if (!cursor->failed)
        cursor->at += n;
}

/* Reads the four digits of an escape; false when they are not there. */
static bool read_escape(const char *digits, char *byte) {
    unsigned code;
    if (strspn(digits, "0123456789ABCDEFabcdef") < 4 || sscanf(digits, "%4x", &code) != 1)
        return false;
    *byte = (char)code;
    return true;
}

/* Removes a text with its quotes and undoes its escapes. */
static const char *cut_text(Cursor *cursor) {
    expect(cursor, "\"");
    char *text = cursor->at, *to = text, what[CZ_FAULT_ROOM];
    size_t at;
    while (!cursor->failed && *cursor->at != '"') {
        if (strncmp(cursor->at, "\\u", 2) == 0 && read_escape(cursor->at + 2, to)) {
            to++;
            cursor->at += 6;
        } else {
            cursor->at += *cursor->at == '\\';
            cursor->failed = *cursor->at == '\0';
            if (!cursor->failed)
                *to++ = *cursor->at++;
        }
    }
    expect(cursor, "\"");
    const size_t n = (size_t)(to - text);
    cursor->failed = cursor->failed || cz_text_fault(text, n, false, &at, what);
    const char *copy = cursor->failed ? NULL : cz_arena_copy_text(cursor->arena, text, n);
    cursor->failed |= copy == NULL;
    return copy != NULL ? copy : "";
}

/* Removes a number up to the sign that follows it. */
static double cut_number(Cursor *cursor) {
    const size_t n = strcspn(cursor->at, ",]}");
    char text[CZ_NUMBER_TEXT] = "";
    double value = NAN;
    if (cursor->failed || n >= sizeof text) {
        cursor->failed = true;
        return NAN;
    }
    memcpy(text, cursor->at, n);
    cursor->at += n;
    if (strcmp(text, "\"inf\"") == 0 || strcmp(text, "\"-inf\"") == 0)
        return text[1] == '-' ? -INFINITY : INFINITY;
    cursor->failed = strcmp(text, "null") != 0 && !cz_number_scan(text, &value);
    return value;
}

static long cut_whole(Cursor *cursor, const char *before) {
    expect(cursor, before);
    const double value = cut_number(cursor);
    cursor->failed |= !(fabs(value) < 1e15) || value != round(value);
    return cursor->failed ? 0 : (long)value;
}

/* Removes a list of numbers; *n is their number. */
static const double *cut_numbers(Cursor *cursor, const char *before, int *n) {
    expect(cursor, before);
    const size_t n_byte = cursor->failed ? 0 : strcspn(cursor->at, "]");
    *n = n_byte > 0;
    for (size_t i = 0; i < n_byte; i++)
        *n += cursor->at[i] == ',';
    double *value = cz_arena_numbers(cursor->arena, (size_t)*n);
    cursor->failed |= value == NULL;
    for (int i = 0; i < *n && !cursor->failed; i++) {
        value[i] = cut_number(cursor);
        expect(cursor, i + 1 < *n ? ", " : "");
    }
    expect(cursor, "], ");
    return value;
}

static const char *const *cut_texts(Cursor *cursor, const char *before, int *n) {
    const char **text = NULL;
    expect(cursor, before);
    for (*n = 0; !cursor->failed && *cursor->at != ']'; (*n)++) {
        text = cz_arena_grow(cursor->arena, text, *n, sizeof *text);
        if (text == NULL)
            cursor->failed = true;
        else
            text[*n] = cut_text(cursor);
        if (!cursor->failed && *cursor->at != ']')
            expect(cursor, ", ");
    }
    expect(cursor, "]");
    return text;
}

static bool read_head(char *line, CzArena *arena, CzJournalStart *start) {
    Cursor cursor = {.at = line, .arena = arena};
    expect(&cursor, "{\"format\": \"crushzone.history\", \"command\": ");
    start->command = cut_text(&cursor);
    expect(&cursor, ", \"version\": ");
    start->version = cut_text(&cursor);
    expect(&cursor, ", \"nlopt\": ");
    start->nlopt = cut_text(&cursor);
    expect(&cursor, ", \"problem\": ");
    start->problem = cut_text(&cursor);
    expect(&cursor, ", \"algorithm\": ");
    start->head.algorithm = cut_text(&cursor);
    start->head.seed = cut_whole(&cursor, ", \"seed\": ");
    start->head.evaluations = cut_whole(&cursor, ", \"evaluations\": ");
    start->n_earlier = cut_whole(&cursor, ", \"earlier\": ");
    start->n_variable = (int)cut_whole(&cursor, ", \"n_variable\": ");
    start->n_constraint = (int)cut_whole(&cursor, ", \"n_constraint\": ");
    start->n_detail = (int)cut_whole(&cursor, ", \"n_detail\": ");
    start->head.set = cut_texts(&cursor, ", \"set\": [", &start->head.n_set);
    start->head.word = cut_texts(&cursor, ", \"options\": [", &start->head.n_word);
    return !cursor.failed && start->head.seed >= 0 && start->head.evaluations > 0 &&
           start->n_earlier >= 0 && start->n_variable >= 0 && start->n_constraint >= 0 &&
           start->n_detail >= 0;
}

/* Reads an evaluation; false when the line is damaged, or without memory. */
static bool read_entry(char *line, size_t n_line, const CzJournalStart *start, CzArena *arena,
                       CzAnswer *answer) {
    int n_variable;
    Cursor cursor = {.at = line, .arena = arena};
    answer->x = cut_numbers(&cursor, "{\"x\": [", &n_variable);
    expect(&cursor, "\"objective\": ");
    answer->objective = cut_number(&cursor);
    expect(&cursor, ", ");
    answer->constraint = cut_numbers(&cursor, "\"constraints\": [", &answer->n_constraint);
    answer->detail = cut_numbers(&cursor, "\"details\": [", &answer->n_detail);
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
        if (start->head.was_torn) /* the process died while it wrote this line */
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
