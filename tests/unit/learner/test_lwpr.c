/* The jobs of locally weighted projection regression, each against what mathematics says it is. */
#include <math.h>
#include <string.h>

#include "bed.h"
#include "learner/lwpr/lwpr.h"
#include "tests/unit/suite.h"

enum { SAMPLES = 40 };

static struct arena *arena;

static struct learner_config config_for(int n_inputs, int n_outputs)
{
    struct learner_config config = learner_config_default(n_inputs, n_outputs);

    config.kind = LEARNER_LWPR;
    return config;
}

/* The implementation itself. */
static struct lwpr *open_up(const struct learner_config *config)
{
    char err[160] = "";

    ck_assert_msg(learner_config_check(config, err, sizeof err) == 0, "%s", err);
    arena = arena_create(learner_memory(config));
    struct lwpr *m = learner_lwpr_ops.create(config, arena);
    ck_assert_ptr_nonnull(m);
    return m;
}

/* Samples of one field with one projection through the origin, and what they add up to. */
struct batch {
    double v[SAMPLES][2], y[SAMPLES];
    double w[SAMPLES], s[SAMPLES], e[SAMPLES], e_cv[SAMPLES], h[SAMPLES];
    double W, SS, E;
};

/* The cost that the metric minimises, by its definition: leave-one-out errors of the weighted
 * regression of y on s, and the penalty. */
static double cost(const struct lwpr *m, const struct lwpr_field *f, struct batch *b)
{
    double SR = 0.0, penalty = 0.0, unit[2] = {0}, column[2];

    b->W = b->SS = b->E = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        b->w[i] = exp(-0.5 * lwpr_distance(m, f, b->v[i]));
        b->s[i] = f->direction[0] * b->v[i][0] + f->direction[1] * b->v[i][1];
        b->W += b->w[i];
        b->SS += b->w[i] * b->s[i] * b->s[i];
        SR += b->w[i] * b->s[i] * b->y[i];
    }
    for (int i = 0; i < SAMPLES; i++) {
        b->h[i] = b->w[i] * b->s[i] * b->s[i] / b->SS;
        b->e[i] = b->y[i] - b->s[i] * SR / b->SS;
        b->e_cv[i] = b->e[i] / (1.0 - b->h[i]);
        b->E += b->w[i] * b->e_cv[i] * b->e_cv[i];
    }
    for (int k = 0; k < 2; k++) {
        unit[k] = 1.0;
        lwpr_metric_times(m, f, unit, column);
        unit[k] = 0.0;
        penalty += column[0] * column[0] + column[1] * column[1];
    }
    return b->E / b->W + m->p.penalty / 2.0 * penalty;
}

/* Sum of the stochastic gradients of all samples, each with the memory of all others. */
static void sum_gradients(const struct lwpr *m, const struct lwpr_field *f, const struct batch *b,
                          double *sum)
{
    double H = 0.0, G = 0.0, gradient[3];

    f->stage[0] = (struct lwpr_stage){.W = b->W, .V = b->W, .SS = b->SS, .E = b->E, .n = SAMPLES};
    for (int i = 0; i < SAMPLES; i++) {
        H += b->w[i] * b->e_cv[i] * b->s[i] / (1.0 - b->h[i]);
        G += pow(b->w[i] * b->e_cv[i] * b->s[i], 2) / (1.0 - b->h[i]);
    }
    for (int i = 0; i < SAMPLES; i++) {
        struct lwpr_step step = {.w = b->w[i], .e = b->e[i], .e_cv = b->e_cv[i], .mature = 1};
        memcpy(step.v, b->v[i], sizeof b->v[i]);
        step.s[0] = b->s[i];
        f->stage[0].H = H - b->w[i] * b->e_cv[i] * b->s[i] / (1.0 - b->h[i]);
        f->stage[0].G = G - pow(b->w[i] * b->e_cv[i] * b->s[i], 2) / (1.0 - b->h[i]);
        lwpr_metric_gradient(m, f, &step, gradient);
        for (int k = 0; k < m->n_root; k++)
            sum[k] += gradient[k];
    }
}

static void compare_metric_gradient(bool diagonal_only)
{
    struct learner_config config = config_for(2, 1);
    struct batch b;
    double sum[3] = {0}, largest = 0.0;

    config.lwpr.diagonal_only = diagonal_only;
    config.lwpr.max_projections = 1;
    config.lwpr.penalty = 0.01;
    struct lwpr *m = open_up(&config);
    lwpr_field_birth(m, 0);
    const struct lwpr_field f = lwpr_field_at(m, 0);
    for (int k = 0; k < m->n_root; k++)
        f.root[k] = bed_uniform(0.5, 1.5);
    f.direction[0] = 0.6;
    f.direction[1] = 0.8;
    for (int i = 0; i < SAMPLES; i++) {
        b.v[i][0] = bed_uniform(-1.0, 1.0);
        b.v[i][1] = bed_uniform(-1.0, 1.0);
        b.y[i] = sin(2.0 * b.v[i][0]) + b.v[i][1] * b.v[i][1];
    }
    cost(m, &f, &b);
    sum_gradients(m, &f, &b, sum);
    for (int k = 0; k < m->n_root; k++) {
        const double step = 1e-5;
        f.root[k] += step;
        double above = cost(m, &f, &b);
        f.root[k] -= 2.0 * step;
        double below = cost(m, &f, &b);
        f.root[k] += step;
        ck_assert_double_eq_tol(sum[k], (above - below) / (2.0 * step), 1e-7);
        largest = fmax(largest, fabs(sum[k]));
    }
    ck_assert_double_gt(largest, 1e-3);
    arena_destroy(arena);
}

