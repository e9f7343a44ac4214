/* JSON document `crushzone.fit`. */
#include <stdlib.h>

#include "base/memory_text.h"
#include "base/error.h"
#include "crushzone/report.h"
#include "report/json.h"
#include "report/units.h"

static void put_summary(CzJson *json, const CzFitSummary *summary) {
    cz_json_text(json, "kind", cz_fit_kind_word(summary->kind));
    cz_json_text(json, "basis", summary->is_dynamic ? "dynamic" : "static");
    cz_json_text(json, "file", summary->file);
    cz_json_text(json, "name", summary->name);
    cz_json_whole(json, "points", summary->n_point);
    cz_json_real(json, "stroke_mm", summary->stroke * CZ_MILLI_PER_UNIT);
    cz_json_real(json, "peak_force_kN", summary->peak_force / CZ_KILO);
    cz_json_real(json, "energy_kJ", summary->energy / CZ_KILO);
    cz_json_real(json, "law_energy_kJ", summary->law_energy / CZ_KILO);
    cz_json_real(json, "energy_error", summary->law_energy / summary->energy - 1.0);
    cz_json_real(json, "returned_kJ", summary->returned / CZ_KILO);
    cz_json_real(json, "law_returned_kJ", summary->law_returned / CZ_KILO);
    cz_json_real(json, "largest_force_difference_kN", summary->largest_difference / CZ_KILO);
    cz_json_real(json, "at_stroke_mm", summary->at_stroke * CZ_MILLI_PER_UNIT);
    cz_json_real(json, "mean_square_difference_kN", summary->mean_square / CZ_KILO);
    cz_json_real(json, "mean_force_kN", summary->mean_force / CZ_KILO);
    cz_json_real(json, "law_peak_force_kN", summary->law_peak / CZ_KILO);
    cz_json_real(json, "whole_energy_kJ", summary->whole_energy / CZ_KILO);
    cz_json_real(json, "law_whole_energy_kJ", summary->law_whole_energy / CZ_KILO);
    cz_json_real(json, "stretch_difference_kN", summary->stretch_difference / CZ_KILO);
    cz_json_text(json, "verdict", cz_fit_verdict_word(summary->verdict));
}

/* The YAML text, to be freed; NULL without memory. */
static char *yaml_of(const CzFit *fit) {
    CzMemoryText memory = {0};
    FILE *stream = cz_memory_text_open(&memory);
    if (stream != NULL)
        cz_fit_write_yaml(fit, stream);
    if (stream != NULL && fclose(stream) == 0 && !memory.failed)
        return memory.text;
    cz_memory_text_free(&memory);
    return NULL;
}

CzStatus cz_report_write_fit(const CzFit *fit, FILE *stream, CzError *error) {
    const bool is_written = cz_fit_summary(fit)->verdict != CZ_FIT_REFUSED;
    char *yaml = is_written ? yaml_of(fit) : NULL;
    CzJson *json = cz_json_create();
    cz_json_text(json, "format", "crushzone.fit");
    cz_json_whole(json, "version", 1);
    put_summary(json, cz_fit_summary(fit));
    cz_json_open_object(json, "values");
    for (int i = 0; i < cz_fit_n_value(fit); i++)
        cz_json_exact(json, cz_fit_value_path(fit, i), cz_fit_value(fit, i));
    cz_json_close(json);
    cz_json_open_list(json, "doubts");
    for (int i = 0; i < cz_fit_n_doubt(fit); i++)
        cz_json_text(json, NULL, cz_fit_doubt(fit, i));
    cz_json_close(json);
    cz_json_open_list(json, "notes");
    for (int i = 0; i < cz_fit_n_note(fit); i++)
        cz_json_text(json, NULL, cz_fit_note(fit, i));
    cz_json_close(json);
    cz_json_text(json, "yaml", yaml);
    const bool has_memory = yaml != NULL || !is_written;
    free(yaml);
    const CzStatus status = cz_json_finish(json, stream, error);
    return has_memory || status != CZ_OK
               ? status
               : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a JSON document");
}
