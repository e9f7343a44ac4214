/* The resolved problem as YAML: parts, copies and defaults filled in, values in SI, origins in
 * comments. Reading it gives the same input to the last bit. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "problem/acts.h"
#include "problem/changes.h"
#include "problem/write_text.h"

enum { COMMENT_COLUMN = 44 };

typedef struct {
    const CzProblem *problem;
    FILE *stream;
    const char *lead; /* "# " for a record that is not in the file */
    bool is_there;    /* for a result folder */
} Writer;

static void write_record(const Writer *writer, const CzRecord *record, const char *memory,
                         int indent, const char *dash);

/* ---- origins ---- */

/* Writes the place of a field in its file, or that it is a default. */
static void write_origin(const Writer *writer, const CzKey *key, const void *field, int column) {
    const CzPlace *place = cz_places_find(&writer->problem->places, field);
    fprintf(writer->stream, "%*s # ", column < COMMENT_COLUMN ? COMMENT_COLUMN - column : 0, "");
    if (place == NULL || place->address != field || place->key != key) {
        fputs(strstr(key->doc, "(ours") != NULL ? "default (ours)\n" : "default\n", writer->stream);
        return;
    }
    fprintf(writer->stream, "%s:%d",
            cz_problem_reported_name(writer->problem, place->node->source->name),
            place->node->line);
    if (place->unit != NULL && place->unit->si != 1)
        fprintf(writer->stream, ", %s: %s", place->node->text, place->value->text);
    for (const CzTrail *trail = place->trail; trail != NULL && trail->part != NULL;
         trail = trail->from)
        fprintf(writer->stream, ", part %s", trail->part);
    fputc('\n', writer->stream);
}

/* ---- values ---- */

static int write_key(const Writer *writer, const char *key, const char *suffix, int indent,
                     const char *dash) {
    return fprintf(writer->stream, "%s%*s%s%s%s%s:", writer->lead, indent - (int)strlen(dash), "",
                   dash, key, suffix[0] != '\0' ? "_" : "", suffix);
}

/* A text of a record as it is written; for a file that is copied to a result folder, its name
 * there. */
static const char *text_of(const Writer *writer, const char *const *field, size_t room,
                           char *name) {
    const CzOptimise *optimise = &writer->problem->input.optimise;
    for (int i = 0; writer->is_there && i < optimise->n_match; i++)
        if (&optimise->match[i].file == field && *field != NULL &&
            cz_problem_measured_file(writer->problem,
                                     cz_problem_measured(writer->problem, i)->number, room,
                                     name) != NULL)
            return name;
    return *field;
}

/* Writes "key: value # origin" for the keys of one value; false when the key is absent. */
static bool write_value(const Writer *writer, const CzKey *key, const char *field, int indent,
                        const char *dash) {
    char number[CZ_NUMBER_TEXT], name[CZ_PATH_SIZE];
    const char *value = number;
    const char *suffix = "";
    if (key->kind == CZ_KEY_NUMBER) {
        const double si = *(const double *)(const void *)field;
        if (isnan(si))
            return false;
        suffix = cz_unit_si(key->dimension)->suffix;
        cz_number_print(number, si);
    } else if (key->kind == CZ_KEY_COUNT) {
        const int count = *(const int *)(const void *)field;
        if (count < key->lo)
            return false;
        snprintf(number, sizeof number, "%d", count);
    } else if (key->kind == CZ_KEY_CHOICE) {
        value = key->words->word[*(const int *)(const void *)field].word;
    } else if (key->kind == CZ_KEY_FLAG) {
        value = *(const bool *)field ? "true" : "false";
    } else {
        value = text_of(writer, (const char *const *)(const void *)field, sizeof name, name);
        if (value == NULL)
            return false;
    }
    int column = write_key(writer, key->stem, suffix, indent, dash);
    column += fprintf(writer->stream, " ") + (int)strlen(value);
    if (key->kind == CZ_KEY_TEXT)
        cz_write_yaml_text(writer->stream, value);
    else
        fputs(value, writer->stream);
    write_origin(writer, key, field, column);
    return true;
}

static void write_texts(const Writer *writer, const CzKey *key, const CzTexts *texts, int indent) {
    int column = write_key(writer, key->stem, "", indent, "");
    column += fprintf(writer->stream, " [");
    for (int i = 0; i < texts->n_text; i++) {
        fputs(i > 0 ? ", " : "", writer->stream);
        cz_write_yaml_text(writer->stream, texts->text[i]);
        column += 2 + (int)strlen(texts->text[i]);
    }
    fputc(']', writer->stream);
    write_origin(writer, key, texts, column);
}

