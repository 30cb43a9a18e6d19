/* What the simulator's tests share: the shipped configuration, and robots set up in a pose. */
#ifndef SIMROBOT_TEST_FIXTURE_H
#define SIMROBOT_TEST_FIXTURE_H

#include <initializer_list>
#include <memory>
#include <string>

#include "simrobot/simulation.h"

/* After all others: it defines `fail`, a word that the standard library uses. */
#include <check.h>

namespace fixture
{

inline constexpr double degree = 3.14159265358979323846 / 180;

/* Where a shipped configuration is; ctest sets REACH_SOURCE_DIR. */
std::string configuration_path(const char *name = "simrobot-kobian.yaml");

/* A shipped robot, the Kobian by default, with these overrides; ends the test on an error. */
sim::Config config(std::initializer_list<const char *> overrides = {},
                   const char *name = "simrobot-kobian.yaml");
sim::Rig rig(const sim::Config &config);

/* A world and what it needs to outlive. */
struct Stage {
    sim::Config config;
    sim::Rig rig;
    std::unique_ptr<sim::Simulation> simulation;
};

/* The shipped Kobian with its joints at `degrees` (arm, then head), at rest, tool in hand. */
std::unique_ptr<Stage> stage(std::initializer_list<const char *> overrides,
                             const std::vector<double> &degrees, int tool = 0, uint64_t seed = 1);

/* Lets time go by. */
void steps(sim::Simulation &simulation, int n);

/* REACH_TEST_SEED, else one from the clock; printed, so that a failure can be repeated. */
uint64_t test_seed();

} // namespace fixture
#endif
