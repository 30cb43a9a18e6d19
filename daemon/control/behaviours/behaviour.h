/* What the robot wants now. Each behaviour is one small file behind one ops table.
 *
 * A behaviour sees the senses through `struct control` and writes what it wants there; it reads no
 * clock, does no input or output, and knows nothing of motors' limits (motion.h, safety.h). */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_BEHAVIOUR_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_BEHAVIOUR_H

#include "common/base/random.h"
#include "daemon/config/config.h"
#include "daemon/control/behaviours/explore.h"
#include "daemon/control/behaviours/gaze.h"
#include "daemon/control/behaviours/tried.h"
#include "daemon/control/kinematics/estimate.h"
#include "daemon/control/senses/sight.h"

#include <reach_request_t.h>
#include <stdbool.h>
#include <stdint.h>

/* One training pair that a behaviour has gathered. */
struct pair {
    int64_t utime;         /* us */
    double q[MAX_JOINTS];  /* arm joints, rad */
    double x[MAX_OUTPUTS]; /* task position */
};

/* The senses and the wants of one tick. */
struct control {
    const struct config *config;
    int64_t now;            /* us */
    const double *q;        /* all joints, arm first, rad */
    const double *previous; /* velocities commanded in the tick before, rad/s */
    const struct sight *sight;
    struct estimate *estimate;
    struct gaze *gaze;
    struct tried *tried;

    double velocity[MAX_JOINTS];     /* wanted, all joints, rad/s */
    bool has_target;                 /* `target` holds */
    double target[SPACE_DIMENSIONS]; /* where it is to be, in what is seen: px or m */
    bool has_pair;                   /* `pair` was gathered in this tick */
    struct pair pair;
};

/* How far a behaviour is; phases are those of status_t. */
struct progress {
    int8_t phase;
    int done, total, skipped;
};

/* Random joint references, each followed by fixation (paper section 7.1). */
struct babble {
    struct random_state random;
    double min[MAX_JOINTS], max[MAX_JOINTS]; /* of the references, rad */
    double goal[MAX_JOINTS];                 /* rad */
    int64_t deadline;                        /* us */
};

/* Babbling where targets are missed (practice.h). */
struct practice {
    bool on;
    bool again;     /* the present target was practised for already */
    uint8_t missed; /* of the newest targets, the newest in bit 0 */
    struct babble babble;
    struct progress progress;
};

/* Arm follows head (section 7.2), or arm reaches under a resting head (section 7.3). */
struct targets {
    int n;
    double target[MAX_TARGETS][SPACE_DIMENSIONS]; /* px or m */
    int64_t period;                               /* us */
    int64_t deadline;                             /* us */
    double start[MAX_JOINTS]; /* where the arm was fixated, or goes to for that; rad */
    struct practice practice;
    double head_goal[HEAD_JOINTS]; /* rad */
    /* Where the arm that reaches is to be by now (px or m), or the head that turns (rad). */
    double setpoint[SPACE_DIMENSIONS];
};

struct behaviour;

struct behaviour_ops {
    const char *name;
    int8_t code; /* status_t.behaviour */
    /* Starts on a request that was found valid. */
    void (*start)(struct behaviour *behaviour, const reach_request_t *request,
                  struct control *control);
    /* One tick. Returns false when the work is done. */
    bool (*step)(struct behaviour *behaviour, struct control *control);
};

/* The behaviour that runs, with its state. ops NULL = none. */
struct behaviour {
    const struct behaviour_ops *ops;
    int64_t request_seq;
    bool learn;
    struct progress progress;
    union {
        struct babble babble;
        struct targets targets;
        struct explore explore;
    };
};

extern const struct behaviour_ops behaviour_babble, behaviour_coordinate, behaviour_reach,
    behaviour_explore;

/* The table entry of a request's kind, NULL when the kind starts no behaviour. */
const struct behaviour_ops *behaviour_for_request(int8_t kind);

/* Helpers that behaviours share. */

/* Begins to babble between `min` and `max` (rad); `progress->total` samples are wanted. */
void babble_begin(struct babble *babble, int64_t seed, const double *min, const double *max,
                  struct progress *progress, struct control *control);

/* One tick of that, however many samples there are; `progress` counts. */
void babble_run(struct babble *babble, struct progress *progress, struct control *control);

/* Position control of the arm towards `goal` (rad). Returns true when it is there. */
bool control_arm_to(struct control *control, const double *goal);

/* The head follows the marker, or searches it. */
enum gaze_state control_gaze(struct control *control, bool may_search);

/* Arm velocities for a wanted task velocity (rad/s, rad/s, px/s) by eq. 4; none without a model. */
void control_task_velocity(struct control *control, const double *x_velocity);

/* The same with the joints' null space drawn to `posture` (rad) at `gain` (K_s, rad/s) instead of
 * the middle of their range. */
void control_task_velocity_by(struct control *control, const double *x_velocity,
                              const double *posture, double gain);

/* Feedback in terms of what is seen (eq. 5 and 13): `gain` (1/s) times what is left between the
 * marker and `target` (px), as a task velocity (rad/s, rad/s, px/s). `target` becomes this tick's
 * target. */
void control_approach(struct control *control, const double *target, double gain,
                      double *x_velocity);

/* Makes the pair of the last n frames this tick's pair. */
void control_gather(struct control *control, int n);

/* Middle of the babbled range, rad. */
void control_babble_centre(const struct config *config, double *goal);

#endif
