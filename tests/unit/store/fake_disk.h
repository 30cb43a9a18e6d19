/* A disk in memory behind the table of files.h, which can fill up, fail, write less than it was
 * asked to, and lose power: what was not synced is then gone, or some of it, in any order. */
#ifndef TESTS_UNIT_STORE_FAKE_DISK_H
#define TESTS_UNIT_STORE_FAKE_DISK_H

#include "common/base/random.h"
#include "learner/store/files.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FAKE_DISK_DIRECTORY "/fake"

/* There is one of them at a time. */
struct fake_disk {
    long operations; /* so far, of those that change something */
    long dies_at;  /* from this operation on nothing works, and that one is half done; -1 = never */
    long fails_at; /* this operation fails; -1 = none */
    int error;     /* what failing operations say */
    size_t capacity; /* bytes in all files */
    bool read_only;
    bool short_writes;
    struct random_state random;
};

extern struct fake_disk fake_disk;
extern const struct files fake_disk_files;

/* An empty, healthy disk. */
void fake_disk_reset(struct random_state random);

/* The process ends, and the disk works again. */
enum fake_disk_crash {
    FAKE_DISK_KILLED,    /* the system lives: everything that was written is there */
    FAKE_DISK_POWER_OFF, /* exactly what was synced is there */
    FAKE_DISK_TORN,      /* what was not synced may be there, in parts */
};
void fake_disk_crash(enum fake_disk_crash crash);

/* The i-th file, in some order; NULL after the last. */
const char *fake_disk_name(int i);

/* The bytes of a file, or NULL. */
unsigned char *fake_disk_bytes(const char *name, size_t *size);

void fake_disk_truncate(const char *name, size_t size);

/* FNV-1a of all names and bytes. */
uint64_t fake_disk_hash(void);

#endif
