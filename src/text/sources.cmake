# Sources of src/text, one per line.
set(CZ_SOURCES_text
    curve_columns.c
    curve_dyna.c
    curve_fields.c
    curve_file.c
    curve_mme.c
    curve_number.c
    curve_title.c
    mistakes.c
    node.c
    range.c
    source.c
    units.c
    value.c
    yaml.c
)
