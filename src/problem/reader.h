/* The steps from files to typed records, in the order in which they are taken:
 *
 *   load      files -> one tree: `extends` merged, parts of catalogues gathered
 *   settings  `set:` and --set put into the tree
 *   trains    `copy`, `repeat`, `reversed` written out
 *   families  `sweep` of a scenario written out
 *   bind      tree -> typed records, with a place for every value; `use` is taken on the way
 *   rules     what must hold between values
 *
 * All of them go on after a mistake, so that one pass tells every mistake. When memory is short
 * they return NULL or leave; the arena knows that a request failed.
 */
#ifndef CZ_PROBLEM_READER_H
#define CZ_PROBLEM_READER_H

#include "base/index.h"
#include "base/suggest.h"
#include "crushzone/names.h"
#include "problem/input.h"
#include "problem/keys.h"
#include "text/mistakes.h"
#include "problem/problem.h"
#include "text/source.h"

/* ---- trees ---- */

typedef struct CzPart {
    const char *name;
    const CzNode *written; /* the part's name where it is written */
    const CzNode *node;    /* a mapping */
    int depth;             /* of the parts that it uses: 0 without any */
} CzPart;

/* What a problem says, in nodes. */
typedef struct CzTree {
    const CzNode *root;
    int n_part;
    CzPart *part;     /* (n_part) */
    CzIndex by_name;  /* of the parts */
    bool lacks_parts; /* a catalogue could not be read: what a part is missing for is told there */
} CzTree;

/* Where a record or one of its values was written. */
typedef struct CzPlace {
    const void *address; /* of the record or field in the input */
    size_t size;         /* of a record [byte]; 0 for a field */
    const CzNode *node;  /* key of a field, mapping of a record */
    const CzNode *value; /* value of a field */
    const CzTrail *trail;
    const CzKey *key; /* of a field */
    const CzUnit *unit;
} CzPlace;

/* A record's memory, from start to before end, and the record around it: -1 for none. */
typedef struct CzPlacedRecord {
    uintptr_t start, end;
    int place, around;
} CzPlacedRecord;

typedef struct CzPlaces {
    int n_place, n_allocated;
    CzPlace *place;
    int n_slot; /* fields by address */
    int *slot;
    int n_record; /* records by address, as of the last cz_places_sort */
    CzPlacedRecord *record;
} CzPlaces;

typedef struct CzReader {
    CzArena arena;
    CzSources sources;
    CzMistakes mistakes, warnings;
    CzPlaces places;
    int n_set;      /* values that settings have changed so far */
    bool has_holes; /* records could not be read, so what is absent may have been written */
    const char *share_folder; /* with catalogue/ and profiles/; NULL for none */
} CzReader;

struct CzProblem {
    CzReader reader;
    CzTree tree; /* as the files say it, before settings */
    const char *file;
    char hash[17];
    int n_setting;
    const struct CzSetting *setting; /* of the file, then of the options (n_setting) */
    CzInput input;
    int n_vehicle;
    CzVehicle *vehicle; /* those of all trains (n_vehicle) */
    CzProfile profile;
    CzMeasured *measured; /* one per match; NULL while they are not read */
};

/* ---- load.c ---- */

/* Reads one further YAML file that `place` names; NULL when it cannot be read. */
const CzNode *cz_load_file(CzReader *reader, const char *path, const CzNode *place);
/* Reads what the top file names: base files and catalogues. The tree's root is NULL at a failure.
 */
CzTree cz_load_tree(CzReader *reader, const CzNode *top);
/* The file that `name` stands for beside the file of `place`, then in the share folder under
 * `subfolder` (may be NULL); a mistake and NULL when there is none. */
const char *cz_load_locate(CzReader *reader, const char *name, const CzNode *place,
                           const char *subfolder);

/* ---- merge.c ---- */

extern const CzTrail cz_no_trail;

