/* The keys for readers: a list for the terminal and the reference in Markdown. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "problem/acts.h"
#include "problem/usual.h"

/* Writes how a key may be spelled: "stroke_m or stroke_mm". */
static void spell(char *text, size_t size, const CzKey *key) {
    if (key->kind == CZ_KEY_NUMBER)
        cz_key_spellings(text, size, key->stem, key->dimension);
    else
        snprintf(text, size, "%s", key->stem);
}

/* Writes the kind of value of a key: "number, 0 to 10 m". */
static void write_kind(FILE *stream, const CzKey *key) {
    const CzWordSet *set = key->words;
    switch (key->kind) {
    case CZ_KEY_NUMBER:
        fprintf(stream, "%s to %s%s%s", CZ_SHORT(key->lo), CZ_SHORT(key->hi),
                key->dimension != CZ_DIMENSION_NONE ? " " : "", cz_unit_si(key->dimension)->symbol);
        cz_usual_write(stream, key);
        break;
    case CZ_KEY_COUNT:
        fprintf(stream, "whole number, %.0f to %.0f", key->lo, key->hi);
        break;
    case CZ_KEY_CHOICE:
        for (int i = 0; i < set->n_word; i++)
            fprintf(stream, "%s%s",
                    i == 0                ? ""
                    : i + 1 < set->n_word ? ", "
                                          : " or ",
                    set->word[i].word);
        break;
    case CZ_KEY_FLAG:
        fputs("true or false", stream);
        break;
    case CZ_KEY_TEXT:
        fputs("text", stream);
        break;
    case CZ_KEY_CHILD:
        fprintf(stream, "record: %s", key->child->name);
        break;
    case CZ_KEY_STAGES:
    case CZ_KEY_LIST:
        fprintf(stream, "list of %s", key->child->name);
        break;
    case CZ_KEY_NAMED:
        fprintf(stream, "%s by name", key->child->name);
        break;
    case CZ_KEY_TABLE:
        fputs("points: {columns, points, basis, strokes}, or {file, basis, strokes} with columns, "
              "decimal, flip, zero, scale, from_mm, to_mm where the file needs them",
              stream);
        break;
    case CZ_KEY_TEXTS:
        fputs("list of texts", stream);
        break;
    }
    cz_acts_write(stream, key);
}

/* Writes whether a key is required, or its default. */
static void write_presence(FILE *stream, const CzKey *key) {
    if (key->presence == CZ_PRESENCE_REQUIRED)
        fputs("required", stream);
    else if (key->presence == CZ_PRESENCE_REQUIRED_FULL)
        fputs("required for a full vehicle", stream);
    else if (key->presence == CZ_PRESENCE_OPTIONAL)
        fputs("optional", stream);
    else if (key->kind == CZ_KEY_CHOICE)
        fprintf(stream, "default %s", key->words->word[(int)key->absent].word);
    else if (key->kind == CZ_KEY_FLAG)
        fprintf(stream, "default %s", key->absent != 0 ? "true" : "false");
    else
        fprintf(stream, "default %s%s%s", CZ_SHORT(key->absent),
                key->dimension != CZ_DIMENSION_NONE ? " " : "", cz_unit_si(key->dimension)->symbol);
}

static const char *variation_text(CzVariation variation) {
    static const char *const texts[] = {[CZ_VARIATION_DATA] = "",
                                        [CZ_VARIATION_FITS] = "; may be fitted",
                                        [CZ_VARIATION_VARIES] = "; may be a design variable"};
    return texts[variation];
}

static const CzKey *key_of(const char *record, int index) {
    for (int i = 0; i < CZ_N_RECORD; i++)
        if (strcmp(cz_records[i].name, record) == 0 && index < cz_records[i].n_key)
            return &cz_records[i].key[index];
    return NULL;
}

const char *cz_key_name(const char *record, int index) {
    const CzKey *key = key_of(record, index);
    return key != NULL ? key->stem : NULL;
}

const char *cz_key_doc(const char *record, int index) {
    const CzKey *key = key_of(record, index);
    return key != NULL ? key->doc : NULL;
}

void cz_keys_write_help(FILE *stream) {
    char spelled[200];
    fputs("Keys of a problem file. Every number with a dimension carries its unit in the key.\n"
          "Any record may also have `use: PART`; its own keys override those of the part.\n"
          "A number outside its usual range is used as written; a warning asks to\ncheck its unit; "
          "-q suppresses warnings.\n",
          stream);
    for (int r = 0; r < CZ_N_RECORD; r++) {
        const CzRecord *record = &cz_records[r];
        fprintf(stream, "\n%s: %s\n", record->name, record->doc);
        for (int i = 0; i < record->n_key; i++) {
            const CzKey *key = &record->key[i];
            spell(spelled, sizeof spelled, key);
            fprintf(stream, "  %s\n      %s\n      ", spelled, key->doc);
            write_kind(stream, key);
            fputs("; ", stream);
            write_presence(stream, key);
            fprintf(stream, "%s\n", variation_text(key->variation));
        }
        for (int i = 0; i < cz_n_reuse_key; i++)
            if (strcmp(cz_reuse_keys[i].record, record->name) == 0)
                fprintf(stream, "  %s\n      %s\n", cz_reuse_keys[i].key, cz_reuse_keys[i].doc);
    }
}

