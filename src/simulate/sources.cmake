# Sources of src/simulate, one per line.
set(CZ_SOURCES_simulate
    balance.c
    batch.c
    budget.c
    channels.c
    elements.c
    ending.c
    filter.c
    history.c
    input_curve.c
    interface_load.c
    reference.c
    rest.c
    run.c
    summary.c
    watch.c
)
