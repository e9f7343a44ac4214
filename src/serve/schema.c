/* The JSON schema of a request. */
#include "crushzone/serve.h"
#include "serve/request.h"

static void write_shape(CzRequestForm form, FILE *stream) {
    static const char *const shapes[] = {
        [CZ_REQUEST_TEXT] = "\"type\": \"string\"",
        [CZ_REQUEST_WHOLE] = "\"type\": \"integer\"",
        [CZ_REQUEST_NUMBER] = "\"type\": \"number\"",
        [CZ_REQUEST_TEXTS] = "\"type\": \"array\", \"items\": {\"type\": \"string\"}",
        [CZ_REQUEST_VALUES] = ("\"type\": \"object\", \"additionalProperties\": "
                               "{\"type\": [\"number\", \"string\", \"boolean\"]}")};
    fputs(shapes[form], stream);
}

void cz_server_write_request_schema(FILE *stream) {
    fputs("{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
          "  \"title\": \"crushzone.request\",\n  \"$ref\": \"#/$defs/REQUEST\",\n"
          "  \"$defs\": {\n    \"REQUEST\": {\n"
          "      \"description\": \"a request to the command serve, one line\",\n"
          "      \"type\": \"object\",\n      \"properties\": {",
          stream);
    for (int i = 0; i < CZ_N_REQUEST_KEY; i++) {
        const CzRequestKeyInfo *key = &cz_request_keys[i];
        fprintf(stream, "%s\n        \"%s\": {", i > 0 ? "," : "", key->name);
        write_shape(key->form, stream);
        fprintf(stream, ", \"description\": \"%s\"}", key->doc);
    }
    fputs("\n      },\n      \"required\": [],\n      \"additionalProperties\": false\n    }\n"
          "  }\n}\n",
          stream);
}
