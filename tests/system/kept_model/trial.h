/* What both tests of a kept model share: a real reachd that learns from the fake robot over LCM, in
 * lockstep, and the uninterrupted learner that its model on disk is compared with. */
#ifndef REACH_TEST_TRIAL_H
#define REACH_TEST_TRIAL_H

#include "reachd_process.h"
#include "reference.h"
#include "robot_on_bus.h"

#include <stdbool.h>
#include <stdint.h>

struct trial {
    char directory[64]; /* of the model */
    char log[80];       /* of the daemons */
    char set_directory[100];
    const char *options[32]; /* ends with NULL; room for one that a test adds */
    struct config config;
    struct reachd_process daemon;
    struct robot_on_bus robot;
    struct reference reference;
    int64_t sample_seq; /* of the newest sample of this daemon */
    uint64_t stored;    /* greatest number that a status counted as stored */
    uint64_t base;      /* samples of the model that this daemon started with */
};

/* Ends the program, with the files left in place. */
_Noreturn void trial_fail(const struct trial *trial, const char *what);

/* An empty directory, a robot on the bus. `setting` is an option of the daemon's, NAME=VALUE, kept,
 * not copied; NULL: none. */
void trial_prepare(struct trial *trial, const char *reachd, const char *config,
                   const char *setting);
void trial_clean(struct trial *trial);

/* The directory is empty again, and the reference knows nothing. */
void trial_begin_anew(struct trial *trial);

void trial_start(struct trial *trial);

/* The robot lives while the daemon does, at most until a monotonic time or until `enough`, if it is
 * given, says so. Returns the time from now to the first motion of the arm, 0 = none came; us. */
typedef bool trial_enough_fn(const struct trial *trial);
int64_t trial_live(struct trial *trial, int64_t until, trial_enough_fn *enough);

/* Takes in what a daemon had said before it ended. */
void trial_listen_to_the_rest(struct trial *trial);

/* Compares what is on disk with the reference, and ends the program where it differs. Returns false
 * when nothing can be said: the disk has a sample whose message died with the daemon. */
bool trial_judge(struct trial *trial);

/* Ends the daemon as a service is ended: nothing at all may be lost. Ends the program where
 * something is. */
void trial_end_well(struct trial *trial);

/* Makes directory `to` a copy of `from`; an empty `from` only removes it. */
void trial_copy(const char *from, const char *to);

#endif
