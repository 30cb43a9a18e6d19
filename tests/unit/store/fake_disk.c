#include "fake_disk.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_INODES 400
#define MOST_NAMES 64
#define MOST_FILES 16
#define MOST_BYTES 16384
#define SECTOR 512

/* What a file holds, and what of it would be there after a loss of power. */
struct inode {
    int64_t written; /* the operation that did */
    size_t size, synced_size;
    bool sync_failed; /* the system has forgotten that the bytes are not on the disk */
    unsigned char now[MOST_BYTES];
    unsigned char synced[MOST_BYTES];
};

struct name {
    char text[80];
    int now, synced; /* inodes; -1 = there is no such name */
};

struct open_file {
    bool used, directory, locked;
    int inode;
    size_t at;
};

struct fake_disk fake_disk;
static struct inode inodes[MOST_INODES];
static int n_inodes;
static struct name names[MOST_NAMES];
static struct open_file open_files[MOST_FILES];

void fake_disk_reset(struct random_state random)
{
    fake_disk =
        (struct fake_disk){.dies_at = -1, .fails_at = -1, .capacity = SIZE_MAX, .random = random};
    n_inodes = 0;
    memset(names, 0, sizeof names);
    memset(open_files, 0, sizeof open_files);
}

/* Counts an operation that changes something. Returns whether it is to fail, with errno. */
static bool fails(void)
{
    long operation = fake_disk.operations++;

    errno = fake_disk.error ? fake_disk.error : EIO;
    if (fake_disk.read_only)
        errno = EROFS;
    return fake_disk.read_only || operation == fake_disk.fails_at ||
           (fake_disk.dies_at >= 0 && operation >= fake_disk.dies_at);
}

static bool dead(void)
{
    errno = EIO;
    return fake_disk.dies_at >= 0 && fake_disk.operations > fake_disk.dies_at;
}

static int some_of(int n)
{
    return (int)random_uniform(&fake_disk.random, 0, n);
}

/* An entry that is free has an empty text. */
static struct name *find(const char *text)
{
    for (int i = 0; i < MOST_NAMES; i++)
        if (strcmp(names[i].text, text) == 0)
            return &names[i];
    return NULL;
}

static struct name *find_or_make(const char *text)
{
    struct name *name = find(text);

    if (!name) {
        name = find("");
        for (int i = 0; !name && i < MOST_NAMES; i++)
            if (names[i].now < 0 && names[i].synced < 0)
                name = &names[i]; /* gone for good */
        if (!name)
            abort(); /* MOST_NAMES are too few */
        snprintf(name->text, sizeof name->text, "%s", text);
        name->now = name->synced = -1;
    }
    return name;
}

static int hand_out(struct open_file file)
{
    for (int i = 0; i < MOST_FILES; i++)
        if (!open_files[i].used) {
            open_files[i] = file;
            open_files[i].used = true;
            return i;
        }
    errno = EMFILE;
    return -1;
}

static int make(struct name *name)
{
    memset(&inodes[n_inodes], 0, sizeof inodes[n_inodes]);
    name->now = n_inodes++;
    return name->now;
}

static int fake_open(const char *path, int flags)
{
    struct name *name = find(path);
    bool there = name && name->now >= 0;

    if (dead())
        return -1;
    if (strcmp(path, FAKE_DISK_DIRECTORY) == 0)
        return hand_out((struct open_file){.directory = true});
    if (!there && !(flags & O_CREAT)) {
        errno = ENOENT;
        return -1;
    }
    if (there && (flags & O_EXCL)) {
        errno = EEXIST;
        return -1;
    }
    if ((flags & O_CREAT) && (!there || (flags & O_TRUNC))) {
        if (fails())
            return -1;
        make(find_or_make(path)); /* what was there under this name stays what was synced */
    }
    return hand_out((struct open_file){.inode = find(path)->now});
}

static ssize_t fake_read(int file, void *bytes, size_t size)
{
    const struct inode *inode = &inodes[open_files[file].inode];
    size_t left = inode->size - open_files[file].at;

    if (dead())
        return -1;
    if (size > left)
        size = left;
    memcpy(bytes, inode->now + open_files[file].at, size);
    open_files[file].at += size;
    return (ssize_t)size;
}

static size_t bytes_in_use(void)
{
    size_t sum = 0;

    for (int i = 0; i < MOST_NAMES; i++)
        if (names[i].text[0] && names[i].now >= 0)
            sum += inodes[names[i].now].size;
    return sum;
}

static ssize_t fake_write(int file, const void *bytes, size_t size)
{
    struct inode *inode = &inodes[open_files[file].inode];
    size_t used = bytes_in_use();
    size_t room = fake_disk.capacity > used ? fake_disk.capacity - used : 0;
    bool failed;

    if (dead())
        return -1;
    failed = fails();
    if (failed) /* half done */
        size = fake_disk.read_only ? 0 : (size_t)some_of((int)size);
    else if (fake_disk.short_writes && size > 1)
        size = 1 + (size_t)some_of((int)size - 1);
    if (size > room)
        size = room;
    inode->written = fake_disk.operations;
    memcpy(inode->now + inode->size, bytes, size);
    inode->size += size;
    if (!failed && size == 0)
        errno = ENOSPC;
    return failed || size == 0 ? -1 : (ssize_t)size;
}

