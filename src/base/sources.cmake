# Sources of src/base, one per line.
set(CZ_SOURCES_base
    arena.c
    bytes.c
    error.c
    increment.c
    index.c
    least_squares.c
    memory_text.c
    number.c
    roots.c
    stream.c
    suggest.c
    symmetric.c
    text.c
)
