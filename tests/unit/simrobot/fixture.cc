#include "fixture.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
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
    result->config.start.n = static_cast<int>(degrees.size());
    for (size_t i = 0; i < degrees.size(); i++)
        result->config.start.value[i] = degrees[i] * degree;
    result->simulation = std::make_unique<sim::Simulation>(result->config, result->rig, seed);
    ck_assert(result->simulation->set_tool(tool));
    return result;
}

void steps(sim::Simulation &simulation, int n)
{
    for (int i = 0; i < n; i++)
        simulation.step();
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
