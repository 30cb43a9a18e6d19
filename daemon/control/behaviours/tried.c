#include "daemon/control/behaviours/tried.h"

#include <math.h>
#include <string.h>

void tried_note(struct tried *tried, const double *posture, bool good)
{
    memcpy(tried->posture[tried->next], posture, sizeof tried->posture[0]);
    tried->good[tried->next] = good;
    tried->next = (tried->next + 1) % TRIED_LENGTH;
    if (tried->count < TRIED_LENGTH)
        tried->count++;
}

static double distance(const struct config *config, const double *a, const double *b)
{
    double sum = 0;

    for (int i = 0; i < config_arm_joints(config); i++) {
        double share = (a[i] - b[i]) / (config->babble_max.value[i] - config->babble_min.value[i]);
        sum += share * share;
    }
    return sum;
}

bool tried_promises(const struct tried *tried, const struct config *config, const double *posture)
{
    double nearest = INFINITY;
    bool good = true;

    for (int k = 0; k < tried->count; k++) {
        double d = distance(config, tried->posture[k], posture);
        if (d < nearest) {
            nearest = d;
            good = tried->good[k];
        }
    }
    return good;
}
