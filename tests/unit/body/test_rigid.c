/* What no rigid chain explains, against what was made up. */
#include <math.h>

#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"
#include "tools_bed.h"

static const double tip[3] = {0.1, 0.02, 0.05};

/* Each output bends by `most` times the sine of a joint, which no tip does. */
static struct learner *bent(const struct body *body, const double *most)
{
    struct learner_config config = body_config(JOINTS, body->sees, 16);
    char err[160];

    for (int k = 0; k < BODY_OUTPUTS; k++)
        config.psi0[k] = body->noise[k] * body->noise[k];
    config.noise_share = 1.0;
    struct learner *learner = bed_create(&config);
    ck_assert_msg(learner_give_body(learner, body, err, sizeof err) == 0, "%s", err);
    for (int s = 0; s < 600; s++) {
        double z[JOINTS], x[3];
        random_joints(body, z);
        if (!arm_sample(body, tip, z, x))
            continue;
        for (int k = 0; k < 3; k++)
            x[k] += most[k] * sin(7.0 * z[2]);
        learner_update(learner, z, x);
    }
    return learner;
}

START_TEST(what_is_no_chain_is_told)
{
    double share[LEARNER_MAX_OUTPUTS];

    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        double most[3];
        for (int k = 0; k < 3; k++)
            most[k] = (k + 1) * body.noise[k];
        struct learner *learner = bent(&body, most);
        ck_assert_int_eq(learner_not_rigid(learner, share), 0);
        for (int k = 0; k < 3; k++) { /* rms of a sine, of which a tip may take a little */
            ck_assert_double_gt(share[k], 0.7 * most[k] / sqrt(2.0));
            ck_assert_double_lt(share[k], 1.2 * most[k] / sqrt(2.0));
        }
        bed_clean();
    }
}
END_TEST

START_TEST(a_rigid_arm_has_no_such_share)
{
    const double none[3] = {0};
    double share[LEARNER_MAX_OUTPUTS];

    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        struct learner *learner = bent(&body, none);
        ck_assert_int_eq(learner_not_rigid(learner, share), 0);
        for (int k = 0; k < 3; k++)
            ck_assert_double_lt(share[k], 0.45 * body.noise[k]);
        bed_clean();
    }
}
END_TEST

START_TEST(without_a_body_there_is_no_answer)
{
    double share[LEARNER_MAX_OUTPUTS];

    bed_seed();
    struct learner_config config = body_config(JOINTS, false, 4);
    ck_assert_int_eq(learner_not_rigid(bed_create(&config), share), -1);
    struct body body = made_up_arm(JOINTS, false);
    ck_assert_int_eq(learner_not_rigid(on_body(&body, 4), share), -1); /* nothing kept */
    config.features = LEARNER_POLYNOMIAL;
    ck_assert_int_eq(learner_not_rigid(bed_create(&config), share), -1);
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        what_is_no_chain_is_told,
        a_rigid_arm_has_no_such_share,
        without_a_body_there_is_no_answer,
    };

    return SUITE_RUN("rigid", tests);
}
