#include "learner/store/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

static const char magic[8] = "REACHJNL";
static const uint32_t format_version = 1;

enum kind { SAMPLE = 1, MARK = 2 };

/* Little-endian, as every machine that this runs on. */
struct header {
    char magic[8];
    uint32_t version;
    uint32_t checksum; /* CRC-32 of what follows */
    uint64_t first;
    uint64_t model;
};

struct record {
    uint32_t checksum; /* CRC-32 of what follows, begun with the header's */
    uint32_t kind;
    struct journal_sample sample; /* MARK: only the number, all up to which are safe */
};

_Static_assert(sizeof(struct header) == 32 && sizeof(struct record) == 208,
               "the files' layout, docs/models.md");

static uint32_t header_checksum(const struct header *header)
{
    size_t from = offsetof(struct header, first);

    return (uint32_t)crc32(0, (const Bytef *)header + from, (uInt)(sizeof *header - from));
}

static uint32_t record_checksum(uint32_t seed, const struct record *record)
{
    size_t from = offsetof(struct record, kind);

    return (uint32_t)crc32(seed, (const Bytef *)record + from, (uInt)(sizeof *record - from));
}

int journal_create(struct journal *journal, const struct files *files, const char *path,
                   uint64_t first, uint64_t model)
{
    struct header header = {.version = format_version, .first = first, .model = model};
    int file = files->open(path, O_WRONLY | O_CREAT | O_EXCL);

    if (file < 0)
        return -1;
    memcpy(header.magic, magic, sizeof magic);
    header.checksum = header_checksum(&header);
    if (files_write_all(files, file, &header, sizeof header) || files->sync(file)) {
        int why = errno;
        files->close(file);
        files->remove(path);
        errno = why;
        return -1;
    }
    *journal = (struct journal){.files = files,
                                .file = file,
                                .seed = header.checksum,
                                .first = first,
                                .appended = first,
                                .stored = first};
    return 0;
}

static int append(struct journal *journal, struct record *record)
{
    record->checksum = record_checksum(journal->seed, record);
    return files_write_all(journal->files, journal->file, record, sizeof *record);
}

int journal_append(struct journal *journal, const struct journal_sample *sample)
{
    struct record record = {.kind = SAMPLE, .sample = *sample};

    if (append(journal, &record))
        return -1;
    journal->appended = sample->number;
    return 0;
}

int journal_commit(struct journal *journal)
{
    struct record mark = {.kind = MARK, .sample = {.number = journal->appended}};

    if (journal->stored == journal->appended)
        return 0;
    if (journal->files->sync_data(journal->file) || append(journal, &mark) ||
        journal->files->sync_data(journal->file))
        return -1;
    journal->stored = journal->appended;
    return 0;
}

void journal_close(struct journal *journal)
{
    if (journal->file >= 0)
        journal->files->close(journal->file);
    journal->file = -1;
}

bool journal_is_empty(const struct files *files, const char *path)
{
    unsigned char bytes[sizeof(struct header) + 1];
    int file = files->open(path, O_RDONLY);
    ssize_t got;

    if (file < 0)
        return errno == ENOENT;
    got = files_read_all(files, file, bytes, sizeof bytes);
    files->close(file);
    return got >= 0 && got < (ssize_t)sizeof bytes;
}

static const char *header_fault(const struct header *header, ssize_t got,
                                const struct journal_reading *reading)
{
    if (got < 0)
        return strerror(errno);
    if ((size_t)got < sizeof *header || memcmp(header->magic, magic, sizeof magic) != 0)
        return "not a journal, or damaged";
    if (header->version != format_version)
        return "of another version, or damaged";
    if (header->checksum != header_checksum(header))
        return "its header is damaged: the checksum differs";
    if (header->first != reading->number || header->model != reading->model)
        return "it does not continue the model before it";
    return NULL;
}

/* What has been understood of the records so far. */
struct scan {
    const struct files *files;
    int file;
    uint32_t seed;
    long long at;  /* offset of the record in hand */
    long long bad; /* offset of the first bad one; -1 = none */
    bool unreadable;
};

/* The next record. Returns false at the end. `*good`: it is whole and has its checksum. */
static bool next_record(struct scan *scan, struct record *record, bool *good)
{
    ssize_t got = files_read_all(scan->files, scan->file, record, sizeof *record);

    if (got < 0)
        scan->unreadable = true;
    *good =
        got == (ssize_t)sizeof *record && record->checksum == record_checksum(scan->seed, record);
    return got > 0;
}

/* Takes the records one by one. Returns NULL, or what is wrong at scan->at. */
static const char *read_records(struct scan *scan, struct journal_reading *reading,
                                journal_visit_fn *visit, void *user)
{
    struct record record;
    bool good;

    for (; next_record(scan, &record, &good); scan->at += (long long)sizeof record) {
        uint64_t number = record.sample.number;
        if (good && record.kind == MARK) {
            if (number <= reading->number)
                continue;
            scan->at = scan->bad < 0 ? scan->at : scan->bad;
            return "damaged: samples that were stored from here on are not whole";
        }
        if (scan->bad >= 0)
            continue; /* in search of a mark */
        if (good && record.kind == SAMPLE && number == reading->number + 1) {
            visit(user, &record.sample);
            reading->number++;
        } else {
            scan->bad = scan->at;
        }
    }
    reading->torn = scan->bad;
    return scan->unreadable ? "it cannot be read" : NULL;
}

int journal_read(const struct files *files, const char *path, struct journal_reading *reading,
                 journal_visit_fn *visit, void *user, char *reason, size_t reason_size)
{
    struct scan scan = {.files = files, .file = files->open(path, O_RDONLY), .bad = -1};
    struct header header;
    const char *wrong;

    if (scan.file < 0) {
        snprintf(reason, reason_size, "%s: %s", path, strerror(errno));
        return -1;
    }
    wrong =
        header_fault(&header, files_read_all(files, scan.file, &header, sizeof header), reading);
    scan.seed = header.checksum;
    scan.at = wrong ? 0 : sizeof header;
    if (!wrong)
        wrong = read_records(&scan, reading, visit, user);
    files->close(scan.file);
    if (wrong)
        snprintf(reason, reason_size, "%s: at byte %lld: %s", path, scan.at, wrong);
    return wrong ? -1 : 0;
}
