#include "learner/store/model_file.h"

#include "learner/base/hash.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

#define CHUNK 65536

static const char magic[8] = "REACHMDL";
static const uint32_t format_version = 2;

/* Little-endian, as every machine that this runs on; the learner's own header says more. */
struct header {
    char magic[8];
    uint32_t version;
    uint32_t checksum; /* CRC-32 of all that follows, header and bytes */
    uint64_t size;     /* of the learner's bytes */
    uint64_t samples;
    uint64_t hash;
};

#define CHECKED_FROM offsetof(struct header, size)

uint64_t model_hash(const void *bytes, size_t size)
{
    return learner_hash(LEARNER_HASH_START, bytes, size);
}

uint64_t model_samples(const struct learner *learner)
{
    struct learner_statistics counts = learner_get_statistics(learner);

    return counts.samples + counts.outliers + counts.full + counts.refused;
}

void model_capture(struct model_bytes *model, const struct learner *learner)
{
    model->size = learner_save(learner, model->bytes, model->capacity);
    model->samples = model_samples(learner);
    model->hash = model_hash(model->bytes, model->size);
}

static uint32_t header_checksum(const struct header *header)
{
    return (uint32_t)crc32(0, (const Bytef *)header + CHECKED_FROM,
                           (uInt)(sizeof *header - CHECKED_FROM));
}

static void aside_of(const char *path, char *aside)
{
    snprintf(aside, MODEL_PATH_MOST + 8, "%s.new", path);
}

int model_file_write_aside(const struct files *files, const char *path,
                           const struct model_bytes *model)
{
    struct header header = {.version = format_version,
                            .size = model->size,
                            .samples = model->samples,
                            .hash = model->hash};
    char aside[MODEL_PATH_MOST + 8];
    int failed;
    int file;

    memcpy(header.magic, magic, sizeof magic);
    header.checksum = (uint32_t)crc32(header_checksum(&header), model->bytes, (uInt)model->size);
    aside_of(path, aside);
    file = files->open(aside, O_WRONLY | O_CREAT | O_TRUNC);
    if (file < 0)
        return -1;
    failed = files_write_all(files, file, &header, sizeof header) ||
             files_write_all(files, file, model->bytes, model->size) || files->sync(file);
    if (failed) {
        int why = errno;
        files->close(file);
        files->remove(aside);
        errno = why;
        return -1;
    }
    return files->close(file);
}

int model_file_place(const struct files *files, const char *directory, const char *path)
{
    char aside[MODEL_PATH_MOST + 8];

    aside_of(path, aside);
    return files->rename(aside, path) || files_sync_directory(files, directory) ? -1 : 0;
}

void model_file_drop_aside(const struct files *files, const char *path)
{
    char aside[MODEL_PATH_MOST + 8];

    aside_of(path, aside);
    files->remove(aside);
}

/* Where what is read goes: into the model, or, without one, only through the checksum. */
struct sink {
    struct model_bytes *model;
    const struct model_bytes *like; /* without a model */
    bool foreign;                   /* than that */
    unsigned char chunk[CHUNK];
    const char *wrong; /* NULL = nothing so far */
    int64_t at;        /* offset of what is wrong */
};

static enum model_file_result found(struct sink *sink, enum model_file_result result, int64_t at,
                                    const char *wrong)
{
    sink->wrong = wrong;
    sink->at = at;
    return result;
}

static enum model_file_result check_header(const struct header *header, ssize_t got,
                                           struct sink *sink)
{
    if (got < 0)
        return found(sink, MODEL_FILE_UNREADABLE, 0, strerror(errno));
    if (got < (ssize_t)sizeof *header)
        return found(sink, MODEL_FILE_DAMAGED, got, "cut short within its header");
    if (memcmp(header->magic, magic, sizeof magic) != 0)
        return found(sink, MODEL_FILE_DAMAGED, 0, "not a model file, or damaged");
    if (header->version != format_version)
        return found(sink, MODEL_FILE_FOREIGN, offsetof(struct header, version),
                     "of another version, or damaged");
    return MODEL_FILE_READ;
}

