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
        a_width_that_is_none_is_refused,
    };

    return SUITE_RUN("learner kernels", tests);
}
