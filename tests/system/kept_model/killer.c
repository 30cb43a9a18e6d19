#include "killer.h"

#include <dirent.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/inotify.h>
#include <time.h>
#include <unistd.h>

static const int patience_ms = 10000; /* for a file to be made */

static void sleep_us(int64_t us)
{
    const struct timespec time = {.tv_sec = us / 1000000, .tv_nsec = us % 1000000 * 1000};

    nanosleep(&time, NULL);
}

static bool is_aside(const char *name)
{
    size_t length = strlen(name);

    return length > 4 && strcmp(name + length - 4, ".new") == 0;
}

static void wait_for_file(int watch)
{
    _Alignas(struct inotify_event) char bytes[4096];
    struct pollfd ready = {.fd = watch, .events = POLLIN};

    while (poll(&ready, 1, patience_ms) > 0) {
        ssize_t got = read(watch, bytes, sizeof bytes);
        for (char *at = bytes; at < bytes + got;) {
            const struct inotify_event *event = (const void *)at;
            if (event->len > 0 && is_aside(event->name))
                return;
            at += sizeof *event + event->len;
        }
    }
}

static void *run(void *user)
{
    const struct killer *killer = user;

    sleep_us(killer->after_us);
    if (killer->directory) {
        int watch = inotify_init1(IN_CLOEXEC);
        inotify_add_watch(watch, killer->directory, IN_CREATE);
        wait_for_file(watch);
        close(watch);
        sleep_us(killer->into_us);
    }
    kill(killer->pid, SIGKILL);
    return NULL;
}

void killer_start(struct killer *killer)
{
    pthread_create(&killer->thread, NULL, run, killer);
}

void killer_join(struct killer *killer)
{
    pthread_join(killer->thread, NULL);
}

bool killer_left_a_file(const char *directory)
{
    DIR *entries = opendir(directory);
    const struct dirent *entry;
    bool found = false;

    while (entries && (entry = readdir(entries)))
        found |= is_aside(entry->d_name);
    if (entries)
        closedir(entries);
    return found;
}
