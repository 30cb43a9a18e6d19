#include "motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct joint {
    double lowest, highest, fastest, acceleration; /* rad, rad/s, rad/s^2 */
    double wanted;                                 /* commanded, rad/s */
    double position, velocity;                     /* the set-point, rad and rad/s */
    double measured, moves;                        /* the arm, rad and rad/s */
};

struct motion {
    int joints;
    double leash, period; /* rad, s */
    bool begun;
    int64_t robot; /* of the newest reading, the robot's clock, us */
    int64_t commanded,
        commanded_robot; /* when the newest command came, by both clocks; 0 = never */
    int leashed;
    struct joint joint[MOTION_JOINTS];
};

static bool are_finite(int n, const double *values)
{
    for (int i = 0; i < n; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

/* Written so that a NaN fails. */
static bool is_sensible(const struct joint *joint)
{
    return isfinite(joint->lowest) && isfinite(joint->highest) && joint->lowest < joint->highest &&
           joint->fastest > 0 && isfinite(joint->fastest) && joint->acceleration > 0 &&
           isfinite(joint->acceleration);
}

struct motion *motion_create(int joints, const double *lowest, const double *highest,
                             const double *fastest, const double *acceleration, double leash,
                             double period)
{
    struct motion *motion = NULL;

    if (joints >= 1 && joints <= MOTION_JOINTS && leash > 0 && isfinite(leash) && period > 0 &&
        isfinite(period))
        motion = calloc(1, sizeof *motion);
    if (!motion)
        return NULL;
    motion->joints = joints;
    motion->leash = leash;
    motion->period = period;
    for (int i = 0; i < joints; i++) {
        motion->joint[i] = (struct joint){.lowest = lowest[i],
                                          .highest = highest[i],
                                          .fastest = fastest[i],
                                          .acceleration = acceleration[i]};
        if (!is_sensible(&motion->joint[i])) {
            free(motion);
            return NULL;
        }
    }
    return motion;
}

void motion_destroy(struct motion *motion)
{
    free(motion);
}

bool motion_command(struct motion *motion, int n, const double *velocity, int64_t now)
{
    if (n != motion->joints || !are_finite(n, velocity))
        return false;
    for (int i = 0; i < n; i++)
        motion->joint[i].wanted = velocity[i];
    motion->commanded = now;
    motion->commanded_robot = motion->robot;
    return true;
}

static void begin(struct motion *motion, const double *measured)
{
    for (int i = 0; i < motion->joints; i++) {
        motion->joint[i].position = measured[i];
        motion->joint[i].velocity = 0;
        motion->joint[i].moves = 0;
    }
    motion->begun = true;
    motion->commanded = 0;
}

static bool is_fresh(const struct motion *motion, int64_t robot, int64_t now)
{
    return motion->commanded > 0 && now - motion->commanded < MOTION_FRESH_US &&
           robot - motion->commanded_robot < MOTION_FRESH_US;
}

/* The fastest that comes to rest within `room`, when it is held for `dt` and then braked. */
static double fastest_within(double room, double acceleration, double dt)
{
    return room > 0 ? acceleration * (sqrt(dt * dt + 2 * room / acceleration) - dt) : 0;
}

static double clamp(double value, double least, double most)
{
    return fmax(least, fmin(most, value));
}

/* The velocity that leash and arm leave of a wanted one: no faster than the arm but for what can be
 * braked before the set-point is farther away. An arm that follows is not held back, and one that
 * sags or is pushed does not take the set-point along. */
static double on_leash(const struct joint *joint, double wanted, double leash, double dt)
{
    double ahead = joint->position - joint->measured;
    double up = joint->moves + fastest_within(leash - ahead, joint->acceleration, dt);
    double down = joint->moves - fastest_within(leash + ahead, joint->acceleration, dt);

    return clamp(wanted, fmin(0, down), fmax(0, up));
}

/* One joint for dt. Returns whether it is the leash that holds it back. */
static bool move(struct joint *joint, double wanted, double leash, double dt)
{
    double up = fastest_within(joint->highest - joint->position, joint->acceleration, dt);
    double down = fastest_within(joint->position - joint->lowest, joint->acceleration, dt);
    double most = joint->acceleration * dt;
    double free = clamp(wanted, -fmin(joint->fastest, down), fmin(joint->fastest, up));
    double target = on_leash(joint, free, leash, dt);

    joint->velocity += clamp(target - joint->velocity, -most, most);
    joint->position += joint->velocity * dt;
    return target != free && fabs(joint->position - joint->measured) > 0.9 * leash;
}

static void measure(struct joint *joint, double measured, double passed)
{
    if (passed > 0)
        joint->moves = (measured - joint->measured) / passed;
    joint->measured = measured;
}

bool motion_step(struct motion *motion, const double *measured, const double *set_point,
                 const double *set_velocity, int64_t robot, int64_t now, double *position,
                 double *velocity)
{
    int64_t passed = robot - motion->robot;

    if (!are_finite(motion->joints, measured) ||
        (set_point && !are_finite(motion->joints, set_point)) ||
        (set_velocity && !are_finite(motion->joints, set_velocity)))
        return false;
    if (!motion->begun || passed < 0 || passed > MOTION_GAP_US) {
        begin(motion, measured);
        passed = 0;
    }
    motion->robot = robot;
    motion->leashed = 0;
    for (int i = 0; i < motion->joints; i++) {
        struct joint *joint = &motion->joint[i];
        if (set_point)
            joint->position = set_point[i];
        if (set_velocity)
            joint->velocity = set_velocity[i];
        measure(joint, measured[i], (double)passed * 1e-6);
        if (move(joint, is_fresh(motion, robot, now) ? joint->wanted : 0, motion->leash,
                 fmin((double)passed * 1e-6, motion->period)))
            motion->leashed = i + 1;
        position[i] = joint->position;
        velocity[i] = joint->velocity;
    }
    return true;
}

int motion_leashed(const struct motion *motion)
{
    return motion->leashed;
}
