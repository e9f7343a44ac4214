/* The only file that includes libyaml: converts its events to nodes.
 *
 * Reading stops at the first syntax error, because the rest would be guesswork; all rejected
 * features and duplicate keys are reported, and reading continues after them.
 */
#include "text/yaml.h"
#include "base/index.h"
#include "base/number.h"
#include "base/text.h"
#include "text/source.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <yaml.h>

enum { DEEPEST = 32, MAX_NODES = 250000, MAX_ENTRIES = 20000, MAX_KEYS = 2000 };

#define USE_A_PART CZ_HELP "name a part under 'parts:' and take it with 'use:'"

typedef struct {
    CzMistakes *mistakes;
    const CzSource *source;
    yaml_parser_t parser;
    yaml_event_t event; /* present event */
    int n_node;
    bool failed;
} Document;

static int line_of(yaml_mark_t mark) {
    return (int)mark.line + 1;
}

static int column_of(yaml_mark_t mark) {
    return (int)mark.column + 1;
}

static void fail_without_memory(Document *document) {
    document->mistakes->arena->out_of_memory = true;
    document->failed = true;
}

/* Most frequent causes of messages of libyaml. */
static const struct {
    const char *problem, *help;
} hints[] = {
    {"found a tab character", "indent by spaces instead of tabs"},
    {"cannot start any token",
     "indent by spaces instead of tabs; texts that begin with @, ` or % need quotes"},
    {"mapping values are not allowed",
     "is a line indented too far, a ':' without quotes, or the line before without one?"},
    {"did not find expected ','", "is a bracket open, or does a text between brackets contain a "
                                  "bracket and need quotes, such as 'stages[0].force_kN'?"},
    {"did not find expected key",
     "keys of one mapping begin in the same column, and every quotation mark needs a closing one"},
};

/* Reports why libyaml cannot read the text. */
static void report_syntax(Document *document) {
    const yaml_parser_t *parser = &document->parser;
    document->failed = true;
    if (parser->error == YAML_MEMORY_ERROR) {
        document->mistakes->arena->out_of_memory = true;
        return;
    }
    const char *problem = parser->problem != NULL ? parser->problem : "unreadable";
    char began[80] = "", help[160] = "";
    if (parser->context != NULL)
        snprintf(began, sizeof began, ", which began at line %d", line_of(parser->context_mark));
    if (strstr(problem, "could not find expected ':'") != NULL)
        snprintf(help, sizeof help, "line %d has no colon, or no space after it",
                 line_of(parser->context_mark));
    for (size_t i = 0; i < sizeof hints / sizeof *hints && help[0] == '\0'; i++)
        if (strstr(problem, hints[i].problem) != NULL)
            snprintf(help, sizeof help, "%s", hints[i].help);
    cz_mistake_at(document->mistakes, document->source, line_of(parser->problem_mark),
                  column_of(parser->problem_mark), "this is not YAML: %s%s%s%s" CZ_HELP "%s",
                  problem, parser->context != NULL ? " " : "",
                  parser->context != NULL ? parser->context : "", began, help);
}

/* Reads the next event; false on failure. */
static bool next_event(Document *document) {
    if (document->failed)
        return false;
    yaml_event_delete(&document->event);
    if (yaml_parser_parse(&document->parser, &document->event))
        return true;
    memset(&document->event, 0, sizeof document->event);
    report_syntax(document);
    return false;
}

/* Reports a mistake at the beginning of the present event. */
__attribute__((format(printf, 2, 3))) static void refuse(Document *document, const char *format,
                                                         ...) {
    const CzNode place = {.source = document->source,
                          .line = line_of(document->event.start_mark),
                          .column = column_of(document->event.start_mark)};
    va_list arguments;
    va_start(arguments, format);
    cz_mistake_list(document->mistakes, &place, NULL, format, arguments);
    va_end(arguments);
}

static void refuse_decorations(Document *document, const yaml_char_t *anchor,
                               const yaml_char_t *tag) {
    if (anchor != NULL)
        refuse(document, "anchors ('&') are not supported" USE_A_PART);
    if (tag != NULL)
        refuse(document, "tags ('!') are not supported");
}

