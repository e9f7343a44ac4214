# Sources of src/simulate, one per line.
set(CZ_SOURCES_simulate
)
