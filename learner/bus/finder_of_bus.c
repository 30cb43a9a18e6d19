#include "learner/bus/finder_of_bus.h"

#include "common/bus/open.h"
#include "learner/bus/body_message.h"

#include <stdlib.h>
#include <string.h>

static void forget_request(struct finder_of_bus *finder)
{
    free(finder->request.numbers);
    free(finder->request.z);
    free(finder->request.x);
    memset(&finder->request, 0, sizeof finder->request);
}

static void put_settings(reach_body_request_t *request, const struct finder_settings *settings)
{
    request->n_joints = settings->n_joints;
    request->sees = settings->sees;
    request->angle_unit = settings->angle_unit;
    request->starts = settings->starts;
    request->seed = settings->seed;
    memcpy(request->noise, settings->noise, sizeof request->noise);
    memcpy(request->gravity, settings->gravity, sizeof request->gravity);
    memcpy(request->low, settings->low, sizeof request->low);
    memcpy(request->high, settings->high, sizeof request->high);
}

/* Returns false when there is no memory. */
static bool put_samples(reach_body_request_t *request, const struct body_search *search)
{
    int samples = 0;

    request->n_contexts = search->n_contexts;
    for (int c = 0; c < search->n_contexts; c++) {
        request->rigid[c] = search->contexts[c].rigid;
        request->count[c] = search->contexts[c].n;
        samples += search->contexts[c].n;
    }
    request->n_z = samples * request->n_joints;
    request->n_x = samples * BODY_OUTPUTS;
    request->z = calloc((size_t)request->n_z, sizeof *request->z);
    request->x = calloc((size_t)request->n_x, sizeof *request->x);
    double *z = request->z;
    double *x = request->x;
    for (int c = 0; z && x && c < search->n_contexts; c++) {
        size_t n = (size_t)search->contexts[c].n;
        memcpy(z, search->contexts[c].z, n * (size_t)request->n_joints * sizeof *z);
        memcpy(x, search->contexts[c].x, n * BODY_OUTPUTS * sizeof *x);
        z += n * (size_t)request->n_joints;
        x += n * BODY_OUTPUTS;
    }
    return z && x;
}

static bool put_start(reach_body_request_t *request, const struct body *start)
{
    if (!start)
        return true;
    request->numbers = calloc(BODY_NUMBERS, sizeof *request->numbers);
    if (!request->numbers)
        return false;
    request->n_numbers = BODY_NUMBERS;
    body_to_numbers(start, request->numbers);
    return true;
}

static void ask_again(void *user)
{
    struct finder_of_bus *finder = user;

    if (finder->request.seq > 0)
        reach_body_request_t_publish(finder->lcm, finder_channels[finder->asker].request,
                                     &finder->request);
}

static void ask(void *user, const struct body_search *search)
{
    struct finder_of_bus *finder = user;
    reach_body_request_t *request = &finder->request;

    forget_request(finder);
    request->utime = bus_utime();
    put_settings(request, &search->settings);
    if (!put_samples(request, search) || !put_start(request, search->settings.start)) {
        forget_request(finder); /* as if nobody answered */
        return;
    }
    request->seq = search->seq;
    ask_again(finder);
}

/* Answers to requests of before this program's start are none of ours. */
static bool take(void *user, struct body_answer *answer)
{
    struct finder_of_bus *finder = user;

    while (mailbox_take(finder->answers, &finder->received)) {
        if (finder->received.request_utime != finder->request.utime)
            continue;
        *answer = finder->received.answer;
        return true;
    }
    return false;
}

static void tell(void *user, const struct body *body)
{
    struct finder_of_bus *finder = user;
    reach_body_t *message = &finder->told;

    message->utime = bus_utime();
    message->outcome = REACH_BODY_T_FOUND;
    message->samples = body->samples;
    message->error = body->error;
    message->doubt = body->doubt;
    body_message_put(body, message);
    reach_body_t_publish(finder->lcm, "REACH_BODY_IN_USE", message);
}

void finder_of_bus_init(struct finder_of_bus *finder, enum finder_asker asker)
{
    memset(finder, 0, sizeof *finder);
    finder->asker = asker;
    finder->port = (struct finder_port){
        .ask = ask, .ask_again = ask_again, .take = take, .tell = tell, .user = finder};
}

void finder_of_bus_end(struct finder_of_bus *finder)
{
    forget_request(finder);
}
