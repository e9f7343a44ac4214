# Sources of src/dynamics, one per line. kernel.c is compiled once per instruction set.
set(CZ_SOURCES_dynamics
    dynamics.c
    equilibrium.c
    equipment.c
    face_moment.c
    lay_track.c
    receptance.c
    slow_closing.c
    stored.c
    track.c
    track_elements.c
)
