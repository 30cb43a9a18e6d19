#include "harness.h"

#include <sys/mman.h>
#include <unistd.h>

const char *harness_file(const uint8_t *data, size_t size)
{
    static int file = -1;
    static char path[32];

    if (file >= 0)
        close(file);
    file = memfd_create("input", MFD_CLOEXEC);
    HARNESS_REQUIRE(file >= 0 && write(file, data, size) == (ssize_t)size);
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    return path;
}
