#include "learner/bus/finder_channels.h"

const struct finder_channels finder_channels[FINDER_ASKERS] = {
    [FINDER_ASKED_BY_DAEMON] = {"REACH_BODY_REQUEST", "REACH_BODY"},
    [FINDER_ASKED_BY_LEARNER] = {"LEARNER_BODY_REQUEST", "LEARNER_BODY"},
};
