#include "fixture.h"

#include "common/base/arena.h"
#include "daemon/config/load.h"
#include "daemon/control/tick.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>

static struct config load(const char *const *names, int n_names, const char *const *overrides,
                          int n_overrides)
{
    const char *source = getenv("REACH_SOURCE_DIR");
    char path[2][512];
    const char *paths[] = {path[0], path[1]};
    struct config config;
    char error[512];

    for (int i = 0; i < n_names; i++)
        snprintf(path[i], sizeof path[i], "%s/etc/%s", source ? source : ".", names[i]);
    ck_assert_msg(
        config_load(&config, paths, n_names, overrides, n_overrides, error, sizeof error) == 0,
        "%s", error);
    return config;
}

struct config fixture_config(const char *const *overrides, int n_overrides)
{
    const char *names[] = {"kobian.yaml"};

    return load(names, 1, overrides, n_overrides);
}

struct config fixture_robot_config(const char *robot)
{
    return load(&robot, 1, NULL, 0);
}

struct config fixture_overlaid_config(const char *robot, const char *overlay)
{
    const char *names[] = {robot, overlay};

    return load(names, 2, NULL, 0);
}

struct config fixture_learner_config(const char *learner)
{
    return fixture_overlaid_config("kobian.yaml", learner);
}

struct tick *fixture_tick_of(const struct tick_settings *settings, struct arena **arena)
{
    char error[256] = "";
    struct tick *tick;

    *arena = arena_create(tick_memory(settings->config));
    tick = tick_create(settings, *arena, error, sizeof error);
    ck_assert_msg(tick != NULL, "%s", error);
    return tick;
}

struct tick *fixture_tick(const struct config *config, struct arena **arena)
{
    const struct tick_settings settings = {.config = config, .model = model_port_none()};

    return fixture_tick_of(&settings, arena);
}
