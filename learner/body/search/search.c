#include "learner/body/search/search.h"

#include <math.h>

#include "learner/body/chain/order.h"

struct finder_settings finder_settings_of(const struct learner_config *config)
{
    struct finder_settings settings = {
        .n_joints = config->n_inputs,
        .sees = config->body.space == LEARNER_BODY_EYES,
        .angle_unit = config->body.degrees ? M_PI / 180 : 1,
        .gravity = {0, 0, -1},
        .starts = config->body.starts,
    };

    double share = config->body.noise_share > 0 ? config->body.noise_share : config->noise_share;

    for (int i = 0; i < BODY_OUTPUTS; i++)
        settings.noise[i] = sqrt(config->psi0[i] * share);
    order_to_chain(config, config->body.low, settings.low);
    order_to_chain(config, config->body.high, settings.high);
    return settings;
}