/* Whether there is a list of texts to write: one without texts when the file has it. */
static bool has_texts(const Writer *writer, const CzKey *key, const char *field) {
    const CzPlace *place = cz_places_find(&writer->problem->places, field);
    return ((const CzTexts *)(const void *)field)->n_text > 0 ||
           (place != NULL && place->address == field && place->key == key);
}

static void write_table(const Writer *writer, const CzKey *key, const CzTable *table, int indent) {
    char x[CZ_NUMBER_TEXT], y[CZ_NUMBER_TEXT];
    const int column = write_key(writer, key->stem, "", indent, "");
    write_origin(writer, key, table, column);
    fprintf(writer->stream, "%*sbasis: %s\n", indent + 2, "",
            table->basis == CZ_BASIS_DYNAMIC ? "dynamic" : "static");
    fprintf(writer->stream, "%*sstrokes: %s\n", indent + 2, "",
            table->strokes == CZ_STROKES_TOTAL ? "total" : "plastic");
    fprintf(writer->stream, "%*scolumns: [%s_%s, %s_%s]\n", indent + 2, "", key->x,
            cz_unit_si(key->dimension)->suffix, key->y, cz_unit_si(key->y_dimension)->suffix);
    fprintf(writer->stream, "%*spoints:\n", indent + 2, "");
    for (int i = 0; i < table->n_point; i++)
        fprintf(writer->stream, "%*s- [%s, %s]\n", indent + 4, "", cz_number_print(x, table->x[i]),
                cz_number_print(y, table->y[i]));
}

/* ---- design variables ----
 *
 * Parts and copies are written out, so a variable's path through a part is replaced by the places
 * in the vehicles; min and max keep the unit of its key. */

/* Writes the path of a number inside a record, such as ".front.stages[0].force". */
static bool write_inner_path(char *text, size_t size, const CzRecord *record, size_t offset) {
    for (int i = 0; i < record->n_key; i++) {
        const CzKey *key = &record->key[i];
        const CzRecord *inside = key->child;
        char rest[CZ_PATH_SIZE];
        const size_t at = offset - key->offset;
        if (key->kind == CZ_KEY_NUMBER && offset == key->offset) {
            return (size_t)snprintf(text, size, ".%s", key->stem) < size;
        }
        if (offset < key->offset)
            continue;
        if (key->kind == CZ_KEY_CHILD && at < inside->size &&
            write_inner_path(rest, sizeof rest, inside, at)) {
            return (size_t)snprintf(text, size, ".%s%s", key->stem, rest) < size;
        }
        if (key->kind == CZ_KEY_STAGES && at < CZ_MAX_STAGES * inside->size &&
            write_inner_path(rest, sizeof rest, inside, at % inside->size)) {
            return (size_t)snprintf(text, size, ".%s[%zu]%s", key->stem, at / inside->size, rest) <
                   size;
        }
    }
    return false;
}

/* Path of a target in the vehicles. */
static const char *path_of(const Writer *writer, const CzTarget *target,
                           char text[2 * CZ_PATH_SIZE]) {
    const CzInput *input = &writer->problem->input;
    char inner[CZ_PATH_SIZE] = "";
    int train = 0, vehicle = target->vehicle;
    if (vehicle < 0) /* not in a vehicle, so not from a part */
        return target->place;
    while (vehicle >= input->trains[train].n_vehicles)
        vehicle -= input->trains[train++].n_vehicles;
    write_inner_path(inner, sizeof inner, &cz_records[CZ_RECORD_CzVehicle], target->offset);
    snprintf(text, 2 * CZ_PATH_SIZE, "trains.%.48s.vehicles.%.48s%s%s%.16s",
             input->trains[train].name, writer->problem->vehicle[target->vehicle].name, inner,
             target->suffix[0] != '\0' ? "_" : "", target->suffix);
    return text;
}

static void write_target(const Writer *writer, const CzTarget *target) {
    char text[2 * CZ_PATH_SIZE];
    cz_write_yaml_text(writer->stream, path_of(writer, target, text));
}

