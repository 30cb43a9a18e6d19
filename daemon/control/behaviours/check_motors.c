/* Each joint in turn a little to and fro, so that whoever listens can compare what was commanded
 * with what was measured (reachctl check-motors). The velocities do not look at the encoders: a
 * joint whose sign is wrong must not be driven on by its own error. */
#include "daemon/control/behaviours/behaviour.h"

#include <reach_status_t.h>

static const double amplitude = 0.035; /* of a move, rad: 2 degrees */
static const double slow = 0.05;       /* rad/s */
static const double rest = 0.4;        /* between moves, s: longer than any loop's delay */

/* The second and the fourth go on as the joint went before, so that backlash is taken up. */
static const double directions[] = {1, 1, -1, -1};
enum { MOVES = sizeof directions / sizeof directions[0] };

struct check_motors {
    int joint;
    int move;
    int64_t since; /* the move began, us */
    double side;   /* +1 or -1: away from the nearer limit */
};

static double middle_of(const struct config *config, int joint)
{
    int n_arm = config_arm_joints(config);

    return joint < n_arm ? 0.5 * (config->arm_min.value[joint] + config->arm_max.value[joint])
                         : 0.5 * (config->head_min.value[joint - n_arm] +
                                  config->head_max.value[joint - n_arm]);
}

static void begin_move(struct check_motors *check, const struct senses *senses)
{
    check->since = senses->time;
    if (check->move == 0)
        check->side = senses->q[check->joint] > middle_of(senses->config, check->joint) ? -1 : 1;
}

static bool check_accepts(const struct config *config, const reach_request_t *request)
{
    (void)config, (void)request;
    return true;
}

static void check_start(struct behaviour *behaviour, const reach_request_t *request,
                        const struct senses *senses, struct wants *wants)
{
    (void)request, (void)wants;
    behaviour->progress.total = config_joints(senses->config);
    behaviour->progress.phase = REACH_STATUS_T_MOVE;
    begin_move(behaviour_state(behaviour), senses);
}

/* Returns false after the last joint. */
static bool next_move(struct check_motors *check, struct progress *progress,
                      const struct senses *senses)
{
    if (++check->move == MOVES) {
        check->move = 0;
        progress->done = ++check->joint;
    }
    if (check->joint == progress->total)
        return false;
    begin_move(check, senses);
    return true;
}

static bool check_step(struct behaviour *behaviour, const struct senses *senses,
                       struct wants *wants)
{
    struct check_motors *check = behaviour_state(behaviour);
    double elapsed = (double)(senses->time - check->since) * 1e-6;

    if (elapsed >= amplitude / slow + rest && !next_move(check, &behaviour->progress, senses))
        return false;
    elapsed = (double)(senses->time - check->since) * 1e-6;
    if (elapsed < amplitude / slow)
        wants->velocity[check->joint] = check->side * directions[check->move] * slow;
    return true;
}

BEHAVIOUR_STATE_FITS(struct check_motors);

const struct behaviour_ops behaviour_check_motors = {
    .name = "check-motors",
    .kind = REACH_REQUEST_T_CHECK_MOTORS,
    .code = REACH_STATUS_T_CHECK_MOTORS,
    .state_size = sizeof(struct check_motors),
    .accepts = check_accepts,
    .start = check_start,
    .step = check_step,
};
