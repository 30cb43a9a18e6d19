#include "learner/finder/question.h"

#include "common/base/big_endian.h"
#include "learner/body/contexts/contexts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_AT = 8, MOST_STARTS = 10000, MOST_SAMPLES = CONTEXTS_KEPT };

_Static_assert(sizeof((reach_body_request_t *)0)->low == sizeof((struct finder_settings *)0)->low,
               "body_request_t.low and high");
_Static_assert(BODY_NUMBERS == 5841, "body_t.numbers and body_request_t.n_numbers");
_Static_assert(MOST_SAMPLES == 512 && (int)MOST_SAMPLES >= (int)CONTEXTS_KEPT,
               "body_request_t.count");

/* LCM allocates what length fields say, so they are looked at before it reads them: they are the
 * last three numbers of the part whose size is fixed. */
static bool lengths_fit(const unsigned char *bytes, size_t size)
{
    const reach_body_request_t empty = {0};
    size_t fixed = (size_t)reach_body_request_t_encoded_size(&empty);
    uint64_t n = 0;

    if (size < fixed || (int64_t)big_endian(bytes, 8) != __reach_body_request_t_get_hash())
        return false;
    for (size_t i = 0; i < 3; i++)
        n += big_endian(bytes + fixed - 4 * (3 - i), 4);
    return size == fixed + 8 * n;
}

static bool usable(const double *numbers, int n)
{
    for (int i = 0; i < n; i++)
        if (!(fabs(numbers[i]) <= LEARNER_LARGEST_NUMBER))
            return false;
    return true;
}

static const char *settings_fault(const reach_body_request_t *request)
{
    const double *g = request->gravity;

    if (request->n_joints < 1 || request->n_joints > LEARNER_MAX_INPUTS)
        return "n_joints is out of range";
    if (!(request->angle_unit > 0 && request->angle_unit <= 1))
        return "angle_unit is out of range";
    for (int i = 0; i < BODY_OUTPUTS; i++)
        if (!(request->noise[i] >= 1e-12 && request->noise[i] <= LEARNER_LARGEST_NUMBER))
            return "noise is out of range";
    if (!(fabs(sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) - 1) < 1e-9))
        return "gravity is no unit vector";
    if (!usable(request->low, LEARNER_MAX_INPUTS) || !usable(request->high, LEARNER_MAX_INPUTS))
        return "low or high is not finite, or too large";
    if (request->starts < 1 || request->starts > MOST_STARTS)
        return "starts is out of range";
    return NULL;
}

static const char *samples_fault(const reach_body_request_t *request)
{
    int samples = 0;

    if (request->n_contexts < 1 || request->n_contexts > LEARNER_MAX_SOLUTIONS)
        return "n_contexts is out of range";
    for (int c = 0; c < request->n_contexts; c++) {
        if (request->count[c] < 1 || request->count[c] > MOST_SAMPLES)
            return "count is out of range";
        samples += request->count[c];
    }
    if (request->n_z != samples * request->n_joints || request->n_x != samples * BODY_OUTPUTS)
        return "n_z or n_x does not follow from count";
    if (!usable(request->z, request->n_z) || !usable(request->x, request->n_x))
        return "a sample is not finite, or too large";
    return NULL;
}

/* Returns false with a line in `why`. */
static bool take_start(struct question *question, char *why, size_t why_size)
{
    const reach_body_request_t *request = &question->request;

    if (request->n_numbers == 0)
        return true;
    if (request->n_numbers != BODY_NUMBERS || !usable(request->numbers, BODY_NUMBERS)) {
        snprintf(why, why_size, "n_numbers is out of range, or a number is not finite");
        return false;
    }
    body_from_numbers(request->numbers, &question->start);
    if (body_check(&question->start, why, why_size) != 0)
        return false;
    if (question->start.chain.n != request->n_joints ||
        question->start.sees != (request->sees != 0)) {
        snprintf(why, why_size, "the body that it begins with is of another robot");
        return false;
    }
    question->settings.start = &question->start;
    return true;
}

static void take_settings(struct question *question)
{
    const reach_body_request_t *request = &question->request;
    struct finder_settings *settings = &question->settings;

    *settings = (struct finder_settings){
        .n_joints = request->n_joints,
        .sees = request->sees != 0,
        .angle_unit = request->angle_unit,
        .seed = request->seed,
        .starts = request->starts,
    };
    for (int i = 0; i < BODY_OUTPUTS; i++) {
        settings->noise[i] = request->noise[i];
        settings->gravity[i] = request->gravity[i];
    }
    memcpy(settings->low, request->low, sizeof settings->low);
    memcpy(settings->high, request->high, sizeof settings->high);
}

static void take_samples(struct question *question)
{
    const reach_body_request_t *request = &question->request;
    const double *z = request->z;
    const double *x = request->x;

    question->n_contexts = request->n_contexts;
    for (int c = 0; c < request->n_contexts; c++) {
        question->contexts[c] =
            (struct learner_samples){request->rigid[c] != 0, request->count[c], z, x};
        z += (ptrdiff_t)request->count[c] * request->n_joints;
        x += (ptrdiff_t)request->count[c] * BODY_OUTPUTS;
    }
}

/* Returns false with a line in `why`. */
static bool take(struct question *question, char *why, size_t why_size)
{
    const char *fault = settings_fault(&question->request);

    if (!fault)
        fault = samples_fault(&question->request);
    if (fault) {
        snprintf(why, why_size, "%s", fault);
        return false;
    }
    take_settings(question);
    take_samples(question);
    return take_start(question, why, why_size);
}

struct question *question_read(const void *data, size_t size, struct question_name *name, char *why,
                               size_t why_size)
{
    struct question *question;

    *name = (struct question_name){0};
    if (!lengths_fit(data, size)) {
        snprintf(why, why_size, "it is no body_request_t of this version");
        return NULL;
    }
    name->utime = (int64_t)big_endian((const unsigned char *)data + NAME_AT, 8);
    name->seq = (int64_t)big_endian((const unsigned char *)data + NAME_AT + 8, 8);
    question = calloc(1, sizeof *question);
    if (!question ||
        reach_body_request_t_decode(data, 0, (int)size, &question->request) != (int)size) {
        snprintf(why, why_size, "it cannot be read");
        free(question);
        return NULL;
    }
    if (take(question, why, why_size))
        return question;
    question_free(question);
    return NULL;
}

void question_free(struct question *question)
{
    if (!question)
        return;
    reach_body_request_t_decode_cleanup(&question->request);
    free(question);
}
