# Sources of src/cli, one per line.
set(CZ_SOURCES_cli
    ../base/suggest.c
    arguments.c
    command_explain.c
    command_fit.c
    command_new.c
    command_optimise.c
    command_problem.c
    command_run.c
    command_sweep.c
    help.c
    interrupt.c
    main.c
    messages.c
    progress.c
    session.c
)
