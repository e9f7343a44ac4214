# Sources of src/integrate, one per line.
set(CZ_SOURCES_integrate
    sundials_adapter.c
)
