#include "tools/measure/etc_directory.h"

#include <libgen.h>
#include <limits.h>
#include <stdio.h>
#include <unistd.h>

const char *etc_file(const char *name, char *path, size_t size)
{
    char self[PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);

    if (length > 0) {
        self[length] = '\0';
        snprintf(path, size, "%s/%s/%s", dirname(self), REACH_ETC_FROM_PROGRAM, name);
        if (access(path, R_OK) == 0)
            return path;
    }
    snprintf(path, size, "%s/%s", REACH_ETC_IN_SOURCE, name);
    return path;
}
