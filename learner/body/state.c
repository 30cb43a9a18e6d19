/* The state as bytes, and back: the body, the contexts with what they keep, the samples that wait
 * for a body, and the mixture that answers meanwhile, empty once there is a body. Its size depends
 * on the mixture's experts alone. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/body/body_learner.h"
#include "learner/body/contexts/state_private.h"

/* One number a field, so that no padding is saved. */
enum { HEAD = 15 + CHANGE_VIEW };

static size_t fixed_numbers(const struct body_learner *learner)
{
    return HEAD + BODY_NUMBERS + CONTEXTS_ROOM * state_context_numbers(&learner->contexts->design) +
           3 + kept_numbers(BODY_WAITING, learner->config.n_inputs, BODY_OUTPUTS);
}

size_t body_state_size(const void *self, int n_experts)
{
    const struct body_learner *learner = self;

    return fixed_numbers(learner) * sizeof(double) +
           learner_imle_ops.state_size(learner->meanwhile, n_experts);
}

static void write_trial(const struct body_learner *learner, double *head)
{
    head[0] = learner->doubtful;
    head[1] = learner->given_up;
    head[2] = learner->contest.rows;
    head[3] = learner->contest.scored;
    head[4] = learner->contest.polynomial;
    head[5] = learner->contest.body;
}

static void write_news(const struct contexts *contexts, double *head)
{
    head[0] = contexts->looked;
    head[1] = contexts->streak;
    head[2] = contexts->streak_left;
    head[3] = contexts->news.changes;
    head[4] = contexts->news.cause;
    memcpy(head + 5, contexts->news.by, sizeof contexts->news.by);
}

void body_save(const void *self, unsigned char *buffer)
{
    const struct body_learner *learner = self;
    struct writer writer = {buffer};
    double head[HEAD] = {learner->found, learner->contexts->n,
                         imle_saved_experts(learner->meanwhile), learner->contexts->births};
    double numbers[BODY_NUMBERS];

    write_trial(learner, head + 4);
    write_news(learner->contexts, head + 10);
    state_write(&writer, HEAD, head);
    body_to_numbers(&learner->body, numbers);
    state_write(&writer, BODY_NUMBERS, numbers);
    for (int j = 0; j < CONTEXTS_ROOM; j++)
        state_write_context(&writer, &learner->contexts->design, &learner->contexts->context[j]);
    state_write_kept(&writer, &learner->waiting);
    learner_imle_ops.save(learner->meanwhile, writer.to);
}

static void read_body(struct reader *reader, bool found, int n_joints, struct body *body)
{
    double numbers[BODY_NUMBERS];
    struct body other;
    char ignored[128];

    state_read_head(reader, BODY_NUMBERS, numbers);
    body_from_numbers(numbers, &other);
    state_demand(reader, !found || (other.chain.n == n_joints &&
                                    body_check(&other, ignored, sizeof ignored) == 0));
    if (reader->into_place)
        *body = other;
}

static bool read_trial(struct reader *reader, const double *head, struct body_learner *learner)
{
    bool doubtful = state_whole(reader, head[0], 0, 1) != 0;

    for (int k = 1; k < 6; k++)
        state_demand(reader, head[k] >= 0.0 && head[k] < state_most_counted);
    if (!reader->into_place)
        return doubtful;
    learner->doubtful = doubtful;
    learner->given_up = head[1];
    learner->contest = (struct contest){head[2], head[3], head[4], head[5]};
    return doubtful;
}

static void read_news(struct reader *reader, const double *head, struct contexts *contexts)
{
    int cause = state_whole(reader, head[4], -1, contexts->design.n_joints);

    for (int k = 0; k < 4; k++)
        state_demand(reader, head[k] >= 0.0 && head[k] < state_most_counted);
    if (!reader->into_place)
        return;
    contexts->looked = head[0];
    contexts->streak = head[1];
    contexts->streak_left = head[2];
    contexts->news.changes = head[3];
    contexts->news.cause = cause;
    memcpy(contexts->news.by, head + 5, sizeof contexts->news.by);
}

/* Returns the experts of the mixture, whose bytes are at reader->from then. */
static int read_all(struct reader *reader, struct body_learner *learner)
{
    struct contexts *contexts = learner->contexts;
    int confirmed = 0;
    double head[HEAD];

    state_read_head(reader, HEAD, head);
    bool doubtful = read_trial(reader, head + 4, learner);
    read_news(reader, head + 10, contexts);
    state_demand(reader, head[3] >= 0.0 && head[3] < state_most_counted &&
                             head[3] == (double)(int64_t)head[3]);
    bool found = state_whole(reader, head[0], 0, 1) != 0;
    int n = state_whole(reader, head[1], 0, found ? contexts->most + 1 : 0);
    int meanwhile =
        state_whole(reader, head[2], 0, found && !doubtful ? 0 : learner->config.capacity);
    read_body(reader, found, learner->config.n_inputs, &learner->body);
    if (reader->into_place) {
        learner->found = found;
        contexts->n = n;
        contexts->births = head[3];
    }
    for (int j = 0; j < CONTEXTS_ROOM; j++)
        confirmed += state_read_context(reader, &contexts->design, j < n, &contexts->context[j]);
    state_demand(reader, confirmed <= contexts->most);
    state_read_kept(reader, &learner->waiting);
    return meanwhile;
}

int body_load(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size)
{
    struct body_learner *learner = self;
    struct reader look = {buffer, true, false};
    struct reader take = {buffer, true, true};
    struct contexts *contexts = learner->contexts;
    int meanwhile = read_all(&look, learner);

    if (!look.fits || meanwhile != n_experts) {
        snprintf(err, err_size, "it holds numbers that no state can have");
        return -1;
    }
    if (learner_imle_ops.load(learner->meanwhile, n_experts, look.from, err, err_size) != 0)
        return -1;
    read_all(&take, learner);
    if (!learner->found)
        return 0;
    design_init(&contexts->design, &learner->body);
    for (int j = 0; j < contexts->n; j++)
        tied_refresh(&contexts->context[j].tied, &contexts->design, contexts->kernels,
                     &contexts->scratch);
    return 0;
}
