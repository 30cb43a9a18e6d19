/* Every vector width gives the same bytes: what is learned, and what is predicted from it. Widths
 * that the machine lacks are said and left out. */
#include "learner/kernels/kernels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bed.h"
#include "tests/unit/suite.h"

enum { WIDTHS = LEARNER_KERNELS_AVX512 + 1, INPUTS = 5, OUTPUTS = 3 };

static struct learner_prediction prediction[WIDTHS];
static struct learner_inverse inverse[WIDTHS];

static struct learner_config config_for(enum learner_features features,
                                        enum learner_clustering clustering, double alpha)
{
    struct learner_config config = learner_config_default(INPUTS, OUTPUTS);

    config.features = features;
    config.clustering = clustering;
    config.alpha = alpha;
    config.capacity = 500;
    config.em_pred_iterations = 5;
    config.gamma_floor = features == LEARNER_POLYNOMIAL ? 0.05 : 0.0;
    for (int i = 0; i < OUTPUTS; i++)
        config.psi0[i] = 0.003;
    for (int i = 0; i < INPUTS; i++)
        config.sigma0[i] = 0.3;
    return config;
}

/* One learner for each width there is, the plain one first. Returns how many. */
static int create_all(struct learner_config config, struct learner **learners)
{
    int n = 0;

    for (int width = LEARNER_KERNELS_PLAIN; width < WIDTHS; width++) {
        config.kernels = (enum learner_kernels)width;
        if (kernels_of(config.kernels))
            learners[n++] = bed_create(&config);
    }
    return n;
}

static void teach_and_ask(struct learner **learners, int n, int samples)
{
    for (int k = 0; k < samples; k++) {
        double z[INPUTS], x[OUTPUTS];
        for (int i = 0; i < INPUTS; i++)
            z[i] = bed_uniform(-1.0, 1.0);
        for (int i = 0; i < OUTPUTS; i++)
            x[i] = sin(2.0 * z[i]) * z[i + 1] + (k % 2) + 0.05 * bed_normal();
        memset(prediction, 0, sizeof prediction);
        memset(inverse, 0, sizeof inverse);
        for (int w = 0; w < n; w++) {
            learner_update(learners[w], z, x);
            learner_predict(learners[w], z, &prediction[w]);
            if (k % 50 == 0)
                learner_predict_inverse(learners[w], x, &inverse[w]);
            ck_assert_int_eq(memcmp(&prediction[w], &prediction[0], sizeof prediction[0]), 0);
            ck_assert_int_eq(memcmp(&inverse[w], &inverse[0], sizeof inverse[0]), 0);
        }
    }
}

START_TEST(all_widths_learn_and_predict_the_same_bytes)
{
    const enum learner_clustering rules[] = {LEARNER_CLUSTER_PUBLISHED, LEARNER_CLUSTER_SPLIT,
                                             LEARNER_CLUSTER_LEADER};
    struct learner *learners[WIDTHS];

    bed_seed();
    for (int features = LEARNER_LINEAR; features <= LEARNER_POLYNOMIAL; features++)
        for (int rule = 0; rule < 3; rule++) {
            struct learner_config config =
                config_for((enum learner_features)features, rules[rule], rule == 1 ? 0.95 : 0.999);
            int n = create_all(config, learners);
            teach_and_ask(learners, n, 600);
            for (int w = 1; w < n; w++)
                bed_expect_same_state(learners[0], learners[w]);
            printf("%d widths, %d experts\n", n, learner_get_statistics(learners[0]).experts);
            bed_clean();
        }
}
END_TEST

/* Against plain sums, for every length and odd addresses: the kernels do what they say. */
START_TEST(kernels_compute_what_they_say)
{
    enum { N = 43 };
    double G[N * (N + 1) / 2 + 1], v[N + 1], y[N], back[N], expected[N];

    bed_seed();
    for (int width = LEARNER_KERNELS_PLAIN; width < WIDTHS; width++) {
        const struct kernels *kernels = kernels_of((enum learner_kernels)width);
        if (!kernels) {
            printf("width %d: not on this machine\n", width);
            continue;
        }
        for (int n = 1; n <= N; n++) {
            double *triangle = G + n % 2;
            for (int i = 0; i < n * (n + 1) / 2; i++)
                triangle[i] = bed_uniform(-1.0, 1.0);
            for (int i = 0; i < n; i++)
                v[i + n % 2] = bed_uniform(-1.0, 1.0);
            kernels->whiten(n, triangle, v + n % 2, y, back);
            memset(expected, 0, sizeof expected);
            for (int i = 0; i < n; i++) {
                double sum = 0.0;
                for (int c = 0; c <= i; c++)
                    sum += triangle[i * (i + 1) / 2 + c] * v[c + n % 2];
                ck_assert_double_eq_tol(y[i], sum, 1e-13);
                for (int c = 0; c <= i; c++)
                    expected[c] += triangle[i * (i + 1) / 2 + c] * sum;
            }
            for (int i = 0; i < n; i++)
                ck_assert_double_eq_tol(back[i], expected[i], 1e-12);
            double product = 0.0;
            for (int i = 0; i < n; i++)
                product += v[i + n % 2] * y[i];
            ck_assert_double_eq_tol(kernels->dot(n, v + n % 2, y), product, 1e-13);
        }
    }
}
END_TEST

