#include "learner/body/chain/order.h"

#include <string.h>

bool order_is_whole(const struct learner_config *config)
{
    bool named[LEARNER_MAX_INPUTS] = {false};

    for (int i = 0; i < config->n_inputs; i++) {
        int input = config->body.order[i];
        if (input < 0 || input >= config->n_inputs || named[input])
            return false;
        named[input] = true;
    }
    return true;
}

void order_to_chain(const struct learner_config *config, const double *inputs, double *joints)
{
    for (int i = 0; i < config->n_inputs; i++)
        joints[i] = inputs[config->body.order[i]];
}

void order_to_inputs(const struct learner_config *config, int rows, double *numbers)
{
    double joints[LEARNER_MAX_INPUTS];
    size_t size = (size_t)config->n_inputs * sizeof *numbers;

    for (int row = 0; row < rows; row++) {
        double *inputs = numbers + (ptrdiff_t)row * config->n_inputs;
        memcpy(joints, inputs, size);
        for (int i = 0; i < config->n_inputs; i++)
            inputs[config->body.order[i]] = joints[i];
    }
}
