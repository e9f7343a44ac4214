/* Histories of a run as a test folder in ISO-MME. */
#include "report/iso_mme.h"

#include "base/number.h"
#include "report/units.h"
#include "text/units.h"

#include <math.h>
#include <string.h>

/* ---- codes and units ---- */

/* Entry of iso_mme.def. */
typedef struct Kind {
    const char *location, *dimension, *direction;
} Kind;

static const Kind kinds[CZ_N_CHANNEL] = {
#define CZ_MME_CHANNEL(constant, location, dimension, direction)                                   \
    [CZ_CHANNEL_##constant] = {location, dimension, direction},
#include "report/iso_mme.def"
#undef CZ_MME_CHANNEL
};

/* Physical dimension of a code. */
typedef struct Dimension {
    const char *code;
    CzDimension dimension;
    const char *unit;
} Dimension;

static const Dimension *dimension_of(CzChannel channel) {
    static const Dimension dimensions[] = {
#define CZ_MME_DIMENSION(code, dimension, unit) {code, CZ_DIMENSION_##dimension, unit},
#include "text/mme_dimensions.def"
#undef CZ_MME_DIMENSION
    };
    size_t i = 0;
    while (strcmp(dimensions[i].code, kinds[channel].dimension) != 0) /* the list has all */
        i++;
    return &dimensions[i];
}

static CzColumn column_of(const CzIsoMme *mme, int channel) {
    return cz_run_column(mme->run, channel + 1); /* the first column is the time */
}

int cz_iso_mme_n_channel(const CzIsoMme *mme) {
    return cz_run_n_column(mme->run) - 1;
}

/* Test object 1 is the train behind, 2 the train ahead, 0 what belongs to neither alone. */
void cz_iso_mme_code(const CzIsoMme *mme, int channel, char code[CZ_ISO_MME_CODE]) {
    const CzColumn column = column_of(mme, channel);
    const CzChannelAt at = cz_channel_info(column.channel)->at;
    const Kind *kind = &kinds[column.channel];
    const int index = cz_place_index(at, column.place);
    const int first = cz_first_place(at, index), colliding = mme->scene->colliding;
    const bool is_of_train = at != CZ_AT_RUN && !(at == CZ_AT_INTERFACE && index == colliding);
    const int train = !is_of_train ? 0 : index <= colliding ? 1 : 2;
    const bool is_counted_in_train = at != CZ_AT_INTERFACE && train == 2;
    const int number = is_counted_in_train ? index - colliding : index + 1;
    const char *fine = at == CZ_AT_VEHICLE ? "CG" : "00";
    if (at == CZ_AT_END)
        fine = column.place == first ? "RE" : "FR";
    char location[5], count[3] = "00";
    snprintf(location, sizeof location, "%s", kind->location);
    if (at == CZ_AT_WHEELSET)
        location[3] = (char)('1' + column.place - first);
    if (at != CZ_AT_RUN && number < 100) {
        count[0] = (char)('0' + number / 10);
        count[1] = (char)('0' + number % 10);
    } else if (at != CZ_AT_RUN) {
        count[0] = count[1] = '?';
    }
    snprintf(code, CZ_ISO_MME_CODE, "%d0%s%s00%s%s%s0", train, location, fine, count,
             kind->dimension, kind->direction);
}

/* Name of a channel as in channels.csv, without its unit. */
static void name_channel(const CzIsoMme *mme, int channel, char name[CZ_CHANNEL_SIZE]) {
    const CzColumn column = column_of(mme, channel);
    const CzChannelInfo *info = cz_channel_info(column.channel);
    cz_channel_name(info, column.place,
                    cz_run_place_name(cz_run_summary(mme->run), info->at, column.place), name);
    name[strlen(name) - strlen(info->unit) - 1] = '\0';
}

/* ---- files ---- */

static void put(FILE *stream, const char *key, const char *value) {
    fprintf(stream, "%-28s:%s\n", key, value);
}

static void put_number(FILE *stream, const char *key, double value) {
    char text[CZ_NUMBER_TEXT];
    put(stream, key, cz_number_print(text, value));
}

void cz_iso_mme_write_test(const CzIsoMme *mme, FILE *stream) {
    static const char *const unknown[] = {"Laboratory name", "Customer name", "Regulation",
                                          "Date of the test"};
    const CzInput *input = cz_problem_input(mme->problem);
    put(stream, "Data format edition number", "1.6");
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++)
        put(stream, unknown[i], "NOVALUE");
    put(stream, "Customer test ref. number", mme->test);
    put(stream, "Title", cz_problem_title(mme->problem));
    put(stream, "Type of the test", "Simulation of a train collision");
    put(stream, "Subtype of the test", mme->scene->name);
    for (int i = 0; i < 2; i++) {
        char key[40];
        snprintf(key, sizeof key, "Name of test object %d", i + 1);
        put(stream, key, input->trains[mme->scene->train[i]].name);
    }
    fprintf(stream, "%-28s:computed by crushzone %s; time 0 is the first contact\n", "Comments",
            cz_version());
    put(stream, "Comments", "fine location 3 is the number of the vehicle or interface");
}

