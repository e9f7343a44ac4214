# Sources of src/laws, one per line.
set(CZ_SOURCES_laws
)
