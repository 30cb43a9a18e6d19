/* The state machine: every state under every combination of conditions. */
#include "daemon/control/supervisor.h"
#include "tests/unit/suite.h"

#include <reach_status_t.h>

#define ALL_CONDITIONS (1u << SUPERVISOR_N_CONDITIONS)
#define FRESH (CONDITION_STATE_KNOWN | CONDITION_STATE_FRESH | CONDITION_STATE_ALIVE)

START_TEST(motion_needs_a_fresh_state)
{
    for (int from = 0; from < SUPERVISOR_N_STATES; from++)
        for (uint32_t c = 0; c < ALL_CONDITIONS; c++) {
            enum supervisor_state next = supervisor_next((enum supervisor_state)from, c);
            ck_assert_int_ge(next, 0);
            ck_assert_int_lt(next, SUPERVISOR_N_STATES);
            if (next == SUPERVISOR_ACTIVE) {
                ck_assert_uint_ne(c & CONDITION_STATE_FRESH, 0);
                ck_assert_uint_ne(c & CONDITION_STATE_ALIVE, 0);
                ck_assert_uint_eq(c & CONDITION_OVERRUNNING, 0);
            }
        }
}
END_TEST

START_TEST(a_fault_stays_until_it_is_reset)
{
    for (uint32_t c = 0; c < ALL_CONDITIONS; c++)
        ck_assert_int_eq(supervisor_next(SUPERVISOR_FAULT, c) == SUPERVISOR_FAULT,
                         !(c & CONDITION_RESET_REQUESTED) ||
                             (c & (CONDITION_EMERGENCY | CONDITION_STALLED)));
}
END_TEST

START_TEST(overrunning_is_a_fault_everywhere)
{
    for (int from = 0; from < SUPERVISOR_FAULT; from++)
        ck_assert_int_eq(
            supervisor_next((enum supervisor_state)from, FRESH | CONDITION_OVERRUNNING),
            SUPERVISOR_FAULT);
}
END_TEST

/* Also in the tick in which a reset is asked for. */
START_TEST(an_emergency_or_a_stall_is_a_fault_everywhere)
{
    for (int from = 0; from < SUPERVISOR_N_STATES; from++)
        for (uint32_t c = 0; c < ALL_CONDITIONS; c++) {
            ck_assert_int_eq(supervisor_next((enum supervisor_state)from, c | CONDITION_EMERGENCY),
                             SUPERVISOR_FAULT);
            ck_assert_int_eq(supervisor_next((enum supervisor_state)from, c | CONDITION_STALLED),
                             SUPERVISOR_FAULT);
        }
}
END_TEST

START_TEST(a_fault_keeps_its_reason)
{
    const int8_t none = REACH_STATUS_T_FAULT_NONE;
    int8_t fault = supervisor_fault(SUPERVISOR_FAULT, FRESH | CONDITION_OVERRUNNING, none);

    ck_assert_int_eq(fault, REACH_STATUS_T_FAULT_OVERRUNS);
    fault = supervisor_fault(SUPERVISOR_FAULT, FRESH, fault);
    ck_assert_int_eq(fault, REACH_STATUS_T_FAULT_OVERRUNS);
    fault = supervisor_fault(SUPERVISOR_FAULT, FRESH | CONDITION_STALLED, fault);
    ck_assert_int_eq(fault, REACH_STATUS_T_FAULT_STALL);
    fault = supervisor_fault(SUPERVISOR_FAULT, FRESH | CONDITION_EMERGENCY, fault);
    fault = supervisor_fault(SUPERVISOR_FAULT, FRESH | CONDITION_OVERRUNNING, fault);
    ck_assert_int_eq(fault, REACH_STATUS_T_FAULT_EMERGENCY);
    ck_assert_int_eq(supervisor_fault(SUPERVISOR_WAITING, FRESH, fault), none);
}
END_TEST

START_TEST(staleness_holds_then_suspends_and_comes_back)
{
    enum supervisor_state state = SUPERVISOR_WAITING;

    state = supervisor_next(state, 0);
    ck_assert_int_eq(state, SUPERVISOR_WAITING);
    state = supervisor_next(state, FRESH);
    ck_assert_int_eq(state, SUPERVISOR_IDLE);
    state = supervisor_next(state, FRESH | CONDITION_BUSY);
    ck_assert_int_eq(state, SUPERVISOR_ACTIVE);
    state = supervisor_next(state, CONDITION_STATE_KNOWN | CONDITION_STATE_ALIVE | CONDITION_BUSY);
    ck_assert_int_eq(state, SUPERVISOR_HOLD);
    state = supervisor_next(state, CONDITION_STATE_KNOWN | CONDITION_BUSY);
    ck_assert_int_eq(state, SUPERVISOR_SUSPENDED);
    state = supervisor_next(state, CONDITION_STATE_KNOWN | CONDITION_STATE_ALIVE | CONDITION_BUSY);
    ck_assert_int_eq(state, SUPERVISOR_SUSPENDED);
    state = supervisor_next(state, FRESH | CONDITION_BUSY);
    ck_assert_int_eq(state, SUPERVISOR_ACTIVE);
}
END_TEST

/* No state is a dead end: with good conditions (and a reset) each comes back to IDLE. */
START_TEST(every_state_has_an_exit)
{
    for (int from = 0; from < SUPERVISOR_N_STATES; from++) {
        enum supervisor_state state = (enum supervisor_state)from;
        for (int i = 0; i < 3; i++)
            state = supervisor_next(state, FRESH | CONDITION_RESET_REQUESTED);
        ck_assert_int_eq(state, SUPERVISOR_IDLE);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {motion_needs_a_fresh_state,
                                  a_fault_stays_until_it_is_reset,
                                  overrunning_is_a_fault_everywhere,
                                  an_emergency_or_a_stall_is_a_fault_everywhere,
                                  a_fault_keeps_its_reason,
                                  staleness_holds_then_suspends_and_comes_back,
                                  every_state_has_an_exit};

    return SUITE_RUN("supervisor", tests);
}
