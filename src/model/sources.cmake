# Sources of src/model, one per line.
set(CZ_SOURCES_model
)
