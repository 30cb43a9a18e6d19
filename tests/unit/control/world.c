#include "world.h"

#include "common/base/arena.h"
#include "fixture.h"

#include <check.h>
#include <math.h>
#include <string.h>

struct world world;

void world_begin(struct config config, double noise)
{
    memset(&world, 0, sizeof world);
    world.config = config;
    world.tick = fixture_tick(&world.config, &world.arena);
    fake_robot_init(&world.robot, &world.config);
    world.robot.noise = noise;
    world.inputs.state_age = INFINITY;
}

void world_end(void)
{
    arena_destroy(world.arena);
}

void world_step(void)
{
    world.inputs.state_age = 0;
    fake_robot_tick(&world.robot, world.tick, &world.inputs, &world.outputs);
    if (world.watch)
        world.watch();
    fake_robot_step(&world.robot, &world.outputs.command);
}

void world_decide(void)
{
    tick_decide(world.tick, &world.inputs, world.robot.now, &world.outputs);
    tick_report(world.tick, world.robot.now, &world.outputs);
}

void world_tick(bool with_state)
{
    world.inputs.has_state = with_state;
    if (with_state) {
        world.inputs.state = fake_robot_state(&world.robot);
        world.inputs.state_age = 0;
    }
    world_decide();
    world.inputs.n_requests = 0;
    if (world.outputs.has_command)
        fake_robot_step(&world.robot, &world.outputs.command);
}

void world_prepare(reach_request_t request)
{
    request.seq = ++world.request_seq;
    world.inputs.request[world.inputs.n_requests++] = request;
}

int world_ask(reach_request_t request)
{
    world_prepare(request);
    world_step();
    ck_assert_int_eq(world.outputs.status.request_seq, world.request_seq);
    return world.outputs.status.request_result;
}

void world_finish(int most_ticks)
{
    const reach_status_t *status = &world.outputs.status;

    for (int i = 0; status->behaviour != REACH_STATUS_T_NONE; i++) {
        ck_assert_msg(i < most_ticks, "not done after %d ticks: phase %d, %d of %d, %d skipped", i,
                      status->phase, status->progress, status->progress_total, status->skipped);
        world_step();
    }
}

void world_run(reach_request_t request)
{
    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
    world_finish(20000);
}

void world_babble(int count, int64_t seed)
{
    world_run((reach_request_t){
        .kind = REACH_REQUEST_T_BABBLE, .count = count, .seed = seed, .learn = 1});
}