enum { MOST = 43, SPARE = 8 };

/* A triangle with its vectors, and numbers behind each that nobody may change or count. */
struct triangle {
    double G[MOST * (MOST + 1) / 2 + SPARE];
    double v[3 * MOST + SPARE];
    double y[3 * MOST], back[MOST + SPARE];
};

static void fill(struct triangle *t, int n)
{
    for (int i = 0; i < n * (n + 1) / 2; i++)
        t->G[i] = bed_uniform(-1.0, 1.0);
    for (int i = 0; i < 3 * n; i++)
        t->v[i] = bed_uniform(-1.0, 1.0);
    for (int i = 0; i < SPARE; i++)
        t->G[n * (n + 1) / 2 + i] = t->v[3 * n + i] = t->back[n + i] = i % 2 ? NAN : INFINITY;
}

static void expect_spare(const struct triangle *t, int n)
{
    for (int i = 0; i < SPARE; i++) {
        ck_assert_int_eq(isnan(t->G[n * (n + 1) / 2 + i]) != 0, i % 2);
        ck_assert_int_eq(isnan(t->back[n + i]) != 0, i % 2);
    }
}

/* The kernels that take the diagonal as a vector, beside those that do not. */
static void compare_three(const struct kernels *kernels, int n)
{
    static struct triangle t;
    double y[MOST], back[MOST];

    fill(&t, n);
    kernels->whiten_three(n, (size_t)n, t.G, t.v, t.y);
    for (int k = 0; k < 3; k++) {
        kernels->whiten(n, t.G, t.v + (size_t)k * (size_t)n, y, back);
        for (int i = 0; i < n; i++)
            ck_assert_double_eq_tol(t.y[k * n + i], y[i], 1e-13);
    }
    kernels->whiten(n, t.G, t.v + 2 * (size_t)n, y, back);
    kernels->solve(n, t.G, t.v + 2 * (size_t)n, t.y, t.back);
    for (int i = 0; i < n; i++) {
        ck_assert_double_eq_tol(t.y[i], y[i], 1e-13);
        ck_assert_double_eq_tol(t.back[i], back[i], 1e-12);
    }
    expect_spare(&t, n);
}

/* Turns in one pass are the turns one after the other. */
static void compare_turns(const struct kernels *kernels, int n, int turns)
{
    enum { STRIDE = 48, ROW = 4 * STRIDE };
    static struct triangle t, plain;
    double by[4][ROW];

    fill(&t, n);
    plain = t;
    for (int i = 0; i < ROW; i++)
        for (int part = 0; part < 3; part++)
            by[part][i] = bed_uniform(0.5, 1.0);
    memset(by[3], 0, sizeof by[3]);
    for (int turn = 0; turn < turns; turn++) {
        double s[MOST] = {0.0};
        size_t at = (size_t)turn * STRIDE;
        kernels->rotate(n, 0, plain.G, by[0] + at, by[1] + at, by[2] + at, s);
    }
    kernels->rotate_often(n, turns, STRIDE, t.G, by[0], by[1], by[2], by[3]);
    ck_assert_int_eq(memcmp(t.G, plain.G, (size_t)n * ((size_t)n + 1) / 2 * sizeof *t.G), 0);
    expect_spare(&t, n);
}

START_TEST(kernels_of_three_rows_compute_the_same)
{
    bed_seed();
    for (int width = LEARNER_KERNELS_PLAIN; width < WIDTHS; width++) {
        const struct kernels *kernels = kernels_of((enum learner_kernels)width);
        for (int n = 1; n <= MOST && kernels; n++) {
            compare_three(kernels, n);
            compare_turns(kernels, n, 3);
            compare_turns(kernels, n, 4);
        }
    }
}
END_TEST

START_TEST(a_width_that_is_none_is_refused)
{
    struct learner_config config = config_for(LEARNER_LINEAR, LEARNER_CLUSTER_PUBLISHED, 0.999);
    char err[160] = "";

    config.kernels = (enum learner_kernels)WIDTHS;
    ck_assert_int_eq(learner_config_check(&config, err, sizeof err), -1);
    ck_assert_ptr_nonnull(strstr(err, "kernels"));
    ck_assert_ptr_nonnull(kernels_of(LEARNER_KERNELS_AUTO));
    ck_assert_ptr_nonnull(kernels_of(LEARNER_KERNELS_PLAIN));
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        all_widths_learn_and_predict_the_same_bytes,
        kernels_compute_what_they_say,
        kernels_of_three_rows_compute_the_same,
        a_width_that_is_none_is_refused,
    };

    return SUITE_RUN("learner kernels", tests);
}