/* Writes one variable that drives the places of one match, or of all matches when `match` < 0. */
static void write_variable(const Writer *writer, const CzVariable *variable, const char *name,
                           const CzTargets *targets, int match, int indent) {
    const CzRecord *record = &cz_records[CZ_RECORD_CzVariable];
    const char *before = "";
    write_key(writer, "name", "", indent, "- ");
    fputc(' ', writer->stream);
    cz_write_yaml_text(writer->stream, name);
    fputc('\n', writer->stream);
    write_key(writer, "paths", "", indent, "");
    fputs(" [", writer->stream);
    for (int i = 0; i < targets->n; i++) {
        if (match >= 0 && targets->target[i].match != match)
            continue;
        fputs(before, writer->stream);
        write_target(writer, &targets->target[i]);
        before = ", ";
    }
    fputs("]\n", writer->stream);
    for (int i = 0; i < record->n_key; i++)
        if (record->key[i].kind == CZ_KEY_NUMBER)
            write_value(writer, &record->key[i], (const char *)variable + record->key[i].offset,
                        indent, "");
        else if (record->key[i].offset == offsetof(CzVariable, values) &&
                 variable->values.n_text > 0)
            write_texts(writer, &record->key[i], &variable->values, indent);
}

static void write_variables(const Writer *writer, const CzVariable *variable, int indent) {
    const CzOptimise *optimise = &writer->problem->input.optimise;
    const CzTargets *targets =
        cz_problem_targets(writer->problem, (int)(variable - optimise->variables));
    const CzTarget *target = targets->target;
    if (variable->choices.n_text > 0 || targets->n == 0) { /* without parts there is no choice */
        Writer remark = *writer;
        remark.lead = variable->choices.n_text > 0 ? "# " : writer->lead;
        write_record(&remark, &cz_records[CZ_RECORD_CzVariable], (const char *)variable, indent,
                     "- ");
        return;
    }
    const int n_match = variable->path != NULL ? target[targets->n - 1].match + 1 : 1;
    const char *name = variable->name != NULL   ? variable->name
                       : variable->path != NULL ? variable->path
                                                : variable->paths.text[0];
    if (n_match == 1)
        write_variable(writer, variable, name, targets, -1, indent);
    for (int match = 0, i = 0; n_match > 1 && match < n_match; match++) {
        while (target[i].match != match)
            i++;
        write_variable(writer, variable, target[i].place, targets, match, indent);
    }
}

/* ---- changes and uncertain numbers ----
 *
 * Paths through parts are replaced by the places in the vehicles, as those of variables are. One
 * that cannot be replaced is written as it is, so that the file is refused and not read
 * differently. */

/* Writes the numbers and words of a record that are not texts. */
static void write_rest(const Writer *writer, const CzRecord *record, const char *memory,
                       int indent) {
    for (int i = 0; i < record->n_key; i++)
        if (record->key[i].kind != CZ_KEY_TEXT && record->key[i].kind != CZ_KEY_TEXTS)
            write_value(writer, &record->key[i], memory + record->key[i].offset, indent, "");
}

static void write_change(const Writer *writer, int scenario, const CzChange *change, int indent) {
    const CzRecord *record = &cz_records[CZ_RECORD_CzChange];
    CzTargets targets = {0};
    const bool is_replaced =
        !cz_change_is_late(change->path) &&
        cz_problem_find_changed(writer->problem, scenario, change->path, &targets, NULL) == CZ_OK;
    for (int i = 0; i < targets.n; i++) {
        write_key(writer, "path", "", indent, "- ");
        fputc(' ', writer->stream);
        write_target(writer, &targets.target[i]);
        fputc('\n', writer->stream);
        write_rest(writer, record, (const char *)change, indent);
    }
    if (!is_replaced)
        write_record(writer, record, (const char *)change, indent, "- ");
    free(targets.target);
}

/* Length of the name of a target's part, behind "parts."; 0 when its path begins otherwise. */
static size_t part_length(const CzTarget *target) {
    return cz_change_is_late(target->place) ? 0 : strcspn(target->place + 6, ".[");
}

static bool same_part(const CzTarget *a, const CzTarget *b) {
    const size_t n = part_length(a);
    return n == part_length(b) && strncmp(a->place + 6, b->place + 6, n) == 0;
}

/* Writes an uncertain number with the places of one part, `of`, or with all places when it is NULL.
 */
