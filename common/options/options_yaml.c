/* From a YAML document to a sequence of dotted names with their values. */
#include "common/options/options.h"

#include <string.h>
#include <yaml.h>

#define MAX_DEPTH 8
#define MAX_ITEMS 64

struct reader {
    yaml_parser_t parser;
    const char *path;
    char name[OPTION_MAX_TEXT];
    option_apply_fn *apply;
    void *user;
    char *error;
    size_t error_size;
};

static int fail(struct reader *reader, size_t line, const char *reason)
{
    snprintf(reader->error, reader->error_size, "%s:%zu: %s%s%s", reader->path, line + 1,
             reader->name, reader->name[0] ? ": " : "", reason);
    return -1;
}

static int next(struct reader *reader, yaml_event_t *event)
{
    if (yaml_parser_parse(&reader->parser, event))
        return 0;
    reader->name[0] = '\0';
    return fail(reader, reader->parser.problem_mark.line,
                reader->parser.problem ? reader->parser.problem : "not readable as YAML");
}

static int apply(struct reader *reader, size_t line, const char *const *items, int n, bool is_list)
{
    char reason[OPTION_MAX_TEXT * 2] = "";

    if (!reader->name[0])
        return fail(reader, line, "a map of options is wanted");
    if (reader->apply(reader->user, reader->name, items, n, is_list, reason, sizeof reason))
        return fail(reader, line, reason);
    return 0;
}

/* A list's scalars up to its end; the start event is already consumed. */
static int read_list(struct reader *reader, size_t line)
{
    char texts[MAX_ITEMS][OPTION_MAX_TEXT];
    const char *items[MAX_ITEMS];
    yaml_event_t event;
    int n = 0;

    for (;;) {
        if (next(reader, &event))
            return -1;
        if (event.type == YAML_SEQUENCE_END_EVENT) {
            yaml_event_delete(&event);
            return apply(reader, line, items, n, true);
        }
        if (event.type != YAML_SCALAR_EVENT || n == MAX_ITEMS ||
            event.data.scalar.length >= OPTION_MAX_TEXT) {
            size_t where = event.start_mark.line;
            yaml_event_delete(&event);
            return fail(reader, where, "a list holds plain values, at most 64");
        }
        memcpy(texts[n], event.data.scalar.value, event.data.scalar.length + 1);
        items[n] = texts[n];
        n++;
        yaml_event_delete(&event);
    }
}

/* Lengthens the dotted name by a key. Returns the old length, or -1. */
static int push_name(struct reader *reader, const yaml_event_t *key)
{
    size_t length = strlen(reader->name);
    const char *text = (const char *)key->data.scalar.value;

    if (length + strlen(text) + 2 > sizeof reader->name)
        return fail(reader, key->start_mark.line, "name is too long");
    if (length)
        strcat(reader->name, ".");
    strcat(reader->name, text);
    return (int)length;
}

/* The maps that are open, as the lengths of the names to fall back to. */
struct open_maps {
    int depth;
    int length[MAX_DEPTH + 1];
};

/* The value of the key just read: a leaf is applied, a map is opened. */
static int read_value(struct reader *reader, struct open_maps *open, int old_length)
{
    yaml_event_t event;
    int result = 0;

    if (next(reader, &event))
        return -1;
    if (event.type == YAML_MAPPING_START_EVENT) {
        if (open->depth == MAX_DEPTH)
            result = fail(reader, event.start_mark.line, "maps are nested too deeply");
        else
            open->length[++open->depth] = old_length;
        yaml_event_delete(&event);
        return result;
    }
    if (event.type == YAML_SCALAR_EVENT) {
        const char *item = (const char *)event.data.scalar.value;
        result = apply(reader, event.start_mark.line, &item, 1, false);
    } else if (event.type == YAML_SEQUENCE_START_EVENT) {
        result = read_list(reader, event.start_mark.line);
    } else {
        result = fail(reader, event.start_mark.line, "anchors and aliases are not used here");
    }
    yaml_event_delete(&event);
    reader->name[old_length] = '\0';
    return result;
}

/* The body of the outermost map: keys and values until it ends. */
static int read_map(struct reader *reader)
{
    struct open_maps open = {0};
    yaml_event_t event;

    for (;;) {
        int old_length;
        if (next(reader, &event))
            return -1;
        if (event.type == YAML_MAPPING_END_EVENT) {
            yaml_event_delete(&event);
            if (open.depth == 0)
                return 0;
            reader->name[open.length[open.depth--]] = '\0';
            continue;
        }
        if (event.type != YAML_SCALAR_EVENT) {
            size_t line = event.start_mark.line;
            yaml_event_delete(&event);
            return fail(reader, line, "a key must be a plain word");
        }
        old_length = push_name(reader, &event);
        yaml_event_delete(&event);
        if (old_length < 0 || read_value(reader, &open, old_length))
            return -1;
    }
}

static int read_document(struct reader *reader)
{
    yaml_event_t event;

    for (;;) {
        yaml_event_type_t type;
        size_t line;
        if (next(reader, &event))
            return -1;
        type = event.type;
        line = event.start_mark.line;
        /* An empty document holds one empty scalar. */
        if (type == YAML_SCALAR_EVENT && event.data.scalar.length == 0)
            type = YAML_NO_EVENT;
        yaml_event_delete(&event);
        if (type == YAML_STREAM_END_EVENT)
            return 0;
        if (type == YAML_MAPPING_START_EVENT && read_map(reader))
            return -1;
        if (type == YAML_SCALAR_EVENT || type == YAML_SEQUENCE_START_EVENT)
            return fail(reader, line, "a map of options is wanted");
    }
}

int options_read_yaml(const char *path, FILE *file, option_apply_fn *apply_leaf, void *user,
                      char *error, size_t error_size)
{
    struct reader reader = {
        .path = path, .apply = apply_leaf, .user = user, .error = error, .error_size = error_size};
    int result;

    if (!yaml_parser_initialize(&reader.parser)) {
        snprintf(error, error_size, "%s: out of memory", path);
        return -1;
    }
    yaml_parser_set_input_file(&reader.parser, file);
    result = read_document(&reader);
    yaml_parser_delete(&reader.parser);
    return result;
}
