# Sources of src/optimise, one per line.
set(CZ_SOURCES_optimise
    nlopt_adapter.c
    optimise.c
    sample.c
    search.c
    snap.c
    strategy.c
    surface.c
)
