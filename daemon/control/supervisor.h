/* The daemon's state machine: pure, next = f(state, conditions). */
#ifndef REACH_DAEMON_CONTROL_SUPERVISOR_H
#define REACH_DAEMON_CONTROL_SUPERVISOR_H

#include <stdint.h>

/* Values are those of status_t. */
enum supervisor_state {
    SUPERVISOR_WAITING,   /* no robot state yet */
    SUPERVISOR_IDLE,      /* nothing asked */
    SUPERVISOR_ACTIVE,    /* a behaviour runs */
    SUPERVISOR_HOLD,      /* robot state is late: zero velocity, behaviour waits */
    SUPERVISOR_SUSPENDED, /* robot state is missing: as HOLD, and said */
    SUPERVISOR_FAULT,     /* zero velocity until a reset is asked for */
    SUPERVISOR_N_STATES,
};

/* What holds at this tick, as bits. */
enum supervisor_condition {
    CONDITION_STATE_KNOWN = 1 << 0,     /* a robot state was ever received */
    CONDITION_STATE_FRESH = 1 << 1,     /* its age is within safety.state_hold */
    CONDITION_STATE_ALIVE = 1 << 2,     /* its age is within safety.state_suspend */
    CONDITION_BUSY = 1 << 3,            /* a behaviour has work */
    CONDITION_OVERRUNNING = 1 << 4,     /* too many late ticks in a row */
    CONDITION_RESET_REQUESTED = 1 << 5, /* the user wants a fault cleared */
    CONDITION_EMERGENCY = 1 << 6,       /* somebody wants the arm stopped at once */
    CONDITION_STALLED = 1 << 7,         /* the loop stood still, the watchdog had to brake */
    CONDITION_JUMPS = 1 << 8,           /* a joint is read where it cannot be */
    CONDITION_SENDERS = 1 << 9,         /* two programs send robot states */
    CONDITION_ASTRAY = 1 << 10,         /* a joint does not follow its commands */
};
#define SUPERVISOR_N_CONDITIONS 11

enum supervisor_state supervisor_next(enum supervisor_state state, uint32_t conditions);

/* Why the state is a fault: a constant FAULT_* of status_t. `fault` is the reason so far. */
int8_t supervisor_fault(enum supervisor_state state, uint32_t conditions, int8_t fault);

#endif
