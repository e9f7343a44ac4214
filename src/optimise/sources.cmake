# Sources of src/optimise, one per line.
set(CZ_SOURCES_optimise
    alternatives.c
    gauss_newton.c
    combinations.c
    nlopt_adapter.c
    optimise.c
    outcome.c
    pareto.c
    replay.c
    sample.c
    search.c
    sensitivity.c
    snap.c
    strategy.c
    subspace.c
    surface.c
)
