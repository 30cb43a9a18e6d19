#include "daemon/control/senses/witness_private.h"

#include <math.h>
#include <string.h>

static const double lever = 15;           /* scaled a radian: 3 m, 150 deg, 600 px, as scales are */
static const double jump_noise = 1.5;     /* of space.noise: less is no jump, */
static const double rest_noise = 0.5;     /* and less no motion */
static const int64_t gap_us = 250000;     /* after which frames are not compared */
static const int64_t rest_us = 100000;    /* over which it is to rest */
static const int64_t wait_us = 1000000;   /* nothing is learned while it shows what it may be */
static const int64_t silent_us = 5000000; /* nor after a finding, at least and at most */
static const int64_t silent_most_us = 60000000;
static const int64_t told_us = 10000000; /* and it is told for longer */

enum {
    JUMPS_IN = 16,    /* frames, */
    JUMPS_MOST = 6,   /* of which so many are strange by jumping: a single step makes two */
    RESTLESS_FOR = 3, /* times rest_us; a step is over after one */
    FOUND_FOR = 8,    /* frames in a row */
    FITS_FOR = 50,    /* frames in a row with motion, after which all is well again */
};
static const double misfit_share = 0.004; /* of the slow mean, a frame */
static const double misfit_most = 0.3;    /* that counts in it */
static const double misfit_fits = 0.1;    /* up to this the model knows what moving does */
static const double misfit_sure = 0.05;   /* up to this it knows it well */
static const double misfit_wrong = 0.04;  /* from this on something is other than it was: late, */
static const double misfit_row = 0.2;     /* and so from this on, of one row */

void witness_init(struct witness *witness, const struct config *config)
{
    memset(witness, 0, sizeof *witness);
    witness->config = config;
    witness->misfit = misfit_most;
}

/* Adds the motion since the frame before as the model has it: by that of its solutions which fits
 * best, since the one in use may be another for a moment. */
static void expect(const struct witness *witness, struct witness_frame *frame,
                   const struct witness_frame *before, const struct learner_prediction *prediction)
{
    const double *scale = witness->config->space.scale;
    int n = config_arm_joints(witness->config);
    double least = INFINITY, best[SPACE_DIMENSIONS] = {0};

    for (int k = 0; k < prediction->n_solutions; k++) {
        const double *jacobian = prediction->solution[k].jacobian;
        double moved[SPACE_DIMENSIONS] = {0}, missed = 0;
        for (int row = 0; row < SPACE_DIMENSIONS; row++) {
            for (int i = 0; i < n; i++)
                moved[row] += jacobian[row * n + i] * (frame->q[i] - before->q[i]) / scale[row];
            double e = frame->x[row] - before->x[row] - moved[row];
            missed += e * e;
        }
        if (missed >= least)
            continue;
        least = missed;
        memcpy(best, moved, sizeof best);
    }
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        frame->expected[row] += best[row];
}

/* Takes the frame in; its path and what is expected go on from the one before. */
static void push(struct witness *witness, const struct sight *sight,
                 const struct learner_prediction *prediction)
{
    const struct config *config = witness->config;
    const struct witness_frame before = *witness_frame_at(witness, 0);
    struct witness_frame *frame;
    double x[SPACE_DIMENSIONS];

    witness->newest = (witness->newest + 1) % WITNESS_FRAMES;
    frame = &witness->frame[witness->newest];
    *frame = before;
    frame->strange = false;
    sight_pair(sight, 1, frame->q, x, &frame->utime);
    if (frame->utime <= before.utime || frame->utime - before.utime > gap_us)
        witness->kept = witness->modelled = witness->restless = witness->late = witness->still =
            witness->fits = 0;
    for (int i = 0; i < config_arm_joints(config); i++)
        frame->path += fabs(frame->q[i] - before.q[i]);
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        frame->x[row] = x[row] / config->space.scale[row];
        frame->image[row] = sight->frame[sight->last].image[row];
    }
    expect(witness, frame, &before, prediction);
    witness->kept += witness->kept < WITNESS_FRAMES;
    witness->modelled =
        prediction->n_solutions > 0 ? witness->modelled + (witness->modelled < WITNESS_FRAMES) : 0;
}

/* Whether the frame before the newest is off the line between its neighbours. */
static bool is_strange(const struct witness *witness)
{
    const struct witness_frame *a = witness_frame_at(witness, 2), *b = witness_frame_at(witness, 1),
                               *c = witness_frame_at(witness, 0);
    double share = (double)(b->utime - a->utime) / (double)(c->utime - a->utime);
    double bent = 0;

    for (int i = 0; i < config_arm_joints(witness->config); i++)
        bent += fabs(b->q[i] - a->q[i] - share * (c->q[i] - a->q[i]));
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        double off = b->x[row] - a->x[row] - share * (c->x[row] - a->x[row]);
        if (fabs(off) > witness_noise(witness->config, row, jump_noise) + lever * bent)
            return true;
    }
    return false;
}

