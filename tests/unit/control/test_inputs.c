/* What may come in: each field of each message, one at a time, made absurd. */
#include "daemon/control/behaviours/table.h"
#include "daemon/control/inputs.h"
#include "fixture.h"
#include "tests/unit/suite.h"

#include <math.h>

static struct config config;
static struct state_fault fault;

static reach_robot_state_t good_state(void)
{
    reach_robot_state_t state = {.utime = 1, .seq = 1, .n_joints = 6};

    for (int i = 0; i < 6; i++)
        state.position[i] =
            0.5 * (config_joint_limits(&config, i).min + config_joint_limits(&config, i).max);
    return state;
}

START_TEST(a_bad_state_is_refused)
{
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e300, -4};
    reach_robot_state_t state;

    config = fixture_config(NULL, 0);
    state = good_state();
    ck_assert(inputs_state_ok(&config, &state, &fault));
    for (int i = 0; i < 6; i++)
        for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
            state = good_state();
            state.position[i] = bad[k];
            ck_assert(!inputs_state_ok(&config, &state, &fault));
            state = good_state();
            state.velocity[i] = k == 4 ? 200 : bad[k];
            ck_assert(!inputs_state_ok(&config, &state, &fault));
        }
    for (int n = -1; n <= 17; n++) {
        state = good_state();
        state.n_joints = n;
        ck_assert_int_eq(inputs_state_ok(&config, &state, &fault), n == 6);
    }
    state = good_state();
    state.utime = 0;
    ck_assert(!inputs_state_ok(&config, &state, &fault));
}
END_TEST

START_TEST(a_bad_marker_is_refused)
{
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e9};
    struct observation marker = {.utime = 1, .seen = 1};

    config = fixture_config(NULL, 0);

    ck_assert(inputs_observation_ok(&config, &marker));
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        marker = (struct observation){.utime = 1, .seen = 1, .value[0] = bad[k]};
        ck_assert(!inputs_observation_ok(&config, &marker));
        marker = (struct observation){.utime = 1, .seen = 1, .value[1] = bad[k]};
        ck_assert(!inputs_observation_ok(&config, &marker));
        marker = (struct observation){.utime = 1, .seen = 1, .value[2] = bad[k]};
        ck_assert(!inputs_observation_ok(&config, &marker));
    }
    marker = (struct observation){.utime = -5, .seen = 1};
    ck_assert(!inputs_observation_ok(&config, &marker));
}
END_TEST

/* By the behaviour that it starts, or by the daemon. */
static bool accepts(const reach_request_t *request)
{
    const struct behaviour_ops *ops = behaviour_find(behaviour_table, request->kind);

    return ops ? ops->accepts(&config, request) : inputs_request_ok(request);
}

START_TEST(a_bad_request_is_refused)
{
    reach_request_t request = {.kind = REACH_REQUEST_T_BABBLE, .count = 10};

    config = fixture_config(NULL, 0);

    ck_assert(accepts(&request));
    request.count = 0;
    ck_assert(!accepts(&request));
    request = (reach_request_t){.kind = REACH_REQUEST_T_REACH, .n_targets = 32, .period = 1};
    ck_assert(accepts(&request));
    for (int n = -2; n < 1; n++) {
        request.n_targets = n;
        ck_assert(!accepts(&request));
    }
    request.n_targets = 33;
    ck_assert(!accepts(&request));
    request.n_targets = 32;
    request.target[31][2] = NAN;
    ck_assert(!accepts(&request));
    request.target[31][2] = 0;
    request.period = NAN;
    ck_assert(!accepts(&request));
    request = (reach_request_t){.kind = 99};
    ck_assert(!accepts(&request));
    request = (reach_request_t){.kind = REACH_REQUEST_T_SAVE, .count = -1};
    ck_assert(!accepts(&request));
    request.count = 9999; /* four digits in the file's name */
    ck_assert(accepts(&request));
    request.count = 10000;
    ck_assert(!accepts(&request));
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_bad_state_is_refused, a_bad_marker_is_refused,
                                  a_bad_request_is_refused};

    return SUITE_RUN("inputs", tests);
}
