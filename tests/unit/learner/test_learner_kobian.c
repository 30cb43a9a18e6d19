/* The shipped Kobian settings on a robot like it: 150 samples with the hand, then 150 with a bent
 * tool that nobody tells of, measured with slow bias and jitter. The table that this prints is the
 * one that docs/learner.md speaks of. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"
#include "tests/unit/suite.h"

enum { HAND = 150, ALL = 300, QUERIES = 100, SEEDS = 5, MOMENTS = 6 };

static const double degree = 3.14159265358979323846 / 180.0;
static const int moments[MOMENTS] = {75, 150, 155, 160, 175, 300};
static struct learner_prediction prediction;

/* One robot: lengths in m, the tool's direction in the forearm's frame and its droop. */
struct robot {
    double upper_arm;
    double forearm;
    double tool[3];
    double droop;
};

struct vector {
    double x, y, z;
};

static struct vector turn_x(double a, struct vector v)
{
    return (struct vector){v.x, cos(a) * v.y - sin(a) * v.z, sin(a) * v.y + cos(a) * v.z};
}

static struct vector turn_y(double a, struct vector v)
{
    return (struct vector){cos(a) * v.x + sin(a) * v.z, v.y, cos(a) * v.z - sin(a) * v.x};
}

static struct vector turn_z(double a, struct vector v)
{
    return (struct vector){cos(a) * v.x - sin(a) * v.y, sin(a) * v.x + cos(a) * v.y, v.z};
}

static struct vector sum(struct vector a, struct vector b)
{
    return (struct vector){a.x + b.x, a.y + b.y, a.z + b.z};
}

static struct vector shoulder(const double *q, struct vector v)
{
    return turn_z(13.0 * degree, turn_y(q[0], turn_x(-q[1], turn_z(q[2], v))));
}

/* The ball, in m: x forward, y left, z up; arm hanging along -z at zero. */
static struct vector ball(const struct robot *robot, const double *q, bool tool)
{
    struct vector at = {0.0, -0.195, 0.0};

    at = sum(at, shoulder(q, (struct vector){0.0, 0.0, -robot->upper_arm}));
    at = sum(at, shoulder(q, turn_y(q[3], (struct vector){0.0, 0.0, -robot->forearm})));
    if (tool) {
        struct vector along = {robot->tool[0], robot->tool[1], robot->tool[2]};
        along = shoulder(q, turn_y(q[3], along));
        double level = 1.0 - along.z * along.z; /* it bends the more, the more level it is */
        at = sum(at, (struct vector){0.35 * along.x + robot->droop * along.x * along.z,
                                     0.35 * along.y + robot->droop * along.y * along.z,
                                     0.35 * along.z - robot->droop * level});
    }
    return at;
}

/* Head yaw and pitch in rad that look at the ball, and its disparity in px between eyes 90 mm apart
 * with 1200 px of focal length and zero disparity at 0.5 m. */
static void look_at_hand(const struct robot *robot, const double *q, bool tool, double *x)
{
    struct vector v = ball(robot, q, tool);
    double height = 0.324 - v.z;
    double level = hypot(v.x, v.y);

    x[0] = atan2(v.y, v.x);
    x[1] = atan2(height, level);
    x[2] = 1200.0 * 0.09 * (1.0 / hypot(level, height) - 1.0 / 0.5);
}

static struct robot random_robot(void)
{
    struct robot robot = {.upper_arm = 0.28 * bed_uniform(0.95, 1.05),
                          .forearm = 0.19 * bed_uniform(0.95, 1.05),
                          .tool = {-0.15 + 0.05 * bed_normal(), 0.94, -0.29},
                          .droop = bed_uniform(0.03, 0.06)};
    double length = sqrt(robot.tool[0] * robot.tool[0] + 0.94 * 0.94 + 0.29 * 0.29);

    for (int i = 0; i < 3; i++)
        robot.tool[i] /= length;
    return robot;
}

static void random_posture(double *q)
{
    const double low[4] = {-70.0, -30.0, -15.0, -90.0};
    const double high[4] = {-60.0, -5.0, 15.0, -40.0};

    for (int i = 0; i < 4; i++)
        q[i] = bed_uniform(low[i], high[i]) * degree;
}

/* A bias that wanders within 2 px (0.1 deg), and jitter. */
static void disturb(double *bias, double *x)
{
    const double unit[3] = {0.05 * degree, 0.05 * degree, 1.0};

    for (int i = 0; i < 3; i++) {
        bias[i] = 0.95 * bias[i] + 0.31 * bed_normal();
        x[i] += unit[i] * (fmax(-2.0, fmin(2.0, bias[i])) + 0.5 * bed_normal());
    }
}

static struct learner_config shipped(enum learner_features features)
{
    bool linear = features == LEARNER_LINEAR;
    struct learner_config config = learner_config_default(4, 3);
    const double reference[4] = {-65.0, -17.5, 0.0, -65.0};
    double angle = (linear ? 1.0 : 0.5) * degree;
    double disparity = linear ? 6.0 : 3.0;

