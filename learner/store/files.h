/* The few calls by which models reach the disk, as a table, so that tests can put a disk in its
 * place that fails, fills up or loses power. Housekeeping only: all of them may block. */
#ifndef REACH_LEARNER_STORE_FILES_H
#define REACH_LEARNER_STORE_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

typedef void files_name_fn(void *user, const char *name);

/* As the calls of POSIX: -1 with errno set is failure. */
struct files {
    /* Flags of open(2); new files get mode 0644. ENXIO: neither a regular file nor a directory. */
    int (*open)(const char *path, int flags);
    ssize_t (*read)(int file, void *bytes, size_t size);
    ssize_t (*write)(int file, const void *bytes, size_t size);
    int (*sync)(int file);      /* fsync: all of it is on the disk */
    int (*sync_data)(int file); /* fdatasync: what is needed to read it again */
    int (*close)(int file);
    int (*rename)(const char *from, const char *to);
    int (*remove)(const char *path);
    int (*list)(const char *directory, files_name_fn *take, void *user); /* in any order */
    int64_t (*written)(const char *path); /* when it was written last: grows; -1 = unknown */
    int (*lock)(int file, bool shared);   /* flock without waiting; EWOULDBLOCK: another has it */
};

extern const struct files files_system;

/* errno of a call above in words. */
const char *files_reason(void);

/* Writes all of it. Returns 0, or -1. */
int files_write_all(const struct files *files, int file, const void *bytes, size_t size);

/* Reads until `size` bytes are there or the file ends. Returns how many, or -1. */
ssize_t files_read_all(const struct files *files, int file, void *bytes, size_t size);

/* Names that were made, changed or removed are on the disk. */
int files_sync_directory(const struct files *files, const char *directory);

/* Whether it can be opened, or at least is there. */
bool files_exists(const struct files *files, const char *path);

/* Renames to PATH.damaged-1, or the first such number that is free: evidence is kept, and nothing
 * is written over. Writes the new name into `aside`. Returns 0, or -1. */
int files_set_aside(const struct files *files, const char *path, char *aside, size_t size);

#endif
