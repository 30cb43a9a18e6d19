#include "daemon/control/senses/witness.h"

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
    STRIDE = 5,       /* frames over which motion is measured, */
    WINDOW = 30,      /* how often, */
    LAG_MOST = 40,    /* and how far back it is looked for */
    LAG_LEAST = 4,
    FOUND_FOR = 8, /* frames in a row */
    FITS_FOR = 50, /* frames in a row with motion, after which all is well again */
};
static const double misfit_share = 0.004; /* of the slow mean, a frame */
static const double misfit_most = 0.3;    /* that counts in it */
static const double misfit_fits = 0.1;    /* up to this the model knows what moving does */
static const double misfit_sure = 0.05;   /* up to this it knows it well */
static const double misfit_wrong = 0.04;  /* from this on something is other than it was: late, */
static const double misfit_row = 0.2;     /* and so from this on, of one row */
static const double late_fits = 0.02;     /* misfit at another time that is none */
static const double late_gain = 0.3;      /* when another time fits so much better */
static const double still_share = 0.05;   /* of the squared motion expected */
static const double eye_fits = 0.1;       /* of the squared motion of disparity */
static const double still_noise = 0.03;   /* and of what is noise */
static const double least_motion = 1;     /* noises a stride, mean: less shows nothing */

void witness_init(struct witness *witness, const struct config *config)
{
    memset(witness, 0, sizeof *witness);
    witness->config = config;
    witness->misfit = misfit_most;
}

static const struct witness_frame *frame_at(const struct witness *witness, int age)
{
    return &witness->frame[(witness->newest - age + WITNESS_FRAMES) % WITNESS_FRAMES];
}

/* So many times the noise of an output, in scaled units. */
static double noise_of(const struct config *config, int row, double times)
{
    return config->eyes_doubt * times * config->space.noise[row] / config->space.scale[row];
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
    const struct witness_frame before = *frame_at(witness, 0);
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
    const struct witness_frame *a = frame_at(witness, 2), *b = frame_at(witness, 1),
                               *c = frame_at(witness, 0);
    double share = (double)(b->utime - a->utime) / (double)(c->utime - a->utime);
    double bent = 0;

    for (int i = 0; i < config_arm_joints(witness->config); i++)
        bent += fabs(b->q[i] - a->q[i] - share * (c->q[i] - a->q[i]));
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        double off = b->x[row] - a->x[row] - share * (c->x[row] - a->x[row]);
        if (fabs(off) > noise_of(witness->config, row, jump_noise) + lever * bent)
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
        n += frame_at(witness, age)->strange;
    return n >= JUMPS_MOST;
}

/* Whether it moved in the last `rest_us` by more than the arm can have moved it. */
static bool moved_at_rest(const struct witness *witness)
{
    const struct witness_frame *now = frame_at(witness, 0), *then = now;

    for (int age = 1; age < witness->kept; age++) {
        then = frame_at(witness, age);
        if (now->utime - then->utime >= rest_us)
            break;
    }
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        if (fabs(now->x[row] - then->x[row]) >
            noise_of(witness->config, row, rest_noise) + lever * (now->path - then->path))
            return true;
    return false;
}

static bool is_restless(struct witness *witness)
{
    int64_t frame_us;

    if (witness->kept < 2)
        return false;
    frame_us = frame_at(witness, 0)->utime - frame_at(witness, 1)->utime;
    witness->restless = moved_at_rest(witness) ? witness->restless + 1 : 0;
    return witness->restless * frame_us >= RESTLESS_FOR * rest_us;
}

/* Whether what was seen made a step in the stride that ended so many frames ago: that is none of
 * the arm's motion. */
static bool has_step(const struct witness *witness, int age)
{
    for (int i = age; i <= age + STRIDE; i++)
        if (frame_at(witness, i)->strange)
            return true;
    return false;
}

/* Squared motion over the window: seen, expected `lag` frames before, and their difference. */
struct motion {
    double seen, expected, missed;
};

static struct motion motion_of(const struct witness *witness, int row, int lag)
{
    struct motion sum = {0};

