/* What the simulator's tests share: the shipped configuration, and robots set up in a pose. */
#ifndef SIMROBOT_TEST_FIXTURE_H
#define SIMROBOT_TEST_FIXTURE_H

#include <initializer_list>
#include <memory>
#include <string>

#include "simrobot/world/simulation.h"

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

/* A URDF in a file of its own that goes with the test. */
class UrdfFile
{
public:
    explicit UrdfFile(const std::string &text);
    ~UrdfFile();
    UrdfFile(const UrdfFile &) = delete;
    UrdfFile &operator=(const UrdfFile &) = delete;

    /* A shipped configuration with this robot in the place of its own. */
    sim::Config config(std::initializer_list<const char *> overrides = {},
                       const char *name = "simrobot-kobian.yaml") const;

    /* What loading that says; "" if it is taken. */
    std::string complaint(std::initializer_list<const char *> overrides = {}) const;

    const char *path() const
    {
        return path_;
    }

private:
    char path_[40] = "/tmp/simrobot-test-XXXXXX";
};

/* The text of a shipped configuration's URDF, and text with every `old_text` replaced. */
std::string shipped_urdf(const char *name = "simrobot-kobian.yaml");
std::string replaced(std::string text, const std::string &old_text, const std::string &new_text);

/* Lets time go by. */
void steps(sim::Simulation &simulation, int n);

/* Position control of all joints towards `degrees` for so many periods; what is left of the joint
 * that is furthest away, degrees. */
double go_to(sim::Simulation &simulation, const std::vector<double> &degrees, int periods = 300);

/* REACH_TEST_SEED, else one from the clock; printed, so that a failure can be repeated. */
uint64_t test_seed();

} // namespace fixture
#endif
