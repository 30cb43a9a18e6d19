/* kill -9 at random instants: a real reachd is killed while it learns, and is started again, many
 * times. After each kill the model on disk must have every sample that a status had counted as
 * stored, and the hash that an uninterrupted learner has at its number of samples.
 *   usage: kill_daemon REACHD CONFIG KILLS [SEED] */
#include "common/base/random.h"
#include "killer.h"
#include "trial.h"

#include "common/bus/open.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define KILLS_MOST 10000

static const int64_t latest_us = 900000;      /* of a kill, after the start */
static const int64_t longest_into_us = 150;   /* of a kill within a snapshot, after its begin */
static const double least_in_snapshot = 0.25; /* share of the kills */
static const double control_within = 1;       /* of a warm restart, s */

struct kills {
    struct trial trial;
    struct random_state random;
    int in_snapshot, while_starting, repeated;
    int n_times;
    int64_t times[KILLS_MOST]; /* from start to the first motion of the arm, us */
};

static int64_t kill_once(struct kills *kills, bool in_snapshot)
{
    struct trial *trial = &kills->trial;
    struct random_state *random = &kills->random;
    struct killer killer = {.after_us = (int64_t)random_uniform(random, 0, latest_us),
                            .directory = in_snapshot ? trial->directory : NULL,
                            .into_us = (int64_t)random_uniform(random, 0, longest_into_us)};
    int64_t moved;

    trial->robot.robot.tool = 0.03 * (double)(random_bits(random) % 25) - 0.3;
    trial_start(trial);
    killer.pid = trial->daemon.pid;
    killer_start(&killer);
    moved = trial_live(trial, INT64_MAX, NULL);
    killer_join(&killer);
    if (reachd_process_end(&trial->daemon, SIGKILL) != SIGKILL)
        trial_fail(trial, "the daemon ended by itself");
    trial_listen_to_the_rest(trial);
    return moved;
}

/* Again from the same files, if the round says nothing. */
static void kill_and_judge(struct kills *kills, bool in_snapshot)
{
    struct trial *trial = &kills->trial;
    const uint64_t stored = trial->stored;
    char before[100];
    int64_t moved;

    snprintf(before, sizeof before, "%s.before", trial->directory);
    trial_copy(trial->directory, before);
    for (;;) {
        moved = kill_once(kills, in_snapshot);
        if (trial_judge(trial))
            break;
        trial_copy(before, trial->directory);
        trial->stored = stored;
        trial->reference.heard = trial->base;
        kills->repeated++;
    }
    if (moved)
        kills->times[kills->n_times++] = moved;
    else
        kills->while_starting++;
    kills->in_snapshot += killer_left_a_file(trial->directory);
    trial_copy("", before);
}

/* Ended as a service is ended: nothing at all is lost. */
static void end_well(struct trial *trial)
{
    trial_start(trial);
    trial_live(trial, bus_monotonic_us() + 2 * latest_us, NULL);
    trial_end_well(trial);
}

static int compare(const void *a, const void *b)
{
    int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;

    return (x > y) - (x < y);
}

/* The time that a share of the starts took at most, s. */
static double start_time(const struct kills *kills, double share)
{
    int index = (int)(share * (kills->n_times - 1));

    return kills->n_times > 0 ? (double)kills->times[index] * 1e-6 : 0;
}

/* Returns the exit status. */
static int report(struct kills *kills, int n, int least)
{
    const struct trial *trial = &kills->trial;

    qsort(kills->times, (size_t)kills->n_times, sizeof kills->times[0], compare);
    printf("%d of %d kills: every stored sample there, hash of the uninterrupted run\n", n, n);
    printf("  %d within a snapshot, %d before the arm moved; %d rounds repeated\n",
           kills->in_snapshot, kills->while_starting, kills->repeated);
    printf("  %llu samples in the end, %d experts\n", (unsigned long long)trial->base,
           learner_get_statistics(trial->reference.learner).experts);
    printf("  from start to motion of the arm: median %.2f s, 90 %% within %.2f s, most %.2f s; %d "
           "starts\n",
           start_time(kills, 0.5), start_time(kills, 0.9), start_time(kills, 1), kills->n_times);
    if (kills->in_snapshot < least)
        printf("FAILED: too few kills within a snapshot, at least %d are wanted\n", least);
    if (start_time(kills, 0.9) > control_within)
        printf("FAILED: warm restarts take longer than a second\n");
    return kills->in_snapshot < least || start_time(kills, 0.9) > control_within;
}

int main(int argc, char **argv)
{
    static struct kills kills;
    int wanted = argc > 3 ? atoi(argv[3]) : 0;
    int n;
    long long seed = argc > 4 ? atoll(argv[4]) : (long long)time(NULL);

    if (wanted < 1 || wanted > KILLS_MOST / 3) {
        fprintf(stderr, "usage: kill_daemon REACHD CONFIG KILLS [SEED]\n");
        return 2;
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    printf("kill_daemon: seed %lld\n", seed);
    kills.random = random_seed(seed);
    trial_prepare(&kills.trial, argv[1], argv[2], NULL);
    for (n = 0; n < wanted; n++)
        kill_and_judge(&kills, n % 5 < 3);
    /* A snapshot is short, and the killer may wake too late: more of those, until they are enough.
     */
    for (; kills.in_snapshot < least_in_snapshot * wanted && n < 3 * wanted; n++)
        kill_and_judge(&kills, true);
    end_well(&kills.trial);
    trial_clean(&kills.trial);
    return report(&kills, n, (int)(least_in_snapshot * wanted));
}
