#include "tools/eval/model_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "tools/measure/output_file.h"

static int fail(const char *path, const char *reason, char *error, size_t error_size)
{
    snprintf(error, error_size, "%s: %s", path, reason);
    return -1;
}

int model_file_save(const char *path, const struct learner *learner, char *error, size_t error_size)
{
    struct output_file file;
    size_t size = learner_save_size(learner);
    void *bytes = malloc(size);

    if (!bytes || learner_save(learner, bytes, size) != size) {
        free(bytes);
        return fail(path, "no memory for the learner's state", error, error_size);
    }
    int result = output_begin(&file, path, error, error_size);
    if (result == 0) {
        fwrite(bytes, 1, size, file.stream); /* output_commit sees a failure */
        result = output_commit(&file, error, error_size);
    }
    free(bytes);
    return result;
}

static int load_bytes(const char *path, FILE *stream, size_t size, struct learner *learner,
                      char *error, size_t error_size)
{
    char reason[256];
    void *bytes = malloc(size > 0 ? size : 1);
    int result = -1;

    if (!bytes)
        fail(path, "no memory for the learner's state", error, error_size);
    else if (fread(bytes, 1, size, stream) != size)
        fail(path, "cannot be read whole", error, error_size);
    else if (learner_load(learner, bytes, size, reason, sizeof reason) != 0)
        fail(path, reason, error, error_size);
    else
        result = 0;
    free(bytes);
    return result;
}

int model_file_load(const char *path, struct learner *learner, char *error, size_t error_size)
{
    FILE *stream = fopen(path, "rb");
    struct stat status;
    int result = -1;

    if (!stream)
        return fail(path, strerror(errno), error, error_size);
    if (fstat(fileno(stream), &status) != 0 || !S_ISREG(status.st_mode))
        fail(path, "is not a file", error, error_size);
    else
        result = load_bytes(path, stream, (size_t)status.st_size, learner, error, error_size);
    fclose(stream);
    return result;
}
