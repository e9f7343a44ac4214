# Sources of src/dynamics, one per line. kernel.c is compiled once per instruction set.
set(CZ_SOURCES_dynamics
    dynamics.c
    equilibrium.c
    lay_track.c
    stored.c
    track.c
    track_elements.c
)
