# Sources of src/optimise, one per line.
set(CZ_SOURCES_optimise
)
