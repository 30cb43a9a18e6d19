#include "daemon/config/defaults.h"

#include "common/options/options.h"

#include <math.h>
#include <string.h>

/* Monomials of degree 4 of more joints do not fit into what one tick can touch. */
enum { MANY_JOINTS = 7 };

static const struct reason {
    const char *name, *reason;
} reasons[] = {
    {"babble.tolerance", "visual 0.3; cartesian and fixed 1: samples need no rest"},
    {"task.secondary_gain", "visual and fixed 0.05, cartesian 0.2"},
    {"task.singular_threshold", "visual and fixed 0.05, cartesian 0.2"},
    {"task.damping_max", "visual and fixed 0.05, cartesian 0.2"},
    {"learner.capacity", "visual and fixed 64, cartesian 32"},
    {"learner.degree", "visual and fixed 3; cartesian 4, with more than 7 arm joints 3"},
    {"learner.hyper_sigma", "twice the number of arm joints"},
    {"learner.prior_sigma", "2 to the power of the number of arm joints"},
    {"learner.ridge", "visual and fixed 5e-5, cartesian 1e-5"},
    {"learner.n_outliers", "visual and fixed 1, cartesian 3"},
    {"learner.p0", "visual and fixed 0.001, cartesian 0.1"},
    {"learner.leader_level", "visual and fixed 0.9999, cartesian 0.9"},
    {"learner.noise_share", "visual and fixed 0.1, cartesian 1e-4"},
    {"learner.body.noise_share", "visual and fixed 0.004, cartesian 0.0025"},
    {"learner.reference", "the middle of babble.min and .max, or of arm.min and .max"},
};

const char *config_default_reason(const char *name)
{
    for (size_t i = 0; i < sizeof reasons / sizeof reasons[0]; i++)
        if (strcmp(name, reasons[i].name) == 0)
            return reasons[i].reason;
    return NULL;
}

/* The middle as people would write it: of round degrees to the bit. */
static double middle(double low, double high)
{
    const double degree = M_PI / 180, fine = 1e9;

    return round(0.5 * (low + high) / degree * fine) / fine * degree;
}

static struct option_list middles(const struct option_list *low, const struct option_list *high)
{
    struct option_list list = {.n = low->n};

    for (int i = 0; i < low->n && i < high->n; i++)
        list.value[i] = middle(low->value[i], high->value[i]);
    return list;
}

static void follow_the_arm(struct config *config, const struct config *robot)
{
    int n = config_arm_joints(robot);
    bool babbles = robot->babble_min_given.n == n;

    config->learner.hyper_sigma = 2 * n;
    config->learner.prior_sigma = ldexp(1, n);
    config->learner_reference = babbles
                                    ? middles(&robot->babble_min_given, &robot->babble_max_given)
                                    : middles(&robot->arm_min, &robot->arm_max);
}

/* What eyes tell: head angles, or pixels that stand for them (derived.c). */
static void follow_eyes(struct config *config)
{
    config->task_secondary_gain = 0.05;
    config->task_singular_threshold = config->task_damping_max = 0.05;
    config->learner.capacity = 64;
    config->learner.degree = 3;
    config->learner.ridge = 5e-5;
    config->learner.n_outliers = 1;
    config->learner.p0 = 0.001;
    config->learner.leader_level = 0.9999;
    config->learner.noise_share = 0.1;
    config->learner.body.noise_share = 0.004;
}

/* Places in metres, measured well and often. */
static void follow_places(struct config *config, int n_joints)
{
    config->task_secondary_gain = 0.2;
    config->task_singular_threshold = config->task_damping_max = 0.2;
    config->learner.capacity = 32;
    config->learner.degree = n_joints > MANY_JOINTS ? 3 : 4;
    config->learner.ridge = 1e-5;
    config->learner.n_outliers = 3;
    config->learner.p0 = 0.1;
    config->learner.leader_level = 0.9;
    config->learner.noise_share = 1e-4;
    config->learner.body.noise_share = 2.5e-3;
}

void config_set_defaults(struct config *config, const struct config *robot)
{
    const double degree = M_PI / 180;

    follow_the_arm(config, robot);
    config->babble_tolerance = (robot->task_space == SPACE_VISUAL ? 0.3 : 1) * degree;
    if (robot->task_space == SPACE_CARTESIAN)
        follow_places(config, config_arm_joints(robot));
    else
        follow_eyes(config);
}
