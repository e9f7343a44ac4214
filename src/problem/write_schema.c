/* JSON schema (draft-07) of a problem file, for completion and checks in editors.
 *
 * Overrides next to `use` and overlays omit keys, so only a stage, which is always complete, has
 * required keys. No stem may occur in two units.
 */
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "crushzone/problem.h"
#include "problem/input.h"
#include "problem/keys.h"

static void write_json_text(FILE *stream, const char *text) {
    fputc('"', stream);
    for (const char *c = text; *c != '\0'; c++)
        fprintf(stream, *c == '"' || *c == '\\' ? "\\%c" : "%c", *c);
    fputc('"', stream);
}

static void open_property(FILE *stream, bool *is_first, const char *stem, const char *suffix,
                          const char *doc) {
    fprintf(stream, "%s\n        \"%s%s%s\": {\"description\": ", *is_first ? "" : ",", stem,
            suffix[0] != '\0' ? "_" : "", suffix);
    write_json_text(stream, doc);
    *is_first = false;
}

static void write_number(FILE *stream, bool *is_first, const CzKey *key) {
    for (const CzUnit *unit = cz_unit_si(key->dimension); unit != NULL; unit = cz_unit_next(unit)) {
        open_property(stream, is_first, key->stem, unit->suffix, key->doc);
        fprintf(stream, ", \"type\": \"number\", \"minimum\": %s, \"maximum\": %s}",
                CZ_SHORT(key->lo / unit->si), CZ_SHORT(key->hi / unit->si));
    }
}

static void write_words(FILE *stream, const CzWordSet *set) {
    fputs(", \"enum\": [", stream);
    for (int i = 0; i < set->n_word; i++)
        fprintf(stream, "%s\"%s\"", i > 0 ? ", " : "", set->word[i].word);
    fputs("]}", stream);
}

static void write_table(FILE *stream) {
    fputs(
        ", \"type\": \"object\", \"additionalProperties\": false, \"properties\": {"
        "\"columns\": {\"type\": \"array\", \"items\": {\"type\": \"string\"}, \"minItems\": 2, "
        "\"maxItems\": 2}, "
        "\"points\": {\"type\": \"array\", \"items\": {\"type\": \"array\", \"items\": {\"type\": "
        "\"number\"}, \"minItems\": 2, \"maxItems\": 2}, \"minItems\": 2}, "
        "\"file\": {\"type\": \"string\"}, "
        "\"basis\": {\"enum\": [\"static\", \"dynamic\"]}, "
        "\"strokes\": {\"enum\": [\"plastic\", \"total\"]}, "
        "\"decimal\": {\"enum\": [\".\", \",\"]}, "
        "\"zero\": {\"enum\": [\"start\", \"contact\"]}, "
        "\"flip\": {\"enum\": [\"stroke\", \"force\", \"both\"]}, "
        "\"scale\": {\"type\": \"number\"}, "
        "\"zero_m\": {\"type\": \"number\"}, \"zero_mm\": {\"type\": \"number\"}, "
        "\"from_m\": {\"type\": \"number\"}, \"from_mm\": {\"type\": \"number\"}, "
        "\"to_m\": {\"type\": \"number\"}, \"to_mm\": {\"type\": \"number\"}}, "
        "\"required\": [\"basis\"], "
        "\"oneOf\": [{\"required\": [\"columns\", \"points\"]}, {\"required\": [\"file\"]}]}",
        stream);
}

static void write_key(FILE *stream, bool *is_first, const CzKey *key) {
    if (key->kind == CZ_KEY_NUMBER) {
        write_number(stream, is_first, key);
        return;
    }
    open_property(stream, is_first, key->stem, "", key->doc);
    switch (key->kind) {
    case CZ_KEY_COUNT:
        fprintf(stream, ", \"type\": \"integer\", \"minimum\": %.0f, \"maximum\": %.0f}", key->lo,
                key->hi);
        break;
    case CZ_KEY_CHOICE:
        write_words(stream, key->words);
        break;
    case CZ_KEY_FLAG:
        fputs(", \"type\": \"boolean\"}", stream);
        break;
    case CZ_KEY_CHILD: /* a description next to $ref is ignored in draft-07, hence allOf */
        fprintf(stream, ", \"allOf\": [{\"$ref\": \"#/definitions/%s\"}]}", key->child->name);
        break;
    case CZ_KEY_STAGES:
        fprintf(stream,
                ", \"type\": [\"array\", \"null\"], \"minItems\": 1, \"maxItems\": %d, \"items\": "
                "{\"$ref\": "
                "\"#/definitions/stage\"}}",
                (int)CZ_MAX_STAGES);
        break;
    case CZ_KEY_LIST:
        fprintf(stream, ", \"type\": \"array\", \"items\": {\"$ref\": \"#/definitions/%s\"}}",
                key->child->name);
        break;
    case CZ_KEY_NAMED:
        fprintf(stream,
                ", \"type\": \"object\", \"additionalProperties\": {\"$ref\": "
                "\"#/definitions/%s\"}}",
                key->child->name);
        break;
    case CZ_KEY_TEXTS:
        fputs(", \"type\": \"array\", \"items\": {\"type\": [\"string\", \"number\"]}}", stream);
        break;
    case CZ_KEY_TABLE:
        write_table(stream);
        break;
    default:
        fputs(", \"type\": \"string\"}", stream);
    }
}

