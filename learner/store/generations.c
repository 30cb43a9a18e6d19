#include "learner/store/generations.h"

#include "common/program/log.h"
#include "learner/store/head.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char prefix[] = "current-";
static const char snapshot_suffix[] = ".imle";
static const char journal_suffix[] = ".journal";

static void path_of(const struct generations *generations, int64_t number, const char *suffix,
                    char *path)
{
    snprintf(path, MODEL_PATH_MOST, "%s/%s%06lld%s", generations->directory, prefix,
             (long long)number, suffix);
}

/* The number in one of our names, -1 for others. `suffix` is what follows it. */
static int64_t number_of(const char *name, const char **suffix)
{
    char *end;
    long long number;

    if (strncmp(name, prefix, sizeof prefix - 1) != 0 || name[sizeof prefix - 1] < '0' ||
        name[sizeof prefix - 1] > '9')
        return -1;
    errno = 0;
    number = strtoll(name + sizeof prefix - 1, &end, 10);
    *suffix = end;
    return errno == 0 ? number : -1;
}

/* What is next to a number, -1 = nothing, and the greatest number of any file. */
struct neighbours {
    int64_t of;
    int64_t below; /* snapshot */
    int64_t above; /* snapshot or journal */
    int64_t greatest;
};

static void compare_number(void *user, const char *name)
{
    struct neighbours *found = user;
    const char *suffix = NULL;
    int64_t number = number_of(name, &suffix);

    if (number < 0)
        return;
    if (number > found->greatest)
        found->greatest = number;
    bool snapshot = strcmp(suffix, snapshot_suffix) == 0;
    bool journal = strcmp(suffix, journal_suffix) == 0;
    if (snapshot && number < found->of && number > found->below)
        found->below = number;
    if ((snapshot || journal) && number > found->of && (found->above < 0 || number < found->above))
        found->above = number;
}

static int find_neighbours(const struct generations *generations, int64_t of,
                           struct neighbours *found)
{
    *found = (struct neighbours){.of = of, .below = -1, .above = -1, .greatest = -1};
    return generations->files->list(generations->directory, compare_number, found);
}

/* A recovery on its way. */
struct work {
    struct generations *generations;
    struct learner *learner;
    struct model_bytes *model;
    struct recovery *recovery;
    char reason[MODEL_REASON_MOST];
};

static int load_snapshot(struct work *work, int64_t number)
{
    char path[MODEL_PATH_MOST];
    char why[200];

    path_of(work->generations, number, snapshot_suffix, path);
    if (model_file_read(work->generations->files, path, work->model, work->reason,
                        sizeof work->reason) != MODEL_FILE_READ)
        return -1;
    work->recovery->stored = work->model->samples;
    if (learner_load(work->learner, work->model->bytes, work->model->size, why, sizeof why) == 0)
        return 0;
    snprintf(work->reason, sizeof work->reason, "%s: %s", path, why);
    return -1;
}

static void learn_sample(void *user, const struct journal_sample *sample)
{
    learner_update(user, sample->z, sample->x);
}

static const char *give_body(void *user, const struct journal_body *recorded)
{
    struct body body;
    char ignored[160];

    body_from_numbers(recorded->numbers, &body);
    return learner_give_body(user, &body, ignored, sizeof ignored)
               ? "it has a body that no learner "
                 "of this configuration takes"
               : NULL;
}

/* A generation whose making was cut short: its snapshot has no name, its journal no sample yet. */
static bool never_began(const struct generations *generations, int64_t number)
{
    char snapshot[MODEL_PATH_MOST];
    char journal[MODEL_PATH_MOST];

    path_of(generations, number, snapshot_suffix, snapshot);
    path_of(generations, number, journal_suffix, journal);
    return !files_exists(generations->files, snapshot) &&
           journal_is_empty(generations->files, journal);
}

static int learn_journal(struct work *work, int64_t number)
{
    struct journal_reading reading = {.model = work->model->hash, .number = work->model->samples};
    const struct journal_visitor visitor = {learn_sample, give_body, work->learner};
    char path[MODEL_PATH_MOST];

    if (never_began(work->generations, number))
        return 0;
    path_of(work->generations, number, journal_suffix, path);
    if (journal_read(work->generations->files, path, &reading, &visitor, work->reason,
                     sizeof work->reason))
        return -1;
    if (reading.torn >= 0)
        log_warning("%s: cut off at byte %lld, where writing was interrupted; all that is marked "
                    "as stored is there, up to sample %llu",
                    path, reading.torn, (unsigned long long)reading.stored);
    work->recovery->from_journals += reading.number - work->model->samples;
    work->recovery->stored = reading.stored;
    model_capture(work->model, work->learner);
    return 0;
}

/* A snapshot and all journals from it on: the newest state, if each continues the one before. */
static int rebuild_from(struct work *work, int64_t number)
{
    struct neighbours found;

    work->recovery->generation = number;
    if (load_snapshot(work, number))
        return -1;
    for (; number >= 0; number = found.above)
        if (learn_journal(work, number) || find_neighbours(work->generations, number, &found))
            return -1;
    return 0;
}