static int fake_sync(int file)
{
    struct inode *inode = &inodes[open_files[file].inode];

    if (dead())
        return -1;
    if (fails()) {
        inode->sync_failed |= !open_files[file].directory;
        return -1;
    }
    if (open_files[file].directory) {
        for (int i = 0; i < MOST_NAMES; i++)
            names[i].synced = names[i].now;
    } else if (!inode->sync_failed) {
        memcpy(inode->synced, inode->now, inode->size);
        inode->synced_size = inode->size;
    }
    return 0;
}

static int fake_close(int file)
{
    open_files[file].used = false;
    return 0;
}

static int fake_rename(const char *from, const char *to)
{
    struct name *source = find(from);

    if (dead() || fails())
        return -1;
    if (!source || source->now < 0) {
        errno = ENOENT;
        return -1;
    }
    find_or_make(to)->now = source->now;
    source->now = -1;
    return 0;
}

static int fake_remove(const char *path)
{
    struct name *name = find(path);

    if (dead() || fails())
        return -1;
    if (!name || name->now < 0) {
        errno = ENOENT;
        return -1;
    }
    name->now = -1;
    return 0;
}

static int fake_list(const char *directory, files_name_fn *take, void *user)
{
    if (dead())
        return -1;
    for (int i = 0; i < MOST_NAMES; i++)
        if (names[i].text[0] && names[i].now >= 0)
            take(user, names[i].text + strlen(directory) + 1);
    return 0;
}

static int fake_lock(int file, bool shared)
{
    (void)shared;
    for (int i = 0; i < MOST_FILES; i++)
        if (open_files[i].used && open_files[i].locked) {
            errno = EWOULDBLOCK;
            return -1;
        }
    open_files[file].locked = true;
    return 0;
}

static int64_t fake_written(const char *path)
{
    const struct name *name = find(path);

    return name && name->now >= 0 ? inodes[name->now].written : -1;
}

const struct files fake_disk_files = {
    .open = fake_open,
    .read = fake_read,
    .write = fake_write,
    .sync = fake_sync,
    .sync_data = fake_sync,
    .close = fake_close,
    .rename = fake_rename,
    .remove = fake_remove,
    .list = fake_list,
    .written = fake_written,
    .lock = fake_lock,
};

static void back_to_synced(struct inode *inode)
{
    memcpy(inode->now, inode->synced, inode->synced_size);
    inode->size = inode->synced_size;
}

/* Of what was not synced: any length, and within it any sectors. */
static void tear(struct inode *inode)
{
    size_t most = inode->size;
    size_t length = inode->synced_size;

    if (most > length)
        length += (size_t)some_of((int)(most - length) + 1);
    for (size_t at = inode->synced_size; at < length; at++) {
        size_t end = (at / SECTOR + 1) * SECTOR;
        bool written = some_of(2);
        for (; at < length && at < end; at++)
            if (!written)
                inode->now[at] = 0;
        at--;
    }
    inode->size = length;
}

void fake_disk_crash(enum fake_disk_crash crash)
{
    fake_disk.dies_at = fake_disk.fails_at = -1;
    fake_disk.read_only = false;
    fake_disk.capacity = SIZE_MAX;
    memset(open_files, 0, sizeof open_files);
    if (crash == FAKE_DISK_KILLED)
        return;
    for (int i = 0; i < MOST_NAMES; i++)
        if (crash == FAKE_DISK_POWER_OFF || some_of(2))
            names[i].now = names[i].synced;
    for (int i = 0; i < n_inodes; i++) {
        if (crash == FAKE_DISK_POWER_OFF)
            back_to_synced(&inodes[i]);
        else
            tear(&inodes[i]);
        inodes[i].sync_failed = false;
        inodes[i].synced_size = inodes[i].size;
        memcpy(inodes[i].synced, inodes[i].now, inodes[i].size);
    }
    for (int i = 0; i < MOST_NAMES; i++)
        names[i].synced = names[i].now;
}

const char *fake_disk_name(int i)
{
    for (int k = 0; k < MOST_NAMES; k++)
        if (names[k].text[0] && names[k].now >= 0 && i-- == 0)
            return names[k].text;
    return NULL;
}

unsigned char *fake_disk_bytes(const char *name, size_t *size)
{
    const struct name *found = find(name);

    if (!found || found->now < 0)
        return NULL;
    *size = inodes[found->now].size;
    return inodes[found->now].now;
}

void fake_disk_truncate(const char *name, size_t size)
{
    inodes[find(name)->now].size = size;
}

static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 1099511628211ULL;
    return hash;
}

uint64_t fake_disk_hash(void)
{
    uint64_t hash = 14695981039346656037ULL;
    const char *name;

    for (int i = 0; (name = fake_disk_name(i)); i++) {
        size_t size = 0;
        const unsigned char *bytes = fake_disk_bytes(name, &size);
        hash = hash_bytes(hash_bytes(hash, name, strlen(name)), bytes, size);
    }
    return hash;
}
