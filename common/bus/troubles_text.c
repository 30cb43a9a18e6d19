#include "common/bus/troubles_text.h"

#include <stdio.h>

bool trouble_text(const reach_status_t *status, int kind, char *text, size_t size)
{
    const double degree = 3.14159265358979323846 / 180;

    switch (status->troubles & 1 << kind) {
    case REACH_STATUS_T_MANY_FULL:
        snprintf(text, size,
                 "over 5 %% of the samples were dropped: all %d experts are in use (learner.p0, "
                 "learner.psi0, learner.capacity)",
                 status->experts);
        return true;
    case REACH_STATUS_T_MANY_OUTLIERS:
        snprintf(text, size,
                 "over 5 %% of the samples were dropped as outliers: is learner.psi0 too small, or "
                 "what is measured wrong?");
        return true;
    case REACH_STATUS_T_FAR:
        snprintf(text, size,
                 "joint %d was at %.1f deg, %.0f learner.scale from its learner.reference: another "
                 "unit, or a wider range?",
                 status->trouble_joint, status->trouble_value / degree, status->trouble_scales);
        return true;
    case REACH_STATUS_T_STILL:
        snprintf(text, size,
                 "what was seen stood still while joints moved, as behind a tracker that repeats "
                 "itself: %lld samples were not learned",
                 (long long)status->frozen_samples);
        return true;
    case REACH_STATUS_T_EXPERTS:
        snprintf(text, size,
                 "%d experts are more than there are branches: a smaller learner.p0 or a larger "
                 "learner.psi0 makes fewer",
                 status->experts);
        return true;
    default:
        return false;
    }
}
