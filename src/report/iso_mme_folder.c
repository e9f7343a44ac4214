/* The test folder of a run in ISO-MME: its files in a result folder. */
#include "report/iso_mme_folder.h"

#include "report/iso_mme.h"
#include "report/page.h"

/* Files of the folder; a channel is its number from 0. */
enum { TEST = -2, INDEX = -1 };

static CzStatus write_file(CzFolder *folder, const CzIsoMme *mme, const char *before, int which,
                           CzError *error) {
    char name[3 * CZ_NAME_SIZE];
    FILE *stream = NULL;
    if (which == TEST)
        snprintf(name, sizeof name, "%siso-mme/%s.mme", before, mme->test);
    else if (which == INDEX)
        snprintf(name, sizeof name, "%siso-mme/Channel/%s.chn", before, mme->test);
    else
        snprintf(name, sizeof name, "%siso-mme/Channel/%s.%03d", before, mme->test, which + 1);
    const CzStatus status = cz_folder_open(folder, name, &stream, error);
    if (status != CZ_OK)
        return status;
    if (which == TEST)
        cz_iso_mme_write_test(mme, stream);
    else if (which == INDEX)
        cz_iso_mme_write_index(mme, stream);
    else
        cz_iso_mme_write_channel(mme, which, stream);
    return cz_folder_close(folder, error);
}

CzStatus cz_iso_mme_write_folder(CzFolder *folder, const CzReport *report, int scenario,
                                 const char *before, CzError *error) {
    CzArena arena = {0};
    CzScene *scene;
    int n_scene;
    char test[CZ_NAME_SIZE];
    CzStatus status = cz_scenes_build(report->problem, &arena, &n_scene, &scene, error);
    if (status == CZ_OK) {
        const CzIsoMme mme = {.problem = report->problem,
                              .run = report->evaluation->run[scenario],
                              .scene = &scene[scenario],
                              .test = test};
        cz_page_folder_name(scene[scenario].name, test);
        for (int i = TEST; i < cz_iso_mme_n_channel(&mme) && status == CZ_OK; i++)
            status = write_file(folder, &mme, before, i, error);
    }
    cz_arena_free(&arena);
    return status;
}
