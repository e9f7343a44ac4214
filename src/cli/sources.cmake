# Sources of src/cli, one per line.
set(CZ_SOURCES_cli
)
