/* A run as bytes: its structs as they are in memory, texts and arrays behind them. */
#include "simulate/run_bytes.h"

#include <stdlib.h>

#include "base/error.h"
#include "simulate/run.h"

/* Elements of an interface that has none are not sent. */
static void put_interface(CzMemoryText *bytes, const CzInterfaceResult *interface) {
    cz_put(bytes, interface, 1, offsetof(CzInterfaceResult, element));
    cz_put(bytes, interface->element, (size_t)interface->n_element, sizeof *interface->element);
}

static void get_interface(CzReading *reading, CzInterfaceResult *interface) {
    cz_get(reading, interface, 1, offsetof(CzInterfaceResult, element));
    if (interface->n_element < 0 || interface->n_element > CZ_MAX_ELEMENTS)
        interface->n_element = 0;
    cz_get(reading, interface->element, (size_t)interface->n_element, sizeof *interface->element);
}

static void put_pulses(CzMemoryText *bytes, const CzRunSummary *summary) {
    const int n_pulse = summary->pulse != NULL ? summary->n_vehicle : 0;
    cz_put_int(bytes, n_pulse);
    for (int i = 0; i < n_pulse; i++) {
        const CzPulse *pulse = &summary->pulse[i];
        cz_put(bytes, pulse, 1, sizeof *pulse);
        cz_put_numbers(bytes, pulse->speed, (size_t)pulse->n_sample);
        cz_put_numbers(bytes, pulse->step_speed, (size_t)pulse->n_step);
        cz_put_numbers(bytes, pulse->force, (size_t)pulse->n_step);
        cz_put(bytes, pulse->window, (size_t)pulse->n_window, sizeof *pulse->window);
    }
}

/* NULL without pulses, and without memory for them. */
static const CzPulse *get_pulses(CzReading *reading, CzArena *arena) {
    const int n_pulse = cz_get_int(reading);
    reading->has_ended |= n_pulse > 0 && (size_t)n_pulse > reading->n_left / sizeof(CzPulse);
    CzPulse *pulse = n_pulse > 0 && !reading->has_ended
                         ? cz_arena_allocate(arena, (size_t)n_pulse, sizeof *pulse)
                         : NULL;
    for (int i = 0; pulse != NULL && i < n_pulse; i++) {
        cz_get(reading, &pulse[i], 1, sizeof *pulse);
        pulse[i].speed = cz_get_items(reading, arena, pulse[i].n_sample, sizeof(double));
        pulse[i].step_speed = cz_get_items(reading, arena, pulse[i].n_step, sizeof(double));
        pulse[i].force = cz_get_items(reading, arena, pulse[i].n_step, sizeof(double));
        pulse[i].window = cz_get_items(reading, arena, pulse[i].n_window, sizeof *pulse[i].window);
    }
    return pulse;
}

void cz_run_put(CzMemoryText *bytes, const CzRun *run) {
    const CzRunSummary *summary = &run->summary;
    const CzChannels *channels = &run->channels;
    const int n_budget = summary->budget != NULL ? summary->n_vehicle : 0;
    cz_put(bytes, summary, 1, sizeof *summary);
    cz_put_text(bytes, summary->scenario);
    cz_put_text(bytes, summary->awaited);
    for (int i = 0; i < summary->n_interface; i++)
        put_interface(bytes, &summary->interface[i]);
    cz_put(bytes, summary->vehicle, (size_t)summary->n_vehicle, sizeof *summary->vehicle);
    put_pulses(bytes, summary);
    cz_put_int(bytes, n_budget);
    cz_put(bytes, summary->budget, (size_t)n_budget, sizeof *summary->budget);
    cz_put(bytes, summary->event, (size_t)summary->n_event, sizeof *summary->event);
    cz_put_int(bytes, channels->n_column);
    cz_put_int(bytes, channels->n_sample);
    cz_put(bytes, channels->column, (size_t)channels->n_column, sizeof *channels->column);
    for (int i = 0; i < channels->n_column; i++)
        cz_put_numbers(bytes, channels->value[i], (size_t)channels->n_sample);
}

static void get_summary(CzReading *reading, CzRun *run) {
    CzRunSummary *summary = &run->summary;
    CzArena *arena = &run->arena;
    cz_get(reading, summary, 1, sizeof *summary);
    summary->scenario = cz_get_text(reading, arena);
    summary->awaited = cz_get_text(reading, arena);
    const int n = summary->n_interface;
    CzInterfaceResult *interface =
        n >= 0 ? cz_arena_allocate(arena, (size_t)n + 1, sizeof *interface) : NULL;
    for (int i = 0; interface != NULL && i < n; i++)
        get_interface(reading, &interface[i]);
    summary->interface = interface;
    summary->vehicle = cz_get_items(reading, arena, summary->n_vehicle, sizeof *summary->vehicle);
    summary->pulse = get_pulses(reading, arena);
    const int n_budget = cz_get_int(reading);
    summary->budget =
        n_budget > 0 ? cz_get_items(reading, arena, n_budget, sizeof *summary->budget) : NULL;
    summary->event = cz_get_items(reading, arena, summary->n_event, sizeof *summary->event);
}

/* Rows of channels belong to the run one by one. */
static bool get_channels(CzReading *reading, CzChannels *channels) {
    const int n_column = cz_get_int(reading), n_given = cz_get_int(reading);
    const size_t n = n_column > 0 ? (size_t)n_column : 0, n_sample = (size_t)n_given;
    if (reading->has_ended || n_given < 0 || n == 0)
        return true;
    channels->column = calloc(n, sizeof *channels->column);
    channels->value = calloc(n, sizeof *channels->value);
    if (channels->column == NULL || channels->value == NULL)
        return false;
    channels->n_column = n_column;
    channels->n_sample = channels->capacity = n_given;
    cz_get(reading, channels->column, n, sizeof *channels->column);
    for (size_t i = 0; i < n; i++) {
        channels->value[i] = malloc((n_sample + 1) * sizeof(double));
        if (channels->value[i] == NULL)
            return false;
        cz_get_numbers(reading, channels->value[i], n_sample);
    }
    return true;
}

CzStatus cz_run_get(CzReading *reading, CzRun **run, CzError *error) {
    CzRun *made = *run = calloc(1, sizeof *made);
    if (made == NULL)
        return cz_no_memory(error, "a run");
    get_summary(reading, made);
    if (get_channels(reading, &made->channels) && !reading->has_ended && !made->arena.out_of_memory)
        return CZ_OK;
    cz_run_free(made);
    *run = NULL;
    return cz_no_memory(error, "a run");
}
