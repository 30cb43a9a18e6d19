/* The head: signs of eq. 11, and a search that looks everywhere. */
#include "daemon/control/kinematics/head.h"
#include "fixture.h"
#include "tests/unit/suite.h"

#include <math.h>

START_TEST(the_head_turns_towards_the_marker)
{
    struct config config = fixture_config(NULL, 0);
    double velocity[HEAD_JOINTS];

    head_fixate(&config, (double[]){100, 0, 0}, velocity);
    ck_assert_double_lt(velocity[0], 0); /* right of the centre: turn right */
    ck_assert_double_eq(velocity[1], 0);
    head_fixate(&config, (double[]){0, 100, 0}, velocity);
    ck_assert_double_gt(velocity[1], 0); /* below the centre: look down */
}
END_TEST

START_TEST(the_search_covers_the_range)
{
    struct config config = fixture_config(NULL, 0);
    struct head_search search;
    double q[HEAD_JOINTS] = {0, 0}, velocity[HEAD_JOINTS];
    bool looked[4][4] = {{false}};
    int cells = 0;

    head_search_init(&search, 3);
    for (int64_t now = 1; now < 120 * 1000000; now += 20000) {
        head_search_step(&search, &config, now, q, velocity);
        for (int i = 0; i < HEAD_JOINTS; i++) {
            double low = config.head_min.value[i], high = config.head_max.value[i];
            ck_assert(fabs(velocity[i]) <= config.head_search_velocity);
            q[i] += velocity[i] * 0.02;
            ck_assert(q[i] >= low && q[i] <= high);
        }
        looked[(int)(3.999 * (q[0] - config.head_min.value[0]) /
                     (config.head_max.value[0] - config.head_min.value[0]))]
              [(int)(3.999 * (q[1] - config.head_min.value[1]) /
                     (config.head_max.value[1] - config.head_min.value[1]))] = true;
    }
    for (int i = 0; i < 16; i++)
        cells += looked[i / 4][i % 4];
    ck_assert_int_eq(cells, 16);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {the_head_turns_towards_the_marker, the_search_covers_the_range};

    return SUITE_RUN("head", tests);
}
