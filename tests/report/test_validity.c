/* Documents and CSV files of a run beyond the model's validity. */
#include "support/check.h"

#include "report/csv.h"
#include "report/json_at.h"
#include "report/stand_in.h"

static char *summary_text(const StandIn *s) {
    char *text = NULL;
    size_t n = 0;
    FILE *stream = open_memstream(&text, &n);
    assert_non_null(stream);
    const CzReport report = stand_in_run(s);
    assert_int_equal(cz_report_write_json(&report, stream, NULL), CZ_OK);
    fclose(stream);
    return text;
}

/* The CSV of interfaces and channels of a stand-in. */
static char *csv_text(const StandIn *s) {
    const CzReportOptions options = cz_report_options_default();
    char *text = NULL;
    size_t n = 0;
    FILE *stream = open_memstream(&text, &n);
    assert_non_null(stream);
    cz_csv_write_interfaces(&s->run[0].summary, &options, stream);
    cz_csv_write_channels(&s->run[0], &options, stream);
    fclose(stream);
    return text;
}

static void values_after_an_override_are_marked_and_totals_blank(void **state) {
    (void)state;
    StandIn s;
    stand_in_fill(&s);
    s.run[0].summary.beyond_validity = true;
    s.run[0].summary.beyond_validity_time = 0.5e-3;
    char *text = summary_text(&s);
    json_t *json = json_loads(text, 0, NULL);
    assert_non_null(json);
    free(text);
    static const char *const totals[] = {
        "scenarios.0.energy.dissipated_kJ",
        "scenarios.0.energy.stored_kJ",
        "scenarios.0.energy.final_kinetic_kJ",
        "scenarios.0.energy.absorbers_kJ",
        "scenarios.0.energy.wheel_rail_kJ",
        "scenarios.0.energy.survival_kJ",
        "scenarios.0.interfaces.0.energy_kJ",
        "scenarios.0.interfaces.0.energy_share",
        "scenarios.0.interfaces.0.elements.0.energy_kJ",
        "scenarios.0.interfaces.0.elements.0.zone_energy_kJ.crush"};
    for (size_t i = 0; i < sizeof totals / sizeof totals[0]; i++)
        assert_null_at(json, totals[i]);
    static const char *const marked[] = {"scenarios.0.interfaces.0.beyond_validity",
                                         "scenarios.0.interfaces.0.elements.0.beyond_validity",
                                         "scenarios.0.vehicles.0.beyond_validity",
                                         "scenarios.0.events.1.beyond_validity"};
    for (size_t i = 0; i < sizeof marked / sizeof marked[0]; i++)
        assert_true(json_is_true(at(json, marked[i])));
    assert_real_at(json, "scenarios.0.interfaces.0.peak_force_kN", 3483);
    json_decref(json);

    char *written = csv_text(&s);
    assert_non_null(strstr(written, "\r\nA1-B1,,3483,372,659,,,,,,yes,yes\r\n"));
    assert_non_null(strstr(written, "\r\nA1-B1,coupler A1,1412,,,250,1.01,,,,yes,yes\r\n"));
    assert_non_null(strstr(written, "\r\n0,10,0\r\n1,9.66666667,1\r\n2,,1\r\n"));
    free(written);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_after_an_override_are_marked_and_totals_blank),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
