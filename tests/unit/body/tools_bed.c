#include "tools_bed.h"

#include <check.h>
#include <math.h>

#include "tests/unit/learner/bed.h"

struct learner *on_body(const struct body *body, int capacity)
{
    struct learner_config config = body_config(body->chain.n, body->sees, capacity);
    struct learner *learner = bed_create(&config);
    char err[160];

    ck_assert_msg(learner_give_body(learner, body, err, sizeof err) == 0, "%s", err);
    return learner;
}

void random_tip(double *tip)
{
    for (int k = 0; k < 3; k++)
        tip[k] = bed_uniform(-0.25, 0.25);
}

void teach(struct learner *learner, const struct body *body, const double *tip, int samples)
{
    for (int s = 0; s < samples; s++) {
        double z[JOINTS], x[3];
        random_joints(body, z);
        if (arm_sample(body, tip, z, x))
            ck_assert_int_le(learner_update(learner, z, x), LEARNER_BORN);
    }
}

int experts(const struct learner *learner)
{
    return learner_get_statistics(learner).experts;
}

double nearest_square(const struct learner_prediction *prediction, const struct body *body,
                      const double *x)
{
    double least = INFINITY;

    for (int k = 0; k < prediction->n_solutions; k++) {
        double square = 0.0;
        for (int i = 0; i < 3; i++) {
            double off = (prediction->solution[k].value[i] - x[i]) / body->noise[i];
            square += off * off / 3.0;
        }
        least = fmin(least, square);
    }
    return least;
}

double misfit(struct learner *learner, const struct body *body, const double *tip)
{
    static struct learner_prediction prediction;
    double sum = 0.0;
    int n = 0;

    for (int s = 0; s < 100; s++) {
        double z[JOINTS], x[3];
        random_joints(body, z);
        if (!arm_output(body, tip, z, x))
            continue;
        learner_predict(learner, z, &prediction);
        sum += nearest_square(&prediction, body, x);
        n++;
    }
    ck_assert_int_gt(n, 50);
    return sqrt(sum / n);
}
