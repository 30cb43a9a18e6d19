/* What the daemon's tests share: the shipped configuration, an arena, random numbers. */
#ifndef TESTS_UNIT_CONTROL_FIXTURE_H
#define TESTS_UNIT_CONTROL_FIXTURE_H

#include "daemon/config/config.h"
#include "tests/unit/seed.h"

#include <stdint.h>

struct arena;
struct tick;
struct tick_settings;

/* etc/kobian.yaml with overrides "name=value"; ends the test with the reason when it is bad. */
struct config fixture_config(const char *const *overrides, int n_overrides);

/* Another robot of etc, such as "icub.yaml". */
struct config fixture_robot_config(const char *robot);

/* etc/kobian.yaml with a file of etc over it, such as "learner-linear.yaml". */
struct config fixture_learner_config(const char *learner);

/* A robot's file of etc with another over it. */
struct config fixture_overlaid_config(const char *robot, const char *overlay);

/* A control step that knows nothing yet and keeps nothing, in an arena that the test destroys. */
struct tick *fixture_tick(const struct config *config, struct arena **arena);

/* Likewise, as the settings say. */
struct tick *fixture_tick_of(const struct tick_settings *settings, struct arena **arena);

#endif
