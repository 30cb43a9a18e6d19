/* What the simulator hears: commands and the experimenter's requests. */
#include <reach_hello_t.h>

#include <cmath>

#include "fake_lcm.h"
#include "harness.h"
#include "simrobot/run/bus.h"

namespace
{

const size_t joints = 6;

struct fake_lcm_channel channels[3];

void begin()
{
    const reach_robot_command_t command = {};
    const reach_sim_request_t request = {};
    const reach_hello_t hello = {};

    channels[0] = {"ROBOT_COMMAND", __reach_robot_command_t_get_hash(),
                   static_cast<size_t>(reach_robot_command_t_encoded_size(&command)) - 8};
    channels[1] = {"SIM_REQUEST", __reach_sim_request_t_get_hash(),
                   static_cast<size_t>(reach_sim_request_t_encoded_size(&request)) - 8};
    channels[2] = {"REACH_HELLO", __reach_hello_t_get_hash(),
                   static_cast<size_t>(reach_hello_t_encoded_size(&hello)) - 8};
}

sim::SimBus &opened()
{
    static std::unique_ptr<sim::SimBus> bus;
    std::string error;

    if (!bus) {
        begin();
        bus = sim::SimBus::open("fake:", "", std::vector<std::string>(joints, "joint"), &error);
        HARNESS_REQUIRE(bus != nullptr);
    }
    return *bus;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sim::SimBus &bus = opened();
    sim::Command command;
    reach_sim_request_t request;

    while (size > 0) {
        const size_t used = fake_lcm_deliver_next(channels, 3, data, size);
        data += used;
        size -= used;
        if (!bus.take_command(&command))
            continue;
        HARNESS_REQUIRE(command.velocity.size() == joints);
        for (double velocity : command.velocity)
            HARNESS_REQUIRE(std::isfinite(velocity));
    }
    while (bus.take_request(&request))
        ;
    return 0;
}
