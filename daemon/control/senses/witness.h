/* Whether what the eyes (or END_EFFECTOR) tell can be true: it is held against itself and against
 * how the joints move, over several frames, never one. What is found wrong is told and not learned;
 * the arm is not stopped by it. A step, as when a tool is taken or a camera is knocked, is no lie.
 * Plain data; used by the loop thread alone.
 *
 * Two tests need no model. Between two frames the end-effector moves by at most what the joints can
 * do in between: `lever` units for each radian. A frame that lies farther from the line between its
 * neighbours jumps, and so does one that moves on while the arm rests.
 *
 * Two more compare motion, over the last second, with the motion that the learned Jacobian expects;
 * they are silent until that has been right for some seconds. Late is what follows the expected
 * motion of a time before; still is what hardly moves where much is expected. */
#ifndef REACH_DAEMON_CONTROL_SENSES_WITNESS_H
#define REACH_DAEMON_CONTROL_SENSES_WITNESS_H

#include "daemon/config/config.h"
#include "daemon/config/sizes.h"
#include "daemon/control/senses/sight.h"
#include "learner/learner.h"

#include <stdbool.h>
#include <stdint.h>

enum { WITNESS_FRAMES = 128 };

enum witness_doubt {
    WITNESS_JUMPS,    /* from frame to frame, farther than the arm can move */
    WITNESS_RESTLESS, /* moves while the arm rests */
    WITNESS_LATE,     /* shows what was, under a newer stamp */
    WITNESS_ONE_EYE,  /* one eye is late or frozen beside the other */
    WITNESS_STILL,    /* does not move while the arm does */
    WITNESS_DOUBTS
};

struct witness_frame {
    int64_t utime;
    double q[MAX_JOINTS];              /* arm joints, rad */
    double path;                       /* that all of them went since the first frame, rad */
    double x[SPACE_DIMENSIONS];        /* task position, in units of space.scale */
    double image[SPACE_DIMENSIONS];    /* as it was seen, px or m */
    double expected[SPACE_DIMENSIONS]; /* the same by the Jacobian alone, from the first frame on */
    bool strange;                      /* far from the line between its neighbours */
};

struct witness {
    const struct config *config;
    int newest;                     /* index into the ring */
    int kept;                       /* frames since the last gap, up to all */
    int modelled;                   /* those of them whose motion the model said something of */
    int restless;                   /* frames in a row that moved on while the arm rested */
    int late, still, one_eye, fits; /* frames with motion in a row that were so */
    int64_t since; /* us of senses.time at which what is seen began to move otherwise; 0 = not */
    double misfit; /* of motion and model, 0 = none, 1 = they have nothing in common; slow mean */
    int64_t last[WITNESS_DOUBTS]; /* us of senses.time at which it was found last; 0 = never */
    struct witness_frame frame[WITNESS_FRAMES];
};

void witness_init(struct witness *witness, const struct config *config);

/* The newest frame of `sight`, once for each in which something was seen; what the model says near
 * there; `time` is that of durations. */
void witness_look(struct witness *witness, const struct sight *sight,
                  const struct learner_prediction *prediction, int64_t time);

/* Whether what is seen now is to be learned: not while anything was found in the last second. */
bool witness_believes(const struct witness *witness, int64_t time);

/* What was found lately, for people: bit 1 << enum witness_doubt each. */
unsigned witness_tells(const struct witness *witness, int64_t time);

#endif