/* The trail of an entry in a mapping or list that has the trail `outer`. */
const CzTrail *cz_entry_trail(const CzEntry *entry, const CzTrail *outer);
/* `over` laid over `base`. With by_name, lists of named records merge by name. */
const CzNode *cz_merge(CzArena *arena, const CzNode *base, const CzTrail *base_trail,
                       const CzNode *over, const CzTrail *over_trail, bool by_name);

/* ---- parts.c ---- */

enum { CZ_MOST_NESTED = 40 }; /* parts that use one another */

/* The part whose name is the first n bytes of a text; NULL when there is none. */
CzPart *cz_tree_part(const CzTree *tree, const char *name, size_t n);
/* Finds how deep parts use one another, each part once; tells circles and chains that are too deep.
 */
void cz_parts_measure(CzReader *reader, CzTree *tree);
/* A mapping with its `use` taken; the node itself when it has none. NULL without memory. */
const CzNode *cz_take_part(CzReader *reader, const CzTree *tree, const CzNode *node,
                           const CzTrail *trail);

/* ---- settings.c ---- */

typedef struct CzSetting {
    const char *path;
    const CzNode *place; /* of the path */
    const CzNode *value;
} CzSetting;

/* Settings of the file's `set:`, then of the options. */
const CzSetting *cz_settings_gather(CzReader *reader, const CzNode *root,
                                    const CzProblemOptions *options, int *n_setting);
/* When a setting takes its turn: 0 for parts without parts in them, more the deeper parts are
 * nested in a part, CZ_LAST_RANK for what is no part. */
enum { CZ_LAST_RANK = 48 };
int cz_setting_rank(const CzTree *tree, const char *path);
/* The tree with all settings put in. */
CzTree cz_settings_apply(CzReader *reader, const CzTree *tree, const CzSetting *setting,
                         int n_setting);

/* ---- problem.c ---- */

/* The scenario of a name, or the first of a family of that name; -1 when there is none, and the
 * nearest word. */
int cz_input_find_scenario(const CzInput *input, const char *name, CzSuggestion *nearest);

/* ---- path.c ---- */

enum { CZ_MAX_PLACE = CZ_PATH_ROOM };

/* What a path ended in: the concrete path of each match. */
typedef struct CzMatches {
    int n_match;
    char (*place)[CZ_MAX_PLACE]; /* (n_match) */
} CzMatches;

/* Puts a value under a path, which may name several places; with `matches` each place gets a node
 * of its own that stands for any number. False, with a mistake, when the path names none. */
bool cz_path_put(CzReader *reader, CzTree *tree, const char *path, const CzNode *place,
                 const CzNode *value, CzMatches *matches);

/* ---- trains.c ---- */

enum { CZ_MOST_VEHICLES = 1000 };

/* The root with the vehicles of all trains written out; NULL without memory. */
const CzNode *cz_trains_write_out(CzReader *reader, const CzTree *tree);
/* The root with names for the vehicles of its trains that have none, so that an overlay can name
 * them; NULL without memory. */
const CzNode *cz_trains_name_vehicles(CzArena *arena, const CzNode *root);
/* How many vehicles an item of a list of vehicles stands for. */
int cz_vehicle_repeat(const CzNode *vehicle);
/* Writes the name of the k-th vehicle of an item: `given` (may be NULL) counted on, or the train's
 * name and the position in the train. */
void cz_vehicle_name(char *text, size_t size, const CzNode *vehicle, const char *train,
                     int position, int k);

/* ---- families.c ---- */

/* The root with every scenario that has `sweep` written out as its members; NULL without memory. */
const CzNode *cz_families_write_out(CzReader *reader, const CzTree *tree);

/* ---- bind.c ---- */

/* Reads a mapping as a record. `record_memory` was zeroed. */
void cz_bind_record(CzReader *reader, const CzTree *tree, CzRecordId record, const CzNode *node,
                    const CzTrail *trail, void *record_memory);
/* Fills a record that the file does not have. */
void cz_bind_absent(CzRecordId record, void *record_memory);

/* ---- places.c ---- */

