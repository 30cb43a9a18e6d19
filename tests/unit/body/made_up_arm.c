#include "made_up_arm.h"

#include <math.h>
#include <string.h>

#include "learner/body/chain/vec3.h"
#include "tests/unit/learner/bed.h"

void random_unit(double v[3])
{
    double length;

    do {
        for (int k = 0; k < 3; k++)
            v[k] = bed_normal();
        length = vec3_length(v);
    } while (length < 0.1);
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

void random_joints(const struct body *body, double *z)
{
    for (int i = 0; i < body->chain.n; i++)
        z[i] = body->chain.middle[i] + bed_uniform(-1.0, 1.0) * body->range[i];
}

/* A head behind and above the middle of all places, whose eyes look forward at it. */
static void give_eyes(struct body *body)
{
    struct eyes *eyes = &body->eyes;

    body->sees = true;
    *eyes = (struct eyes){.angle_unit = 1.0,
                          .disparity_unit = 20.0,
                          .neck = {0.02, 0.01, 0.05},
                          .eye = {0.06, 0.0, 0.04},
                          .tilt = {0.03, -0.05},
                          .law = {1.4, 0.5, 0.02}};
    body->noise[0] = body->noise[1] = ARM_NOISE_ANGLE;
    body->noise[2] = ARM_NOISE_DISPARITY;
    body->chain.offset[0][0] += 0.7; /* the arm is before the eyes */
}

struct body made_up_arm(int n_joints, bool sees)
{
    struct body body = {.chain = {.n = n_joints}, .length = 0.3, .gravity = {0, 0, -1}};

    for (int i = 0; i < n_joints; i++) {
        body.chain.middle[i] = bed_uniform(-0.5, 0.5);
        body.range[i] = 1.2;
        random_unit(body.chain.axis[i]);
        random_unit(body.chain.offset[i]);
        for (int k = 0; k < 3; k++)
            body.chain.offset[i][k] *= (sees ? 0.3 : 1.0) * (i == 0 ? 0.05 : 0.2);
    }
    for (int k = 0; k < BODY_OUTPUTS; k++)
        body.noise[k] = ARM_NOISE;
    if (sees)
        give_eyes(&body);
    size_t n = (size_t)body_unknowns(&body);
    for (size_t i = 0; i < n; i++)
        body.root[i * (i + 1) / 2 + i] = 1e-5;
    return body;
}

bool arm_output(const struct body *body, const double *tip, const double *z, double *x)
{
    struct chain_pose pose;
    double place[3];
    double by_place[9];

    chain_at(&body->chain, z, &pose);
    mat3_apply(pose.turn[body->chain.n], tip, place);
    vec3_add(1.0, pose.p, place);
    if (body->sees)
        memset(x, 0, 3 * sizeof *x);
    return body_output(body, place, x, by_place);
}

bool arm_sample(const struct body *body, const double *tip, const double *z, double *x)
{
    bool seen = arm_output(body, tip, z, x);

    for (int k = 0; k < BODY_OUTPUTS; k++)
        x[k] += body->noise[k] * bed_normal();
    return seen;
}

struct learner_config body_config(int n_inputs, bool sees, int capacity)
{
    struct learner_config config = learner_config_default(n_inputs, BODY_OUTPUTS);

    config.features = LEARNER_BODY;
    config.body.space = sees ? LEARNER_BODY_EYES : LEARNER_BODY_PLACE;
    config.degree = 2;
    config.capacity = capacity;
    for (int i = 0; i < n_inputs; i++)
        config.sigma0[i] = 10.0;
    for (int k = 0; k < BODY_OUTPUTS; k++)
        config.psi0[k] = 1e-4;
    return config;
}
