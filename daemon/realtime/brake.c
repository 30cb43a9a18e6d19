#include "daemon/realtime/brake.h"

#include "common/bus/open.h"
#include "daemon/control/limits/safety.h"

static int encode(struct brake *brake)
{
    return reach_robot_command_t_encode(bus_direct_message(&brake->way), 0,
                                        (int)bus_direct_room(&brake->way), &brake->command);
}

int brake_open(struct brake *brake, const struct config *config, const char *url, char *error,
               size_t error_size)
{
    *brake = (struct brake){.config = config};
    if (bus_direct_open(&brake->way, url, "ROBOT_COMMAND", error, error_size))
        return -1;
    encode(brake); /* once, so that the message's fingerprint is computed before it counts */
    return 0;
}

void brake_follow(struct brake *brake, const reach_robot_command_t *command)
{
    brake->command = *command;
    brake->any = true;
}

bool brake_step(struct brake *brake)
{
    int size;

    if (!brake->any)
        return false;
    safety_brake(brake->config, brake->command.velocity);
    brake->command.utime = bus_utime();
    size = encode(brake);
    if (size > 0)
        bus_direct_send(&brake->way, (size_t)size);
    return true;
}

bool brake_at_rest(const struct brake *brake)
{
    return !brake->any || safety_at_rest(brake->command.velocity);
}

void brake_close(struct brake *brake)
{
    bus_direct_close(&brake->way);
}
