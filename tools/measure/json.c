#include "tools/measure/json.h"

#include <assert.h>
#include <math.h>

static void quote(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(out, "\\%c", c);
        else if (c < 0x20)
            fprintf(out, "\\u%04x", c);
        else
            fputc(c, out);
    }
    fputc('"', out);
}

/* What stands before a value: comma, line break, indent, key. */
static void begin_entry(struct json *json, const char *key)
{
    if (json->depth > 0) {
        if (json->has_entries[json->depth])
            fputc(',', json->out);
        fprintf(json->out, "\n%*s", 2 * json->depth, "");
        json->has_entries[json->depth] = true;
    }
    if (key) {
        quote(json->out, key);
        fputs(": ", json->out);
    }
}

static void open_nest(struct json *json, const char *key, char bracket)
{
    begin_entry(json, key);
    fputc(bracket, json->out);
    json->depth++;
    assert(json->depth < JSON_MOST_NESTED);
    json->has_entries[json->depth] = false;
}

static void close_nest(struct json *json, char bracket)
{
    bool had_entries = json->has_entries[json->depth];

    json->depth--;
    if (had_entries)
        fprintf(json->out, "\n%*s", 2 * json->depth, "");
    fputc(bracket, json->out);
    if (json->depth == 0)
        fputc('\n', json->out);
}

void json_object(struct json *json, const char *key)
{
    open_nest(json, key, '{');
}

void json_end_object(struct json *json)
{
    close_nest(json, '}');
}

void json_array(struct json *json, const char *key)
{
    open_nest(json, key, '[');
}

void json_end_array(struct json *json)
{
    close_nest(json, ']');
}

void json_text(struct json *json, const char *key, const char *value)
{
    begin_entry(json, key);
    if (value)
        quote(json->out, value);
    else
        fputs("null", json->out);
}

static void put_number(FILE *out, double value)
{
    if (isfinite(value))
        fprintf(out, "%.12g", value);
    else
        fputs("null", out);
}

void json_number(struct json *json, const char *key, double value)
{
    begin_entry(json, key);
    put_number(json->out, value);
}

void json_integer(struct json *json, const char *key, int64_t value)
{
    begin_entry(json, key);
    fprintf(json->out, "%lld", (long long)value);
}

void json_count(struct json *json, const char *key, size_t value)
{
    begin_entry(json, key);
    fprintf(json->out, "%zu", value);
}

void json_bool(struct json *json, const char *key, bool value)
{
    begin_entry(json, key);
    fputs(value ? "true" : "false", json->out);
}

void json_numbers(struct json *json, const char *key, int n, const double *values)
{
    begin_entry(json, key);
    fputc('[', json->out);
    for (int i = 0; i < n; i++) {
        if (i > 0)
            fputs(", ", json->out);
        put_number(json->out, values[i]);
    }
    fputc(']', json->out);
}
