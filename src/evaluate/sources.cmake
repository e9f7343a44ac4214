# Sources of src/evaluate, one per line.
set(CZ_SOURCES_evaluate
    checklist.c
    checks.c
    compose.c
    design.c
    devices.c
    evaluator.c
    metric.c
    place.c
    runs.c
    scene.c
    sweep.c
    sweep_axis.c
    tasks.c
)
