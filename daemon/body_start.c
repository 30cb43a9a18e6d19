#include "daemon/body_start.h"

#include "learner/finder/urdf.h"

#include <stdio.h>
#include <string.h>

int body_start_read(const struct config *config, struct body *body, const struct body **start,
                    char *error, size_t error_size)
{
    const char *tip = config->learner_body_tip;
    char reason[400];

    *start = NULL;
    if (!config->learner_body_start[0])
        return 0;
    memset(body, 0, sizeof *body);
    if (finder_read_urdf(config->learner_body_start, tip[0] ? tip : NULL, config_arm_joints(config),
                         &body->chain, reason, sizeof reason)) {
        snprintf(error, error_size, "learner.body.start: %s", reason);
        return -1;
    }
    for (int i = 0; i < BODY_OUTPUTS; i++)
        body->noise[i] = 1;
    body->length = 1;
    body->gravity[2] = -1;
    *start = body;
    return 0;
}
