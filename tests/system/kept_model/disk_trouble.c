/* A disk that is full, a directory that is read-only, a second daemon on the same model, a file
 * that is damaged: what a real reachd does about each, on a small file system of our own. usage:
 * disk_trouble REACHD CONFIG */
#include "trial.h"

#include "common/bus/open.h"

#include <fcntl.h>
#include <glob.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static const int64_t patience_us = 30000000;
static int64_t seq_then;
static uint64_t samples_then;

/* In a mount namespace of our own: nobody else sees it, and it goes with us. */
static void mount_small_disk(const struct trial *trial)
{
    if (unshare(CLONE_NEWNS) || mount(NULL, "/", NULL, MS_REC | MS_PRIVATE, NULL) ||
        mount("none", trial->directory, "tmpfs", 0, "size=8m")) {
        perror("disk_trouble: cannot mount a file system");
        exit(1);
    }
}

static void make_read_only(const struct trial *trial, bool read_only)
{
    if (mount(NULL, trial->directory, NULL, MS_REMOUNT | (read_only ? MS_RDONLY : 0), NULL))
        trial_fail(trial, "cannot remount");
}

static void path_in(const struct trial *trial, const char *name, char *path, size_t size)
{
    snprintf(path, size, "%s/%s", trial->directory, name);
}

/* Takes every byte that is left. */
static void fill(const struct trial *trial)
{
    static const char bytes[4096];
    char path[100];
    int file;

    path_in(trial, "filler", path, sizeof path);
    file = open(path, O_WRONLY | O_CREAT, 0644);
    while (write(file, bytes, sizeof bytes) > 0)
        ;
    close(file);
}

static void live_until(struct trial *trial, trial_enough_fn *enough, const char *what)
{
    trial_live(trial, bus_monotonic_us() + patience_us, enough);
    if (reachd_process_ended(&trial->daemon) || !enough(trial))
        trial_fail(trial, what);
}

static bool stores_some(const struct trial *trial)
{
    return trial->robot.status.storing && trial->stored >= trial->base + 20;
}

static bool does_not_store(const struct trial *trial)
{
    return !trial->robot.status.storing && trial->robot.status.seq > 50;
}

static bool has_gone_on(const struct trial *trial)
{
    return trial->robot.status.seq > seq_then + 500 &&
           (uint64_t)trial->robot.status.model_samples >= samples_then + 20;
}

static bool stores_again(const struct trial *trial)
{
    const reach_status_t *status = &trial->robot.status;

    return status->storing && status->samples_stored == status->model_samples &&
           status->samples_stored > (int64_t)samples_then;
}

/* Control and learning go on, and nothing counts as stored. */
static void goes_on_without(struct trial *trial)
{
    uint64_t stored = trial->stored;

    seq_then = trial->robot.status.seq;
    samples_then = (uint64_t)trial->robot.status.model_samples;
    live_until(trial, has_gone_on, "control or learning stopped with the disk");
    if (trial->stored != stored || trial->robot.status.storing)
        trial_fail(trial, "samples count as stored that cannot be");
}

static void has_said(const struct trial *trial, const char *text)
{
    char command[300];

    snprintf(command, sizeof command, "grep -q '%s' %s", text, trial->log);
    if (system(command)) {
        printf("not in the log: %s\n", text);
        trial_fail(trial, "the log does not say why");
    }
}

static void kill_and_judge(struct trial *trial)
{
    reachd_process_end(&trial->daemon, SIGKILL);
    trial_listen_to_the_rest(trial);
    if (!trial_judge(trial))
        trial_fail(trial, "a sample was stored that was never announced");
}

static void full_disk(struct trial *trial)
{
    char path[100];

    trial_start(trial);
    live_until(trial, stores_some, "nothing is stored");
    fill(trial);
    live_until(trial, does_not_store, "a full disk is not noticed");
    goes_on_without(trial);
    has_said(trial, "No space left on device; what is learned from here");
    path_in(trial, "filler", path, sizeof path);
    unlink(path);
    live_until(trial, stores_again, "nothing is stored when there is space again");
    has_said(trial, "stored again");
    kill_and_judge(trial);
    puts("a full disk: control goes on, storing resumes, nothing is lost by kill -9");
}

