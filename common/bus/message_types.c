#include "common/bus/message_types.h"

#include "common/base/big_endian.h"

#include <bot_core_images_t.h>
#include <bot_core_joint_state_t.h>
#include <reach_body_request_t.h>
#include <reach_body_t.h>
#include <reach_config_t.h>
#include <reach_end_effector_t.h>
#include <reach_hello_t.h>
#include <reach_learner_prediction_t.h>
#include <reach_learner_reply_t.h>
#include <reach_learner_request_t.h>
#include <reach_marker_t.h>
#include <reach_request_t.h>
#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <reach_sample_t.h>
#include <reach_sim_contacts_t.h>
#include <reach_sim_request_t.h>
#include <reach_sim_truth_t.h>
#include <reach_status_t.h>
#include <reach_trace_t.h>
#include <string.h>

#define TYPE(package, type, channel)                                                               \
    {                                                                                              \
#package "." #type, channel, __##package##_##type##_get_hash,                              \
            package##_##type##_get_type_info                                                       \
    }

static const struct message_type types[] = {
    TYPE(reach, robot_state_t, "ROBOT_STATE"),
    TYPE(reach, robot_command_t, "ROBOT_COMMAND"),
    TYPE(reach, end_effector_t, "END_EFFECTOR"),
    TYPE(reach, marker_t, "MARKER"),
    TYPE(reach, status_t, "REACH_STATUS"),
    TYPE(reach, trace_t, "REACH_TRACE"),
    TYPE(reach, sample_t, "REACH_SAMPLE"),
    TYPE(reach, request_t, "REACH_REQUEST"),
    TYPE(reach, config_t, "REACH_CONFIG"),
    TYPE(reach, body_request_t, "REACH_BODY_REQUEST"),
    TYPE(reach, body_t, "REACH_BODY"),
    TYPE(reach, body_t, "REACH_BODY_IN_USE"),
    TYPE(reach, body_request_t, "LEARNER_BODY_REQUEST"),
    TYPE(reach, body_t, "LEARNER_BODY"),
    TYPE(reach, hello_t, "REACH_HELLO"),
    TYPE(reach, sim_request_t, "SIM_REQUEST"),
    TYPE(reach, sim_truth_t, "SIM_TRUTH"),
    TYPE(reach, sim_contacts_t, "SIM_CONTACTS"),
    TYPE(reach, learner_request_t, "LEARNER_REQUEST"),
    TYPE(reach, learner_reply_t, "LEARNER_REPLY"),
    TYPE(reach, learner_prediction_t, "LEARNER_PREDICTION"),
    TYPE(bot_core, images_t, "STEREO_IMAGES"),
    TYPE(bot_core, images_t, "SIM_VIEW"),
    TYPE(bot_core, joint_state_t, "JOINT_STATE"),
};
enum { N_TYPES = sizeof types / sizeof types[0], FINGERPRINT = 8 };

const struct message_type *message_type_of_channel(const char *channel)
{
    for (int i = 0; i < N_TYPES; i++)
        if (strcmp(types[i].channel, channel) == 0)
            return &types[i];
    return NULL;
}

bool message_type_same(const struct message_type *a, const struct message_type *b)
{
    return a->info == b->info;
}

const struct message_type *message_type_of(const void *data, size_t size)
{
    int64_t fingerprint = size >= FINGERPRINT ? (int64_t)big_endian(data, FINGERPRINT) : 0;

    for (int i = 0; i < N_TYPES && size >= FINGERPRINT; i++)
        if (types[i].fingerprint() == fingerprint)
            return &types[i];
    return NULL;
}
