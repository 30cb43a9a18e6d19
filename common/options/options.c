#include "common/options/options.h"

#include "common/options/option_set.h"
#include "common/options/regular_file.h"

#include <errno.h>
#include <string.h>

#define OPTION_MAX_ROWS 256

const char option_preset[] = "preset";

const struct option_row *option_find(const struct option_row *table, const char *name)
{
    for (; table->name; table++)
        if (strcmp(table->name, name) == 0)
            return table;
    return NULL;
}

/* What is being filled, and which rows already have a value from the present source. */
struct loading {
    const struct option_row *table;
    void *target;
    bool given[OPTION_MAX_ROWS];
    bool seen_in_file[OPTION_MAX_ROWS];
};

static int apply_to_table(void *user, const char *name, const char *const *items, int n_items,
                          bool is_list, char *error, size_t error_size)
{
    struct loading *loading = (struct loading *)user;
    const struct option_row *row = option_find(loading->table, name);
    ptrdiff_t index;

    if (!row) {
        snprintf(error, error_size, "unknown option; --help-options lists them all");
        return -1;
    }
    index = row - loading->table;
    if (loading->seen_in_file[index]) {
        snprintf(error, error_size, "given twice");
        return -1;
    }
    loading->seen_in_file[index] = true;
    loading->given[index] = true;
    return option_set(row, loading->target, items, n_items, is_list, error, error_size);
}

/* "1,2,3" for a list: on a command line brackets are for the shell. */
static bool is_bare_list(const struct option_row *row, const char *value)
{
    return row && (row->type == OPTION_LIST || row->type == OPTION_SPREAD) && strchr(value, ',') &&
           !strchr(value, '[');
}

/* Reads "name: value" as YAML, so that defaults and overrides follow the file's own syntax. */
static int apply_text(struct loading *loading, const char *origin, const char *name,
                      const char *value, char *error, size_t error_size)
{
    char text[OPTION_MAX_NAMES + OPTION_MAX_TEXT + 64];
    FILE *stream;
    int result;
    const bool is_bare = is_bare_list(option_find(loading->table, name), value);
    int length = snprintf(text, sizeof text, is_bare ? "%s: [%s]\n" : "%s: %s\n", name, value);

    if (length < 0 || length >= (int)sizeof text) {
        snprintf(error, error_size, "%s: %s: value is too long", origin, name);
        return -1;
    }
    stream = fmemopen(text, (size_t)length, "r");
    if (!stream) {
        snprintf(error, error_size, "%s: %s", origin, strerror(errno));
        return -1;
    }
    result = options_read_yaml(origin, stream, apply_to_table, loading, error, error_size);
    fclose(stream);
    return result;
}

static int apply_defaults(struct loading *loading, char *error, size_t error_size)
{
    for (const struct option_row *row = loading->table; row->name; row++)
        if (row->initial == option_preset)
            loading->given[row - loading->table] = true;
        else if (row->initial &&
                 apply_text(loading, "default", row->name, row->initial, error, error_size))
            return -1;
    return 0;
}

static int apply_file(struct loading *loading, const char *path, char *error, size_t error_size)
{
    FILE *file = regular_file_open(path, error, error_size);
    int result;

    if (!file)
        return -1;
    result = options_read_yaml(path, file, apply_to_table, loading, error, error_size);
    fclose(file);
    return result;
}

static int apply_overrides(struct loading *loading, const char *option,
                           const char *const *overrides, int n_overrides, char *error,
                           size_t error_size)
{
    char name[OPTION_MAX_TEXT];

    for (int i = 0; i < n_overrides; i++) {
        const char *equals = strchr(overrides[i], '=');
        if (!equals || (size_t)(equals - overrides[i]) >= sizeof name) {
            snprintf(error, error_size, "%s '%s': name=value is wanted", option, overrides[i]);
            return -1;
        }
        memcpy(name, overrides[i], (size_t)(equals - overrides[i]));
        name[equals - overrides[i]] = '\0';
        memset(loading->seen_in_file, 0, sizeof loading->seen_in_file);
        if (apply_text(loading, option, name, equals + 1, error, error_size))
            return -1;
    }
    return 0;
}

int options_load(const struct option_row *table, void *target, const char *const *paths,
                 int n_paths, const char *const *overrides, int n_overrides, char *error,
                 size_t error_size)
{
    return options_load_as(table, target, paths, n_paths, "--set", overrides, n_overrides, error,
                           error_size);
}

static int load(const struct option_row *table, void *target, const char *const *paths, int n_paths,
                const char *override_option, const char *const *overrides, int n_overrides,
                char *error, size_t error_size)
{
    struct loading loading = {.table = table, .target = target};
    const struct option_row *row;

    for (row = table; row->name; row++)
        if (row - table >= OPTION_MAX_ROWS - 1) {
            snprintf(error, error_size, "more than %d options", OPTION_MAX_ROWS);
            return -1;
        }
    if (apply_defaults(&loading, error, error_size))
        return -1;
    for (int i = 0; i < n_paths; i++) {
        memset(loading.seen_in_file, 0, sizeof loading.seen_in_file);
        if (apply_file(&loading, paths[i], error, error_size))
            return -1;
    }
    if (apply_overrides(&loading, override_option, overrides, n_overrides, error, error_size))
        return -1;
    for (row = table; row->name; row++)
        if (!loading.given[row - table]) {
            snprintf(error, error_size, "%s: %s must be given (%s)",
                     n_paths > 0 ? paths[0] : "options", row->name, row->help);
            return -1;
        }
    return 0;
}

/* What a file holds may be in the message, and then it may not break the line, nor a terminal. */
static void keep_on_one_line(char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 0x7f)
            *text = '?';
}

int options_load_as(const struct option_row *table, void *target, const char *const *paths,
                    int n_paths, const char *override_option, const char *const *overrides,
                    int n_overrides, char *error, size_t error_size)
{
    int failed = load(table, target, paths, n_paths, override_option, overrides, n_overrides, error,
                      error_size);

    if (failed)
        keep_on_one_line(error);
    return failed;
}