static bool jumps(struct witness *witness)
{
    int n = 0;

    if (witness->kept < 3)
        return false;
    witness->frame[(witness->newest - 1 + WITNESS_FRAMES) % WITNESS_FRAMES].strange =
        is_strange(witness);
    for (int age = 1; age <= JUMPS_IN && age < witness->kept; age++)
        n += witness_frame_at(witness, age)->strange;
    return n >= JUMPS_MOST;
}

/* Whether it moved in the last `rest_us` by more than the arm can have moved it. */
static bool moved_at_rest(const struct witness *witness)
{
    const struct witness_frame *now = witness_frame_at(witness, 0), *then = now;

    for (int age = 1; age < witness->kept; age++) {
        then = witness_frame_at(witness, age);
        if (now->utime - then->utime >= rest_us)
            break;
    }
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        if (fabs(now->x[row] - then->x[row]) >
            witness_noise(witness->config, row, rest_noise) + lever * (now->path - then->path))
            return true;
    return false;
}

static bool is_restless(struct witness *witness)
{
    int64_t frame_us;

    if (witness->kept < 2)
        return false;
    frame_us = witness_frame_at(witness, 0)->utime - witness_frame_at(witness, 1)->utime;
    witness->restless = moved_at_rest(witness) ? witness->restless + 1 : 0;
    return witness->restless * frame_us >= RESTLESS_FOR * rest_us;
}

/* What a moment's misfit says of whether the model can be held against what is seen. */
static void judge_fit(struct witness *witness, double misfit, double worst, int64_t time)
{
    if (misfit > misfit_wrong || worst > misfit_row) {
        witness->fits = 0;
        if (witness->misfit < misfit_sure && !witness->since)
            witness->since = time;
    } else {
        witness->fits++;
        if (witness->fits >= FITS_FOR)
            witness->since = 0;
    }
    if (witness_believes(witness, time))
        witness->misfit += misfit_share * (fmin(misfit, misfit_most) - witness->misfit);
}

/* Compares what moved with what was expected to. */
static void compare(struct witness *witness, int64_t time)
{
    bool knows = witness->misfit < misfit_fits, late = false, still = false;
    struct witness_motion now;
    double misfit, worst;

    if (witness->modelled <= WITNESS_WINDOW + WITNESS_STRIDE)
        return;
    now = witness_motion(witness, 0, &worst);
    if (worst > 0) {
        misfit = witness_misfit(&now);
        still = knows && witness_is_still(witness, &now);
        late = knows && misfit > misfit_wrong && witness_fits_another_time(witness, misfit);
        judge_fit(witness, misfit, worst, time);
    }
    witness->late = late ? witness->late + 1 : 0;
    witness->still = still ? witness->still + 1 : 0;
}

static void find(struct witness *witness, enum witness_doubt doubt, bool found, int64_t time)
{
    if (!found)
        return;
    witness->last[doubt] = time;
    witness->fits = 0;
}

void witness_look(struct witness *witness, const struct sight *sight,
                  const struct learner_prediction *prediction, int64_t time)
{
    if (witness->config->eyes_doubt <= 0)
        return;
    push(witness, sight, prediction);
    compare(witness, time);
    find(witness, WITNESS_JUMPS, jumps(witness), time);
    find(witness, WITNESS_RESTLESS, is_restless(witness), time);
    witness->one_eye = witness_one_eye_is_late(witness) ? witness->one_eye + 1 : 0;
    find(witness, WITNESS_ONE_EYE, witness->one_eye >= FOUND_FOR, time);
    find(witness, WITNESS_LATE, witness->late >= FOUND_FOR, time);
    find(witness, WITNESS_STILL, witness->still >= FOUND_FOR, time);
}

static bool found_within(const struct witness *witness, int doubt, int64_t time, int64_t within)
{
    return witness->last[doubt] != 0 && time - witness->last[doubt] < within;
}

/* Whether the finding is over: some time has gone by, and where the model knows what moving does,
 * what is seen has moved so again. */
static bool is_over(const struct witness *witness, int doubt, int64_t time)
{
    bool fits = witness->misfit >= misfit_fits || witness->fits >= FITS_FOR;

    return !found_within(witness, doubt, time, fits ? silent_us : silent_most_us);
}

bool witness_believes(const struct witness *witness, int64_t time)
{
    bool waits = witness->since && time - witness->since < wait_us;

    for (int doubt = 0; doubt < WITNESS_DOUBTS; doubt++)
        if (!is_over(witness, doubt, time))
            return false;
    return !waits || witness->config->space.fixates;
}

unsigned witness_tells(const struct witness *witness, int64_t time)
{
    unsigned told = 0;

    for (int doubt = 0; doubt < WITNESS_DOUBTS; doubt++)
        told |= (unsigned)found_within(witness, doubt, time, told_us) << doubt;
    return told;
}