/* The newest snapshot does not serve, for the reason in `why`: tries the others. */
static int rebuild_from_older(struct work *work, int64_t newest, const char *why)
{
    struct neighbours found;

    work->generations->damage = true;
    for (int64_t at = newest; find_neighbours(work->generations, at, &found) == 0;
         at = found.below) {
        if (found.below < 0)
            return -1;
        work->recovery->from_journals = 0;
        if (rebuild_from(work, found.below) == 0) {
            log_warning("%s; rebuilt from generation %lld and the journals after it", why,
                        (long long)found.below);
            return 0;
        }
    }
    return -1;
}

int generations_recover(struct generations *generations, struct learner *learner,
                        struct model_bytes *model, struct recovery *recovery, char *reason,
                        size_t reason_size)
{
    struct work work = {generations, learner, model, recovery, ""};
    struct neighbours found;

    *recovery = (struct recovery){0};
    if (find_neighbours(generations, INT64_MAX, &found)) {
        snprintf(reason, reason_size, "%s: %s", generations->directory, strerror(errno));
        return -1;
    }
    generations->newest = found.greatest;
    recovery->any = found.below >= 0;
    if (!recovery->any || rebuild_from(&work, found.below) == 0)
        return 0;
    snprintf(reason, reason_size, "%s", work.reason);
    return rebuild_from_older(&work, found.below, reason);
}

/* Returns 0, or -1 with errno; nothing but a name is then left to be done. */
static int write_aside(const struct generations *generations, const char *snapshot,
                       const char *path, const struct model_bytes *model, struct journal *journal)
{
    const struct files *files = generations->files;
    int why;

    if (model_file_write_aside(files, snapshot, model))
        return -1;
    if (journal_create(journal, files, path, model->samples, model->hash) == 0) {
        if (files_sync_directory(files, generations->directory) == 0)
            return 0;
        why = errno;
        journal_close(journal);
        files->remove(path);
        head_remove(files, path);
        errno = why;
    }
    why = errno;
    model_file_drop_aside(files, snapshot);
    errno = why;
    return -1;
}

static int write_generation(const struct generations *generations, const struct model_bytes *model,
                            struct journal *journal)
{
    char snapshot[MODEL_PATH_MOST];
    char path[MODEL_PATH_MOST];
    int why;

    path_of(generations, generations->newest, snapshot_suffix, snapshot);
    path_of(generations, generations->newest, journal_suffix, path);
    if (write_aside(generations, snapshot, path, model, journal))
        return -1;
    if (model_file_place(generations->files, generations->directory, snapshot) == 0)
        return 0;
    why = errno; /* the snapshot may have its name or not: what belongs to it stays */
    journal_close(journal);
    errno = why;
    return -1;
}

/* Snapshots that cannot be read are evidence, and must not be removed with their age. */
static void set_damaged_aside(struct generations *generations)
{
    struct neighbours found = {.below = generations->newest};
    char reason[MODEL_REASON_MOST];
    char path[MODEL_PATH_MOST];
    char aside[MODEL_PATH_MOST + 16];

    while (find_neighbours(generations, found.below, &found) == 0 && found.below >= 0) {
        path_of(generations, found.below, snapshot_suffix, path);
        if (model_file_check(generations->files, path, NULL, reason, sizeof reason) ==
            MODEL_FILE_READ)
            continue;
        if (files_set_aside(generations->files, path, aside, sizeof aside))
            log_warning("%s: cannot be set aside: %s", path, strerror(errno));
        else
            log_warning("%s; set aside as %s", reason, aside);
    }
    generations->damage = false;
}

/* What is to go: ours and older than a number. */
struct removal {
    const struct generations *generations;
    int64_t oldest_kept;
};

static void remove_old(void *user, const char *name)
{
    const struct removal *removal = user;
    const char *suffix = NULL;
    int64_t number = number_of(name, &suffix);
    char path[MODEL_PATH_MOST];

    if (number < 0 || number >= removal->oldest_kept || strstr(suffix, ".damaged"))
        return;
    path_of(removal->generations, number, suffix, path);
    removal->generations->files->remove(path);
}

static void tidy(struct generations *generations)
{
    struct removal removal = {generations, generations->newest};
    struct neighbours found;

    if (generations->damage)
        set_damaged_aside(generations);
    for (int kept = 1; kept < generations->keep; kept++) {
        if (find_neighbours(generations, removal.oldest_kept, &found) || found.below < 0)
            break;
        removal.oldest_kept = found.below;
    }
    generations->files->list(generations->directory, remove_old, &removal);
}

int generations_begin(struct generations *generations, const struct model_bytes *model,
                      struct journal *journal)
{
    journal->file = -1;
    generations->newest++;
    if (write_generation(generations, model, journal))
        return -1;
    tidy(generations);
    return 0;
}
