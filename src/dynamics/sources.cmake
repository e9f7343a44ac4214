# Sources of src/dynamics, one per line.
set(CZ_SOURCES_dynamics
)
