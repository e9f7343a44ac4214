# Sources of src/model, one per line.
set(CZ_SOURCES_model
    build.c
    curve_sizes.c
    facts.c
    fill.c
    fill_car.c
    fill_interface.c
    kinks.c
    lanes.c
    rail.c
    stand.c
    statics.c
    step_bounds.c
    track.c
    track_block.c
    vertical_modes.c
)