/* The learner's bytes, and that nothing comes after them. */
static enum model_file_result read_bytes(const struct files *files, int file,
                                         const struct header *header, struct sink *sink)
{
    uint32_t checksum = header_checksum(header);
    int64_t at = sizeof *header;
    uint64_t left = header->size;

    while (left > 0) {
        size_t want = left < CHUNK ? (size_t)left : CHUNK;
        unsigned char *to = sink->model ? sink->model->bytes + (header->size - left) : sink->chunk;
        ssize_t got = files_read_all(files, file, to, want);
        if (got < 0)
            return found(sink, MODEL_FILE_UNREADABLE, at, strerror(errno));
        checksum = (uint32_t)crc32(checksum, to, (uInt)got);
        if (at == sizeof *header && sink->like)
            sink->foreign = got < LEARNER_SAVED_IDENTITY ||
                            memcmp(to, sink->like->bytes, LEARNER_SAVED_IDENTITY) != 0;
        at += got;
        left -= (uint64_t)got;
        if ((size_t)got < want)
            return found(sink, MODEL_FILE_DAMAGED, at, "cut short");
    }
    if (files_read_all(files, file, sink->chunk, 1) != 0)
        return found(sink, MODEL_FILE_DAMAGED, at, "goes on after its end");
    if (checksum != header->checksum)
        return found(sink, MODEL_FILE_DAMAGED, CHECKED_FROM,
                     "damaged: the checksum of all that follows differs");
    if (sink->foreign)
        return found(sink, MODEL_FILE_FOREIGN, sizeof *header,
                     "the model of another robot or of other parameters");
    return MODEL_FILE_READ;
}

static enum model_file_result read_file(const struct files *files, int file, struct sink *sink)
{
    struct header header;
    enum model_file_result result =
        check_header(&header, files_read_all(files, file, &header, sizeof header), sink);

    if (result != MODEL_FILE_READ)
        return result;
    if (sink->model && header.size > sink->model->capacity)
        return found(sink, MODEL_FILE_FOREIGN, offsetof(struct header, size),
                     "larger than this configuration can hold (learner.capacity), or damaged");
    result = read_bytes(files, file, &header, sink);
    if (result != MODEL_FILE_READ || !sink->model)
        return result;
    sink->model->size = (size_t)header.size;
    sink->model->samples = header.samples;
    sink->model->hash = header.hash;
    if (model_hash(sink->model->bytes, sink->model->size) != header.hash)
        return found(sink, MODEL_FILE_DAMAGED, offsetof(struct header, hash),
                     "damaged: the model's hash differs");
    return MODEL_FILE_READ;
}

static enum model_file_result read_into(const struct files *files, const char *path,
                                        struct model_bytes *model, const struct model_bytes *like,
                                        char *reason, size_t reason_size)
{
    struct sink sink = {.model = model, .like = like};
    int file = files->open(path, O_RDONLY);
    enum model_file_result result;

    if (file < 0) {
        snprintf(reason, reason_size, "%s: %s", path, files_reason());
        return errno == ENOENT ? MODEL_FILE_ABSENT : MODEL_FILE_UNREADABLE;
    }
    result = read_file(files, file, &sink);
    files->close(file);
    if (result != MODEL_FILE_READ)
        snprintf(reason, reason_size, "%s: at byte %lld: %s", path, (long long)sink.at, sink.wrong);
    return result;
}

enum model_file_result model_file_read(const struct files *files, const char *path,
                                       struct model_bytes *model, char *reason, size_t reason_size)
{
    return read_into(files, path, model, NULL, reason, reason_size);
}

enum model_file_result model_file_check(const struct files *files, const char *path,
                                        const struct model_bytes *like, char *reason,
                                        size_t reason_size)
{
    return read_into(files, path, NULL, like, reason, reason_size);
}
