#include "daemon/bus/incoming.h"

#include "common/base/checksum.h"

#include <reach_end_effector_t.h>
#include <reach_marker_t.h>
#include <string.h>

#define DECODE(type, data, size, value)                                                            \
    (type##_decode((data), 0, (int)(size), (value)) == (int)(size))

bool incoming_state(const void *data, size_t size, reach_robot_state_t *state)
{
    return DECODE(reach_robot_state_t, data, size, state);
}

bool incoming_request(const void *data, size_t size, reach_request_t *request)
{
    return DECODE(reach_request_t, data, size, request);
}

static bool take_marker(const void *data, size_t size, struct observation *observation)
{
    reach_marker_t marker;

    if (!DECODE(reach_marker_t, data, size, &marker))
        return false;
    *observation =
        (struct observation){.utime = marker.utime,
                             .seq = marker.seq,
                             .seen = marker.seen,
                             .value = {marker.u_right, marker.v_right, marker.disparity}};
    return true;
}

static bool take_effector(const void *data, size_t size, struct observation *observation)
{
    reach_end_effector_t effector;

    if (!DECODE(reach_end_effector_t, data, size, &effector))
        return false;
    *observation = (struct observation){.utime = effector.utime, .seq = effector.seq, .seen = 1};
    memcpy(observation->value, effector.position, sizeof observation->value);
    return true;
}

bool incoming_observation(enum space_kind space, const void *data, size_t size,
                          struct observation *observation)
{
    bool taken = space == SPACE_CARTESIAN ? take_effector(data, size, observation)
                                          : take_marker(data, size, observation);

    if (taken)
        observation->checksum = checksum_crc32(data, size);
    return taken;
}

const char *incoming_sense(enum space_kind space)
{
    return space == SPACE_CARTESIAN ? "END_EFFECTOR" : "MARKER";
}
