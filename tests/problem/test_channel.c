/* Names of channels: written from an entry and a place, and read again. */
#include "crushzone/channel.h"
#include "support/check.h"

#include <string.h>

/* Of the largest length, without its last letters. */
#define LONG "a-vehicle-whose-name-takes-all-the-room-there_"

static const char *const short_names[] = {"A1", "A2", "B1"};
static const char *const long_names[] = {LONG "_1", LONG "w1", LONG "_3"};

static int n_index(CzChannelAt at, int n_vehicle) {
    return at == CZ_AT_RUN ? 1 : at == CZ_AT_INTERFACE ? n_vehicle - 1 : n_vehicle;
}

/* Writes the name of every place of every channel and reads it back; returns their number. */
static int find_all(int n_vehicle, const char *const *vehicle) {
    int n = 0;
    for (CzChannel channel = 0; channel < CZ_N_CHANNEL; channel++) {
        const CzChannelInfo *info = cz_channel_info(channel);
        const int end = cz_first_place(info->at, n_index(info->at, n_vehicle));
        for (int place = 0; place < end; place++, n++) {
            const int i = cz_place_index(info->at, place);
            char interface[CZ_INTERFACE_SIZE] = "", name[CZ_CHANNEL_SIZE];
            if (info->at == CZ_AT_INTERFACE)
                snprintf(interface, sizeof interface, "%s-%s", vehicle[i], vehicle[i + 1]);
            cz_channel_name(info, place, info->at == CZ_AT_INTERFACE ? interface : vehicle[i],
                            name);
            const char *unit = strrchr(info->pattern, '}');
            unit = unit != NULL ? unit + 1 : info->pattern;
            assert_string_equal(name + strlen(name) - strlen(unit), unit);
            CzColumn column = {CZ_N_CHANNEL, -1};
            assert_true(cz_column_find(name, n_vehicle, vehicle, &column, NULL));
            assert_int_equal(column.channel, channel);
            assert_int_equal(column.place, place);
        }
    }
    return n;
}

static void every_place_of_every_channel_is_found_by_its_name(void **state) {
    (void)state;
    /* 8 of the run, 5 of a vehicle, 4 wheelsets, 3 of each of 2 ends, 8 of an interface */
    assert_int_equal(find_all(3, short_names), 8 + 3 * (5 + 4 + 3 * 2) + 2 * 8);
    assert_int_equal(strlen(long_names[0]), CZ_MAX_NAME);
    find_all(3, long_names);
}

static void names_contain_the_place(void **state) {
    (void)state;
    char name[CZ_CHANNEL_SIZE];
    const CzChannelInfo *lift = cz_channel_info(CZ_CHANNEL_WHEEL_LIFT);
    assert_string_equal(cz_channel_name(lift, cz_wheelset_place(2, 3), "B1", name), "z_B1_w4_mm");
    const CzChannelInfo *stroke = cz_channel_info(CZ_CHANNEL_END_STROKE);
    assert_string_equal(cz_channel_name(stroke, cz_end_place(1, 0), "A2", name),
                        "d_end_rear_A2_mm");
    const CzChannelInfo *energy = cz_channel_info(CZ_CHANNEL_STORED_ENERGY);
    assert_string_equal(cz_channel_name(energy, 0, "", name), "E_stored_kJ");
}

/* Names end with the unit of the entry. */
static void units_are_those_of_the_names(void **state) {
    (void)state;
    for (CzChannel channel = 0; channel < CZ_N_CHANNEL; channel++) {
        const CzChannelInfo *info = cz_channel_info(channel);
        const size_t n = strlen(info->pattern), n_unit = strlen(info->unit);
        assert_string_equal(info->pattern + n - n_unit, info->unit);
        assert_int_equal(info->pattern[n - n_unit - 1], '_');
        assert_true(info->doc[0] != '\0' && info->title[0] != '\0');
    }
}

static void a_mistyped_name_gets_the_nearest_one(void **state) {
    (void)state;
    char nearest[CZ_CHANNEL_SIZE];
    CzColumn column = {CZ_CHANNEL_TIME, 7};
    assert_false(cz_column_find("F_A1-A3_kN", 3, short_names, &column, nearest));
    assert_string_equal(nearest, "F_A1-A2_kN");
    assert_int_equal(column.place, 7);
    assert_false(cz_column_find("something else", 3, short_names, &column, nearest));
    assert_string_equal(nearest, "");
    assert_false(cz_column_find("F_A1-B1_kN", 3, short_names, &column, NULL)); /* not neighbours */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_place_of_every_channel_is_found_by_its_name),
        cmocka_unit_test(names_contain_the_place),
        cmocka_unit_test(units_are_those_of_the_names),
        cmocka_unit_test(a_mistyped_name_gets_the_nearest_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