/* One alternative per unit of a required stem. */
static void write_required(FILE *stream, const CzKey *key) {
    const char *before = "";
    fputs("{\"oneOf\": [", stream);
    for (const CzUnit *unit = cz_unit_si(key->dimension); unit != NULL; unit = cz_unit_next(unit)) {
        fprintf(stream, "%s{\"required\": [\"%s%s%s\"]}", before, key->stem,
                unit->suffix[0] != '\0' ? "_" : "", unit->suffix);
        before = ", ";
    }
    fputs("]}", stream);
}

/* Forbids each pair of units of each stem. */
static void write_pairs(FILE *stream, const CzRecord *record) {
    const char *before = "";
    for (int k = 0; k < record->n_key; k++) {
        const CzKey *key = &record->key[k];
        for (const CzUnit *one = cz_unit_si(key->dimension);
             key->kind == CZ_KEY_NUMBER && one != NULL; one = cz_unit_next(one))
            for (const CzUnit *other = cz_unit_next(one); other != NULL;
                 other = cz_unit_next(other)) {
                fprintf(stream, "%s\n        {\"not\": {\"required\": [\"%s_%s\", \"%s_%s\"]}}",
                        before, key->stem, one->suffix, key->stem, other->suffix);
                before = ",";
            }
    }
    if (record != &cz_records[CZ_RECORD_CzStage])
        return;
    fprintf(stream, "%s\n        {\"anyOf\": [{\"required\": [\"use\"]}, {\"allOf\": [", before);
    const char *between = "";
    for (int k = 0; k < record->n_key; k++) {
        if (record->key[k].presence != CZ_PRESENCE_REQUIRED)
            continue;
        fputs(between, stream);
        write_required(stream, &record->key[k]);
        between = ", ";
    }
    fputs("]}]}", stream);
}

static bool has_pairs(const CzRecord *record) {
    for (int k = 0; k < record->n_key; k++)
        if (record->key[k].kind == CZ_KEY_NUMBER && record->key[k].dimension != CZ_DIMENSION_NONE)
            return true;
    return false;
}

static void write_reuse(FILE *stream, bool *is_first, const CzRecord *record) {
    for (int i = 0; i < cz_n_reuse_key; i++) {
        const CzReuseKey *reuse = &cz_reuse_keys[i];
        if (reuse->record[0] != '\0' && strcmp(reuse->record, record->name) != 0)
            continue;
        open_property(stream, is_first, reuse->key, "", reuse->doc);
        fprintf(stream, ", %s}", reuse->schema);
    }
}

static void write_record(FILE *stream, const CzRecord *record) {
    bool is_first = true;
    fprintf(stream,
            "    \"%s\": {\n      \"type\": [\"object\", \"null\"],\n      \"description\": ",
            record->name);
    write_json_text(stream, record->doc);
    fputs(",\n      \"additionalProperties\": false,\n      \"properties\": {", stream);
    for (int i = 0; i < record->n_key; i++)
        write_key(stream, &is_first, &record->key[i]);
    write_reuse(stream, &is_first, record);
    if (strcmp(record->name, "profile") == 0) { /* the head of its file is not part of the record */
        open_property(stream, &is_first, "schema", "", "version of the format");
        fputs(", \"type\": \"integer\"}", stream);
    }
    fputs("\n      }", stream);
    if (has_pairs(record)) {
        fputs(",\n      \"allOf\": [", stream);
        write_pairs(stream, record);
        fputs("\n      ]", stream);
    }
    fputs("\n    }", stream);
}

void cz_keys_write_schema(FILE *stream) {
    fputs("{\n  \"$schema\": \"http://json-schema.org/draft-07/schema#\",\n"
          "  \"title\": \"crushzone problem file, catalogue or profile\",\n"
          "  \"if\": {\"required\": [\"limits\"]},\n" /* a profile has limits at the top level */
          "  \"then\": {\"$ref\": \"#/definitions/profile\"},\n"
          "  \"else\": {\"$ref\": \"#/definitions/problem\"},\n"
          "  \"type\": \"object\",\n"
          "  \"definitions\": {\n",
          stream);
    for (int i = 0; i < CZ_N_RECORD; i++) {
        write_record(stream, &cz_records[i]);
        fputs(i + 1 < CZ_N_RECORD ? ",\n" : "\n", stream);
    }
    fputs("  }\n}\n", stream);
}
