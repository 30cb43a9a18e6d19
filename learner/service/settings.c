#include "learner/service/settings.h"

#include <stdio.h>
#include <string.h>

_Static_assert(offsetof(struct settings, learner) == 0, "see LEARNER_OPTION_ROWS");

#define ROW(name, type, field, initial, minimum, maximum, choices, help)                           \
    {                                                                                              \
        name, type, offsetof(struct settings, field), NULL, initial, minimum, maximum, help,       \
            choices                                                                                \
    }

static const struct option_row table[] = {
    ROW("inputs", OPTION_INT, n_inputs, NULL, 1, LEARNER_MAX_INPUTS, NULL,
        "number of inputs: entries of z that count"),
    ROW("outputs", OPTION_INT, n_outputs, NULL, 1, LEARNER_MAX_OUTPUTS, NULL,
        "number of outputs: entries of x that count"),
    ROW("kind", OPTION_CHOICE, kind, "imle", 0, 0, "imle|lwpr",
        "learning algorithm: imle = mixture of experts, lwpr = local regression"),
    ROW("model.directory", OPTION_TEXT, model_directory, "", 0, 0, NULL,
        "directory in which the model is kept and saved; empty = nothing is stored"),
    ROW("model.snapshot", OPTION_INT, model_snapshot, "500", 1, 1000000, NULL,
        "samples in the journal after which a snapshot is made, if the budget allows"),
    ROW("model.snapshot_budget", OPTION_NUMBER, model_snapshot_budget, "4000", 0, 1e9, NULL,
        "most MB that snapshots may write a day, in the mean; 0 = no bound"),
    ROW("model.saved_most", OPTION_INT, model_saved_most, "100", 0, 1000000, NULL,
        "most models saved by number; one more, and the oldest is removed; 0 = no bound"),
    ROW("model.keep", OPTION_INT, model_keep, "2", 1, 1000, NULL,
        "number of snapshots kept on disk; with 2 or more, a damaged one can be rebuilt"),
    ROW("learn_frozen", OPTION_BOOL, learn_frozen, "false", 0, 0, NULL,
        "true = samples whose outputs stand still while inputs move are learned; false = they are "
        "dropped and counted"),
    LEARNER_OPTION_ROWS,
    OPTION_END,
};

static int read_rows(struct settings *settings, const char *const *paths, int n_paths,
                     const char *const *overrides, int n_overrides, char *error, size_t error_size)
{
    enum learner_kind kind = (enum learner_kind)settings->kind;

    settings->learner = learner_options_default(kind, settings->n_inputs, settings->n_outputs);
    return options_load(table, settings, paths, n_paths, overrides, n_overrides, error, error_size);
}

/* Twice: the learner's defaults depend on the dimensions, which the first reading finds out. */
int settings_load(struct settings *settings, const char *const *paths, int n_paths,
                  const char *const *overrides, int n_overrides, char *error, size_t error_size)
{
    char reason[256];

    memset(settings, 0, sizeof *settings);
    settings->n_inputs = settings->n_outputs = 1;
    for (int reading = 0; reading < 2; reading++)
        if (read_rows(settings, paths, n_paths, overrides, n_overrides, error, error_size))
            return -1;
    if (learner_options_finish(&settings->learner, reason, sizeof reason) == 0)
        return 0;
    snprintf(error, error_size, "%s: %s", n_paths > 0 ? paths[n_paths - 1] : "--set", reason);
    return -1;
}

void settings_print(FILE *out)
{
    struct settings settings = {.learner = learner_options_default(LEARNER_IMLE, 1, 1)};

    options_print(table, &settings, out);
}

struct model_store_settings settings_store(const struct settings *settings)
{
    return (struct model_store_settings){
        .directory = settings->model_directory,
        .automatic = true,
        .snapshot_samples = settings->model_snapshot,
        .snapshot_rate = settings->model_snapshot_budget * 1e6 / 86400,
        .saved_most = settings->model_saved_most,
        .sync_us = 0,
        .keep = settings->model_keep,
        .learner = settings->learner.config,
    };
}
