# Sources of src/tree, one per line.
set(CZ_SOURCES_tree
    families.c
    load.c
    merge.c
    parts.c
    path.c
    record.c
    segments.c
    settings.c
    trains.c
    write_node.c
)
