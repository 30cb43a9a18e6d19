#include "model_store.h"

#include "common/log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#define PATH_MOST 512

static const char magic[8] = "REACHMDL";
static const uint32_t format_version = 1;

/* Little-endian, as every machine that this runs on; the learner's own header says more. */
struct header {
    char magic[8];
    uint32_t version;
    uint32_t checksum; /* CRC-32 of the bytes that follow */
    uint64_t size;     /* of the bytes that follow */
};

/* Who may touch the store: housekeeping in SAVE_ASKED, LOAD_ASKED and REFUSED, else the loop. */
enum stage { FREE, SAVE_ASKED, SAVED, LOAD_ASKED, READ, REFUSED, FAILED };

struct model_store {
    const char *directory;
    unsigned char *buffer;
    size_t capacity;
    size_t size;
    int number;
    char reason[128]; /* why the learner did not take what was read */
    _Atomic int stage;
};

size_t model_store_memory(size_t learner_bytes)
{
    return arena_footprint(sizeof(struct model_store)) + arena_footprint(learner_bytes);
}

struct model_store *model_store_create(const char *directory, size_t learner_bytes,
                                       struct arena *arena)
{
    struct model_store *store = arena_alloc(arena, sizeof *store);

    if (!store)
        return NULL;
    store->directory = directory;
    store->capacity = learner_bytes;
    store->buffer = arena_alloc(arena, learner_bytes);
    return store->buffer ? store : NULL;
}

static bool begin(struct model_store *store, int number)
{
    if (!store->directory[0] || atomic_load_explicit(&store->stage, memory_order_acquire) != FREE)
        return false;
    store->number = number;
    return true;
}

bool model_store_begin_save(struct model_store *store, const struct learner *learner, int number)
{
    if (!begin(store, number))
        return false;
    store->size = learner_save(learner, store->buffer, store->capacity);
    if (store->size == 0)
        return false;
    atomic_store_explicit(&store->stage, SAVE_ASKED, memory_order_release);
    return true;
}

bool model_store_begin_load(struct model_store *store, int number)
{
    if (!begin(store, number))
        return false;
    atomic_store_explicit(&store->stage, LOAD_ASKED, memory_order_release);
    return true;
}

enum model_store_result model_store_poll(struct model_store *store, struct learner *learner)
{
    enum model_store_result result;

    switch (atomic_load_explicit(&store->stage, memory_order_acquire)) {
    case SAVED:
        result = MODEL_STORE_DONE;
        break;
    case READ:
        if (learner_load(learner, store->buffer, store->size, store->reason,
                         sizeof store->reason)) { /* housekeeping may log, this thread may not */
            atomic_store_explicit(&store->stage, REFUSED, memory_order_release);
            return MODEL_STORE_NOTHING;
        }
        result = MODEL_STORE_DONE;
        break;
    case FAILED:
        result = MODEL_STORE_FAILED;
        break;
    default:
        return MODEL_STORE_NOTHING;
    }
    atomic_store_explicit(&store->stage, FREE, memory_order_release);
    return result;
}

static int write_all(int file, const void *bytes, size_t size)
{
    const unsigned char *from = bytes;

    while (size > 0) {
        ssize_t written = write(file, from, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return -1;
        from += written;
        size -= (size_t)written;
    }
    return 0;
}

static int sync_directory(const char *directory)
{
    int file = open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    int result;

    if (file < 0)
        return -1;
    result = fsync(file);
    close(file);
    return result;
}

static int write_model(const struct model_store *store, const char *path)
{
    struct header header = {.version = format_version, .size = store->size};
    char aside[PATH_MOST + 8];
    int file;
    int failed;

    memcpy(header.magic, magic, sizeof magic);
    header.checksum = (uint32_t)crc32(0, store->buffer, (uInt)store->size);
    snprintf(aside, sizeof aside, "%s.new", path);
    file = open(aside, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0)
        return -1;
    failed = write_all(file, &header, sizeof header) ||
             write_all(file, store->buffer, store->size) || fsync(file);
    failed = close(file) || failed;
    return failed || rename(aside, path) || sync_directory(store->directory) ? -1 : 0;
}

static int read_all(int file, void *bytes, size_t size)
{
    unsigned char *to = bytes;

    while (size > 0) {
        ssize_t got = read(file, to, size);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return -1;
        to += got;
        size -= (size_t)got;
    }
    return 0;
}

/* Reads and checks. Returns NULL, or what is wrong. */
static const char *read_model(struct model_store *store, const char *path)
{
    struct header header;
    struct stat status;
    const char *wrong = NULL;
    int file = open(path, O_RDONLY | O_CLOEXEC);

    if (file < 0)
        return strerror(errno);
    if (fstat(file, &status) || read_all(file, &header, sizeof header) ||
        memcmp(header.magic, magic, sizeof magic) != 0)
        wrong = "not a model file";
    else if (header.version != format_version)
        wrong = "of another version";
    else if (header.size > store->capacity)
        wrong = "larger than this configuration can hold (learner.capacity)";
    else if ((uint64_t)status.st_size != sizeof header + header.size ||
             read_all(file, store->buffer, (size_t)header.size))
        wrong = "cut short or too long";
    else if (crc32(0, store->buffer, (uInt)header.size) != header.checksum)
        wrong = "damaged: the checksum differs";
    else
        store->size = (size_t)header.size;
    close(file);
    return wrong;
}

void model_store_serve(struct model_store *store)
{
    int stage = atomic_load_explicit(&store->stage, memory_order_acquire);
    char path[PATH_MOST];
    const char *wrong = NULL;

    if (stage != SAVE_ASKED && stage != LOAD_ASKED && stage != REFUSED)
        return;
    snprintf(path, sizeof path, "%s/model-%d.imle", store->directory, store->number);
    if (stage == SAVE_ASKED && write_model(store, path))
        wrong = strerror(errno);
    else if (stage == LOAD_ASKED)
        wrong = read_model(store, path);
    else if (stage == REFUSED)
        wrong = store->reason;
    if (wrong)
        log_error("%s: %s", path, wrong);
    else
        log_info("%s: %s", path, stage == SAVE_ASKED ? "saved" : "read");
    if (wrong)
        stage = FAILED;
    else
        stage = stage == SAVE_ASKED ? SAVED : READ;
    atomic_store_explicit(&store->stage, stage, memory_order_release);
}
