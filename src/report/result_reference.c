/* The list of results as a page and as JSON schemas. */
#include "report/results.h"

#include "base/error.h"

#include <ctype.h>
#include <string.h>

/* Names of the documents: the word after "crushzone." in their format. */
static const char *const documents[CZ_N_REPORT] = {
    [CZ_REPORT_RUN] = "summary",           [CZ_REPORT_SEARCH] = "outcome",
    [CZ_REPORT_SWEEP] = "sweep",           [CZ_REPORT_SAMPLE] = "sample",
    [CZ_REPORT_PARETO] = "pareto",         [CZ_REPORT_CHALLENGE] = "challenge",
    [CZ_REPORT_CORRIDOR] = "corridor",     [CZ_REPORT_VERIFICATION] = "verification",
    [CZ_REPORT_BENCHMARK] = "benchmark",   [CZ_REPORT_EXPLANATION] = "explanation",
    [CZ_REPORT_COMPARISON] = "comparison", [CZ_REPORT_FIT] = "fit",
    [CZ_REPORT_MISTAKES] = "mistakes",     [CZ_REPORT_ANSWER] = "answer"};

const char *cz_report_document_name(int index) {
    return index < CZ_N_REPORT ? documents[index] : NULL;
}

static bool is_written(const CzResult *result) {
    return result->form != CZ_FORM_UNWRITTEN;
}

/* Type of a value that is not a record, as JSON schemas name it. */
static const char *type_of(const CzResult *result) {
    switch (result->form) {
    case CZ_FORM_FLAG:
        return "boolean";
    case CZ_FORM_WHOLE:
        return "integer";
    case CZ_FORM_TEXT:
    case CZ_FORM_VERDICT:
        return "string";
    default:
        return "number";
    }
}

static bool may_be_null(const CzResult *result) {
    switch (result->form) {
    case CZ_FORM_NUMBER:
        return result->is_there == NULL || result->number != NULL;
    case CZ_FORM_WHOLE:
        return result->is_null_below_0;
    case CZ_FORM_TEXT:
        return result->is_there == NULL && result->number == NULL &&
               result->member.stored != CZ_STORED_LETTERS;
    default:
        return false;
    }
}

/* ---- schema ---- */

/* Marks a record and all records in it. */
static void mark(CzRecord record, bool is_in[CZ_N_RECORD]) {
    if (is_in[record])
        return;
    is_in[record] = true;
    for (int i = 0; i < CZ_N_RESULT; i++)
        if (cz_results[i].record == record && cz_results[i].form == CZ_FORM_RECORD)
            mark(cz_results[i].of, is_in);
}

/* The shape of a value, or of an item of a list. */
static void write_item_shape(const CzResult *result, FILE *stream) {
    if (result->form == CZ_FORM_RECORD)
        fprintf(stream, "\"$ref\": \"#/$defs/%s\"", cz_result_records[result->of].name);
    else if (result->form == CZ_FORM_VERDICT)
        fprintf(stream, "\"enum\": [\"%s\", \"%s\", \"%s\"]", cz_verdict_text(CZ_VERDICT_PASS),
                cz_verdict_text(CZ_VERDICT_FAIL), cz_verdict_text(CZ_VERDICT_NOT_CHECKED));
    else
        fprintf(stream, may_be_null(result) ? "\"type\": [\"%s\", \"null\"]" : "\"type\": \"%s\"",
                type_of(result));
}

static void write_shape(const CzResult *result, FILE *stream) {
    const bool is_list = result->number != NULL || result->member.n > 0;
    if (is_list)
        fprintf(stream, "\"type\": \"%s\": {",
                result->name != NULL ? "object\", \"additionalProperties" : "array\", \"items");
    write_item_shape(result, stream);
    if (is_list)
        fputc('}', stream);
    if (result->member.n > 0)
        fprintf(stream, ", \"minItems\": %d, \"maxItems\": %d", result->member.n, result->member.n);
}

static void write_properties(CzRecord record, FILE *stream) {
    const char *between = "";
    for (int i = 0; i < CZ_N_RESULT; i++) {
        const CzResult *result = &cz_results[i];
        if (result->record != record || !is_written(result) || result->is_spread)
            continue;
        fprintf(stream, "%s\n        \"%s\": {", between, result->key);
        write_shape(result, stream);
        const char *unit = result->unit->text;
        fprintf(stream, ", \"description\": \"%s%s%s%s\"}", result->doc,
                unit[0] != '\0' ? " [" : "", unit, unit[0] != '\0' ? "]" : "");
        between = ",";
    }
}

