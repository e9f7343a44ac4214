# Sources of src/serve, one per line.
set(CZ_SOURCES_serve
    gradient.c
    request.c
    schema.c
    server.c
)
