#include "common/options/regular_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A folder is opened as well: what is wrong with it shows when it is read. */
static bool makes_nobody_wait(int descriptor)
{
    struct stat status;

    return fstat(descriptor, &status) == 0 && (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode));
}

FILE *regular_file_open(const char *path, char *error, size_t error_size)
{
    /* Without O_NONBLOCK the opening of a pipe would wait for who writes. */
    int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    FILE *file = NULL;

    if (descriptor >= 0 && !makes_nobody_wait(descriptor)) {
        snprintf(error, error_size, "%s: is not a regular file", path);
        close(descriptor);
        return NULL;
    }
    if (descriptor >= 0)
        file = fdopen(descriptor, "rb");
    if (file)
        return file;
    snprintf(error, error_size, "%s: %s", path, strerror(errno));
    if (descriptor >= 0)
        close(descriptor);
    return NULL;
}
