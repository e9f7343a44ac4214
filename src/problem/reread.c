/* Rereads a problem with further settings from its tree; only files of curves are opened. */
#include <string.h>

#include "base/error.h"
#include "problem/changes.h"

/* Makes settings of further texts; false without memory. */
static bool make_settings(CzReader *reader, int n, const char *const *path,
                          const char *const *value, CzSetting *setting) {
    const CzSource *source = cz_sources_add(&reader->sources, "(settings)", ".", "", 0);
    const CzNode place = {.source = source, .line = 1, .column = 1};
    for (int i = 0; source != NULL && i < n; i++) {
        setting[i].place = cz_node_text(&reader->arena, path[i], &place);
        setting[i].put.value = cz_node_text(&reader->arena, value[i], &place);
        if (setting[i].place == NULL || setting[i].put.value == NULL)
            return false;
        setting[i].path = setting[i].place->text;
    }
    return source != NULL;
}

CzStatus cz_problem_read_again(const CzProblem *problem, int n_more, const char *const *path,
                               const char *const *value, CzProblem **again, CzError *error) {
    *again = NULL;
    CzSetting *more = NULL;
    CzProblem *made = cz_problem_create_again(problem, CZ_STEP_SETTINGS, n_more, &more);
    if (made == NULL)
        return cz_no_memory(error, "the problem with other settings");
    CzReader *reader = &made->reader;
    if (make_settings(reader, n_more, path, value, more))
        cz_problem_bind(made, &made->tree);
    const void *field = NULL;
    CzStatus status = cz_rules_check_again(made, error);
    if (status == CZ_OK)
        status = cz_changes_read(made, &field, error);
    if (status != CZ_OK) {
        cz_problem_free(made);
        return status;
    }
    cz_problem_take_files(made, problem);
    *again = made;
    return CZ_OK;
}