static void write_places(const Writer *writer, const CzScatter *scatter, const CzTargets *targets,
                         const CzTarget *of, int indent) {
    const char *before = "", *path = scatter->path != NULL ? scatter->path : scatter->paths.text[0];
    char name[2 * CZ_PATH_SIZE];
    snprintf(name, sizeof name, "%s%s%.*s", scatter->name != NULL ? scatter->name : path,
             of != NULL ? " " : "", of != NULL ? (int)part_length(of) : 0,
             of != NULL ? of->place + 6 : "");
    write_key(writer, "name", "", indent, "- ");
    fputc(' ', writer->stream);
    cz_write_yaml_text(writer->stream, name);
    fputc('\n', writer->stream);
    write_key(writer, "paths", "", indent, "");
    fputs(" [", writer->stream);
    for (int i = 0; i < targets->n; i++) {
        if (of != NULL && !same_part(&targets->target[i], of))
            continue;
        fputs(before, writer->stream);
        write_target(writer, &targets->target[i]);
        before = ", ";
    }
    fputs("]\n", writer->stream);
    CzScatter rest = *scatter;
    rest.group = scatter->group == CZ_GROUP_PART ? CZ_GROUP_ALL : scatter->group;
    write_rest(writer, &cz_records[CZ_RECORD_CzScatter], (const char *)&rest, indent);
    for (int i = 0; i < cz_records[CZ_RECORD_CzScatter].n_key; i++)
        if (scatter->values.n_text > 0 &&
            cz_records[CZ_RECORD_CzScatter].key[i].offset == offsetof(CzScatter, values))
            write_texts(writer, &cz_records[CZ_RECORD_CzScatter].key[i], &scatter->values, indent);
}

static void write_scatter(const Writer *writer, const CzScatter *scatter, int indent) {
    const CzTexts single = {1, &scatter->path};
    const CzTexts *paths = scatter->path != NULL ? &single : &scatter->paths;
    CzTargets targets = {0};
    bool has_parts = false;
    CzStatus status = CZ_OK;
    for (int i = 0; i < paths->n_text; i++)
        has_parts |= !cz_change_is_late(paths->text[i]);
    for (int i = 0; i < paths->n_text && has_parts && status == CZ_OK; i++)
        status = cz_problem_find_changed(writer->problem, 0, paths->text[i], &targets, NULL);
    if (!has_parts || status != CZ_OK)
        write_record(writer, &cz_records[CZ_RECORD_CzScatter], (const char *)scatter, indent, "- ");
    else if (scatter->group != CZ_GROUP_PART)
        write_places(writer, scatter, &targets, NULL, indent);
    for (int i = 0; i < targets.n && status == CZ_OK && scatter->group == CZ_GROUP_PART; i++) {
        bool is_first = true;
        for (int k = 0; k < i; k++)
            is_first &= !same_part(&targets.target[k], &targets.target[i]);
        if (is_first)
            write_places(writer, scatter, &targets, &targets.target[i], indent);
    }
    free(targets.target);
}

/* One record of a list; `memory` is the record around it. */
static void write_item(const Writer *writer, const CzRecord *record, const char *memory,
                       const char *item, int indent) {
    const void *address = item, *around = memory;
    const CzScenario *scenario = around;
    if (record == &cz_records[CZ_RECORD_CzVariable])
        write_variables(writer, address, indent);
    else if (record == &cz_records[CZ_RECORD_CzChange])
        write_change(writer, (int)(scenario - writer->problem->input.scenarios), address, indent);
    else if (record == &cz_records[CZ_RECORD_CzScatter])
        write_scatter(writer, address, indent);
    else
        write_record(writer, record, item, indent, "- ");
}

/* Records of a list: stages by value, others by pointer. */
static void write_list(const Writer *writer, const CzKey *key, const char *memory, int indent) {
    const CzRecord *record = key->child;
    const int n_item = *(const int *)(const void *)(memory + key->n_offset);
    const char *item = memory + key->offset;
    if (key->kind == CZ_KEY_LIST)
        item = *(const char *const *)(const void *)item;
    const int column = write_key(writer, key->stem, "", indent, "");
    write_origin(writer, key, memory + key->offset, column);
    for (int i = 0; i < n_item; i++, item += record->size)
        write_item(writer, record, memory, item, indent + 4);
}

