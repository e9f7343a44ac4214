/* Weak points of a challenge as further scenarios of its problem. */
#include "report/challenge_files.h"

#include "optimise/challenge.h"
#include "report/challenge_table.h"
#include "report/options.h"
#include "report/overlay.h"
#include "report/sample_replay.h"

#include <string.h>

/* Whether a weak point is a counter-example that a file can have. */
static bool is_written(const CzWeakPoint *weak) {
    return weak->verdict == CZ_VERDICT_FAIL && weak->state != CZ_SAMPLE_INVALID;
}

bool cz_challenge_has_files(const CzReport *report) {
    const CzChallenge *challenge = report->challenge;
    bool any = false;
    for (int i = 0; i < challenge->n_weak; i++)
        any |= is_written(&challenge->weak[i]);
    return any && cz_report_options_of(report)->text == NULL;
}

static void write_reason(const CzChallenge *challenge, int weak, FILE *stream) {
    char text[CZ_CHALLENGE_SENTENCE];
    cz_challenge_weak_sentence(challenge, weak, text);
    char name[CZ_NAME_SIZE];
    cz_weak_point_name(challenge, weak, name);
    fprintf(stream, "#   %s: %s\n", name, text);
}

void cz_challenge_write_file(const CzReport *report, bool all, const char *folder, FILE *stream) {
    const CzChallenge *challenge = report->challenge;
    int end = 0;
    while (!is_written(&challenge->weak[end]))
        end++;
    const int first = end;
    end = all ? challenge->n_weak : first + 1;
    fprintf(stream, "# Found by %d runs of crushzone challenge, seed %ld:\n", challenge->n_point,
            challenge->seed);
    for (int i = first; i < end; i++)
        if (is_written(&challenge->weak[i]))
            write_reason(challenge, i, stream);
    cz_overlay_write_base(report, challenge->problem, folder, "", stream);
    cz_replay_begin_scenarios(challenge->problem, stream);
    for (int i = first; i < end; i++) {
        const CzWeakPoint *weak = &challenge->weak[i];
        char name[CZ_NAME_SIZE];
        if (!is_written(weak))
            continue;
        cz_weak_point_name(challenge, i, name);
        cz_replay_write_scenario(challenge->problem, weak->scenario, name, challenge->n_draw,
                                 challenge->draw,
                                 challenge->value + (long)weak->point * challenge->n_draw, stream);
    }
}