void cz_iso_mme_write_index(const CzIsoMme *mme, FILE *stream) {
    const int n = cz_iso_mme_n_channel(mme);
    put(stream, "Instrumentation standard", "NOVALUE");
    fprintf(stream, "%-28s:%d\n", "Number of channels", n);
    for (int i = 0; i < n; i++) {
        char key[40], code[CZ_ISO_MME_CODE], name[CZ_CHANNEL_SIZE];
        snprintf(key, sizeof key, "Name of channel %03d", i + 1);
        cz_iso_mme_code(mme, i, code);
        name_channel(mme, i, name);
        fprintf(stream, "%-28s:%s / %s\n", key, code, name);
    }
}

static void put_head(const CzIsoMme *mme, int channel, const Dimension *dimension, FILE *stream) {
    const double *time = cz_run_channel(mme->run, CZ_CHANNEL_TIME, 0);
    const int n = cz_run_n_sample(mme->run);
    char code[CZ_ISO_MME_CODE], name[CZ_CHANNEL_SIZE];
    cz_iso_mme_code(mme, channel, code);
    name_channel(mme, channel, name);
    fprintf(stream, "%-28s:%c\n", "Test object number", code[0]);
    put(stream, "Name of the channel", name);
    put(stream, "Laboratory channel code", name);
    put(stream, "Customer channel code", "NOVALUE");
    put(stream, "Channel code", code);
    put(stream, "Unit", dimension->unit);
    put(stream, "Reference system", "track");
    put(stream, "Pre-filter type", "NONE");
    put(stream, "Cut off frequency", "NOVALUE");
    put(stream, "Channel amplitude class", "NOVALUE");
    put(stream, "Reference channel", "implicit");
    put(stream, "Reference channel name", "NOVALUE");
    put(stream, "Data source", "simulation");
    put(stream, "Data status", "ok");
    put_number(stream, "Sampling interval", n > 1 ? (time[1] - time[0]) / CZ_MILLI_PER_UNIT : 0);
    put(stream, "Bit resolution", "NOVALUE");
    put_number(stream, "Time of first sample", n > 0 ? time[0] / CZ_MILLI_PER_UNIT : 0);
    fprintf(stream, "%-28s:%d\n", "Number of samples", n);
}

void cz_iso_mme_write_channel(const CzIsoMme *mme, int channel, FILE *stream) {
    const CzColumn column = column_of(mme, channel);
    const Dimension *dimension = dimension_of(column.channel);
    const double *value = cz_run_channel(mme->run, column.channel, column.place);
    const double unit =
        cz_unit_find(dimension->dimension, cz_channel_info(column.channel)->unit)->si;
    put_head(mme, channel, dimension, stream);
    for (int i = 0; i < cz_run_n_sample(mme->run); i++) {
        char text[CZ_NUMBER_TEXT];
        fprintf(stream, "%s\n",
                isfinite(value[i]) ? cz_number_print_exact(text, value[i] * unit) : "NOVALUE");
    }
}
