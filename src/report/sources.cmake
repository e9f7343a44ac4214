# Sources of src/report, one per line.
set(CZ_SOURCES_report
)
