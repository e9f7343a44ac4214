# Sources of src/statistics, one per line.
set(CZ_SOURCES_statistics
    distribution.c
    elementary.c
    latin.c
    quantile.c
    random.c
    rank.c
    share.c
    sobol.c
)
