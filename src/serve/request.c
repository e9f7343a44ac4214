/* Reads requests: the one file that knows the JSON library. */
#include "serve/request.h"

#include "base/error.h"
#include "base/number.h"
#include "base/suggest.h"
#include "base/text.h"

#include <jansson.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#define IN(constant) (1U << CZ_OPERATION_##constant)
const CzRequestKeyInfo cz_request_keys[CZ_N_REQUEST_KEY] = {
#define CZ_REQUEST_KEY(constant, name, form, operations, doc)                                      \
    {name, CZ_REQUEST_##form, operations, doc},
#include "serve/requests.def"
#undef CZ_REQUEST_KEY
};

const char *const cz_operations[CZ_N_OPERATION] = {
#define CZ_OPERATION(constant, name, doc) name,
#include "serve/requests.def"
#undef CZ_OPERATION
};

enum { MAX_ENTRIES = 1000 }; /* of a list or an object in a request */

/* Largest whole number without gaps below it in a double: 2^53. */
#define LARGEST_WHOLE 9007199254740992.0

/* A request that is being read. */
typedef struct Reading {
    CzArena *arena;
    CzRequest *request;
    const char *key;
} Reading;

static const char *kind_of(const json_t *value) {
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        return "a list";
    case JSON_STRING:
        return "a text";
    case JSON_NULL:
        return "null";
    case JSON_TRUE:
    case JSON_FALSE:
        return "true or false";
    default:
        return "a number";
    }
}

static CzStatus refuse(const Reading *reading, const char *needed, const json_t *value) {
    return cz_fail(&reading->request->error, CZ_STATUS_INPUT, "'%s' needs %s, but this is %s",
                   reading->key, needed, kind_of(value));
}

static CzStatus check_number(const Reading *reading, size_t n) {
    return n <= MAX_ENTRIES
               ? CZ_OK
               : cz_fail(&reading->request->error, CZ_STATUS_INPUT,
                         "'%s' has %zu entries, of at most %d", reading->key, n, MAX_ENTRIES);
}

static CzStatus no_memory(const Reading *reading) {
    return cz_no_memory(&reading->request->error, "a request");
}

/* Texts are those of one line of a file. */
static CzStatus copy_bytes(const Reading *reading, const char *bytes, const char **text) {
    char what[CZ_FAULT_SIZE];
    size_t at;
    if (cz_text_fault(bytes, strlen(bytes), false, &at, what))
        return cz_fail(&reading->request->error, CZ_STATUS_INPUT, "a text of '%s' contains %s",
                       reading->key, what);
    *text = cz_arena_copy_text(reading->arena, bytes, strlen(bytes));
    return *text != NULL ? CZ_OK : no_memory(reading);
}

static CzStatus copy_text(const Reading *reading, const json_t *value, const char **text) {
    return copy_bytes(reading, json_string_value(value), text);
}

static CzStatus read_whole(const Reading *reading, const json_t *value) {
    const double number = json_is_real(value) ? json_real_value(value) : NAN;
    if (!(fabs(number) <= LARGEST_WHOLE) || number != round(number))
        return refuse(reading, "a whole number of at most 2^53", value);
    reading->request->has_id = true;
    reading->request->id = (long)number;
    return CZ_OK;
}

static CzStatus read_texts(const Reading *reading, const json_t *value, CzTextList *list) {
    if (!json_is_array(value))
        return refuse(reading, "a list of texts", value);
    CZ_TRY(check_number(reading, json_array_size(value)));
    list->text = cz_arena_allocate(reading->arena, json_array_size(value) + 1, sizeof *list->text);
    if (list->text == NULL)
        return no_memory(reading);
    for (size_t i = 0; i < json_array_size(value); i++) {
        const json_t *item = json_array_get(value, i);
        if (!json_is_string(item))
            return refuse(reading, "a list of texts", item);
        CZ_TRY(copy_text(reading, item, &list->text[list->n]));
        list->n += !cz_text_is_among(list->text[list->n], list->n, list->text);
    }
    return CZ_OK;
}

/* A number, a text or a flag as the text that a file has. */
static CzStatus read_value(const Reading *reading, const json_t *value, const char **text,
                           double *number) {
    char digits[CZ_NUMBER_TEXT];
    *number = json_is_real(value) ? json_real_value(value) : NAN;
    if (json_is_string(value))
        return copy_text(reading, value, text);
    if (json_is_real(value))
        cz_number_print(digits, *number);
    *text = json_is_boolean(value) ? json_is_true(value) ? "true" : "false"
            : json_is_real(value)  ? cz_arena_copy_text(reading->arena, digits, strlen(digits))
                                   : NULL;
    if (*text != NULL)
        return CZ_OK;
    return json_is_real(value) ? no_memory(reading) : refuse(reading, "numbers or texts", value);
}

static CzStatus read_values(const Reading *reading, json_t *value, CzNamedValues *values) {
    if (!json_is_object(value))
        return refuse(reading, "an object of values by name", value);
    const size_t n = json_object_size(value);
    CZ_TRY(check_number(reading, n));
    values->name = cz_arena_allocate(reading->arena, n + 1, sizeof *values->name);
    values->text = cz_arena_allocate(reading->arena, n + 1, sizeof *values->text);
    values->number = cz_arena_numbers(reading->arena, n + 1);
    if (values->name == NULL || values->text == NULL || values->number == NULL)
        return no_memory(reading);
    const char *name;
    json_t *item;
    json_object_foreach(value, name, item) {
        CZ_TRY(copy_bytes(reading, name, &values->name[values->n]));
        CZ_TRY(read_value(reading, item, &values->text[values->n], &values->number[values->n]));
        values->n++;
    }
    return CZ_OK;
}