void cz_places_add(CzReader *reader, CzPlace place);
/* Makes the records that were added be found; reading a record does it at its end. */
void cz_places_sort(CzReader *reader);
void cz_places_free(CzPlaces *places);
/* Place of a field, or of the innermost record about it; NULL when it is not in the input. */
const CzPlace *cz_places_find(const CzPlaces *places, const void *field);

/* ---- bind_value.c ---- */

/* A text node as a number of a key in a unit; false with a mistake when it is none. */
bool cz_bind_number(CzReader *reader, const CzKey *key, const CzUnit *unit, const CzNode *key_node,
                    const CzNode *value, const CzTrail *trail, double *number);
bool cz_bind_count(CzReader *reader, const CzKey *key, const CzNode *value, const CzTrail *trail,
                   int *count);
bool cz_bind_flag(CzReader *reader, const char *key, const CzNode *value, const CzTrail *trail,
                  bool *flag);
bool cz_bind_choice(CzReader *reader, const CzKey *key, const CzNode *value, const CzTrail *trail,
                    int *choice);
/* A text node's text; NULL with a mistake when it has none. */
const char *cz_bind_text(CzReader *reader, const char *key, const CzNode *value,
                         const CzTrail *trail);

/* ---- bind_table.c ---- */

void cz_bind_table(CzReader *reader, const CzKey *key, const CzNode *node, const CzTrail *trail,
                   CzTable *table);

/* ---- bind_curve_file.c ---- */

/* Whether a curve in a file takes a key. */
bool cz_curve_file_takes(const char *key);

/* Where the points of a curve go. */
typedef struct CzCurveInFile {
    int *n_point;
    double **x, **y; /* [SI] (n_point) */
} CzCurveInFile;

/* Reads the file that a curve names: its loading, with strokes that rise from 0. False with a
 * mistake, or without memory. */
bool cz_bind_curve_file(CzReader *reader, const CzKey *key, const CzNode *node,
                        const CzTrail *trail, const CzCurveInFile *points);

/* ---- strokes.c ---- */

/* Makes the strokes of a device's curve those that its law is over: plastic ones of a tube or
 * anti-climber, total ones of an end. Other records are left alone. */
void cz_bind_strokes(CzReader *reader, CzRecordId record, const CzNode *node, const CzTrail *trail,
                     void *memory);
/* Whether the strokes of a curve were made with this number, which then cannot vary. */
bool cz_strokes_depend_on(const CzInput *input, const double *field);

/* ---- rules ---- */

/* Checks what must hold between the values. Values that could not be read are NaN and break no
 * rule, so that the rules hold even for a problem with other mistakes. */
void cz_rules_check(CzProblem *problem);

/* ---- usual.c ---- */

/* Warns of numbers outside of their usual range. */
void cz_usual_check(CzReader *reader);
/* Writes the usual range of a key behind its range; nothing when it has none. */
void cz_usual_write(FILE *stream, const CzKey *key);

/* ---- acts_on.c ---- */

/* Whether a key does anything on a model of vehicle. */
bool cz_key_acts_on(const CzKey *key, CzVehicleModel model);

/* Whether the field of a key does anything on the vehicle that it belongs to; one that belongs to
 * none does. */
bool cz_field_acts(const CzProblem *problem, const CzKey *key, const void *field);
/* Warns of keys that do nothing on the model that they are written for. */
void cz_acts_on_check(CzProblem *problem);
/* Writes on which models a key acts behind its range; nothing when on all. */
void cz_acts_on_write(FILE *stream, const CzKey *key);

/* ---- profile.c ---- */

/* Reads the profile that the problem names, with the limits of its category. */
void cz_profile_read(CzProblem *problem);

/* ---- measured.c ---- */

/* Reads the time histories that the problem's matches name. */
void cz_measured_read(CzProblem *problem);

/* ---- problem.c ---- */

/* Zeroed memory that is freed with the problem; NULL when there is none. */
void *cz_reader_allocate(CzReader *reader, size_t n, size_t size);
/* Puts settings in and reads the input of a tree. */
void cz_problem_bind(CzProblem *problem, const CzTree *tree);

#endif
