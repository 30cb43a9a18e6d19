#include "learner/store/files.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static const int most_set_aside = 1000;

/* Opening a pipe would wait for its other end, and reading one for ever. */
static int system_open(const char *path, int flags)
{
    int file = open(path, flags | O_NONBLOCK | O_CLOEXEC, 0644);
    struct stat status;

    if (file < 0 ||
        (fstat(file, &status) == 0 && (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode))))
        return file;
    close(file);
    errno = ENXIO;
    return -1;
}

const char *files_reason(void)
{
    return errno == ENXIO ? "is not a regular file" : strerror(errno);
}

static int system_list(const char *directory, files_name_fn *take, void *user)
{
    DIR *entries = opendir(directory);
    const struct dirent *entry;

    if (!entries)
        return -1;
    errno = 0;
    while ((entry = readdir(entries)))
        take(user, entry->d_name);
    closedir(entries);
    return errno ? -1 : 0;
}

static int system_lock(int file, bool shared)
{
    return flock(file, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB);
}

static int64_t system_written(const char *path)
{
    struct stat status;

    if (stat(path, &status))
        return -1;
    return (int64_t)status.st_mtim.tv_sec * 1000000000 + status.st_mtim.tv_nsec;
}

const struct files files_system = {
    .open = system_open,
    .read = read,
    .write = write,
    .sync = fsync,
    .sync_data = fdatasync,
    .close = close,
    .rename = rename,
    .remove = unlink,
    .list = system_list,
    .written = system_written,
    .lock = system_lock,
};

int files_write_all(const struct files *files, int file, const void *bytes, size_t size)
{
    const unsigned char *from = bytes;

    while (size > 0) {
        ssize_t written = files->write(file, from, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return -1;
        from += written;
        size -= (size_t)written;
    }
    return 0;
}

ssize_t files_read_all(const struct files *files, int file, void *bytes, size_t size)
{
    unsigned char *to = bytes;
    size_t have = 0;

    while (have < size) {
        ssize_t got = files->read(file, to + have, size - have);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return -1;
        if (got == 0)
            break;
        have += (size_t)got;
    }
    return (ssize_t)have;
}

int files_sync_directory(const struct files *files, const char *directory)
{
    int file = files->open(directory, O_RDONLY | O_DIRECTORY);
    int result;

    if (file < 0)
        return -1;
    result = files->sync(file);
    files->close(file);
    return result;
}

bool files_exists(const struct files *files, const char *path)
{
    int file = files->open(path, O_RDONLY);

    if (file >= 0)
        files->close(file);
    return file >= 0 || errno != ENOENT;
}

int files_set_aside(const struct files *files, const char *path, char *aside, size_t size)
{
    for (int number = 1; number <= most_set_aside; number++) {
        int length = snprintf(aside, size, "%s.damaged-%d", path, number);
        if (length < 0 || (size_t)length >= size)
            break;
        if (!files_exists(files, aside))
            return files->rename(path, aside);
    }
    errno = ENAMETOOLONG;
    return -1;
}