static CzStatus read_operation(const Reading *reading, const json_t *value) {
    CzSuggestion nearest = {0};
    if (!json_is_string(value))
        return refuse(reading, "a text", value);
    const int operation =
        CZ_FIND_TEXT(json_string_value(value), cz_operations, CZ_N_OPERATION, &nearest);
    reading->request->operation = (CzOperation)(operation >= 0 ? operation : 0);
    if (operation >= 0)
        return CZ_OK;
    cz_fail(&reading->request->error, CZ_STATUS_INPUT, "there is no operation '%.60s'",
            json_string_value(value));
    cz_suggest_help(&nearest, &reading->request->error);
    return CZ_STATUS_INPUT;
}

static CzStatus read_step(const Reading *reading, const json_t *value) {
    reading->request->step = json_is_real(value) ? json_real_value(value) : NAN;
    return reading->request->step > 0 && reading->request->step <= 0.5
               ? CZ_OK
               : refuse(reading, "a number above 0, up to 0.5", value);
}

static CzStatus read_key(const Reading *reading, CzRequestKey key, json_t *value) {
    CzRequest *request = reading->request;
    switch (key) {
    case CZ_REQUEST_OP:
        return CZ_OK; /* read before the others */
    case CZ_REQUEST_ID:
        return read_whole(reading, value);
    case CZ_REQUEST_SET:
        return read_values(reading, value, &request->set);
    case CZ_REQUEST_VARIABLES:
        return read_values(reading, value, &request->variables);
    case CZ_REQUEST_SCENARIOS:
        return read_texts(reading, value, &request->scenarios);
    case CZ_REQUEST_WANT:
        return read_texts(reading, value, &request->want);
    case CZ_REQUEST_STEP:
        return read_step(reading, value);
    case CZ_N_REQUEST_KEY:
        break;
    }
    return CZ_OK;
}

static CzStatus read_entry(Reading *reading, const char *name, json_t *value) {
    CzSuggestion nearest = {0};
    const int key =
        CZ_FIND_NAMED(name, CzRequestKeyInfo, cz_request_keys, CZ_N_REQUEST_KEY, &nearest);
    CzError *error = &reading->request->error;
    reading->key = name;
    if (key < 0) {
        cz_fail(error, CZ_STATUS_INPUT, "a request has no key '%.60s'", name);
        cz_suggest_help(&nearest, error);
        return CZ_STATUS_INPUT;
    }
    if ((cz_request_keys[key].operations & 1U << reading->request->operation) == 0)
        return cz_fail(error, CZ_STATUS_INPUT, "'%s' does not belong to the operation '%s'", name,
                       cz_operations[reading->request->operation]);
    return read_key(reading, (CzRequestKey)key, value);
}

/* Reads one request; the id first, so that the answer to a wrong request has it. */
static void read_request(json_t *value, CzArena *arena, CzRequest *request) {
    static const CzRequestKey early[] = {CZ_REQUEST_ID, CZ_REQUEST_OP};
    Reading reading = {.arena = arena, .request = request, .key = "request"};
    *request = (CzRequest){.step = NAN};
    if (!json_is_object(value)) {
        refuse(&reading, "an object", value);
        return;
    }
    for (size_t i = 0; i < sizeof early / sizeof *early; i++) {
        reading.key = cz_request_keys[early[i]].name;
        const json_t *first = json_object_get(value, reading.key);
        const bool is_id = early[i] == CZ_REQUEST_ID;
        if (first != NULL &&
            (is_id ? read_whole(&reading, first) : read_operation(&reading, first)) != CZ_OK)
            return;
    }
    const char *name;
    json_t *item;
    json_object_foreach(value, name, item) {
        if (read_entry(&reading, name, item) != CZ_OK)
            return;
    }
}

static CzStatus read_all(json_t *root, CzArena *arena, CzRequests *requests, CzError *error) {
    requests->is_batch = json_is_array(root);
    requests->n = requests->is_batch ? (int)json_array_size(root) : 1;
    requests->request =
        cz_arena_allocate(arena, (size_t)requests->n + 1, sizeof *requests->request);
    if (requests->request == NULL)
        return cz_no_memory(error, "the requests");
    for (int i = 0; i < requests->n; i++)
        read_request(requests->is_batch ? json_array_get(root, (size_t)i) : root, arena,
                     &requests->request[i]);
    return CZ_OK;
}

CzStatus cz_requests_read(const char *line, size_t n_byte, CzArena *arena, CzRequests *requests,
                          CzError *error) {
    json_error_t mistake = {.column = -1};
    *requests = (CzRequests){0};
    if (n_byte > INT_MAX)
        return cz_fail(error, CZ_STATUS_INPUT, "the line is too long");
    json_t *root = json_loadb(
        line, n_byte, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL | JSON_DECODE_ANY, &mistake);
    if (root == NULL && json_error_code(&mistake) == json_error_out_of_memory)
        return cz_no_memory(error, "a request");
    if (root == NULL) {
        cz_fail(error, CZ_STATUS_INPUT, "the line is not JSON: %s" CZ_HELP "%s", mistake.text,
                "a request is one JSON object, or a list of them, on one line");
        if (error != NULL && mistake.column > 0)
            error->column = mistake.column;
        return CZ_STATUS_INPUT;
    }
    const CzStatus status = read_all(root, arena, requests, error);
    json_decref(root);
    return status;
}