/* Records by name: the first key of each, its name, is that of the mapping. */
static void write_named(const Writer *writer, const CzKey *key, const char *memory, int indent) {
    const int n_item = *(const int *)(const void *)(memory + key->n_offset);
    const char *item = *(const char *const *)(const void *)(memory + key->offset);
    const int column = write_key(writer, key->stem, "", indent, "");
    write_origin(writer, key, memory + key->offset, column);
    CzRecord rest = *key->child;
    rest.key++;
    rest.n_key--;
    for (int i = 0; i < n_item; i++, item += key->child->size) {
        fprintf(writer->stream, "%s%*s", writer->lead, indent + 2, "");
        cz_write_yaml_text(writer->stream,
                           *(const char *const *)(const void *)(item + key->child->key->offset));
        fputs(":\n", writer->stream);
        write_record(writer, &rest, item, indent + 4, "");
    }
}

/* Whether all variables are choices of parts, so that none remains here. */
static bool has_only_choices(const CzKey *key, const char *field) {
    const CzOptimise *optimise = (const CzOptimise *)(const void *)field;
    if (key->child != &cz_records[CZ_RECORD_CzOptimise])
        return false;
    for (int i = 0; i < optimise->n_variables; i++)
        if (optimise->variables[i].choices.n_text == 0)
            return false;
    return true;
}

static void write_child(const Writer *writer, const CzKey *key, const char *field, int indent) {
    const CzRecord *record = key->child;
    const bool is_given = *(const bool *)field;
    Writer inside = *writer;
    if (!is_given && key->child != &cz_records[CZ_RECORD_CzSimulation] &&
        key->child != &cz_records[CZ_RECORD_CzChecks])
        return;
    if (!is_given || has_only_choices(key, field)) /* defaults are not written */
        inside.lead = "# ";
    const int column = write_key(&inside, key->stem, "", indent, "");
    write_origin(writer, key, field, column);
    write_record(&inside, record, field, indent + 2, "");
}

/* Whether a number is its default and has no effect. */
static bool is_idle_default(const Writer *writer, const CzKey *key, const char *field) {
    return key->kind == CZ_KEY_NUMBER && *(const double *)(const void *)field == key->absent &&
           !cz_field_acts(writer->problem, key, field);
}

/* Writes the keys of a record that have an effect; `dash` goes before the first. */
static void write_record(const Writer *writer, const CzRecord *record, const char *memory,
                         int indent, const char *dash) {
    for (int i = 0; i < record->n_key; i++) {
        const CzKey *key = &record->key[i];
        const char *field = memory + key->offset;
        if (!cz_field_acts_on_model(writer->problem, key, field) ||
            is_idle_default(writer, key, field))
            continue;
        switch (key->kind) {
        case CZ_KEY_CHILD:
            write_child(writer, key, field, indent);
            break;
        case CZ_KEY_STAGES:
        case CZ_KEY_LIST:
            if (*(const int *)(const void *)(memory + key->n_offset) > 0)
                write_list(writer, key, memory, indent);
            break;
        case CZ_KEY_NAMED:
            if (*(const int *)(const void *)(memory + key->n_offset) > 0)
                write_named(writer, key, memory, indent);
            break;
        case CZ_KEY_TABLE:
            if (((const CzTable *)(const void *)field)->given)
                write_table(writer, key, (const CzTable *)(const void *)field, indent);
            break;
        case CZ_KEY_TEXTS:
            if (has_texts(writer, key, field))
                write_texts(writer, key, (const CzTexts *)(const void *)field, indent);
            break;
        default:
            if (write_value(writer, key, field, indent, dash))
                dash = "";
        }
    }
}

static void write_resolved(const CzProblem *problem, bool is_there, FILE *stream) {
    const Writer writer = {problem, stream, "", is_there};
    fprintf(
        stream,
        "# %s" CZ_RESOLVED_MARK ", values in SI.\n"
        "# The comment behind each value gives its place in the input, or marks it as a default.\n",
        cz_problem_reported_name(problem, problem->file));
    for (const CzSource *source = problem->reader.sources.first; source != NULL;
         source = source->next)
        fprintf(stream, "# read: %s\n", cz_problem_reported_name(problem, source->name));
    write_record(&writer, &cz_records[CZ_RECORD_CzInput], (const char *)&problem->input, 0, "");
}

void cz_problem_write_resolved(const CzProblem *problem, FILE *stream) {
    write_resolved(problem, false, stream);
}

void cz_problem_write_resolved_in_folder(const CzProblem *problem, FILE *stream) {
    write_resolved(problem, true, stream);
}
