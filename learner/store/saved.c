#include "learner/store/saved.h"

#include "common/program/log.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void saved_path(const char *directory, int number, char *path)
{
    snprintf(path, MODEL_PATH_MOST, "%s/model-%d.imle", directory, number);
}

/* The number in a name that saved_path() makes, -1 for others. */
static int number_of(const char *name)
{
    char again[32];
    int number;

    if (strncmp(name, "model-", 6) != 0)
        return -1;
    number = atoi(name + 6);
    snprintf(again, sizeof again, "model-%d.imle", number);
    return strcmp(name, again) == 0 ? number : -1;
}

/* The one that was written first of all but the newest. */
struct oldest {
    const struct files *files;
    const char *directory;
    int newest; /* not to go */
    int count;
    int number; /* -1 = there is none */
    int64_t written;
};

static void compare_age(void *user, const char *name)
{
    struct oldest *oldest = user;
    char path[MODEL_PATH_MOST];
    int number = number_of(name);
    int64_t written;

    if (number < 0)
        return;
    oldest->count++;
    saved_path(oldest->directory, number, path);
    written = oldest->files->written(path);
    if (number == oldest->newest || written < 0 ||
        (oldest->number >= 0 && written >= oldest->written))
        return;
    oldest->number = number;
    oldest->written = written;
}

/* Returns whether one more may have to go. */
static bool remove_oldest(const struct files *files, const char *directory, int newest, int most)
{
    struct oldest oldest = {files, directory, newest, 0, -1, 0};
    char path[MODEL_PATH_MOST];

    if (files->list(directory, compare_age, &oldest) || oldest.count <= most || oldest.number < 0)
        return false;
    saved_path(directory, oldest.number, path);
    if (files->remove(path)) {
        log_warning("%s: cannot be removed: %s", path, strerror(errno));
        return false;
    }
    log_info("%s: removed, since model.saved_most is %d", path, most);
    return true;
}

int saved_write(const struct files *files, const char *directory, int number, int most,
                const struct model_bytes *model)
{
    char path[MODEL_PATH_MOST];
    char reason[MODEL_REASON_MOST];
    char aside[MODEL_PATH_MOST + 16];
    enum model_file_result before;

    saved_path(directory, number, path);
    before = model_file_check(files, path, model, reason, sizeof reason);
    if (before != MODEL_FILE_READ && before != MODEL_FILE_ABSENT) {
        if (files_set_aside(files, path, aside, sizeof aside))
            return -1;
        log_warning("%s; set aside as %s", reason, aside);
    }
    if (model_file_write_aside(files, path, model) || model_file_place(files, directory, path))
        return -1;
    while (most > 0 && remove_oldest(files, directory, number, most))
        ;
    return 0;
}
