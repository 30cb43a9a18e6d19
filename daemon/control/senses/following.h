/* Whether the joints follow what they are told: commanded against measured motion, joint by joint,
 * over some tenths of a second. Plain data; used by the loop thread alone.
 *
 * Motion may come late by anything up to safety.latency and two periods, so the measured motion is
 * held against the whole span of what was commanded with each of these delays. A joint follows when
 * it is within safety.following of that span, and within half of what was commanded more.
 *
 * A joint that has not followed for a second of motion since the start is at fault at once: so the
 * errors of a first day are found. One that has may be held by something, since arms do touch the
 * body that they are on; it is at fault after safety.following_time. */
#ifndef REACH_DAEMON_CONTROL_SENSES_FOLLOWING_H
#define REACH_DAEMON_CONTROL_SENSES_FOLLOWING_H

#include "daemon/config/config.h"
#include "daemon/config/sizes.h"

#include <stdbool.h>

enum { FOLLOWING_KEPT = 128 /* looks, of which there are 50 a second at most */ };

/* What is wrong with a joint. */
enum following_fault {
    FOLLOWING_WELL,
    FOLLOWING_STILL,    /* it does not move: encoder stuck, motor dead, joint blocked, brake on */
    FOLLOWING_REVERSED, /* it moves the wrong way: the sign of motor or encoder */
    FOLLOWING_ASTRAY,   /* it moves too much or too little: the scale of motor or encoder */
};

struct following {
    const struct config *config;
    double total[MAX_JOINTS];                     /* sum of what was commanded so far, rad */
    int ticks;                                    /* since the newest look */
    int newest;                                   /* index into the rings below */
    int kept;                                     /* entries that count */
    double commanded[FOLLOWING_KEPT][MAX_JOINTS]; /* the sum then, rad */
    double measured[FOLLOWING_KEPT][MAX_JOINTS];  /* rad */
    double wrong[MAX_JOINTS];                     /* for how long it was moved wrongly, s */
    double well[MAX_JOINTS];                      /* for how long it followed, s */
    bool doubts;                                  /* a joint was found wrong at the newest look */
    int joint;                                    /* that does not follow, from 1; 0 = all do */
    enum following_fault fault;
    double missed; /* measured less commanded motion of that joint, rad */
};

void following_init(struct following *following, const struct config *config);

/* The motion before says nothing any more: the robot rested, was begun anew, states were lost. */
void following_forget(struct following *following);

/* A tick: the velocities (rad/s) that were in force since the last one, and the joints (rad). */
void following_look(struct following *following, const double *velocity, const double *q);

#endif
