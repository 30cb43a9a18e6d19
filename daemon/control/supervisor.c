#include "daemon/control/supervisor.h"

#include <assert.h>
#include <reach_status_t.h>
#include <stddef.h>

static_assert(SUPERVISOR_WAITING == REACH_STATUS_T_WAITING &&
                  SUPERVISOR_IDLE == REACH_STATUS_T_IDLE &&
                  SUPERVISOR_ACTIVE == REACH_STATUS_T_ACTIVE &&
                  SUPERVISOR_HOLD == REACH_STATUS_T_HOLD &&
                  SUPERVISOR_SUSPENDED == REACH_STATUS_T_SUSPENDED &&
                  SUPERVISOR_FAULT == REACH_STATUS_T_FAULT,
              "states are published as they are");

#define ANY_STATE ((1u << SUPERVISOR_N_STATES) - 1u)
#define FROM(state) (1u << (state))
#define RUNNING (ANY_STATE & ~FROM(SUPERVISOR_FAULT) & ~FROM(SUPERVISOR_WAITING))

/* The first row that fits decides; none fits: the state stays. */
static const struct {
    uint32_t from;  /* states it holds for, as bits */
    uint32_t set;   /* conditions that must hold */
    uint32_t clear; /* conditions that must not */
    enum supervisor_state next;
} transitions[] = {
    {ANY_STATE, CONDITION_EMERGENCY, 0, SUPERVISOR_FAULT},
    {ANY_STATE, CONDITION_STALLED, 0, SUPERVISOR_FAULT},
    {FROM(SUPERVISOR_FAULT), CONDITION_RESET_REQUESTED, 0, SUPERVISOR_WAITING},
    {FROM(SUPERVISOR_FAULT), 0, 0, SUPERVISOR_FAULT},
    {ANY_STATE, CONDITION_OVERRUNNING, 0, SUPERVISOR_FAULT},
    {ANY_STATE, CONDITION_JUMPS, 0, SUPERVISOR_FAULT},
    {ANY_STATE, CONDITION_SENDERS, 0, SUPERVISOR_FAULT},
    {ANY_STATE, CONDITION_ASTRAY, 0, SUPERVISOR_FAULT},
    {FROM(SUPERVISOR_WAITING), 0, CONDITION_STATE_KNOWN, SUPERVISOR_WAITING},
    {FROM(SUPERVISOR_WAITING), 0, CONDITION_STATE_FRESH, SUPERVISOR_WAITING},
    {FROM(SUPERVISOR_WAITING), 0, CONDITION_STATE_ALIVE, SUPERVISOR_WAITING},
    {RUNNING, 0, CONDITION_STATE_ALIVE, SUPERVISOR_SUSPENDED},
    /* What was suspended resumes only with fresh states, not with merely living ones. */
    {FROM(SUPERVISOR_SUSPENDED), 0, CONDITION_STATE_FRESH, SUPERVISOR_SUSPENDED},
    {RUNNING, 0, CONDITION_STATE_FRESH, SUPERVISOR_HOLD},
    {ANY_STATE, CONDITION_BUSY, 0, SUPERVISOR_ACTIVE},
    {ANY_STATE, 0, CONDITION_BUSY, SUPERVISOR_IDLE},
};

enum supervisor_state supervisor_next(enum supervisor_state state, uint32_t conditions)
{
    for (size_t i = 0; i < sizeof transitions / sizeof transitions[0]; i++)
        if ((transitions[i].from & FROM(state)) &&
            (conditions & transitions[i].set) == transitions[i].set &&
            (conditions & transitions[i].clear) == 0)
            return transitions[i].next;
    return state;
}

int8_t supervisor_fault(enum supervisor_state state, uint32_t conditions, int8_t fault)
{
    if (state != SUPERVISOR_FAULT)
        return REACH_STATUS_T_FAULT_NONE;
    if (conditions & CONDITION_EMERGENCY)
        return REACH_STATUS_T_FAULT_EMERGENCY;
    if (conditions & CONDITION_STALLED)
        return REACH_STATUS_T_FAULT_STALL;
    if (fault != REACH_STATUS_T_FAULT_NONE)
        return fault;
    /* Two senders make joints jump. */
    return conditions & CONDITION_SENDERS  ? REACH_STATUS_T_FAULT_SENDERS
           : conditions & CONDITION_JUMPS  ? REACH_STATUS_T_FAULT_JUMP
           : conditions & CONDITION_ASTRAY ? REACH_STATUS_T_FAULT_ASTRAY
                                           : REACH_STATUS_T_FAULT_OVERRUNS;
}