static void read_only_directory(struct trial *trial)
{
    uint64_t base = trial->base;

    make_read_only(trial, true);
    trial_start(trial);
    live_until(trial, does_not_store, "a read-only directory is not noticed");
    if ((uint64_t)trial->robot.status.model_samples < base)
        trial_fail(trial, "a read-only model is not read");
    goes_on_without(trial);
    has_said(trial, "Read-only file system; what is learned from here");
    kill_and_judge(trial);
    make_read_only(trial, false);
    if (trial->base != base)
        trial_fail(trial, "a read-only model has changed");
    puts("a read-only directory: the model is used, control goes on");
}

/* One option more. Returns where it is. */
static int add_option(struct trial *trial, const char *option, const char *value)
{
    int n = 0;

    while (trial->options[n])
        n++;
    trial->options[n] = option;
    trial->options[n + 1] = value;
    return n;
}

/* Starts a daemon that must refuse. */
static void refuses(struct trial *trial, const char *option, const char *value, const char *why)
{
    struct reachd_process other = trial->daemon;
    int n = add_option(trial, option, value);

    reachd_process_start(&other);
    for (int i = 0; i < 1000 && !reachd_process_ended(&other); i++)
        usleep(10000);
    if (!reachd_process_ended(&other) || WEXITSTATUS(reachd_process_end(&other, 0)) != 1)
        trial_fail(trial, "a daemon has started that should refuse");
    trial->options[n] = NULL;
    has_said(trial, why);
}

static void second_daemon(struct trial *trial)
{
    trial_start(trial);
    live_until(trial, stores_some, "nothing is stored");
    refuses(trial, "--url", "udpm://239.255.76.67:7999?ttl=0",
            "another program keeps its model there");
    kill_and_judge(trial);
    puts("a second daemon on another bus: refused");
}

static void other_parameters(struct trial *trial)
{
    refuses(trial, "--set", "learner.alpha=0.95", "imle: saved with other parameters");
    if (!trial_judge(trial))
        trial_fail(trial, "a refusal has changed the model");
    puts("other parameters: refused, nothing changed");
}

/* The newest journal of the model: the one whose name sorts last. */
static void newest_journal(const struct trial *trial, char *path, size_t size)
{
    char pattern[100];
    glob_t found;

    path_in(trial, "*.journal", pattern, sizeof pattern);
    if (glob(pattern, 0, NULL, &found) != 0)
        trial_fail(trial, "there is no journal");
    snprintf(path, size, "%s", found.gl_pathv[found.gl_pathc - 1]);
    globfree(&found);
}

/* A snapshot begins an empty journal: whether the newest one has a record depends on the moment. */
static bool newest_journal_has_records(const struct trial *trial)
{
    const off_t some = 500; /* bytes */
    char path[200];
    struct stat status;

    if (!stores_some(trial))
        return false;
    newest_journal(trial, path, sizeof path);
    return stat(path, &status) == 0 && status.st_size > some;
}

static void damaged_journal(struct trial *trial)
{
    const off_t in_first_record = 60;
    char path[200];
    int file;

    trial_start(trial);
    live_until(trial, newest_journal_has_records, "nothing is in a journal");
    reachd_process_end(&trial->daemon, SIGKILL); /* which has no time for a snapshot */
    newest_journal(trial, path, sizeof path);
    file = open(path, O_WRONLY);
    if (file < 0 || pwrite(file, "\377", 1, in_first_record) != 1 || close(file))
        trial_fail(trial, "cannot damage the journal");
    refuses(trial, "--verbose", NULL, "journal: at byte 32: damaged");
    puts("a damaged journal: refused with file, offset and reason");
}

int main(int argc, char **argv)
{
    static struct trial trial;

    if (argc != 3) {
        fprintf(stderr, "usage: disk_trouble REACHD CONFIG\n");
        return 2;
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    trial_prepare(&trial, argv[1], argv[2], NULL);
    mount_small_disk(&trial);
    full_disk(&trial);
    read_only_directory(&trial);
    second_daemon(&trial);
    other_parameters(&trial);
    damaged_journal(&trial);
    umount2(trial.directory, MNT_DETACH);
    trial_clean(&trial);
    return 0;
}
