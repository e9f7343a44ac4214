# Sources of src/report, one per line.
set(CZ_SOURCES_report
    checks_table.c
    csv.c
    figure.c
    fit_document.c
    folder.c
    grid.c
    json.c
    options.c
    outcome.c
    outcome_table.c
    overlay.c
    result_folder.c
    summary.c
    sweep.c
    table.c
)
