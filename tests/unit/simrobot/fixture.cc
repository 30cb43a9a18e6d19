#include "fixture.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <vector>

namespace fixture
{

std::string configuration_path(const char *name)
{
    const char *source = getenv("REACH_SOURCE_DIR");
    return std::string(source ? source : ".") + "/etc/" + name;
}

sim::Config config(std::initializer_list<const char *> overrides, const char *name)
{
    std::string path = configuration_path(name);
    std::vector<const char *> list(overrides);
    sim::Config result;
    std::string error;

    if (!sim::config_load(&result, path.c_str(), list.data(), static_cast<int>(list.size()),
                          &error))
        ck_abort_msg("%s", error.c_str());
    return result;
}

sim::Rig rig(const sim::Config &config)
{
    sim::Rig result;
    std::string error;

    if (!sim::rig_load(config, &result, &error))
        ck_abort_msg("%s", error.c_str());
    return result;
}

std::unique_ptr<Stage> stage(std::initializer_list<const char *> overrides,
                             const std::vector<double> &degrees, int tool, uint64_t seed)
{
    auto result = std::make_unique<Stage>();

    result->config = config(overrides);
    result->rig = rig(result->config);
    for (size_t i = 0; i < degrees.size(); i++)
        result->rig.start[i] = degrees[i] * degree;
    result->simulation = std::make_unique<sim::Simulation>(result->config, result->rig, seed);
    ck_assert(result->simulation->set_tool(tool));
    return result;
}

UrdfFile::UrdfFile(const std::string &text)
{
    int file = mkstemp(path_);
    ck_assert_int_ge(file, 0);
    ck_assert_int_eq(write(file, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    close(file);
}

UrdfFile::~UrdfFile()
{
    unlink(path_);
}

sim::Config UrdfFile::config(std::initializer_list<const char *> overrides, const char *name) const
{
    sim::Config config = fixture::config(overrides, name);
    snprintf(config.urdf, sizeof config.urdf, "%s", path_);
    return config;
}

std::string UrdfFile::complaint(std::initializer_list<const char *> overrides) const
{
    sim::Rig rig;
    std::string error;
    return sim::rig_load(config(overrides), &rig, &error) ? "" : error;
}

std::string shipped_urdf(const char *name)
{
    std::ifstream file(config({}, name).urdf);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string replaced(std::string text, const std::string &old_text, const std::string &new_text)
{
    size_t at = text.find(old_text);
    ck_assert(at != std::string::npos);
    for (; at != std::string::npos; at = text.find(old_text, at + new_text.size()))
        text.replace(at, old_text.size(), new_text);
    return text;
}

void steps(sim::Simulation &simulation, int n)
{
    for (int i = 0; i < n; i++)
        simulation.step();
}

double go_to(sim::Simulation &simulation, const std::vector<double> &degrees, int periods)
{
    double furthest = 0;

    for (int period = 0; period < periods; period++) {
        std::vector<double> velocity = simulation.truth().position;
        furthest = 0;
        for (size_t i = 0; i < degrees.size(); i++) {
            double left = degrees[i] * degree - velocity[i];
            furthest = std::max(furthest, std::fabs(left) / degree);
            velocity[i] = std::clamp(3 * left, -1.0, 1.0);
        }
        simulation.command(velocity);
        steps(simulation, simulation.steps_in_period());
    }
    return furthest;
}

uint64_t test_seed()
{
    const char *given = getenv("REACH_TEST_SEED");
    uint64_t seed = given ? strtoull(given, nullptr, 10) : static_cast<uint64_t>(time(nullptr));

    printf("REACH_TEST_SEED=%llu\n", static_cast<unsigned long long>(seed));
    fflush(stdout);
    return seed;
}

} // namespace fixture
