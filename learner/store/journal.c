#include "learner/store/journal.h"

#include "learner/store/head.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

static const char magic[8] = "REACHJNL";
static const uint32_t format_version = 1;

enum kind { SAMPLE = 1, MARK = 2, BODY = 3 };

/* A body goes in parts, as many numbers in each as a sample's record has; the last one's rest is 0.
 */
enum { PART_NUMBERS = LEARNER_MAX_INPUTS + LEARNER_MAX_OUTPUTS };
enum { BODY_PARTS = (BODY_NUMBERS + PART_NUMBERS - 1) / PART_NUMBERS };

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
    /* MARK: the number, all up to which are safe, and in z[0] the bodies that are. BODY: z and x
     * are a part of its numbers. */
    struct journal_sample sample;
};

_Static_assert(sizeof(struct header) == 32 && sizeof(struct record) == 208 && BODY_PARTS == 244,
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
    int head = -1;

    if (file < 0)
        return -1;
    memcpy(header.magic, magic, sizeof magic);
    header.checksum = header_checksum(&header);
    if (files_write_all(files, file, &header, sizeof header) || files->sync(file) ||
        (head = head_create(files, path)) < 0) {
        int why = errno;
        files->close(file);
        files->remove(path);
        errno = why;
        return -1;
    }
    *journal = (struct journal){.files = files,
                                .file = file,
                                .head = head,
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

/* Part `at` of a body, as z and x of a record, or back. */
static void copy_part(struct journal_sample *sample, double *numbers, int at, bool into_sample)
{
    for (int i = 0; i < PART_NUMBERS && at * PART_NUMBERS + i < BODY_NUMBERS; i++) {
        double *part = i < LEARNER_MAX_INPUTS ? &sample->z[i] : &sample->x[i - LEARNER_MAX_INPUTS];
        double *whole = &numbers[at * PART_NUMBERS + i];
        *(into_sample ? part : whole) = *(into_sample ? whole : part);
    }
}

int journal_append_body(struct journal *journal, const struct journal_body *body)
{
    struct journal_body copy = *body;

    for (int part = 0; part < BODY_PARTS; part++) {
        struct record record = {.kind = BODY, .sample = {.number = body->number}};
        copy_part(&record.sample, copy.numbers, part, true);
        if (append(journal, &record))
            return -1;
    }
    journal->bodies++;
    return 0;
}

int journal_commit(struct journal *journal)
{
    struct record mark = {.kind = MARK,
                          .sample = {.number = journal->appended, .z = {(double)journal->bodies}}};

    if (journal->stored == journal->appended && journal->bodies_stored == journal->bodies)
        return 0;
    if (journal->files->sync_data(journal->file) || append(journal, &mark) ||
        journal->files->sync_data(journal->file))
        return -1;
    journal->stored = journal->appended;
    journal->bodies_stored = journal->bodies;
    return head_append(journal->files, journal->head, journal->seed,
                       (struct head){journal->stored, journal->bodies_stored});
}

void journal_close(struct journal *journal)
{
    if (journal->file >= 0) {
        journal->files->close(journal->file);
        journal->files->close(journal->head);
    }
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
    const struct journal_visitor *visitor;
    int file;
    uint32_t seed;
    long long at;  /* offset of the record in hand */
    long long bad; /* offset of the first bad one; -1 = none */
    bool unreadable;
    double bodies;            /* whole ones */
    int parts;                /* of the body at hand */
    long long body_at;        /* offset of its first */
    struct journal_body body; /* at hand */
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

/* One of the parts of a body. The last one makes it whole. Returns NULL, or what is wrong. */
static const char *take_part(struct scan *scan, struct journal_sample *sample)
{
    if (scan->parts == 0)
        scan->body_at = scan->at;
    copy_part(sample, scan->body.numbers, scan->parts, false);
    scan->body.number = sample->number;
    if (++scan->parts < BODY_PARTS)
        return NULL;
    scan->parts = 0;
    scan->bodies++;
    return scan->visitor->body(scan->visitor->user, &scan->body);
}

/* A record that is neither bad nor a mark, in its place: the next sample, or the next part. */
static bool in_order(const struct scan *scan, const struct record *record, uint64_t number)
{
    return (record->kind == SAMPLE && scan->parts == 0 && record->sample.number == number + 1) ||
           (record->kind == BODY && record->sample.number == number);
}

/* What a mark says is safe has been read. */
static bool mark_holds(const struct scan *scan, const struct record *mark, uint64_t number)
{
    return mark->sample.number <= number && mark->sample.z[0] <= scan->bodies;
}

/* Where the good part ends: a body of which a part is bad is bad from its first. */
static long long first_bad(const struct scan *scan)
{
    return scan->parts > 0 ? scan->body_at : scan->at;
}

/* Takes the records one by one. Returns NULL, or what is wrong at scan->at. */
static const char *read_records(struct scan *scan, struct journal_reading *reading)
{
    struct record record;
    bool good;

    for (; next_record(scan, &record, &good); scan->at += (long long)sizeof record) {
        const char *wrong = NULL;
        if (good && record.kind == MARK) {
            reading->stored = record.sample.number;
            if (mark_holds(scan, &record, reading->number))
                continue;
            scan->at = scan->bad < 0 ? scan->at : scan->bad;
            return "damaged: samples that were stored from here on are not whole";
        }
        if (scan->bad >= 0)
            continue; /* in search of a mark */
        if (!good || !in_order(scan, &record, reading->number))
            scan->bad = first_bad(scan);
        else if (record.kind == BODY)
            wrong = take_part(scan, &record.sample);
        else
            scan->visitor->sample(scan->visitor->user, &record.sample);
        if (wrong)
            return wrong;
        reading->number += scan->bad < 0 && record.kind == SAMPLE;
    }
    if (scan->bad < 0 && scan->parts > 0)
        scan->bad = scan->body_at;
    reading->torn = scan->bad;
    return scan->unreadable ? "it cannot be read" : NULL;
}

/* What the file beside it says was stored is there. */
static const char *head_fault(struct scan *scan, const char *path,
                              const struct journal_reading *reading)
{
    struct head head = head_read(scan->files, path, scan->seed);

    if (head.number <= reading->number && (double)head.bodies <= scan->bodies)
        return NULL;
    scan->at = scan->bad < 0 ? scan->at : scan->bad;
    return "cut short: what its .head file says was stored is gone";
}

int journal_read(const struct files *files, const char *path, struct journal_reading *reading,
                 const struct journal_visitor *visitor, char *reason, size_t reason_size)
{
    struct scan scan = {
        .files = files, .visitor = visitor, .file = files->open(path, O_RDONLY), .bad = -1};
    struct header header;
    const char *wrong;

    if (scan.file < 0) {
        snprintf(reason, reason_size, "%s: %s", path, files_reason());
        return -1;
    }
    wrong =
        header_fault(&header, files_read_all(files, scan.file, &header, sizeof header), reading);
    scan.seed = header.checksum;
    scan.at = wrong ? 0 : sizeof header;
    reading->stored = reading->number;
    if (!wrong)
        wrong = read_records(&scan, reading);
    if (!wrong)
        wrong = head_fault(&scan, path, reading);
    files->close(scan.file);
    if (wrong)
        snprintf(reason, reason_size, "%s: at byte %lld: %s", path, scan.at, wrong);
    return wrong ? -1 : 0;
}
