/* The test folder of a run in ISO-MME, as a part of a result folder. */
#ifndef CZ_REPORT_ISO_MME_FOLDER_H
#define CZ_REPORT_ISO_MME_FOLDER_H

#include "crushzone/report.h"
#include "report/folder.h"

/* Writes the test folder of the run of a scenario, which was kept, to iso-mme/ behind `before`, the
 * folder of the scenario with a slash, or "". Statuses: CZ_OK, CZ_STATUS_OUTPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_iso_mme_write_folder(CzFolder *folder, const CzReport *report,
                                               int scenario, const char *before, CzError *error);

#endif
