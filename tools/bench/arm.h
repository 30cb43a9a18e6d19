/* The streams that the benches learn: an arm like the iCub's, with a tool that changes. */
#ifndef REACH_BENCH_ARM_H
#define REACH_BENCH_ARM_H

#include <stdint.h>

#include "learner/body/chain/body.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { ARM_JOINTS = 7, ARM_OUTPUTS = 3 };

/* Position (m) for q (rad: waist yaw, roll, pitch; shoulder pitch, abduction, axial rotation;
 * elbow) of a point that lies `tool` from the palm (m), in the palm's own frame. */
void arm_tip(const double q[ARM_JOINTS], const double tool[3], double x[ARM_OUTPUTS]);

/* The arm as a finder would have found it, with all 7 joints. */
struct body arm_body(void);

/* An endless source of samples and queries; begin with arm_stream_start(). */
struct arm_stream {
    uint64_t state;
    int n_inputs;   /* 7, or 4: the waist stays straight */
    double tool[3]; /* nothing in the hand: zero */
    double speed;   /* rad that the fastest joint moves from sample to sample */
    double q[ARM_JOINTS];
    double step[ARM_JOINTS];
    int steps; /* left to the next turning point of the walk */
};

struct arm_stream arm_stream_start(uint64_t seed, int n_inputs, double speed);

/* Takes another tool: the number-th of a fixed sequence, each up to 60 cm long. Number 0 is none.
 */
void arm_stream_take_tool(struct arm_stream *stream, int number);

/* A configuration z[n_inputs] drawn uniformly from the joints' range. */
void arm_stream_query(struct arm_stream *stream, double *z);

/* The next sample of a walk between such configurations: z[n_inputs], and what is measured there,
 * with noise of 0.5 mm. */
void arm_stream_next(struct arm_stream *stream, double *z, double x[ARM_OUTPUTS]);

#ifdef __cplusplus
}
#endif
#endif
