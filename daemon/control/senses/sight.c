#include "daemon/control/senses/sight.h"

#include <math.h>
#include <string.h>

void sight_init(struct sight *sight, const struct config *config)
{
    memset(sight, 0, sizeof *sight);
    sight->config = config;
    sight->newest = INT64_MIN;
}

bool sight_observe(struct sight *sight, const struct observation *marker,
                   const struct history *history)
{
    struct sight_frame frame = {.utime = marker->utime};

    if (marker->utime <= sight->newest || !history_at(history, marker->utime, frame.q))
        return false;
    memcpy(frame.image, marker->value, sizeof frame.image);
    sight->newest = marker->utime;
    sight->newest_seen = marker->seen;
    if (!marker->seen) {
        sight->count = 0;
        return true;
    }
    sight->any = true;
    sight->new_frame = true;
    sight->last = (sight->last + 1) % SIGHT_FRAMES;
    sight->frame[sight->last] = frame;
    if (sight->count < SIGHT_FRAMES)
        sight->count++;
    return true;
}

void sight_carry(struct sight *sight, const double *q, const double *jacobian)
{
    const struct sight_frame *frame = &sight->frame[sight->last];
    int n_arm = config_arm_joints(sight->config);
    double moved[SPACE_DIMENSIONS] = {0};
    double shift[SPACE_DIMENSIONS];

    if (!sight->any)
        return;
    for (int row = 0; jacobian && row < SPACE_DIMENSIONS; row++)
        for (int i = 0; i < n_arm; i++)
            moved[row] += jacobian[row * n_arm + i] * (q[i] - frame->q[i]);
    for (int i = 0; i < sight->config->space.n_head; i++)
        moved[i] -= q[n_arm + i] - frame->q[n_arm + i];
    space_from_task(&sight->config->space, moved, shift);
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        sight->carried[row] = frame->image[row] + shift[row];
}

bool sight_seen(const struct sight *sight, int64_t now)
{
    return sight->any && sight->newest_seen &&
           (double)(now - sight->newest) * 1e-6 <= sight->config->eyes_stale;
}

/* The frame `age` places before the newest. */
static const struct sight_frame *frame_at(const struct sight *sight, int age)
{
    return &sight->frame[(sight->last - age + SIGHT_FRAMES) % SIGHT_FRAMES];
}

static bool within_tolerance(const struct sight *sight, double u, double v)
{
    return fabs(u) <= sight->config->fixation_tolerance &&
           fabs(v) <= sight->config->fixation_tolerance;
}

/* Largest minus least of one image axis, and its mean. */
static double image_spread(const struct sight *sight, int n, int axis, double *mean)
{
    double least = INFINITY, greatest = -INFINITY, sum = 0;

    for (int age = 0; age < n; age++) {
        double value = frame_at(sight, age)->image[axis];
        least = fmin(least, value);
        greatest = fmax(greatest, value);
        sum += value;
    }
    *mean = sum / n;
    return greatest - least;
}

/* The same of a joint, as seen in the image: a joint that moves is not at rest either. */
static double joint_spread(const struct sight *sight, int n, int joint)
{
    double least = INFINITY, greatest = -INFINITY;

    for (int age = 0; age < n; age++) {
        double value = frame_at(sight, age)->q[joint];
        least = fmin(least, value);
        greatest = fmax(greatest, value);
    }
    return (greatest - least) * sight->config->eyes_pixels_per_radian;
}

int sight_pair_frames(const struct config *config)
{
    return config->space.fixates ? config->fixation_frames : 1;
}

bool sight_fixated(const struct sight *sight)
{
    int n = sight_pair_frames(sight->config);
    double mean[SPACE_DIMENSIONS];

    if (!sight->config->space.fixates || sight->count < n)
        return sight->count >= n;
    for (int axis = 0; axis < SPACE_DIMENSIONS; axis++)
        if (image_spread(sight, n, axis, &mean[axis]) > sight->config->fixation_rest)
            return false;
    for (int joint = 0; joint < config_joints(sight->config); joint++)
        if (joint_spread(sight, n, joint) > sight->config->fixation_rest)
            return false;
    return within_tolerance(sight, mean[0], mean[1]);
}

bool sight_centred(const struct sight *sight)
{
    return sight_within(sight, sight->config->fixation_tolerance);
}

bool sight_within(const struct sight *sight, double pixels)
{
    const double *image = sight->frame[sight->last].image;

    return sight->count > 0 && (!sight->config->space.fixates ||
                                (fabs(image[0]) <= pixels && fabs(image[1]) <= pixels));
}

double sight_eccentricity(const struct sight *sight)
{
    return fmax(fabs(sight->carried[0]), fabs(sight->carried[1]));
}

void sight_position(const struct sight *sight, const double *q, double x[SPACE_DIMENSIONS])
{
    int n_arm = config_arm_joints(sight->config);

    space_to_task(&sight->config->space, sight->carried, x);
    for (int i = 0; i < sight->config->space.n_head; i++)
        x[i] += q[n_arm + i];
}

void sight_pair(const struct sight *sight, int n, double *q, double *x, int64_t *utime)
{
    int n_arm = config_arm_joints(sight->config);
    double image[SPACE_DIMENSIONS] = {0};

    memset(q, 0, sizeof(double) * (size_t)n_arm);
    memset(x, 0, sizeof(double) * SPACE_DIMENSIONS);
    for (int age = n - 1; age >= 0; age--) {
        const struct sight_frame *frame = frame_at(sight, age);
        for (int i = 0; i < n_arm; i++)
            q[i] += frame->q[i] / n;
        for (int i = 0; i < sight->config->space.n_head; i++)
            x[i] += frame->q[n_arm + i] / n;
        for (int axis = 0; axis < SPACE_DIMENSIONS; axis++)
            image[axis] += frame->image[axis] / n;
    }
    double residual[SPACE_DIMENSIONS];
    space_to_task(&sight->config->space, image, residual);
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        x[row] += residual[row];
    *utime = (frame_at(sight, 0)->utime + frame_at(sight, n - 1)->utime) / 2;
}
