/* `new`: writes a commented example that runs as it stands. */
#include "base/suggest.h"
#include "cli/command.h"
#include "cli/messages.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static const char two_trains[] =
    "# yaml-language-server: $schema=./crushzone.schema.json\n"
    "# Two identical trains meet: a first crush zone to play with.\n"
    "#   crushzone run two-trains.yaml        collide, judge, write the results to out/\n"
    "#   crushzone optimise two-trains.yaml   size the absorbers until every check passes\n"
    "#   crushzone help keys                  every key; 'help units' and 'help checks' the rest\n"
    "#   crushzone schema > crushzone.schema.json   lets editors complete and check keys\n"
    "# All numbers are invented for learning; replace them by those of your train.\n"
    "schema: 1\n"
    "title: Two identical 4-car units, 25 km/h\n"
    "\n"
    "parts:                                   # `use: NAME` takes a part; keys beside it override\n"
    "  draft-gear:\n"
    "    stages: [{stroke_mm: 50, force_kN: 400}]\n"
    "\n"
    "  cab-end:                               # distances are behind the foremost plane of the "
    "end\n"
    "    face_gap_mm: 900                     # the bare end structure\n"
    "    stages: [{stroke_mm: 20, force_kN: 1500}, {stroke_mm: 300, force_kN: 2500}]\n"
    "    unloading_stiffness_MN_m: 100\n"
    "    coupler:                             # stands out furthest and moves first\n"
    "      buffer: {use: draft-gear}\n"
    "      tube: {stages: [{stroke_mm: 250, force_kN: 700}]}\n"
    "      shear_off: {force_kN: 1000, retraction_space_mm: 1500}\n"
    "    anti_climber:                        # takes over when the coupler has let go\n"
    "      count: 2                           # forces are per device\n"
    "      gap_mm: 320\n"
    "      stages: [{stroke_mm: 500, force_kN: 500}]\n"
    "\n"
    "  inner-end:\n"
    "    face_gap_mm: 450\n"
    "    stages: [{stroke_mm: 20, force_kN: 1500}, {stroke_mm: 100, force_kN: 2500}]\n"
    "    unloading_stiffness_MN_m: 100\n"
    "    coupler:\n"
    "      buffer: {use: draft-gear}\n"
    "      tube: {stages: [{stroke_mm: 200, force_kN: 700}]}\n"
    "\n"
    "  middle-car:\n"
    "    model: rigid                         # one mass; `full` adds bogies, wheels and pitch\n"
    "    mass_t: 38\n"
    "    front: {use: inner-end}\n"
    "    rear: {use: inner-end}\n"
    "\n"
    "  driving-car: {use: middle-car, mass_t: 40, front: {use: cab-end}}\n"
    "\n"
    "trains:                                  # the train behind first, vehicles along its way\n"
    "  - name: A\n"
    "    speed_km_h: 25\n"
    "    vehicles:\n"
    "      - {use: driving-car, reversed: true}\n"
    "      - {use: middle-car, repeat: 2}\n"
    "      - {use: driving-car}               # A4 meets B1\n"
    "  - {name: B, copy: A, speed_km_h: 0}\n"
    "\n"
    "checks:\n"
    "  closing_rules: false                   # rules for full cars; see 'crushzone help checks'\n"
    "  limits:\n"
    "    - {name: interface force, metric: interfaces.peak_force_kN, max: 1500, source: example,\n"
    "       confidence: user}\n"
    "    - {name: mean deceleration, metric: vehicles.mean_deceleration_120ms_g, max: 5,\n"
    "       source: example, confidence: user}\n"
    "    - {name: stroke of inner couplers, metric: elements.inner coupler *.stroke_used, max: "
    "0.9,\n"
    "       source: example, confidence: user}\n"
    "    - {name: stroke of anti-climbers, metric: elements.anti-climber *.stroke_used, max: 0.9,\n"
    "       source: example, confidence: user}\n"
    "    - {name: car ends stay whole, metric: elements.end *.energy_kJ, max: 1,\n"
    "       source: example, confidence: user}\n"
    "\n"
    "optimise:                                # without `minimise` the smallest margin grows\n"
    "  variables:\n"
    "    - {path: 'parts.cab-end.coupler.tube.stages[0].force_kN', min: 500, max: 900, step: 10}\n"
    "    - {path: 'parts.cab-end.anti_climber.stages[0].force_kN', min: 300, max: 700, step: 10}\n"
    "    - {path: 'parts.cab-end.anti_climber.stages[0].stroke_mm', min: 300, max: 560, step: 10}\n"
    "    - {path: 'parts.inner-end.coupler.tube.stages[0].force_kN', min: 500, max: 1200, step: "
    "10}\n"
    "    - {path: 'parts.inner-end.coupler.tube.stages[0].stroke_mm', min: 100, max: 380, step: "
    "10}\n"
    "  evaluations: 500\n";

typedef struct Template {
    const char *name, *text;
} Template;
static const Template templates[] = {{"two-trains", two_trains}};
enum { N_TEMPLATE = sizeof templates / sizeof *templates };

static const char *find_template(const char *name, CzError *error) {
    CzSuggestion suggestion = {0};
    for (int i = 0; i < N_TEMPLATE; i++) {
        if (strcmp(templates[i].name, name) == 0)
            return templates[i].text;
        cz_suggest(&suggestion, name, templates[i].name);
    }
    error->status = CZ_STATUS_INPUT;
    snprintf(error->message, sizeof error->message, "there is no template '%.100s'", name);
    snprintf(error->help, sizeof error->help, "%s'%s'%s",
             suggestion.best != NULL ? "did you mean " : "there is ", templates[0].name,
             suggestion.best != NULL ? "?" : "");
    return NULL;
}

/* Writes a new file; one that is there already is somebody's work and stays. */
static CzStatus write_new(const char *path, const char *text, CzError *error) {
    FILE *stream = fopen(path, "wbx");
    if (stream != NULL) {
        const bool is_written = fputs(text, stream) != EOF;
        if (fclose(stream) == 0 && is_written)
            return CZ_OK;
    }
    error->status = CZ_STATUS_OUTPUT;
    snprintf(error->message, sizeof error->message, "%.300s cannot be written: %s", path,
             errno == EEXIST ? "it is there already" : strerror(errno));
    if (errno == EEXIST)
        snprintf(error->help, sizeof error->help,
                 "choose another name with -o FILE, or -o - for standard output");
    return CZ_STATUS_OUTPUT;
}

int cz_command_new(const CzArguments *arguments) {
    char room[256];
    CzError error = {0};
    const char *name = arguments->n_operand > 0 ? arguments->operand[0] : templates[0].name;
    const char *path = arguments->text[CZ_OPTION_OUTPUT];
    const char *text = find_template(name, &error);
    if (text == NULL)
        return cz_tell_error(arguments, &error);
    if (path != NULL && strcmp(path, "-") == 0) {
        fputs(text, stdout);
        return 0;
    }
    if (path == NULL) {
        snprintf(room, sizeof room, "%s.yaml", name);
        path = room;
    }
    if (write_new(path, text, &error) != CZ_OK)
        return cz_tell_error(arguments, &error);
    cz_tell(arguments, "wrote %s; next: crushzone run %s", path, path);
    return 0;
}
