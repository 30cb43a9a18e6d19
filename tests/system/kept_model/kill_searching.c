/* kill -9 while a body is searched for: a real reachd on an arm of six joints, a real reach-finder
 * beside it. The daemon is killed at every stage of a search in turn: when it has asked, when the
 * finder is at work, about the time of its answer, when the body was taken, and at any time. After
 * each kill the model on disk must have every stored sample and every body that was told of, and
 * the hash of a learner that was never interrupted. When all stages had their turn a new model
 * begins. Then the finder is killed in its work. usage: kill_searching REACHD CONFIG FINDER KILLS
 * [SEED] */
#include "common/base/random.h"
#include "killer.h"
#include "trial.h"

#include "common/bus/open.h"
#include "learner/bus/body_answer.h"

#include <reach_body_t.h>
#include <reach_trace_t.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum stage { ASKED, SEARCHED, ANSWERED, TAKEN, ANY_TIME, STAGES };

static const char *const stage_names[STAGES] = {"asked", "at work", "answered", "taken",
                                                "at any time"};
/* After what is heard of it, at most; us. The thread that takes answers looks every 20 ms. */
static const int64_t latest_us[STAGES] = {2000, 20000, 60000, 5000, 1500000};
static const int64_t patience_us = 10000000; /* for a stage to come */
static const int64_t answer_us = 30000000;   /* for a finder that was started again */
static const double noise = 5e-4;            /* m */
/* One start is enough here, and the rivals that are looked for take most of a search's time. */
static const char few_starts[] = "learner.body.starts=4";

struct searching {
    struct trial trial;
    struct random_state random;
    struct chain arm;
    const char *finder_program;
    pid_t finder;

    /* This round's: */
    enum stage stage;
    bool due; /* the killer is on its way */
    struct killer killer;
    uint64_t learned; /* in ticks that were told of */

    struct received_body answer; /* newest */
    bool kills_finder;           /* instead of the daemon */
    bool answered;               /* since the finder was started again */
    int killed[STAGES], told, untold, repeated;
};

static void start_finder(struct searching *searching)
{
    searching->finder = fork();
    if (searching->finder != 0)
        return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (freopen(searching->trial.log, "a", stderr))
        execl(searching->finder_program, searching->finder_program, (char *)NULL);
    _exit(127);
}

static void end_finder(struct searching *searching)
{
    kill(searching->finder, SIGKILL);
    waitpid(searching->finder, NULL, 0);
}

static void reached(struct searching *searching, enum stage stage)
{
    if (searching->due || searching->stage != stage)
        return;
    searching->due = true;
    searching->killer = (struct killer){
        .pid = searching->trial.daemon.pid,
        .after_us = (int64_t)random_uniform(&searching->random, 0, (double)latest_us[stage])};
    killer_start(&searching->killer);
}

static void on_request(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    (void)message;
    (void)channel;
    reached(user, ASKED);
}

static void on_work(struct searching *searching)
{
    if (searching->kills_finder) {
        searching->kills_finder = false;
        end_finder(searching);
        start_finder(searching);
    }
    reached(searching, SEARCHED);
}

static void on_answer(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct searching *searching = user;
    struct reference *reference = &searching->trial.reference;
    struct received_body *answer = &searching->answer;

    (void)channel;
    if (!body_answer_read(message->data, message->data_size, answer))
        trial_fail(&searching->trial, "an answer cannot be read");
    if (answer->answer.kind != BODY_ANSWER_REPORT) {
        on_work(searching);
        return;
    }
    searching->answered = true;
    if (answer->answer.report.outcome == FINDER_FOUND) {
        reference->maybe = true;
        reference->found = answer->answer.body;
        reached(searching, ANSWERED);
    }
}

static void on_trace(const lcm_recv_buf_t *message, const char *channel, const reach_trace_t *trace,
                     void *user)
{
    struct searching *searching = user;
    struct reference *reference = &searching->trial.reference;

    (void)message;
    (void)channel;
    reference->told = searching->trial.base + searching->learned;
    if (trace->body > 0) {
        if ((uint32_t)trace->body_checksum != searching->answer.answer.checksum)
            trial_fail(&searching->trial, "a body was taken that nobody has found");
        reference_give(reference, reference->told, &reference->found);
        reference->maybe = false;
        reached(searching, TAKEN);
    }
    searching->learned += (uint64_t)trace->learned;
}