START_TEST(the_metric_descends_the_leave_one_out_cost)
{
    bed_seed();
    for (int n = 0; n < 10; n++) {
        compare_metric_gradient(true);
        compare_metric_gradient(false);
    }
}
END_TEST

/* Weighted least squares with an intercept by Gauss elimination: a[N] slopes, then the constant. */
enum { N = 4 };

static void eliminate(double A[N + 1][N + 2], double *solution)
{
    for (int c = 0; c <= N; c++)
        for (int r = 0; r <= N; r++) {
            double factor = A[r][c] / A[c][c];
            for (int k = c; r != c && k < N + 2; k++)
                A[r][k] -= factor * A[c][k];
        }
    for (int c = 0; c <= N; c++)
        solution[c] = A[c][N + 1] / A[c][c];
}

/* One wide field whose inputs are correlated, so that several projections are needed. */
START_TEST(a_field_with_all_projections_is_least_squares)
{
    struct learner_config config = config_for(N, 1);
    double A[N + 1][N + 2] = {{0}}, least_squares[N + 1], z[N], x;
    struct learner_solution solution;

    bed_seed();
    config.lwpr.init_d = 0.05;
    config.lwpr.init_alpha = 0.0;
    config.lwpr.add_threshold = 1.0;
    config.lwpr.init_lambda = config.lwpr.final_lambda = 0.9999;
    struct learner *learner = bed_create(&config);
    for (int n = 0; n < 60000; n++) {
        double common = bed_uniform(-1.0, 1.0), row[N + 2] = {0};
        for (int i = 0; i < N; i++)
            z[i] = n == 0 ? 0.0 : (i == 0 ? 1.5 : 0.8) * bed_uniform(-1.0, 1.0) + 0.5 * common;
        x = 2.0 * z[0] - z[1] + 0.5 * z[2] + z[3] * z[3] + 3.0 + 0.1 * bed_normal();
        learner_update(learner, z, &x);
        double q = 0.0;
        for (int i = 0; i < N; i++)
            q += 0.05 * z[i] * z[i];
        memcpy(row, z, sizeof z);
        row[N] = 1.0;
        row[N + 1] = x;
        for (int r = 0; r <= N; r++)
            for (int k = 0; k < N + 2; k++)
                A[r][k] = 0.9999 * A[r][k] + exp(-0.5 * q) * row[r] * row[k];
    }
    ck_assert_int_eq(learner_get_statistics(learner).experts, 1);
    eliminate(A, least_squares);
    memset(z, 0, sizeof z);
    ck_assert_int_eq(learner_predict_single(learner, z, &solution), 1);
    ck_assert_double_eq_tol(solution.value[0], least_squares[N], 0.01);
    for (int i = 0; i < N; i++)
        ck_assert_double_eq_tol(solution.jacobian[i], least_squares[i], 0.01);
    bed_clean();
}
END_TEST

static void expect_derivative(struct learner *learner, const double *z)
{
    struct learner_solution at, above, below;
    const double step = 1e-6;

    ck_assert_int_eq(learner_predict_single(learner, z, &at), 1);
    for (int i = 0; i < 3; i++) {
        double moved[3] = {z[0], z[1], z[2]};
        moved[i] = z[i] + step;
        learner_predict_single(learner, moved, &above);
        moved[i] = z[i] - step;
        learner_predict_single(learner, moved, &below);
        for (int o = 0; o < 2; o++) {
            double slope = (above.value[o] - below.value[o]) / (2.0 * step);
            ck_assert_double_eq_tol(at.jacobian[o * 3 + i], slope, 1e-6 * (1.0 + fabs(slope)));
        }
    }
}

START_TEST(the_jacobian_is_the_derivative_of_the_prediction)
{
    bed_seed();
    for (int full = 0; full < 2; full++) {
        struct learner_config config = config_for(3, 2);
        config.lwpr.diagonal_only = !full;
        config.lwpr.cutoff = 1e-12;
        config.lwpr.norm_out[0] = 0.1;
        config.scale[1] = 0.5;
        struct learner *learner = bed_create(&config);
        for (int n = 0; n < 4000; n++) {
            double z[3] = {bed_uniform(-1.0, 1.0), bed_uniform(-0.5, 0.5), bed_uniform(-1.0, 1.0)};
            double x[2] = {sin(3.0 * z[0]) * cos(4.0 * z[1]), z[0] * z[2] + z[1]};
            learner_update(learner, z, x);
        }
        ck_assert_int_gt(learner_get_statistics(learner).experts, 10);
        for (int n = 0; n < 50; n++) {
            double z[3] = {bed_uniform(-1.0, 1.0), bed_uniform(-0.5, 0.5), bed_uniform(-1.0, 1.0)};
            expect_derivative(learner, z);
        }
        bed_clean();
    }
}
END_TEST

