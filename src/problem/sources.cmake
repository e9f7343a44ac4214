# Sources of src/problem, one per line.
set(CZ_SOURCES_problem
)
