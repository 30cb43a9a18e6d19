/* Motions that show a body: on a body that is known roughly, the next posture is the one of twelve
 * whose place the model is least sure of; where a body is known, no joint is turned alone. */
#include "daemon/control/behaviours/tour.h"

#include "fixture.h"
#include "tests/unit/body/made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

#include <check.h>
#include <string.h>

enum { JOINTS = 7, POSTURES = 12 };

static struct config config;
static struct estimate estimate;
static struct learner_prediction imagined;
static struct wants wants;
static double q[MAX_JOINTS];
static double low[MAX_JOINTS], high[MAX_JOINTS];

static struct senses begin(bool known)
{
    struct learner_config learner = body_config(JOINTS, false, 16);
    const double tip[3] = {0.02, 0.01, 0.1};
    struct senses senses = {.config = &config,
                            .q = q,
                            .estimate = &estimate,
                            .imagined = &imagined,
                            .learner = bed_create(&learner)};
    struct body body;
    char err[160];

    bed_seed();
    body = made_up_arm(JOINTS, false);
    config = fixture_robot_config("icub.yaml");
    for (int i = 0; known && i < 6 * JOINTS; i++) /* some axes are known better than others */
        body.root[i * (i + 1) / 2 + i] *= 1 + 200 * (i % 5);
    if (known)
        ck_assert_int_eq(learner_give_body(senses.learner, &body, err, sizeof err), 0);
    for (int k = 0; k < 30; k++) {
        double z[JOINTS], x[3];
        random_joints(&body, z);
        arm_sample(&body, tip, z, x);
        learner_update(senses.learner, z, x);
    }
    estimate_init(&estimate, JOINTS, 3, config.space.scale);
    ck_assert_int_gt(learner_predict(senses.learner, q, &estimate.prediction), 0);
    estimate.solution = 0;
    for (int i = 0; i < JOINTS; i++) {
        low[i] = -1;
        high[i] = 1 + 0.1 * i;
    }
    return senses;
}

static double doubt(const struct senses *senses, const double *posture)
{
    double sum = 0;

    learner_predict(senses->learner, posture, &imagined);
    for (int row = 0; row < 3; row++)
        sum += imagined.solution[0].variance[row];
    return sum;
}

START_TEST(the_posture_that_tells_most_is_next)
{
    struct senses senses = begin(true);
    struct random_state random = random_seed(7), same = random;
    double goal[JOINTS] = {0}, most = 0, sum = 0;
    struct tour tour;

    tour_init(&tour, &senses, low, high);
    tour_visit_postures(&tour, &random, &senses, &wants);
    for (int k = 0; k < POSTURES; k++) {
        double drawn[JOINTS];
        for (int i = 0; i < JOINTS; i++)
            drawn[i] = random_uniform(&same, low[i], high[i]);
        double unsure = doubt(&senses, drawn);
        sum += unsure;
        if (unsure > most)
            memcpy(goal, drawn, sizeof goal);
        most = unsure > most ? unsure : most;
    }
    ck_assert_double_gt(most, 1.001 * sum / POSTURES); /* there is something to choose */
    ck_assert_mem_eq(tour.goal, goal, sizeof goal);
    bed_clean();
}
END_TEST

START_TEST(joints_are_turned_alone_until_there_is_a_body)
{
    struct tour tour;

    for (int known = 0; known < 2; known++) {
        struct senses senses = begin(known);
        tour_init(&tour, &senses, low, high);
        ck_assert_int_eq(tour_turn_joints(&tour, &senses, &wants), !known);
        bed_clean();
    }
}
END_TEST

START_TEST(it_stays_within_its_bounds)
{
    struct senses senses = begin(false);
    struct random_state random = random_seed(7);
    struct tour tour;

    for (int i = 0; i < JOINTS; i++)
        high[i] = -0.8; /* the arm stands at 0, outside */
    tour_init(&tour, &senses, low, high);
    for (int k = 0; k < 4 * JOINTS; k++) {
        if (tour_turn_joints(&tour, &senses, &wants))
            memcpy(q, tour.goal, sizeof q);
        else
            tour_visit_postures(&tour, &random, &senses, &wants);
        for (int i = 0; i < JOINTS; i++)
            ck_assert(tour.goal[i] >= low[i] && tour.goal[i] <= high[i]);
    }
    memset(q, 0, sizeof q);
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {the_posture_that_tells_most_is_next,
                                  joints_are_turned_alone_until_there_is_a_body,
                                  it_stays_within_its_bounds};

    return SUITE_RUN("tour", tests);
}
