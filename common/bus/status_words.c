#include "common/bus/status_words.h"

#include <assert.h>
#include <reach_status_t.h>
#include <stddef.h>
#include <stdio.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const char *const faults[] = {"none",
                                     "late again and again",
                                     "emergency stop",
                                     "the loop stood still",
                                     "a joint jumped",
                                     "two senders of ROBOT_STATE",
                                     "a joint does not move",
                                     "a joint moves the wrong way",
                                     "a joint moves otherwise than told"};
static const char *const states[] = {"waiting", "idle", "active", "hold", "suspended", "fault"};
static const char *const behaviours[] = {"none",  "babble",  "coordinate",
                                         "reach", "explore", "check-motors"};
static const char *const phases[] = {"done", "move", "fixate", "search", "collect", "track"};
static const char *const results[] = {"accepted", "refused, not in this state",
                                      "refused, a value is out of range", "pending",
                                      "failed, see its log"};

static const char *const bodies[] = {"none yet", "searching", "found", "not a chain",
                                     "no reach-finder on the bus"};

static_assert(COUNT(bodies) == REACH_STATUS_T_BODY_NO_FINDER + 1, "a name for each body");
static_assert(COUNT(faults) == REACH_STATUS_T_FAULT_ASTRAY + 1, "a name for each fault");
static_assert(COUNT(states) == REACH_STATUS_T_FAULT + 1, "a name for each state");
static_assert(COUNT(behaviours) == REACH_STATUS_T_CHECK_MOTORS + 1, "a name for each behaviour");
static_assert(COUNT(phases) == REACH_STATUS_T_TRACK + 1, "a name for each phase");
static_assert(COUNT(results) == REACH_STATUS_T_FAILED + 1, "a name for each result");

static const char *word(const char *const *names, size_t n, int index)
{
    return index >= 0 && (size_t)index < n ? names[index] : "unknown";
}

const char *status_fault_word(int fault)
{
    return word(faults, COUNT(faults), fault);
}

void status_fault_text(const reach_status_t *status, char *text, size_t size)
{
    const char *fault = status_fault_word(status->fault);

    if (status->fault_joint > 0)
        snprintf(text, size, "%s: joint %d by %.3g rad", fault, status->fault_joint,
                 status->fault_value);
    else
        snprintf(text, size, "%s", fault);
}

const char *status_state_word(int state)
{
    return word(states, COUNT(states), state);
}

const char *status_behaviour_word(int behaviour)
{
    return word(behaviours, COUNT(behaviours), behaviour);
}

const char *status_phase_word(int phase)
{
    return word(phases, COUNT(phases), phase);
}

const char *status_result_word(int request_result)
{
    return word(results, COUNT(results), request_result);
}

const char *status_body_word(int body)
{
    return word(bodies, COUNT(bodies), body);
}
