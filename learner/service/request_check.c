#include "learner/service/request_check.h"

#include "learner/learner.h"

#include <math.h>
#include <reach_learner_reply_t.h>

#define REPLY(name) REACH_LEARNER_REPLY_T_##name
#define REQUEST(name) REACH_LEARNER_REQUEST_T_##name

static const int32_t largest_model = 999999;

static bool usable(const double *numbers, int n)
{
    for (int i = 0; i < n; i++)
        if (!(fabs(numbers[i]) <= LEARNER_LARGEST_NUMBER)) /* so that NaN is not */
            return false;
    return true;
}

static int8_t check_numbers(const reach_learner_request_t *request, int n_inputs, int n_outputs)
{
    if (request->n_inputs != n_inputs || request->n_outputs != n_outputs)
        return REPLY(DIMENSIONS);
    if (request->kind != REQUEST(PREDICT_INVERSE) && !usable(request->z, n_inputs))
        return REPLY(VALUE);
    if (request->kind != REQUEST(PREDICT) && !usable(request->x, n_outputs))
        return REPLY(VALUE);
    return REPLY(DONE);
}

static int8_t check_save(const reach_learner_request_t *request, bool keeps)
{
    if (!keeps)
        return REPLY(NO_DIRECTORY);
    return request->number >= 0 && request->number <= largest_model ? REPLY(DONE) : REPLY(VALUE);
}

int8_t request_check(const reach_learner_request_t *request, int n_inputs, int n_outputs,
                     bool keeps)
{
    if (request->seq < 1)
        return REPLY(VALUE);
    switch (request->kind) {
    case REQUEST(STATISTICS):
        return REPLY(DONE);
    case REQUEST(UPDATE):
    case REQUEST(PREDICT):
    case REQUEST(PREDICT_INVERSE):
        return check_numbers(request, n_inputs, n_outputs);
    case REQUEST(SAVE):
        return check_save(request, keeps);
    default:
        return REPLY(UNKNOWN_KIND);
    }
}
