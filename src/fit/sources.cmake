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
    read.c
    staged.c
    write_yaml.c
)
