/* Writes JSON: one call an entry, commas and indents are seen to. A number that is not finite
 * becomes null, which is all that JSON has for it. */
#ifndef REACH_TOOLS_MEASURE_JSON_H
#define REACH_TOOLS_MEASURE_JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { JSON_MOST_NESTED = 16 };

/* Begin with {.out = file}. */
struct json {
    FILE *out;
    int depth;
    bool has_entries[JSON_MOST_NESTED];
};

/* Keys are NULL in an array and for the document itself. */
void json_object(struct json *json, const char *key);
void json_end_object(struct json *json);
void json_array(struct json *json, const char *key);
void json_end_array(struct json *json);

void json_text(struct json *json, const char *key, const char *value); /* NULL: null */
void json_number(struct json *json, const char *key, double value);
void json_count(struct json *json, const char *key, size_t value);
void json_integer(struct json *json, const char *key, int64_t value);
void json_bool(struct json *json, const char *key, bool value);
void json_numbers(struct json *json, const char *key, int n, const double *values);

#ifdef __cplusplus
}
#endif
#endif
