# Sources of src/integrate, one per line.
set(CZ_SOURCES_integrate
    two_step.c
)
