/* A status in words, as JSON, and as a progress line. */
#ifndef REACHCTL_VIEW_SHOW_H
#define REACHCTL_VIEW_SHOW_H

#include <reach_status_t.h>
#include <stdio.h>

/* For people: a few lines. */
void show_text(const reach_status_t *status, FILE *out);

/* For programs: one JSON object with the fields of status_t, states as words. */
void show_json(const reach_status_t *status, FILE *out);

/* Rewrites one line on stderr, where that is a terminal. */
void show_progress(const reach_status_t *status);

/* One line on what a behaviour came to, with the error that it ended with: `at_work` is the last
 * status of the behaviour, `after` one without it. */
void show_end(const reach_status_t *at_work, const reach_status_t *after);

/* The words for what the daemon does. */
const char *show_state(const reach_status_t *status);
const char *show_behaviour(const reach_status_t *status);
const char *show_phase(const reach_status_t *status);

/* The error in people's units of the daemon's task space, px or mm. */
/* What is known of the robot's body, in at most `size` bytes. */
void show_body(const reach_status_t *status, char *text, size_t size);

double show_error(const reach_status_t *status);
const char *show_error_unit(const reach_status_t *status);

#endif
