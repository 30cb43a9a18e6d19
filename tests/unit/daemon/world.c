#include "world.h"

#include "arena.h"
#include "fixture.h"

#include <check.h>
#include <string.h>

struct world world;

void world_begin(struct config config, double noise)
{
    memset(&world, 0, sizeof world);
    world.config = config;
    world.tick = fixture_tick(&world.config, &world.arena);
    fake_robot_init(&world.robot, &world.config);
    world.robot.noise = noise;
}

void world_end(void)
{
    arena_destroy(world.arena);
}

void world_step(void)
{
    fake_robot_tick(&world.robot, world.tick, &world.inputs, &world.outputs);
    if (world.watch)
        world.watch();
    fake_robot_step(&world.robot, &world.outputs.command);
}

int world_ask(reach_request_t request)
{
    request.seq = ++world.request_seq;
    world.inputs.request[0] = request;
    world.inputs.n_requests = 1;
    world_step();
    ck_assert_int_eq(world.outputs.status.request_seq, request.seq);
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
