/* `profile`: lists profiles, and shows limits and scenarios of one. */
#include "base/error.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "cli/session.h"

#include <stdio.h>
#include <string.h>

static int refuse(const CzArguments *arguments, const char *what) {
    CzError error;
    cz_fail(&error, CZ_STATUS_INPUT,
            "%s" CZ_HELP "crushzone profile list, profile show NAME, or profile scenarios NAME",
            what);
    return cz_print_error(arguments, &error);
}

int cz_command_profile(const CzArguments *arguments) {
    const CzProblemOptions options = {.share_folder = cz_share_folder};
    const char *what = arguments->operand[0];
    const char *name = arguments->n_operand > 1 ? arguments->operand[1] : NULL;
    const char *category = arguments->text[CZ_OPTION_CATEGORY];
    const bool is_list = strcmp(what, "list") == 0, is_show = strcmp(what, "show") == 0;
    CzError error = {0};
    if (!is_list && !is_show && strcmp(what, "scenarios") != 0)
        return refuse(arguments, "'profile' is followed by list, show or scenarios");
    if (is_list != (name == NULL))
        return refuse(arguments, is_list ? "'profile list' takes no name"
                                         : "the name of a profile is missing");
    if (category != NULL && (is_list || is_show))
        return refuse(arguments, "--category selects among the scenarios of a profile");
    if (is_list) {
        cz_profiles_write_list(&options, stdout);
        return 0;
    }
    if (cz_profile_write(name, is_show ? CZ_PROFILE_LIMITS : CZ_PROFILE_SCENARIOS, category,
                         &options, stdout, &error) != CZ_OK)
        return cz_print_error(arguments, &error);
    return 0;
}