    for (int age = 0; age < WINDOW; age++) {
        if (has_step(witness, age))
            continue;
        double seen = frame_at(witness, age)->x[row] - frame_at(witness, age + STRIDE)->x[row];
        double expected = frame_at(witness, age + lag)->expected[row] -
                          frame_at(witness, age + lag + STRIDE)->expected[row];
        sum.seen += seen * seen;
        sum.expected += expected * expected;
        sum.missed += (seen - expected) * (seen - expected);
    }
    return sum;
}

static double misfit_of(const struct motion *motion)
{
    return motion->missed / (motion->seen + motion->expected);
}

/* Squared motion that would be noise alone. */
static double least_of(const struct config *config, int row)
{
    double least = noise_of(config, row, least_motion);

    return WINDOW * least * least;
}

/* Adds up all rows. `worst` becomes the misfit of that row that moved and fits worst. */
static struct motion motion_at(const struct witness *witness, int lag, double *worst)
{
    struct motion sum = {0};

    *worst = 0;
    for (int row = 0; row < SPACE_DIMENSIONS; row++) {
        const struct motion motion = motion_of(witness, row, lag);
        if (fmax(motion.seen, motion.expected) >= least_of(witness->config, row))
            *worst = fmax(*worst, misfit_of(&motion));
        sum.seen += motion.seen;
        sum.expected += motion.expected;
        sum.missed += motion.missed;
    }
    return sum;
}

static bool is_still(const struct witness *witness, const struct motion *motion)
{
    double least = 0;

    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        least += least_of(witness->config, row);
    return motion->seen < still_share * motion->expected && motion->seen < still_noise * least;
}

static bool fits_another_time(const struct witness *witness, double misfit)
{
    double worst;

    for (int lag = LAG_LEAST; lag <= LAG_MOST && lag + WINDOW + STRIDE < witness->modelled; lag++) {
        const struct motion then = motion_at(witness, lag, &worst);
        if (misfit_of(&then) < fmin(late_gain * misfit, late_fits))
            return true;
    }
    return false;
}

/* Where the left eye shows what was `lag` frames ago, disparity moves by as much as the right image
 * has moved on since; where it is frozen, by as much as the right image moves. */
static bool left_lags(const struct witness *witness, int lag)
{
    double moved = 0, missed = 0;

    for (int age = 0; age < WINDOW; age++) {
        const struct witness_frame *now = frame_at(witness, age),
                                   *then = frame_at(witness, age + STRIDE);
        double right = now->image[0] - then->image[0];
        double disparity = now->image[2] - then->image[2];
        if (lag > 0)
            right -= frame_at(witness, age + lag)->image[0] -
                     frame_at(witness, age + lag + STRIDE)->image[0];
        moved += disparity * disparity;
        missed += (disparity + right) * (disparity + right);
    }
    return missed < eye_fits * moved;
}

/* Whether disparity moves as only one eye's being late or frozen can make it. */
static bool is_one_eye_late(const struct witness *witness)
{
    const struct config *config = witness->config;
    double least = noise_of(config, 2, least_motion) * config->space.scale[2], moved = 0;

    if (config->space.kind != SPACE_VISUAL || witness->kept <= WINDOW + STRIDE)
        return false;
    for (int age = 0; age < WINDOW; age++) {
        double step = frame_at(witness, age)->image[2] - frame_at(witness, age + STRIDE)->image[2];
        moved += step * step;
    }
    if (moved < WINDOW * least * least)
        return false;
    for (int lag = 0; lag <= LAG_MOST && lag + WINDOW + STRIDE < witness->kept;
         lag += lag ? 1 : LAG_LEAST)
        if (left_lags(witness, lag))
            return true;
    return false;
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
    struct motion now;
    double misfit, worst;

    if (witness->modelled <= WINDOW + STRIDE)
        return;
    now = motion_at(witness, 0, &worst);
    if (worst > 0) {
        misfit = misfit_of(&now);
        still = knows && is_still(witness, &now);
        late = knows && misfit > misfit_wrong && fits_another_time(witness, misfit);
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
    witness->one_eye = is_one_eye_late(witness) ? witness->one_eye + 1 : 0;
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
