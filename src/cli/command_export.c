/* `export`: result folders as a database. */
#include "cli/command.h"
#include "cli/messages.h"
#include "crushzone/report.h"

int cz_command_export(const CzArguments *arguments) {
    const char *path = arguments->text[CZ_OPTION_SQLITE];
    CzError error = {0};
    if (path == NULL)
        return cz_print_error(arguments, &(CzError){.status = CZ_STATUS_INPUT,
                                                    .message = "the file is missing: give --sqlite "
                                                               "FILE.db"});
    const CzStatus status =
        cz_report_export(arguments->n_operand, arguments->operand, path, &error);
    if (status != CZ_OK)
        return cz_print_error(arguments, &error);
    cz_print_note(arguments, "wrote %s", path);
    return 0;
}