/* The arm of etc/robots/sixaxis.urdf, roughly: nobody has to know it. */
static void make_arm(struct chain *arm)
{
    static const double axis[6][3] = {{0, 0, 1}, {0, 1, 0}, {0, 1, 0},
                                      {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    static const double offset[6][3] = {{0, 0, 0.2}, {0.05, 0, 0.1}, {0, 0, 0.3},
                                        {0.1, 0, 0}, {0.2, 0, 0},    {0.08, 0, 0}};

    arm->n = 6;
    memcpy(arm->axis, axis, sizeof axis);
    memcpy(arm->offset, offset, sizeof offset);
}

static void begin_round(struct searching *searching)
{
    searching->due = false;
    searching->learned = 0;
    searching->trial.reference.maybe = false;
    searching->trial.reference.told = searching->trial.base;
    trial_start(&searching->trial);
    reached(searching, ANY_TIME);
}

static void kill_once(struct searching *searching)
{
    struct trial *trial = &searching->trial;

    begin_round(searching);
    trial_live(trial, bus_monotonic_us() + patience_us, NULL);
    if (searching->due)
        killer_join(&searching->killer);
    if (reachd_process_end(&trial->daemon, SIGKILL) != SIGKILL)
        trial_fail(trial, "the daemon ended by itself");
    trial_listen_to_the_rest(trial);
}

/* Again from the same files, if the round says nothing. */
static void kill_and_judge(struct searching *searching)
{
    struct trial *trial = &searching->trial;
    const uint64_t stored = trial->stored;
    const int bodies = trial->reference.n_bodies;
    char before[100];

    snprintf(before, sizeof before, "%s.before", trial->directory);
    trial_copy(trial->directory, before);
    for (kill_once(searching); !trial_judge(trial); kill_once(searching)) {
        trial_copy("", trial->directory);
        trial_copy(before, trial->directory);
        trial->stored = stored;
        trial->reference.heard = trial->base;
        trial->reference.n_bodies = bodies;
        searching->repeated++;
    }
    searching->untold += trial->reference.maybe;
    searching->killed[searching->stage] += searching->due;
    trial_copy("", before);
}

static void begin_anew(struct searching *searching)
{
    searching->told += searching->trial.reference.n_bodies;
    trial_begin_anew(&searching->trial);
}

static bool answered_again(const struct trial *trial)
{
    const struct searching *searching = (const struct searching *)trial;

    return searching->answered && !searching->kills_finder;
}

/* The daemon asks again, and loses nothing. */
static void kill_finder(struct searching *searching)
{
    struct trial *trial = &searching->trial;

    searching->stage = STAGES;
    searching->kills_finder = true;
    searching->answered = false;
    begin_round(searching);
    trial_live(trial, bus_monotonic_us() + answer_us, answered_again);
    if (!answered_again(trial))
        trial_fail(trial, "a finder that was killed and started again has not answered");
    trial_end_well(trial);
}

static void prepare(struct searching *searching, char **argv)
{
    struct trial *trial = &searching->trial;
    lcm_t *lcm;

    trial_prepare(trial, argv[1], argv[2], few_starts);
    make_arm(&searching->arm);
    trial->robot.robot.chain = &searching->arm;
    trial->robot.robot.noise = noise;
    searching->finder_program = argv[3];
    lcm = trial->robot.lcm;
    lcm_subscribe(lcm, "REACH_BODY_REQUEST", on_request, searching);
    lcm_subscribe(lcm, "REACH_BODY", on_answer, searching);
    reach_trace_t_subscribe(lcm, "REACH_TRACE", on_trace, searching);
    start_finder(searching);
}

/* Returns the exit status. */
static int report(const struct searching *searching)
{
    const struct trial *trial = &searching->trial;
    int told = searching->told + trial->reference.n_bodies;
    bool failed = told + searching->untold == 0;

    for (int stage = 0; stage < STAGES; stage++) {
        printf("  %d killed: %s\n", searching->killed[stage], stage_names[stage]);
        failed |= searching->killed[stage] == 0;
    }
    printf("  every stored sample there, hash of the uninterrupted run; %llu samples in the last "
           "one\n",
           (unsigned long long)trial->base);
    printf("  %d bodies told of, %d taken by a daemon that could not tell; %d rounds repeated\n",
           told, searching->untold, searching->repeated);
    if (failed)
        printf("FAILED: a stage was never met, or no body was taken\n");
    return failed;
}

int main(int argc, char **argv)
{
    static struct searching searching;
    int wanted = argc > 4 ? atoi(argv[4]) : 0;
    long long seed = argc > 5 ? atoll(argv[5]) : (long long)time(NULL);

    if (wanted < STAGES) {
        fprintf(stderr, "usage: kill_searching REACHD CONFIG FINDER KILLS [SEED]\n");
        return 2;
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    printf("kill_searching: seed %lld\n", seed);
    searching.random = random_seed(seed);
    prepare(&searching, argv);
    for (int n = 0; n < wanted; n++) {
        searching.stage = (enum stage)(n % STAGES);
        if (searching.stage == 0 && n > 0) /* the more samples, the rarer are searches */
            begin_anew(&searching);
        kill_and_judge(&searching);
    }
    kill_finder(&searching);
    end_finder(&searching);
    trial_clean(&searching.trial);
    return report(&searching);
}