static CzNode *node_create(Document *document, CzNodeKind kind) {
    if (++document->n_node > MAX_NODES) {
        if (!document->failed)
            refuse(document, "the file has more than %d values", (int)MAX_NODES);
        document->failed = true;
        return NULL;
    }
    CzNode *node = cz_arena_allocate(document->mistakes->arena, 1, sizeof *node);
    if (node == NULL) {
        fail_without_memory(document);
        return NULL;
    }
    node->kind = kind;
    node->source = document->source;
    node->line = line_of(document->event.start_mark);
    node->column = column_of(document->event.start_mark);
    return node;
}

static CzNode *read_text(Document *document) {
    refuse_decorations(document, document->event.data.scalar.anchor,
                       document->event.data.scalar.tag);
    CzNode *node = node_create(document, CZ_NODE_TEXT);
    if (node == NULL)
        return NULL;
    node->quoted = document->event.data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    size_t n_byte = document->event.data.scalar.length;
    char *text = cz_arena_copy_text(document->mistakes->arena,
                                    (const char *)document->event.data.scalar.value, n_byte);
    node->text = text;
    if (text == NULL) {
        fail_without_memory(document);
        return node;
    }
    char what[CZ_FAULT_SIZE];
    size_t at;
    n_byte = cz_text_one_line(text, n_byte); /* blocks of text have several lines */
    if (cz_text_fault(text, n_byte, false, &at, what)) {
        refuse(document, "a text cannot contain %s", what);
        node->text = "";
        node->is_refused = true;
    }
    return node;
}

/* Returns a node in place of an alias, which is rejected, so that reading can continue. */
static CzNode *read_alias(Document *document) {
    refuse(document, "aliases ('*') are not supported" USE_A_PART);
    CzNode *node = node_create(document, CZ_NODE_TEXT);
    if (node != NULL) {
        node->text = "";
        node->is_refused = true;
    }
    return node;
}

/* Appends an entry to a list or mapping. */
static bool push(Document *document, CzNode *node, CzEntry entry) {
    CzEntry *all =
        cz_arena_grow(document->mistakes->arena, node->entry, node->n_entry, sizeof *all);
    if (all == NULL) {
        fail_without_memory(document);
        return false;
    }
    all[node->n_entry++] = entry;
    node->entry = all;
    return true;
}

static CzNode *read_node(Document *document, int depth);

static CzNode *read_list(Document *document, int depth) {
    refuse_decorations(document, document->event.data.sequence_start.anchor,
                       document->event.data.sequence_start.tag);
    CzNode *list = node_create(document, CZ_NODE_LIST);
    while (list != NULL && next_event(document) &&
           document->event.type != YAML_SEQUENCE_END_EVENT) {
        CzNode *item = read_node(document, depth + 1);
        if (item == NULL || !push(document, list, (CzEntry){.value = item}))
            return NULL;
        if (list->n_entry > MAX_ENTRIES) {
            cz_mistake(document->mistakes, item, NULL, "a list has more than %d items",
                       (int)MAX_ENTRIES);
            document->failed = true;
        }
    }
    return document->failed ? NULL : list;
}

/* The mapping being read: the line of every key so far, the last entry. */
typedef struct {
    CzIndex lines;
    CzNode *last_key, *last_value; /* NULL at the first key */
} Mapping;

/* Whether a key is the text after a decimal comma, since {mass_t: 36,8} has two keys; the value
 * before it is then rejected. */
static bool is_behind_comma(Document *document, Mapping *mapping, const CzNode *key) {
    double number;
    char whole[80];
    CzNode *value = mapping->last_value;
    if (value == NULL || value->kind != CZ_NODE_TEXT || value->quoted || key->quoted ||
        key->line != value->line || key->column != value->column + (int)strlen(value->text) + 1 ||
        key->text[0] < '0' || key->text[0] > '9' || cz_number_parse(value->text, &number) != NULL)
        return false;
    snprintf(whole, sizeof whole, "%.30s,%.30s", value->text, key->text);
    cz_mistake(document->mistakes, value, NULL, "%s: '%s' %s", mapping->last_key->text, whole,
               cz_number_parse(whole, &number));
    value->is_refused = true;
    return true;
}

