#include "trial.h"

#include "common/bus/open.h"
#include "daemon/config/load.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

void trial_fail(const struct trial *trial, const char *what)
{
    printf("FAILED: %s\n  model in %s, log %s; %llu samples at start, %llu heard, %llu stored\n",
           what, trial->directory, trial->log, (unsigned long long)trial->base,
           (unsigned long long)trial->reference.heard, (unsigned long long)trial->stored);
    exit(1);
}

static void hear(void *user, const reach_sample_t *sample)
{
    struct trial *trial = user;

    if (sample->seq != ++trial->sample_seq)
        trial_fail(trial, "the bus lost a sample; the test cannot go on");
    reference_hear(&trial->reference, sample);
}

void trial_prepare(struct trial *trial, const char *reachd, const char *config, const char *setting)
{
    const char *const options[] = {"--config", config,
                                   "--set",    trial->set_directory,
                                   "--set",    "model.snapshot=8",
                                   "--set",    "model.snapshot_budget=0",
                                   "--set",    "model.sync=0.01",
                                   "--set",    "fixation.frames=3",
                                   "--set",    "babble.tolerance=3",
                                   "--set",    setting};
    const size_t n = sizeof options / sizeof options[0];
    char error[500];

    _Static_assert(sizeof options / sizeof options[0] + 2 <
                       sizeof trial->options / sizeof trial->options[0],
                   "one more, and the end");
    memcpy(trial->options, options, sizeof options);
    if (!setting)
        trial->options[n - 2] = NULL;
    strcpy(trial->directory, "/tmp/reach-kept-XXXXXX");
    if (!mkdtemp(trial->directory) ||
        config_load(&trial->config, &config, 1, &setting, setting != NULL, error, sizeof error))
        trial_fail(trial, "cannot begin");
    snprintf(trial->log, sizeof trial->log, "%s.log", trial->directory);
    snprintf(trial->set_directory, sizeof trial->set_directory, "model.directory=%s",
             trial->directory);
    trial->daemon =
        (struct reachd_process){.program = reachd, .options = trial->options, .log = trial->log};
    reference_init(&trial->reference, &trial->config);
    robot_on_bus_init(&trial->robot, &trial->config, hear, trial);
    trial->robot.robot.noise = 0.3;
}

void trial_clean(struct trial *trial)
{
    trial_copy("", trial->directory);
    trial_copy("", trial->log);
}

void trial_begin_anew(struct trial *trial)
{
    trial_copy("", trial->directory);
    if (mkdir(trial->directory, 0700))
        trial_fail(trial, "cannot make the directory again");
    reference_forget(&trial->reference);
    trial->stored = trial->base = 0;
}

void trial_start(struct trial *trial)
{
    trial->sample_seq = 0;
    trial->robot.status.seq = 0;
    trial->robot.status.state_seq = trial->robot.command.state_seq = 0;
    reachd_process_start(&trial->daemon);
}

static bool arm_moves(const struct robot_on_bus *robot)
{
    for (int i = 0; i < config_arm_joints(robot->robot.config); i++)
        if (robot->command.velocity[i] != 0)
            return true;
    return false;
}

static void look_at_status(struct trial *trial)
{
    const reach_status_t *status = &trial->robot.status;

    if (status->seq == 0)
        return;
    if (status->seq == 1 && (uint64_t)status->model_samples != trial->base)
        trial_fail(trial, "the daemon starts with another number of samples than was on disk");
    if ((uint64_t)status->samples_stored > trial->stored)
        trial->stored = (uint64_t)status->samples_stored;
}

int64_t trial_live(struct trial *trial, int64_t until, trial_enough_fn *enough)
{
    struct robot_on_bus *robot = &trial->robot;
    int64_t start = bus_monotonic_us();
    int64_t moved = 0;

    while (!reachd_process_ended(&trial->daemon) && bus_monotonic_us() < until) {
        bool answered = robot_on_bus_ask(robot, 20);
        look_at_status(trial);
        if (!answered)
            continue;
        if (!moved && arm_moves(robot))
            moved = bus_monotonic_us() - start;
        if (enough && enough(trial))
            break;
        if (robot->status.behaviour == REACH_STATUS_T_NONE && robot->status.seq % 5 == 1)
            robot_on_bus_request(robot, REACH_REQUEST_T_BABBLE, 1000000);
        robot_on_bus_move(robot);
    }
    return moved;
}

void trial_listen_to_the_rest(struct trial *trial)
{
    while (robot_on_bus_listen(&trial->robot, 20))
        look_at_status(trial);
}

bool trial_judge(struct trial *trial)
{
    uint64_t samples, hash;

    if (!reachd_process_check(&trial->daemon, &samples, &hash))
        trial_fail(trial, "the model on disk is refused");
    if (samples < trial->stored)
        trial_fail(trial, "samples that were stored are not there");
    if (samples > trial->reference.heard + 1)
        trial_fail(trial, "the model has samples that there never were");
    if (samples > trial->reference.heard)
        return false;
    if (!reference_agrees(&trial->reference, samples, hash))
        trial_fail(trial, "the model is another than that of an uninterrupted run");
    trial->base = samples;
    return true;
}

void trial_end_well(struct trial *trial)
{
    if (reachd_process_end(&trial->daemon, SIGTERM) != 0)
        trial_fail(trial, "the daemon did not end well");
    trial_listen_to_the_rest(trial);
    trial->stored = trial->reference.heard;
    if (!trial_judge(trial))
        trial_fail(trial, "a sample was learned that was never announced");
}

void trial_copy(const char *from, const char *to)
{
    char command[400];

    snprintf(command, sizeof command, "rm -rf %s && test -z \"%s\" || cp -a %s %s", to, from, from,
             to);
    if (system(command))
        exit(1);
}