static void write_units(FILE *stream) {
    fputs("\n## Units\n\n| dimension | units |\n|---|---|\n", stream);
    for (int d = 0; d < CZ_N_DIMENSION; d++) {
        const char *before = "";
        if (d == CZ_DIMENSION_NONE)
            continue;
        fprintf(stream, "| %s | ", cz_dimension_text[d]);
        for (const CzUnit *unit = cz_unit_si((CzDimension)d); unit != NULL;
             unit = cz_unit_next(unit)) {
            fprintf(stream, "%s`%s`", before, unit->suffix);
            before = ", ";
        }
        fputs(" |\n", stream);
    }
}

static void write_reuse(FILE *stream) {
    fputs("\n## Reuse\n\n| key | where | meaning |\n|---|---|---|\n", stream);
    for (int i = 0; i < cz_n_reuse_key; i++) {
        const CzReuseKey *reuse = &cz_reuse_keys[i];
        fprintf(stream, "| `%s` | %s | %s |\n", reuse->key,
                reuse->record[0] != '\0' ? reuse->record : "any record", reuse->doc);
    }
    fputs(
        "\n"
        "A record that has `use` takes all keys of the part; keys beside `use` override them, "
        "inner records key by key, lists as a whole.\n"
        "An inner record with its own `use` replaces that of the part, and so does a curve.\n"
        "`key: null` removes the key of the part or the base file.\n"
        "A value overrides the value of the part also when it is in another unit.\n"
        "A part is checked where it is used: the contents of an unused part are not read, "
        "mistakes included.\n"
        "\n"
        "A path names places: keys and names parted by points, `[0]` for an item of a list, `[*]` "
        "or `*` for every item.\n"
        "A setting acts like the value typed at that place: through `parts.NAME` it "
        "changes every vehicle that uses the part and does not override the key; through a vehicle "
        "it changes this vehicle and those that repeat or copy it.\n",
        stream);
}

static void write_meeting(FILE *stream) {
    fputs(
        "\n## Unlike ends\n\n"
        "Couplers, side buffers and anti-climbers meet parts of their kind.\n"
        "Where the other end has none, they strike its bare end structure, such as a headstock:\n"
        "\n"
        "- it is `face_gap` behind the foremost plane of the end, and reaches from `crush_height` "
        "by half of `face_height` up and down, or is struck at any height without `face_height`;\n"
        "- a part that passes over or under it carries no force, and the reader warns;\n"
        "- an anti-climber with `in_line_with_buffers` presses the plates of side buffers "
        "instead;\n"
        "- friction is the smaller of that of the part and `face_friction`;\n"
        "- a structure with `struck_by: no_couplers` lets couplers through;\n"
        "- the end of a rigid vehicle needs `face_mass` for its crush zone to act on couplers and "
        "side buffers.\n"
        "\n"
        "The wagons, trains and obstacles of standards are parts of `catalogue/partners.yaml`; a "
        "train of them has `role: obstacle`.\n",
        stream);
}

void cz_keys_write_reference(FILE *stream) {
    char spelled[200];
    fputs(
        "# Problem file\n\n"
        "This page is generated from the reader's own tables by `crushzone help keys --markdown`.\n"
        "\n"
        "A problem file is YAML, or JSON, which is nearly a subset of it.\n"
        "Every number with a dimension carries its unit in its key, such as `force_kN`; ranges and "
        "defaults below are in SI units.\n"
        "A number outside its usual range is used as written, with a warning to check the unit; "
        "`-q` suppresses warnings. The usual ranges are ours, from a "
        "light "
        "rail car to a loaded heavy wagon, and change no result.\n"
        "Anchors, aliases, tags and merge keys are refused; parts are reused by "
        "the keys under Reuse.\n",
        stream);
    for (int r = CZ_N_RECORD - 1; r >= 0; r--) {
        const CzRecord *record = &cz_records[r];
        fprintf(stream,
                "\n## %s\n\n%c%s.\n\n| key | value | presence | meaning |\n|---|---|---|---|\n",
                record->name,
                record->doc[0] - ('a' <= record->doc[0] && record->doc[0] <= 'z' ? 32 : 0),
                record->doc + 1);
        for (int i = 0; i < record->n_key; i++) {
            const CzKey *key = &record->key[i];
            spell(spelled, sizeof spelled, key);
            fprintf(stream, "| `%s` | ", spelled);
            write_kind(stream, key);
            fputs(" | ", stream);
            write_presence(stream, key);
            fprintf(stream, " | %s%s |\n", key->doc, variation_text(key->variation));
        }
    }
    write_meeting(stream);
    write_reuse(stream);
    write_units(stream);
}