    config.features = features;
    config.degree = 3;
    config.capacity = 64;
    for (int i = 0; i < 4; i++) {
        config.reference[i] = reference[i] * degree;
        config.scale[i] = 1.5;
        config.sigma0[i] = linear ? 0.0225 : 10.0;
    }
    config.psi0[0] = config.psi0[1] = angle * angle;
    config.psi0[2] = disparity * disparity;
    config.hyper_sigma = 8.0;
    config.prior_sigma = linear ? 64.0 : 16.0;
    config.hyper_psi = config.prior_psi = INFINITY;
    config.ridge = linear ? 1e-3 : 5e-5;
    config.p0 = linear ? 0.1 : 1e-3;
    config.inherit = true;
    config.clustering = linear ? LEARNER_CLUSTER_PUBLISHED : LEARNER_CLUSTER_LEADER;
    config.significance = 0.95;
    config.leader_level = 0.9999;
    config.kappa = 0.5;
    config.noise_share = linear ? 1.0 : 0.1;
    config.gamma_floor = 0.05;
    return config;
}

/* What is measured at one moment: [hand, tool]. */
struct result {
    double squares[2][3];
    double solutions[2];
    double experts;
};

/* The solution nearest to the truth, in units of 1 deg and 3 px. */
static void add_error(const double *truth, double *squares)
{
    const double unit[3] = {degree, degree, 3.0};
    double nearest = INFINITY;
    int best = 0;

    for (int k = 0; k < prediction.n_solutions; k++) {
        double distance = 0.0;
        for (int i = 0; i < 3; i++)
            distance += pow((prediction.solution[k].value[i] - truth[i]) / unit[i], 2.0);
        if (distance < nearest) {
            nearest = distance;
            best = k;
        }
    }
    for (int i = 0; i < 3; i++) {
        double error = prediction.solution[best].value[i] - truth[i];
        squares[i] += error * error / (QUERIES * SEEDS);
    }
}

static void measure_errors(struct learner *learner, const struct robot *robot,
                           struct result *result)
{
    double q[4], truth[3];

    for (int tool = 0; tool < 2; tool++)
        for (int n = 0; n < QUERIES; n++) {
            random_posture(q);
            look_at_hand(robot, q, tool, truth);
            result->solutions[tool] +=
                (double)learner_predict(learner, q, &prediction) / (QUERIES * SEEDS);
            add_error(truth, result->squares[tool]);
        }
    result->experts += (double)learner_get_statistics(learner).experts / SEEDS;
}

static void live(const struct learner_config *config, struct result *results)
{
    struct robot robot = random_robot();
    struct learner *learner = bed_create(config);
    double bias[3] = {0.0, 0.0, 0.0};
    double q[4], x[3];

    for (int n = 1, k = 0; n <= ALL; n++) {
        random_posture(q);
        look_at_hand(&robot, q, n > HAND, x);
        disturb(bias, x);
        learner_update(learner, q, x);
        if (n == moments[k])
            measure_errors(learner, &robot, &results[k++]);
    }
    bed_clean();
}

/* Learns with every seed, prints the table and takes roots of mean squares. */
static void live_all(enum learner_features features, struct result *results)
{
    struct learner_config config = shipped(features);

    memset(results, 0, MOMENTS * sizeof *results);
    for (int seed = 0; seed < SEEDS; seed++)
        live(&config, results);
    printf("%s: samples, experts | hand: yaw deg, pitch deg, px, solutions | tool: the same\n",
           features == LEARNER_LINEAR ? "linear" : "cubic");
    for (int k = 0; k < MOMENTS; k++) {
        printf("%4d %4.1f", moments[k], results[k].experts);
        for (int tool = 0; tool < 2; tool++) {
            double *e = results[k].squares[tool];
            for (int i = 0; i < 3; i++)
                e[i] = sqrt(e[i]) / (i < 2 ? degree : 1.0);
            printf(" | %6.3f %6.3f %6.2f  %4.2f", e[0], e[1], e[2], results[k].solutions[tool]);
        }
        printf("\n");
    }
}

static void expect_errors(const struct result *result, int tool, double angle, double disparity,
                          double solutions)
{
    ck_assert_double_lt(result->squares[tool][0], angle);
    ck_assert_double_lt(result->squares[tool][1], angle);
    ck_assert_double_lt(result->squares[tool][2], disparity);
    ck_assert_double_eq_tol(result->solutions[tool], solutions, 0.05);
}

START_TEST(cubic_experts_learn_hand_and_tool)
{
    struct result results[MOMENTS];

    bed_seed();
    live_all(LEARNER_POLYNOMIAL, results);
    expect_errors(&results[1], 0, 0.2, 1.5, 1.0);
    expect_errors(&results[4], 1, 1.0, 5.0, 2.0);
    expect_errors(&results[5], 0, 0.2, 1.5, 2.0);
    expect_errors(&results[5], 1, 0.2, 1.5, 2.0);
    for (int i = 0; i < 3; i++)
        ck_assert_double_lt(results[5].squares[0][i], 1.2 * results[1].squares[0][i]);
}
END_TEST

START_TEST(linear_experts_learn_hand_and_tool)
{
    struct result results[MOMENTS];

    bed_seed();
    live_all(LEARNER_LINEAR, results);
    expect_errors(&results[5], 0, 1.0, 6.0, 2.0);
    expect_errors(&results[5], 1, 1.0, 6.0, 2.0);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        cubic_experts_learn_hand_and_tool,
        linear_experts_learn_hand_and_tool,
    };

    return SUITE_RUN("learner on a Kobian-like robot", tests);
}
