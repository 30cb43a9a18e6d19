#include "common/bus/troubles_text.h"

#include <stdio.h>

/* What is wrong with what is seen, and where to look; NULL when it is something else. */
static const char *lie_text(int trouble)
{
    switch (trouble) {
    case REACH_STATUS_T_JUMPS:
        return "what is seen jumps farther than the arm can move: does vision take something else "
               "for the marker, or do two programs send it?";
    case REACH_STATUS_T_RESTLESS:
        return "what is seen moves while the arm rests: is an eye frozen or late, are the head's "
               "joints read wrong, or does somebody move the tool?";
    case REACH_STATUS_T_LATE:
        return "what is seen is older than its stamp: a camera or tracker that is late";
    case REACH_STATUS_T_ONE_EYE:
        return "one eye is late or frozen beside the other: are both cameras triggered together?";
    case REACH_STATUS_T_UNMOVED:
        return "what is seen hardly moves while the arm does: a tracker that has lost it";
    default:
        return NULL;
    }
}

/* The same of what the learner did with it; false when it is something else. */
static bool learning_text(const reach_status_t *status, int trouble, char *text, size_t size)
{
    const double degree = 3.14159265358979323846 / 180;

    switch (trouble) {
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

bool trouble_text(const reach_status_t *status, int kind, char *text, size_t size)
{
    const int trouble = status->troubles & 1 << kind;
    const char *lie = lie_text(trouble);

    if (!lie)
        return learning_text(status, trouble, text, size);
    snprintf(text, size, "%s; meanwhile nothing is learned (%lld samples so far)", lie,
             (long long)status->frozen_samples);
    return true;
}