/* Reads a key; *is_kept is false when it is rejected and its value must be skipped. */
static CzNode *read_key(Document *document, Mapping *mapping, int depth, bool *is_kept) {
    CzIndex *lines = &mapping->lines;
    *is_kept = false;
    if (document->event.type != YAML_SCALAR_EVENT) {
        refuse(document, "a key must be a text");
        return read_node(document, depth + 1);
    }
    CzNode *key = read_text(document);
    if (key == NULL || document->failed)
        return NULL;
    const size_t n = strlen(key->text);
    const int first = cz_index_find(lines, key->text, n);
    if (is_behind_comma(document, mapping, key)) {
        /* reported */
    } else if (strcmp(key->text, "<<") == 0) {
        cz_mistake(document->mistakes, key, NULL, "merge keys ('<<') are not supported" USE_A_PART);
    } else if (first >= 0) {
        cz_mistake(document->mistakes, key, NULL, "key '%s' is given twice, first at line %d",
                   key->text, first);
    } else if (cz_index_add(lines, key->text, n, key->line)) {
        *is_kept = true;
    } else {
        fail_without_memory(document);
    }
    return key;
}

static CzNode *read_mapping(Document *document, int depth) {
    refuse_decorations(document, document->event.data.mapping_start.anchor,
                       document->event.data.mapping_start.tag);
    CzNode *mapping = node_create(document, CZ_NODE_MAPPING);
    Mapping at_hand = {.lines = {.arena = document->mistakes->arena}};
    int n_key = 0;
    while (mapping != NULL && next_event(document) &&
           document->event.type != YAML_MAPPING_END_EVENT) {
        bool is_kept = false;
        CzNode *key = read_key(document, &at_hand, depth, &is_kept);
        if (key == NULL || !next_event(document))
            return NULL;
        CzNode *value = read_node(document, depth + 1);
        if (value == NULL)
            return NULL;
        if (is_kept && !push(document, mapping, (CzEntry){.key = key, .value = value}))
            return NULL;
        at_hand.last_key = key;
        at_hand.last_value = value;
        if (++n_key > MAX_KEYS) {
            cz_mistake(document->mistakes, key, NULL, "a mapping has more than %d keys",
                       (int)MAX_KEYS);
            document->failed = true;
        }
    }
    return document->failed ? NULL : mapping;
}

/* Reads the node that begins with the present event. NULL on failure. */
static CzNode *read_node(Document *document, int depth) {
    if (depth > DEEPEST) {
        refuse(document, "records and lists are nested more than %d deep", (int)DEEPEST);
        document->failed = true;
        return NULL;
    }
    switch (document->event.type) {
    case YAML_SCALAR_EVENT:
        return read_text(document);
    case YAML_SEQUENCE_START_EVENT:
        return read_list(document, depth);
    case YAML_MAPPING_START_EVENT:
        return read_mapping(document, depth);
    default:
        return read_alias(document);
    }
}

static const CzNode *read_top(Document *document) {
    if (!next_event(document) || !next_event(document)) /* start of stream, start of document */
        return NULL;
    if (document->event.type == YAML_STREAM_END_EVENT) {
        cz_mistake_at(document->mistakes, document->source, 1, 1,
                      "the file contains only comments");
        return NULL;
    }
    if (!next_event(document))
        return NULL;
    CzNode *top = read_node(document, 0);
    if (top == NULL || !next_event(document) || !next_event(document)) /* ends of both */
        return NULL;
    if (document->event.type != YAML_STREAM_END_EVENT) {
        refuse(document, "a second document begins here; a file contains one");
        return NULL;
    }
    if (top->kind != CZ_NODE_MAPPING) {
        cz_mistake(document->mistakes, top, NULL, "a file is a mapping of keys, but this is %s",
                   cz_node_what(top));
        return NULL;
    }
    return top;
}

const CzNode *cz_yaml_document(CzMistakes *mistakes, const CzSource *source, const char *text,
                               size_t n_byte) {
    Document document = {.mistakes = mistakes, .source = source};
    if (!yaml_parser_initialize(&document.parser)) {
        mistakes->arena->out_of_memory = true;
        return NULL;
    }
    yaml_parser_set_encoding(&document.parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&document.parser, (const unsigned char *)text, n_byte);
    const CzNode *top = read_top(&document);
    yaml_event_delete(&document.event);
    yaml_parser_delete(&document.parser);
    return top;
}
