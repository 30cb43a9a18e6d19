/* What the eyes have told: the newest marker, carried to the present, and whether it is fixated.
 *
 * A marker is one to three periods old when it arrives. It is carried to now by what the joints
 * have done since its exposure, so that control meets less delay (the head's own turn, and the
 * arm's motion through the learned Jacobian). Used by the loop thread alone. */
#ifndef REACH_DAEMON_CONTROL_SENSES_SIGHT_H
#define REACH_DAEMON_CONTROL_SENSES_SIGHT_H

#include "daemon/config/config.h"
#include "daemon/config/sizes.h"
#include "daemon/config/space.h"
#include "daemon/control/senses/joint_history.h"
#include "daemon/control/senses/observation.h"

#include <stdbool.h>

#define SIGHT_FRAMES 16 /* most frames that a sample averages */

/* One exposure in which the marker was seen. */
struct sight_frame {
    int64_t utime;                  /* us */
    double q[MAX_JOINTS];           /* all joints at the exposure, rad */
    double image[SPACE_DIMENSIONS]; /* [u_R, v_R, u_L - u_R], px; or position, m */
};

struct sight {
    const struct config *config;
    bool any;                         /* a marker was ever seen */
    bool new_frame;                   /* this tick brought a frame in which it was seen */
    int64_t newest;                   /* exposure of the newest marker, seen or not, us */
    bool newest_seen;                 /* whether that one was seen */
    int count;                        /* frames seen in a row, up to SIGHT_FRAMES */
    int last;                         /* index of the newest frame */
    double carried[SPACE_DIMENSIONS]; /* newest seen marker at now, px or m */
    struct sight_frame frame[SIGHT_FRAMES];
};

void sight_init(struct sight *sight, const struct config *config);

/* Takes a marker in; `history` gives the joints at its exposure. A marker whose exposure is not
 * after the newest one, or lies outside the history, is ignored. Returns whether it was used. */
bool sight_observe(struct sight *sight, const struct observation *marker,
                   const struct history *history);

/* Carries the newest frame to joints q. `jacobian` (3 x arm joints, row-major, rad and px per
 * rad) is that of the solution in use, NULL when there is none. */
void sight_carry(struct sight *sight, const double *q, const double *jacobian);

/* The newest marker was seen and is not stale at `now`. */
bool sight_seen(const struct sight *sight, int64_t now);

/* Frames that one sample averages: fixation.frames, or one where nothing is to be fixated. */
int sight_pair_frames(const struct config *config);

/* Fixation (paper section 5.2.1): over the last fixation.frames exposures in a row the marker's
 * mean lies within fixation.tolerance of the image centre and its spread, and the joints', within
 * fixation.rest. Where the task space needs none: something was seen. */
bool sight_fixated(const struct sight *sight);

/* The newest frame alone lies within fixation.tolerance: for learning while moving. Where the
 * task space needs no fixation it always does. */
bool sight_centred(const struct sight *sight);

/* The newest frame lies within `pixels` of the centre; always, where nothing is to be fixated. */
bool sight_within(const struct sight *sight, double pixels);

/* How far the marker is from the image centre by now, px. */
double sight_eccentricity(const struct sight *sight);

/* Where the end-effector is by now in task space (space.h), as it was last seen, with all joints at
 * q (rad). Off the image centre this is as good as eq. 11's relation is. */
void sight_position(const struct sight *sight, const double *q, double x[SPACE_DIMENSIONS]);

/* One training pair from the last n frames, oldest to newest: arm joints q (rad), measured task
 * position x (space.h) and the middle of the exposures. What
 * is left between marker and image centre is added to the head's angles.
 * n is 1 .. the frames seen in a row. */
void sight_pair(const struct sight *sight, int n, double *q, double *x, int64_t *utime);

#endif
