#include "daemon/control/senses/plausible.h"

#include <math.h>
#include <string.h>

static const int64_t second = 1000000;
static const int64_t doubt_us = 100000; /* after the newest strike */

void plausible_init(struct plausible *plausible, const struct config *config)
{
    memset(plausible, 0, sizeof *plausible);
    plausible->config = config;
}

void plausible_forget(struct plausible *plausible)
{
    plausible_init(plausible, plausible->config);
}

static void strike(struct plausible_strikes *strikes, int64_t time)
{
    strikes->newest = (strikes->newest + 1) % PLAUSIBLE_MOST;
    strikes->at[strikes->newest] = time;
}

static bool is_recent(int64_t at, int64_t time, int64_t within)
{
    return at != 0 && time - at < within;
}

/* All that are remembered. */
static bool are_too_many(const struct plausible_strikes *strikes, int64_t time)
{
    for (int i = 0; i < PLAUSIBLE_MOST; i++)
        if (!is_recent(strikes->at[i], time, second))
            return false;
    return true;
}

void plausible_crossed(struct plausible *plausible, int crossed, int64_t time)
{
    for (int i = 0; i < crossed && i < PLAUSIBLE_MOST; i++)
        strike(&plausible->crossings, time);
    if (crossed > 0)
        plausible->any = false;
}

/* Of the joint that is farthest beyond what it can have moved; false when none is. */
static bool find_jump(struct plausible *plausible, const reach_robot_state_t *state)
{
    const struct config *config = plausible->config;
    double seconds = fmax((double)(state->utime - plausible->utime) * 1e-6, config->period);
    double worst = 0;

    for (int i = 0; i < state->n_joints; i++) {
        double most =
            config_joint_limits(config, i).safety_velocity * seconds + config->safety_jump;
        double moved = state->position[i] - plausible->q[i];
        if (fabs(moved) - most <= worst)
            continue;
        worst = fabs(moved) - most;
        plausible->jumped = moved;
        plausible->jump = (struct state_fault){i + 1, state->position[i], plausible->q[i] - most,
                                               plausible->q[i] + most};
    }
    return worst > 0;
}

bool plausible_strikes_jump(struct plausible *plausible, const reach_robot_state_t *state,
                            bool within, int64_t time)
{
    /* A clock that was set back says nothing of how long it took. */
    if (!plausible->any || state->utime <= plausible->utime || !find_jump(plausible, state))
        return false;
    strike(within ? &plausible->jumps : &plausible->beyond, time);
    return true;
}

void plausible_believe(struct plausible *plausible, const reach_robot_state_t *state)
{
    plausible->any = true;
    plausible->beyond = (struct plausible_strikes){0};
    plausible->utime = state->utime;
    memcpy(plausible->q, state->position, sizeof plausible->q);
}

bool plausible_doubts(const struct plausible *plausible, int64_t time)
{
    const struct plausible_strikes *jumps = &plausible->jumps, *crossings = &plausible->crossings;

    return is_recent(jumps->at[jumps->newest], time, doubt_us) ||
           is_recent(crossings->at[crossings->newest], time, doubt_us);
}

bool plausible_two_senders(const struct plausible *plausible, int64_t time)
{
    return are_too_many(&plausible->crossings, time);
}

bool plausible_jumps(const struct plausible *plausible, int64_t time)
{
    return are_too_many(&plausible->jumps, time) || are_too_many(&plausible->beyond, time);
}
