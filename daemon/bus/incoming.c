#include "daemon/bus/incoming.h"

#include "common/base/checksum.h"
#include "learner/bus/body_message.h"

#include <math.h>
#include <reach_end_effector_t.h>
#include <reach_marker_t.h>
#include <string.h>

_Static_assert(sizeof((reach_body_t *)0)->why == sizeof((struct finder_report *)0)->why &&
                   REACH_BODY_T_FOUND == FINDER_FOUND && REACH_BODY_T_NOT_YET == FINDER_NOT_YET &&
                   REACH_BODY_T_NO_CHAIN == FINDER_NO_CHAIN &&
                   REACH_BODY_T_REFUTED == FINDER_REFUTED,
               "body_t has what a finder says");

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

static bool take_body(const reach_body_t *message, struct body_answer *answer)
{
    answer->checksum = (uint32_t)message->checksum;
    return isfinite(message->error) && isfinite(message->doubt) &&
           body_message_take(message, &answer->body);
}

static bool take_answer(const reach_body_t *message, struct received_body *received)
{
    struct body_answer *answer = &received->answer;

    *received = (struct received_body){.request_utime = message->request_utime};
    answer->seq = message->seq;
    answer->seconds = message->seconds;
    answer->report.samples = message->samples;
    answer->report.starts = message->starts;
    answer->report.error = message->error;
    answer->report.doubt = message->doubt;
    memcpy(answer->report.why, message->why, sizeof answer->report.why);
    answer->report.why[sizeof answer->report.why - 1] = '\0';
    answer->kind = message->outcome == REACH_BODY_T_SEARCHING ? BODY_ANSWER_COMES
                   : message->outcome == REACH_BODY_T_REFUSED ? BODY_ANSWER_REFUSED
                                                              : BODY_ANSWER_REPORT;
    answer->report.outcome = (enum finder_outcome)message->outcome;
    answer->report.any_body =
        message->outcome == REACH_BODY_T_FOUND ||
        ((message->outcome == REACH_BODY_T_NOT_YET || message->outcome == REACH_BODY_T_REFUTED) &&
         message->numbers[0] != 0);
    if (answer->report.any_body)
        return take_body(message, answer);
    return message->outcome > REACH_BODY_T_FOUND && message->outcome <= REACH_BODY_T_REFUTED;
}

bool incoming_body(const void *data, size_t size, struct received_body *received)
{
    reach_body_t message;

    return DECODE(reach_body_t, data, size, &message) && take_answer(&message, received);
}

const char *incoming_sense(enum space_kind space)
{
    return space == SPACE_CARTESIAN ? "END_EFFECTOR" : "MARKER";
}
