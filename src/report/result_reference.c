/* The list of results as a page and as JSON schemas. */
#include "report/results.h"

#include "base/error.h"

#include <ctype.h>
#include <string.h>

/* Documents, by the word behind "crushzone." in their format. */
static const struct {
    const char *name;
    CzRecord record;
} documents[] = {{"summary", CZ_RECORD_SUMMARY},
                 {"outcome", CZ_RECORD_OUTCOME},
                 {"sweep", CZ_RECORD_SWEEP},
                 {"verification", CZ_RECORD_VERIFICATION},
                 {"explanation", CZ_RECORD_EXPLANATION},
                 {"comparison", CZ_RECORD_COMPARISON},
                 {"fit", CZ_RECORD_FIT},
                 {"mistakes", CZ_RECORD_MISTAKES}};

enum { N_DOCUMENT = sizeof documents / sizeof *documents };

const char *cz_report_document_name(int index) {
    return index < N_DOCUMENT ? documents[index].name : NULL;
}

static bool is_written(const CzResult *result) {
    return result->form != CZ_FORM_METRIC && result->form != CZ_FORM_METRIC_TOTAL &&
           result->form != CZ_FORM_SHOWN_BY;
}

static bool may_be_left_out(const CzResult *result) {
    switch (result->form) {
    case CZ_FORM_REAL_IF_BY:
    case CZ_FORM_FLAG_IF_BY:
    case CZ_FORM_TEXT_IF:
    case CZ_FORM_TEXT_IF_BY:
    case CZ_FORM_PART_IF:
    case CZ_FORM_LIST_IF:
    case CZ_FORM_MAP:
        return true;
    default:
        return false;
    }
}

/* Type of a value that is no list and no record, in the words of JSON schemas. */
static const char *scalar_type(const CzResult *result) {
    switch (result->form) {
    case CZ_FORM_REAL_IF_BY:
        return "\"number\"";
    case CZ_FORM_FLAG:
    case CZ_FORM_FLAG_BY:
    case CZ_FORM_FLAG_IF_BY:
    case CZ_FORM_PROVISIONAL:
        return "\"boolean\"";
    case CZ_FORM_WHOLE:
        return "\"integer\"";
    case CZ_FORM_WHOLE_BY:
        return "[\"integer\", \"null\"]";
    case CZ_FORM_TEXT:
        return result->member.stored == CZ_STORED_LETTERS ? "\"string\"" : "[\"string\", \"null\"]";
    case CZ_FORM_TEXT_IF:
    case CZ_FORM_TEXT_IF_BY:
    case CZ_FORM_TEXTS:
    case CZ_FORM_VERDICT:
        return "\"string\"";
    case CZ_FORM_TEXT_OR_NULL:
    case CZ_FORM_TEXT_BY:
        return "[\"string\", \"null\"]";
    default:
        return "[\"number\", \"null\"]";
    }
}

/* ---- schema ---- */

/* Marks a record and all that are in it. */
static void mark(CzRecord record, bool is_in[CZ_N_RECORD]) {
    if (is_in[record])
        return;
    is_in[record] = true;
    for (int i = 0; i < CZ_N_RESULT; i++)
        if (cz_results[i].record == record && cz_results[i].form >= CZ_FORM_PART &&
            cz_results[i].form <= CZ_FORM_SPREAD)
            mark(cz_results[i].of, is_in);
}

static void write_shape(const CzResult *result, FILE *stream) {
    switch (result->form) {
    case CZ_FORM_PART:
    case CZ_FORM_PART_IF:
        fprintf(stream, "\"$ref\": \"#/$defs/%s\"", cz_record_names[result->of]);
        break;
    case CZ_FORM_LIST:
    case CZ_FORM_LIST_IF:
        fprintf(stream, "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/%s\"}",
                cz_record_names[result->of]);
        break;
    case CZ_FORM_MAP:
        fprintf(stream,
                "\"type\": \"object\", \"additionalProperties\": {\"$ref\": \"#/$defs/%s\"}",
                cz_record_names[result->of]);
        break;
    case CZ_FORM_TEXTS:
    case CZ_FORM_REALS:
    case CZ_FORM_EXACTS:
        fprintf(stream, "\"type\": \"array\", \"items\": {\"type\": %s}", scalar_type(result));
        break;
    case CZ_FORM_NAMED_REALS:
    case CZ_FORM_NAMED_EXACTS:
        fprintf(stream, "\"type\": \"object\", \"additionalProperties\": {\"type\": %s}",
                scalar_type(result));
        break;
    case CZ_FORM_VERDICT:
        fprintf(stream, "\"enum\": [\"%s\", \"%s\", \"%s\"]", cz_verdict_text(CZ_VERDICT_PASS),
                cz_verdict_text(CZ_VERDICT_FAIL), cz_verdict_text(CZ_VERDICT_NOT_CHECKED));
        break;
    default:
        if (result->member.n > 0)
            fprintf(stream,
                    "\"type\": \"array\", \"items\": {\"type\": %s}, \"minItems\": %d, "
                    "\"maxItems\": %d",
                    scalar_type(result), result->member.n, result->member.n);
        else
            fprintf(stream, "\"type\": %s", scalar_type(result));
    }
}

