#include "tools/measure/output_file.h"

#include "common/logs/event_log.h"

#include <errno.h>
#include <libgen.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int fail(const char *path, const char *reason, char *error, size_t error_size)
{
    snprintf(error, error_size, "%s: %s", path, reason);
    return -1;
}

int output_check(const char *path, char *error, size_t error_size)
{
    char copy[OUTPUT_LONGEST_PATH];
    struct stat status;

    if (strlen(path) >= sizeof copy)
        return fail(path, "the path is too long", error, error_size);
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
        return fail(path, "is there, and is not a file", error, error_size);
    if (event_log_begins(path))
        return fail(path, "is a log, and is not overwritten", error, error_size);
    memcpy(copy, path, strlen(path) + 1);
    if (access(dirname(copy), W_OK) != 0)
        return fail(path, strerror(errno), error, error_size);
    return 0;
}

int output_begin(struct output_file *file, const char *path, char *error, size_t error_size)
{
    if (output_check(path, error, error_size))
        return -1;
    snprintf(file->path, sizeof file->path, "%s", path);
    snprintf(file->part, sizeof file->part, "%s.part", path);
    file->stream = fopen(file->part, "wb");
    return file->stream ? 0 : fail(file->part, strerror(errno), error, error_size);
}

int output_commit(struct output_file *file, char *error, size_t error_size)
{
    int written = !ferror(file->stream) && fflush(file->stream) == 0;

    if (fclose(file->stream) == 0 && written && rename(file->part, file->path) == 0)
        return 0;
    fail(file->path, errno ? strerror(errno) : "cannot be written", error, error_size);
    unlink(file->part);
    return -1;
}
