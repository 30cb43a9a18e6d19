#include "learner/store/head.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdio.h>
#include <zlib.h>

enum { PATH_MOST = 600 };

/* Little-endian, as every machine that this runs on. */
struct record {
    uint32_t checksum; /* CRC-32 of what follows, begun with the seed */
    uint32_t unused;
    struct head head;
};

_Static_assert(sizeof(struct record) == 24, "the file's layout, docs/models.md");

static uint32_t checksum_of(uint32_t seed, const struct record *record)
{
    size_t from = offsetof(struct record, unused);

    return (uint32_t)crc32(seed, (const Bytef *)record + from, (uInt)(sizeof *record - from));
}

static void path_of(const char *journal_path, char *path)
{
    snprintf(path, PATH_MOST, "%s.head", journal_path);
}

int head_create(const struct files *files, const char *journal_path)
{
    char path[PATH_MOST];

    path_of(journal_path, path);
    return files->open(path, O_WRONLY | O_CREAT | O_EXCL);
}

void head_remove(const struct files *files, const char *journal_path)
{
    char path[PATH_MOST];

    path_of(journal_path, path);
    files->remove(path);
}

int head_append(const struct files *files, int file, uint32_t seed, struct head head)
{
    struct record record = {.head = head};

    record.checksum = checksum_of(seed, &record);
    return files_write_all(files, file, &record, sizeof record);
}

struct head head_read(const struct files *files, const char *journal_path, uint32_t seed)
{
    struct head newest = {0};
    struct record record;
    char path[PATH_MOST];
    int file;

    path_of(journal_path, path);
    file = files->open(path, O_RDONLY);
    if (file < 0)
        return newest;
    while (files_read_all(files, file, &record, sizeof record) == (ssize_t)sizeof record)
        if (record.checksum == checksum_of(seed, &record))
            newest = record.head;
    files->close(file);
    return newest;
}