static void write_properties(CzRecord record, FILE *stream) {
    const char *between = "";
    for (int i = 0; i < CZ_N_RESULT; i++) {
        const CzResult *result = &cz_results[i];
        if (result->record != record || !is_written(result) || result->form == CZ_FORM_SPREAD)
            continue;
        fprintf(stream, "%s\n        \"%s\": {", between, result->key);
        write_shape(result, stream);
        fprintf(stream, ", \"description\": \"%s%s%s%s\"}", result->doc,
                result->unit != NULL && result->unit->text[0] != '\0' ? " [" : "",
                result->unit != NULL ? result->unit->text : "",
                result->unit != NULL && result->unit->text[0] != '\0' ? "]" : "");
        between = ",";
    }
}

static void write_record(CzRecord record, FILE *stream) {
    const CzResult *spread = NULL;
    const char *between = "";
    fprintf(stream,
            "    \"%s\": {\n      \"description\": \"%s\",\n      \"type\": \"object\",\n"
            "      \"properties\": {",
            cz_record_names[record], cz_record_docs[record]);
    write_properties(record, stream);
    fputs("\n      },\n      \"required\": [", stream);
    for (int i = 0; i < CZ_N_RESULT; i++) {
        const CzResult *result = &cz_results[i];
        if (result->record != record || !is_written(result))
            continue;
        if (result->form == CZ_FORM_SPREAD) {
            spread = result;
        } else if (!may_be_left_out(result)) {
            fprintf(stream, "%s\"%s\"", between, result->key);
            between = ", ";
        }
    }
    fputs("],\n      \"additionalProperties\": ", stream);
    if (spread != NULL)
        fprintf(stream, "{\"$ref\": \"#/$defs/%s\"}\n    }", cz_record_names[spread->of]);
    else
        fputs("false\n    }", stream);
}

CzStatus cz_report_write_document_schema(const char *document, FILE *stream, CzError *error) {
    int index = 0;
    while (index < N_DOCUMENT && strcmp(documents[index].name, document) != 0)
        index++;
    if (index == N_DOCUMENT)
        return cz_fail(error, CZ_STATUS_INPUT, "there is no document '%.40s'", document);
    const CzRecord record = documents[index].record;
    bool is_in[CZ_N_RECORD] = {false};
    const char *between = "";
    mark(record, is_in);
    fprintf(stream,
            "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
            "  \"title\": \"crushzone.%s\",\n  \"$ref\": \"#/$defs/%s\",\n  \"$defs\": {",
            document, cz_record_names[record]);
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
    fprintf(stream, "[%s](#", cz_record_names[record]);
    for (const char *letter = cz_record_names[record]; *letter != '\0'; letter++)
        fputc(tolower((unsigned char)*letter), stream);
    fputc(')', stream);
}

static void write_type(const CzResult *result, FILE *stream) {
    const char *type = scalar_type(result);
    const bool is_null = strstr(type, "null") != NULL;
    const char *word = strstr(type, "number") != NULL    ? "number"
                       : strstr(type, "integer") != NULL ? "whole number"
                       : strstr(type, "boolean") != NULL ? "yes or no"
                                                         : "text";
    switch (result->form) {
    case CZ_FORM_PART:
    case CZ_FORM_PART_IF:
        write_link(result->of, stream);
        break;
    case CZ_FORM_LIST:
    case CZ_FORM_LIST_IF:
        fputs("list of ", stream);
        write_link(result->of, stream);
        break;
    case CZ_FORM_MAP:
    case CZ_FORM_SPREAD:
        write_link(result->of, stream);
        fputs(" by name", stream);
        break;
    case CZ_FORM_TEXTS:
    case CZ_FORM_REALS:
    case CZ_FORM_EXACTS:
        fprintf(stream, "list of %ss", word);
        break;
    case CZ_FORM_NAMED_REALS:
    case CZ_FORM_NAMED_EXACTS:
        fprintf(stream, "%ss by name", word);
        break;
    default:
        if (result->member.n > 0)
            fprintf(stream, "%d %ss or null", result->member.n, word);
        else
            fprintf(stream, "%s%s", word, is_null ? " or null" : "");
    }
}

static void write_rows(CzRecord record, FILE *stream) {
    for (int i = 0; i < CZ_N_RESULT; i++) {
        const CzResult *result = &cz_results[i];
        if (result->record != record || !is_written(result))
            continue;
        fprintf(stream, "| `%s` | %s | ", result->form == CZ_FORM_SPREAD ? "*" : result->key,
                result->unit != NULL ? result->unit->text : "");
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
    for (int i = 0; i < N_DOCUMENT; i++) {
        fprintf(stream, "- `%s`: ", documents[i].name);
        write_link(documents[i].record, stream);
        fprintf(stream, ", %s\n", cz_record_docs[documents[i].record]);
    }
    for (int record = 0; record < CZ_N_RECORD; record++) {
        if (!has_rows((CzRecord)record))
            continue;
        fprintf(stream, "\n## %s\n\n%c%s.\n\n| key | unit | type | meaning |\n|---|---|---|---|\n",
                cz_record_names[record], toupper((unsigned char)cz_record_docs[record][0]),
                cz_record_docs[record] + 1);
        write_rows((CzRecord)record, stream);
    }
}
