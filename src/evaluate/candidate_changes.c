/* Candidate changes: the records with a value, and its change. */
#include "evaluate/candidate_changes.h"

#include <math.h>
#include <stddef.h>

#include "problem/keys.h"

typedef enum CandidatePlace {
    FACE,
    FACE_STAGES,
    TUBE_STAGES,
    HINGE,
    COUPLER,
    END,
    LINK,
    BODY,
    PRIMARY,
    SECONDARY
} CandidatePlace;

typedef struct CandidateKind {
    CzCause cause;
    CandidatePlace place;
    CzRecordId record;
    const char *key;
    double reference; /* in the key's unit */
    const char *name;
} CandidateKind;

#define CZ_CANDIDATE(cause, place, record, key, reference, name)                                   \
    {CZ_CAUSE_##cause, place, CZ_RECORD_##record, key, reference, name},
static const CandidateKind kinds[] = {
#include "evaluate/candidate_changes.def"
};
#undef CZ_CANDIDATE

enum { MAX_RECORDS = 4 * CZ_MAX_STAGES }; /* of one kind in a vehicle */

/* Records of one kind in a vehicle. */
typedef struct Records {
    int n;
    void *record[MAX_RECORDS];
} Records;

static void add(Records *records, void *record, bool given) {
    if (given)
        records->record[records->n++] = record;
}

static void add_stages(Records *records, CzStage *stage, int n) {
    for (int i = 0; i < n; i++)
        add(records, &stage[i], true);
}

static void add_of_end(Records *records, CandidatePlace place, CzEnd *end) {
    CzCoupler *coupler = &end->coupler;
    if (!end->given)
        return;
    if (place == FACE)
        add(records, &end->anti_climber, end->anti_climber.given);
    if (place == FACE_STAGES && end->anti_climber.given)
        add_stages(records, end->anti_climber.stages, end->anti_climber.n_stages);
    if (place == END)
        add(records, end, true);
    if (!coupler->given)
        return;
    if (place == TUBE_STAGES && coupler->tube.given)
        add_stages(records, coupler->tube.stages, coupler->tube.n_stages);
    if (place == TUBE_STAGES && coupler->second_tube.given)
        add_stages(records, coupler->second_tube.stages, coupler->second_tube.n_stages);
    if (place == HINGE)
        add(records, &coupler->hinge, coupler->hinge.given);
    if (place == COUPLER)
        add(records, coupler, true);
}

/* The records of one kind in a vehicle; none unless it is full, since only full vehicles can
 * climb. */
static Records records_of(CandidatePlace place, CzVehicle *vehicle) {
    Records records = {0};
    if (vehicle->model != CZ_MODEL_FULL)
        return records;
    add_of_end(&records, place, &vehicle->rear);
    add_of_end(&records, place, &vehicle->front);
    if (place == LINK)
        add(&records, &vehicle->bogie.link, vehicle->bogie.given);
    if (place == PRIMARY)
        add(&records, &vehicle->bogie.primary, vehicle->bogie.given);
    if (place == SECONDARY)
        add(&records, &vehicle->bogie.secondary, vehicle->bogie.given);
    if (place == BODY)
        add(&records, vehicle, true);
    return records;
}

static double *field_of(void *record, const CzKey *key) {
    return (double *)(void *)((char *)record + key->offset);
}

int cz_n_candidate_kind(void) {
    return (int)(sizeof kinds / sizeof kinds[0]);
}

bool cz_candidate_find(int kind, const CzVehicle *vehicles, int n_vehicle,
                       CzCandidateChange *candidate) {
    const CandidateKind *found = &kinds[kind];
    const CzUnit *unit = NULL;
    const CzKey *key = cz_record_match(&cz_records[found->record], found->key, &unit);
    for (int v = 0; v < n_vehicle; v++) {
        CzVehicle vehicle = vehicles[v]; /* a copy, because the places returned are writable */
        const Records records = records_of(found->place, &vehicle);
        for (int i = 0; i < records.n; i++) {
            const double value = *field_of(records.record[i], key);
            if (isnan(value))
                continue;
            *candidate = (CzCandidateChange){.name = found->name,
                                             .key = found->key,
                                             .cause = found->cause,
                                             .value = value / unit->si};
            return true;
        }
    }
    return false;
}

double cz_candidate_apply(int kind, double change, CzVehicle *vehicles, int n_vehicle) {
    const CandidateKind *found = &kinds[kind];
    const CzUnit *unit = NULL;
    const CzKey *key = cz_record_match(&cz_records[found->record], found->key, &unit);
    double first = NAN;
    for (int v = 0; v < n_vehicle; v++) {
        const Records records = records_of(found->place, &vehicles[v]);
        for (int i = 0; i < records.n; i++) {
            double *value = field_of(records.record[i], key);
            if (isnan(*value)) /* not declared */
                continue;
            const double size = fmax(fabs(*value), found->reference * unit->si);
            *value = fmin(fmax(*value + change * size, key->lo), key->hi);
            if (isnan(first))
                first = *value / unit->si;
        }
    }
    return first;
}
