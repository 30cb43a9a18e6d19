/* What `reachctl top` shows, and how: a frame is a function of what was heard. */
#ifndef REACHCTL_VIEW_TOP_VIEW_H
#define REACHCTL_VIEW_TOP_VIEW_H

#include "tools/reachctl/view/rates.h"

#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <reach_status_t.h>
#include <stdbool.h>
#include <stdio.h>

enum { TOP_HISTORY = 60 };

/* All zero is a fresh one. */
struct top {
    struct rates rates;
    reach_status_t status;
    reach_robot_state_t robot;
    reach_robot_command_t command;
    int64_t status_at, robot_at, command_at; /* when each came, us; 0 = never */
    double speed;               /* robot's seconds a second, in the last window; 0 = unknown */
    int64_t speed_from;         /* the robot's time when that window began, us */
    int n_errors;               /* the newest TOP_HISTORY entries of the error, a window each */
    double errors[TOP_HISTORY]; /* px, oldest first */
    int64_t lateness, late_at;  /* the longest wait of a message for us, and when it was seen, us */
    int64_t dropped; /* packets that found a full socket in this network, since the start */
};

/* Takes in a message of whatever channel. One that does not decode is counted all the same. */
void top_hear(struct top *top, const char *channel, const void *data, size_t size, int64_t now);

/* A message had waited so long for us when it was taken in, us. */
void top_note_lateness(struct top *top, int64_t waited, int64_t now);

/* To be called often: closes the window of a second when it is over. */
void top_settle(struct top *top, int64_t now);

/* Draws at most `height` lines of at most `width` characters. `terminal`: begins in the upper left
 * corner and clears what an earlier frame left, with colours; otherwise plain text. */
void top_draw(const struct top *top, int64_t now, int width, int height, bool terminal, FILE *out);

#endif
