# Sources of src/evaluate, one per line.
set(CZ_SOURCES_evaluate
)
