/* Everything that the daemon hears: its message handlers, and the control step on what they let
 * through. Whatever comes, commands are finite and within the limits of the safety gate. */
#include "common/bus/open.h"
#include "daemon/bus/bus.h"
#include "daemon/config/load.h"
#include "daemon/control/tick.h"
#include "fake_lcm.h"
#include "harness.h"

#include <math.h>
#include <reach_end_effector_t.h>
#include <reach_hello_t.h>
#include <reach_marker_t.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct fake_lcm_channel channels[5];
static struct config config;
static struct arena *arena;

static void check_command(const reach_robot_command_t *command)
{
    for (int i = 0; i < config_joints(&config); i++)
        HARNESS_REQUIRE(fabs(command->velocity[i]) <=
                        config_joint_limits(&config, i).safety_velocity);
}

static void begin(void)
{
    const char *paths[] = {REACH_ETC_DIR "/kobian.yaml"};
    const char *overrides[] = {"learner.capacity=4", "learner.degree=1"};
    char error[512] = "";

    HARNESS_REQUIRE(config_load(&config, paths, 1, overrides, 2, error, sizeof error) == 0);
    channels[0] = (struct fake_lcm_channel){
        "ROBOT_STATE", __reach_robot_state_t_get_hash(),
        (size_t)reach_robot_state_t_encoded_size(&(reach_robot_state_t){0}) - 8};
    channels[1] =
        (struct fake_lcm_channel){"MARKER", __reach_marker_t_get_hash(),
                                  (size_t)reach_marker_t_encoded_size(&(reach_marker_t){0}) - 8};
    channels[2] =
        (struct fake_lcm_channel){"REACH_REQUEST", __reach_request_t_get_hash(),
                                  (size_t)reach_request_t_encoded_size(&(reach_request_t){0}) - 8};
    channels[3] =
        (struct fake_lcm_channel){"REACH_HELLO", __reach_hello_t_get_hash(),
                                  (size_t)reach_hello_t_encoded_size(&(reach_hello_t){0}) - 8};
    channels[4] = (struct fake_lcm_channel){
        "END_EFFECTOR", __reach_end_effector_t_get_hash(),
        (size_t)reach_end_effector_t_encoded_size(&(reach_end_effector_t){0}) - 8};
}

/* As the loop does it in real time. */
static void take_arrived(struct daemon_bus *bus, struct tick_inputs *inputs)
{
    struct received_state received;
    struct received_request asked;

    inputs->has_state = false;
    while (daemon_bus_take_state(bus, &received)) {
        inputs->has_state = true;
        inputs->state = received.state;
        inputs->state_age = 0;
    }
    for (inputs->n_observations = 0; inputs->n_observations < TICK_MAX_OBSERVATIONS;
         inputs->n_observations++)
        if (!mailbox_take(daemon_bus_observations(bus),
                          &inputs->observation[inputs->n_observations]))
            break;
    for (inputs->n_requests = 0; inputs->n_requests < TICK_MAX_REQUESTS; inputs->n_requests++) {
        if (!mailbox_take(daemon_bus_requests(bus), &asked))
            break;
        inputs->request[inputs->n_requests] = asked.request;
    }
    inputs->emergency = daemon_bus_take_emergency(bus);
}

static void hear(struct daemon_bus *bus, struct tick *tick, const uint8_t *data, size_t size)
{
    static struct tick_inputs inputs;
    static struct tick_outputs outputs;
    int64_t now = 1000000;

    memset(&inputs, 0, sizeof inputs);
    inputs.state_age = INFINITY;
    while (size > 0) {
        size_t used = fake_lcm_deliver_next(channels, 5, data, size);
        data += used;
        size -= used;
        take_arrived(bus, &inputs);
        tick_decide(tick, &inputs, now += 20000, &outputs);
        if (outputs.has_command)
            check_command(&outputs.command);
        tick_learn(tick);
        tick_report(tick, now, &outputs);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char error[512] = "";
    struct bus_claim *claim = NULL;
    lcm_t *lcm = lcm_create("");
    const struct tick_settings settings = {.config = &config, .model = model_port_none()};
    struct daemon_bus *bus;
    struct tick *tick;

    if (config.period <= 0)
        begin();
    HARNESS_REQUIRE(bus_claim_role(lcm, REACH_HELLO_T_DAEMON, 0, &claim) == 0);
    arena = arena_create(tick_memory(&config) + daemon_bus_memory());
    tick = tick_create(&settings, arena, error, sizeof error);
    bus = daemon_bus_create(lcm, config.space.kind, arena, error, sizeof error);
    HARNESS_REQUIRE(tick && bus);
    hear(bus, tick, data, size);
    arena_destroy(arena);
    bus_claim_free(claim);
    lcm_destroy(lcm);
    return 0;
}