static void write_record(CzRecord record, FILE *stream) {
    const CzResult *spread = NULL;
    const char *between = "";
    fprintf(stream,
            "    \"%s\": {\n      \"description\": \"%s\",\n      \"type\": \"object\",\n"
            "      \"properties\": {",
            cz_result_records[record].name, cz_result_records[record].doc);
    write_properties(record, stream);
    fputs("\n      },\n      \"required\": [", stream);
    for (int i = 0; i < CZ_N_RESULT; i++) {
        const CzResult *result = &cz_results[i];
        if (result->record != record || !is_written(result))
            continue;
        if (result->is_spread) {
            spread = result;
        } else if (result->is_there == NULL) {
            fprintf(stream, "%s\"%s\"", between, result->key);
            between = ", ";
        }
    }
    fputs("],\n      \"additionalProperties\": ", stream);
    if (spread != NULL)
        fprintf(stream, "{\"$ref\": \"#/$defs/%s\"}\n    }", cz_result_records[spread->of].name);
    else
        fputs("false\n    }", stream);
}

CzStatus cz_report_write_document_schema(const char *document, FILE *stream, CzError *error) {
    int index = 0;
    while (index < CZ_N_REPORT && strcmp(documents[index], document) != 0)
        index++;
    if (index == CZ_N_REPORT)
        return cz_fail(error, CZ_STATUS_INPUT, "there is no document '%.40s'", document);
    const CzRecord record = cz_document_records[index];
    bool is_in[CZ_N_RECORD] = {false};
    const char *between = "";
    mark(record, is_in);
    fprintf(stream,
            "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
            "  \"title\": \"crushzone.%s\",\n  \"$ref\": \"#/$defs/%s\",\n  \"$defs\": {",
            document, cz_result_records[record].name);
    for (int k = 0; k < CZ_N_RECORD; k++) {
        if (!is_in[k])
            continue;
        fprintf(stream, "%s\n", between);
        write_record((CzRecord)k, stream);
        between = ",";
    }
    fputs("\n  }\n}\n", stream);
    return CZ_OK;
}

/* ---- page ---- */

/* Link to the section of a record; anchors of headings have small letters. */
static void write_link(CzRecord record, FILE *stream) {
    fprintf(stream, "[%s](#", cz_result_records[record].name);
    for (const char *letter = cz_result_records[record].name; *letter != '\0'; letter++)
        fputc(tolower((unsigned char)*letter), stream);
    fputc(')', stream);
}

static void write_type(const CzResult *result, FILE *stream) {
    const char *type = type_of(result);
    const char *word = strcmp(type, "integer") == 0   ? "whole number"
                       : strcmp(type, "boolean") == 0 ? "yes or no"
                       : strcmp(type, "string") == 0  ? "text"
                                                      : type;
    if (result->number != NULL && result->name == NULL)
        fputs("list of ", stream);
    if (result->member.n > 0)
        fprintf(stream, "%d ", result->member.n);
    if (result->form == CZ_FORM_RECORD)
        write_link(result->of, stream);
    else
        fprintf(stream, "%s%s", word, result->number != NULL || result->member.n > 0 ? "s" : "");
    if (result->name != NULL)
        fputs(" by name", stream);
    else if (result->number == NULL && may_be_null(result))
        fputs(" or null", stream);
}

static void write_rows(CzRecord record, FILE *stream) {
    for (int i = 0; i < CZ_N_RESULT; i++) {
        const CzResult *result = &cz_results[i];
        if (result->record != record || !is_written(result))
            continue;
        fprintf(stream, "| `%s` | %s | ", result->is_spread ? "*" : result->key,
                result->unit->text);
        write_type(result, stream);
        fprintf(stream, " | %s |\n", result->doc);
    }
}

static bool has_rows(CzRecord record) {
    for (int i = 0; i < CZ_N_RESULT; i++)
        if (cz_results[i].record == record && is_written(&cz_results[i]))
            return true;
    return false;
}

void cz_report_write_results_page(FILE *stream) {
    fputs("# Results\n\nThis page is printed by `crushzone help results --markdown`.\n\n"
          "Each table is a record of the JSON documents; CSV files have the same keys as titles of "
          "their columns.\nNumbers are in the unit of their key; a number that is unknown, does "
          "not apply or is a sum beyond model validity is null.\n"
          "All results are those of the plane of the track's length and height.\n"
          "`crushzone schema NAME` prints the JSON schema of a document:\n\n",
          stream);
    for (int i = 0; i < CZ_N_REPORT; i++) {
        fprintf(stream, "- `%s`: ", documents[i]);
        write_link(cz_document_records[i], stream);
        fprintf(stream, ", %s\n", cz_result_records[cz_document_records[i]].doc);
    }
    for (int record = 0; record < CZ_N_RECORD; record++) {
        if (!has_rows((CzRecord)record))
            continue;
        fprintf(stream, "\n## %s\n\n%c%s.\n\n| key | unit | type | meaning |\n|---|---|---|---|\n",
                cz_result_records[record].name,
                toupper((unsigned char)cz_result_records[record].doc[0]),
                cz_result_records[record].doc + 1);
        write_rows((CzRecord)record, stream);
    }
}
