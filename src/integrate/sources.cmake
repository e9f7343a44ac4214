# Sources of src/integrate, one per line: headers only so far.
set(CZ_SOURCES_integrate
)
