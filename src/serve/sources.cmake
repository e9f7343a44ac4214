# Sources of src/serve, one per line.
set(CZ_SOURCES_serve
    dakota.c
    dakota_parameters.c
    dakota_responses.c
    dakota_targets.c
    gradient.c
    request.c
    schema.c
    server.c
)
