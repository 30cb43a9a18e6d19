/* The choice of a solution, and equation 14. */
#include "daemon/control/kinematics/estimate.h"
#include "tests/unit/suite.h"

#include <math.h>
#include <string.h>

static const double scale[] = {0.1, 0.1, 40};

static struct estimate with_solutions(int n, const double values[][3])
{
    struct estimate estimate;

    estimate_init(&estimate, 2, 3, scale);
    estimate.prediction.n_solutions = n;
    for (int k = 0; k < n; k++)
        memcpy(estimate.prediction.solution[k].value, values[k], 3 * sizeof(double));
    return estimate;
}

START_TEST(closest_is_in_scaled_units)
{
    /* The second is 30 px off, under one unit; the first 0.2 rad, two units. */
    const double values[][3] = {{0.2, 0, 0}, {0, 0, 30}};
    struct estimate estimate = with_solutions(2, values);

    ck_assert_int_eq(estimate_closest(&estimate, &estimate.prediction, (double[]){0, 0, 0}), 1);
    ck_assert_int_eq(estimate_closest(&estimate, &estimate.prediction, (double[]){0.2, 0, 30}), 0);
}
END_TEST

START_TEST(no_solution_is_no_choice)
{
    struct estimate estimate = with_solutions(0, NULL);
    const double values[][3] = {{NAN, 0, 0}};

    ck_assert_int_eq(estimate_closest(&estimate, &estimate.prediction, (double[]){0, 0, 0}), -1);
    ck_assert_ptr_null(estimate_jacobian(&estimate));
    ck_assert_ptr_null(estimate_value(&estimate));
    estimate = with_solutions(1, values);
    ck_assert_int_eq(estimate_closest(&estimate, &estimate.prediction, (double[]){0, 0, 0}), -1);
}
END_TEST

START_TEST(equation_14_integrates_the_previous_jacobian)
{
    const double values[][3] = {{0, 0, 0}};
    struct estimate estimate = with_solutions(1, values);
    const double jacobian[] = {1, 2, 3, 4, 5, 6};

    memcpy(estimate.prediction.solution[0].jacobian, jacobian, sizeof jacobian);
    estimate.solution = 0;
    estimate_anchor(&estimate, (double[]){10, 20, 30});
    estimate_integrate(&estimate, (double[]){0.5, 0.5}); /* first joints seen: no motion yet */
    ck_assert_double_eq(estimate.x_estimated[0], 10);
    estimate_integrate(&estimate, (double[]){0.6, 0.4});
    ck_assert_double_eq_tol(estimate.x_estimated[0], 10 + 0.1 - 0.2, 1e-12);
    ck_assert_double_eq_tol(estimate.x_estimated[1], 20 + 0.3 - 0.4, 1e-12);
    ck_assert_double_eq_tol(estimate.x_estimated[2], 30 + 0.5 - 0.6, 1e-12);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {closest_is_in_scaled_units, no_solution_is_no_choice,
                                  equation_14_integrates_the_previous_jacobian};

    return SUITE_RUN("estimate", tests);
}
