#include "daemon/config/load.h"

#include "daemon/config/check.h"
#include "daemon/config/defaults.h"
#include "daemon/config/derived.h"
#include "daemon/config/table.h"
#include "daemon/config/text.h"

#include <stdio.h>
#include <string.h>

enum { MOST_LINES = 256 };

static int set_checksum(struct config *config, char *error, size_t error_size)
{
    char text[CONFIG_TEXT_SIZE];

    if (config_text(config, text) < 0) {
        snprintf(error, error_size, "the configuration as text has more than %d bytes",
                 CONFIG_TEXT_SIZE - 1);
        return -1;
    }
    config->checksum = config_text_checksum(text);
    return 0;
}

/* Read once to know the robot, then again over the defaults that follow from it. `running` is what
 * the learner was made with, NULL at the start: where babbling goes may change, its middle no more.
 */
static int load(struct config *config, const struct config *running, const char *const *paths,
                int n_paths, const char *const *overrides, int n_overrides, char *error,
                size_t error_size)
{
    struct config robot;
    char reason[320];

    config_preset(&robot);
    if (options_load(config_table(), &robot, paths, n_paths, overrides, n_overrides, error,
                     error_size))
        return -1;
    config_preset(config);
    config_set_defaults(config, &robot);
    if (running)
        config->learner_reference = running->learner_reference;
    if (options_load(config_table(), config, paths, n_paths, overrides, n_overrides, error,
                     error_size))
        return -1;
    config_derive(config);
    if (config_check(config, reason, sizeof reason)) {
        snprintf(error, error_size, "%s: %s", n_paths > 0 ? paths[n_paths - 1] : "options", reason);
        return -1;
    }
    return set_checksum(config, error, error_size);
}

int config_load(struct config *config, const char *const *paths, int n_paths,
                const char *const *overrides, int n_overrides, char *error, size_t error_size)
{
    return load(config, NULL, paths, n_paths, overrides, n_overrides, error, error_size);
}

int config_load_again(struct config *config, const struct config *running, const char *const *paths,
                      int n_paths, const char *const *overrides, int n_overrides, char *error,
                      size_t error_size)
{
    return load(config, running, paths, n_paths, overrides, n_overrides, error, error_size);
}

int config_from_text(struct config *config, char *text, char *error, size_t error_size)
{
    const char *overrides[MOST_LINES];
    char *rest = text, *next;
    int n = 0;

    while ((next = strsep(&rest, "\n")) != NULL && n < MOST_LINES)
        if (*next)
            overrides[n++] = next;
    return config_load(config, NULL, 0, overrides, n, error, error_size);
}
