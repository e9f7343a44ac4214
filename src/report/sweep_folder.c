/* The result folder of a sweep. */
#include "crushzone/report.h"

#include "report/csv.h"
#include "report/folder.h"
#include "report/page_sweep.h"

static CzStatus write_files(CzFolder *folder, const CzSweep *sweep, const CzReportOptions *options,
                            CzError *error) {
    FILE *stream = NULL;
    CzStatus status = cz_folder_open(folder, "sweep.json", &stream, error);
    if (status == CZ_OK)
        status = cz_report_write_sweep(sweep, options, stream, error);
    if (status == CZ_OK)
        status = cz_folder_close(folder, error);
    if (status == CZ_OK)
        status = cz_folder_open(folder, "sweep.csv", &stream, error);
    if (status != CZ_OK)
        return status;
    cz_csv_write_sweep(sweep, options, stream);
    status = cz_folder_close(folder, error); /* a full disk shows here */
    if (status == CZ_OK)
        status = cz_folder_open(folder, "report.html", &stream, error);
    if (status == CZ_OK)
        status = cz_page_write_sweep(sweep, stream, error);
    return status == CZ_OK ? cz_folder_close(folder, error) : status;
}

CzStatus cz_report_write_sweep_folder(const CzSweep *sweep, const CzReportOptions *options,
                                      const char *path, CzError *error) {
    const CzReportOptions absent = cz_report_options_default();
    CzFolder folder;
    options = options != NULL ? options : &absent;
    CzStatus status = cz_folder_begin(&folder, path, options->replaces_search, error);
    if (status != CZ_OK)
        return status;
    status = write_files(&folder, sweep, options, error);
    if (status == CZ_OK)
        return cz_folder_finish(&folder, error);
    cz_folder_abandon(&folder);
    return status;
}
