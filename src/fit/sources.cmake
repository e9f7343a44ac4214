# Sources of src/fit, one per line.
set(CZ_SOURCES_fit
    branch.c
    coupler.c
    curve.c
    end.c
    fit.c
    loading.c
    plastic.c
    plateaus.c
    quality.c
    read.c
    settle.c
    staged.c
    stop.c
    write_yaml.c
)
