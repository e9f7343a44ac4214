# Sources of src/fit, one per line.
set(CZ_SOURCES_fit
    branch.c
    coupler.c
    curve.c
    end.c
    fit.c
    loading.c
    match_energy.c
    plastic.c
    plateaus.c
    quality.c
    read.c
    staged.c
    stop.c
    write_yaml.c
)