/* Two fields that one sample activates nearly fully: the narrower one goes, and the last field
 * takes its place. */
START_TEST(of_two_alike_fields_the_narrower_is_pruned)
{
    struct learner_config config = config_for(1, 1);
    const double z = 0.0, x = 0.0;

    struct lwpr *m = open_up(&config);
    for (int j = 0; j < 3; j++) {
        m->u[0] = j == 2 ? 5.0 : 0.0;
        lwpr_field_birth(m, 0);
    }
    struct lwpr_field f = lwpr_field_at(m, 0);
    f.root[0] *= 2.0;
    ck_assert_int_eq(lwpr_learn(m, &z, &x), LEARNER_UPDATED);
    ck_assert_int_eq(m->M, 2);
    f = lwpr_field_at(m, 0);
    ck_assert_double_eq(f.centre[0], 5.0);
    f = lwpr_field_at(m, 1);
    ck_assert_double_eq(f.centre[0], 0.0);
    ck_assert_double_eq_tol(f.root[0] * f.root[0], 10.0, 1e-12);
    arena_destroy(arena);
}
END_TEST

/* y depends on a direction in which inputs hardly vary: the first projections follow the others. */
static int projections_for(double hidden)
{
    struct learner_config config = config_for(4, 1);

    config.lwpr.init_d = 0.01;
    config.lwpr.init_alpha = 0.0;
    config.lwpr.add_threshold = 0.95;
    config.lwpr.init_lambda = config.lwpr.final_lambda = 1.0;
    struct lwpr *m = open_up(&config);
    for (int n = 0; n < 3000; n++) {
        double z[4] = {2.0 * bed_uniform(-1.0, 1.0), bed_uniform(-1.0, 1.0),
                       0.5 * bed_uniform(-1.0, 1.0), 0.2 * bed_uniform(-1.0, 1.0)};
        double x = z[0] + hidden * (2.0 * z[1] + 6.0 * z[2] + 30.0 * z[3]) + 0.3 * bed_normal();
        lwpr_learn(m, z, &x);
    }
    int projections = (int)lwpr_field_at(m, 0).head->n_projections;
    arena_destroy(arena);
    return projections;
}

START_TEST(projections_are_added_while_they_pay)
{
    bed_seed();
    ck_assert_int_eq(projections_for(1.0), 4);
    ck_assert_int_lt(projections_for(0.0), 4);
}
END_TEST

/* Numbers that no learner writes, behind the envelope and its checksum. */
START_TEST(a_state_that_cannot_be_is_refused)
{
    struct learner_config config = config_for(2, 2);
    const double wrong[][2] = {{0, NAN},      {0, 2.0}, {0, 0.5}, {1, 0.0},  {1, 3.0},   {3, -1.0},
                               {4, INFINITY}, {6, 0.0}, {6, 1e9}, {8, -1.0}, {12, 0.98}, {14, 0.0}};
    unsigned char state[2][8192];
    char err[160] = "";
    double z[2], x[2], good;

    bed_seed();
    struct lwpr *m = open_up(&config);
    for (int n = 0; n < 200; n++) {
        z[0] = bed_uniform(-0.2, 0.2);
        z[1] = x[0] = bed_uniform(-0.2, 0.2);
        x[1] = z[0];
        lwpr_learn(m, z, x);
    }
    ck_assert_int_eq(m->M, 2);
    ck_assert_uint_lt(lwpr_state_size(m, 2), sizeof state[0]);
    lwpr_save(m, state[0]);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        unsigned char *at = state[0] + sizeof(double) * (size_t)wrong[i][0];
        memcpy(&good, at, sizeof good);
        memcpy(at, &wrong[i][1], sizeof good);
        ck_assert_msg(lwpr_load(m, 2, state[0], err, sizeof err) == -1, "number %g of %g",
                      wrong[i][0], wrong[i][1]);
        memcpy(at, &good, sizeof good);
        lwpr_save(m, state[1]);
        ck_assert_int_eq(memcmp(state[0], state[1], lwpr_state_size(m, 2)), 0);
    }
    ck_assert_int_eq(lwpr_load(m, 2, state[0], err, sizeof err), 0);
    arena_destroy(arena);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        the_metric_descends_the_leave_one_out_cost,
        a_field_with_all_projections_is_least_squares,
        the_jacobian_is_the_derivative_of_the_prediction,
        of_two_alike_fields_the_narrower_is_pruned,
        projections_are_added_while_they_pay,
        a_state_that_cannot_be_is_refused,
    };

    return SUITE_RUN("lwpr", tests);
}
