/* The shipped configuration, and what is refused although each option alone is in range. */
#include "daemon/config/defaults.h"
#include "daemon/config/load.h"
#include "daemon/config/reloadable.h"
#include "daemon/config/table.h"
#include "tests/unit/control/fixture.h"
#include "tests/unit/suite.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void refuses(const char *override, const char *reason)
{
    const char *overrides[] = {override};
    struct config config;
    char name[512], error[512] = "";
    const char *path = name;

    snprintf(name, sizeof name, "%s/etc/kobian.yaml", getenv("REACH_SOURCE_DIR"));
    ck_assert_int_eq(config_load(&config, &path, 1, overrides, 1, error, sizeof error), -1);
    ck_assert_msg(strstr(error, reason) != NULL, "'%s' does not say '%s'", error, reason);
}

START_TEST(the_shipped_configuration_is_the_paper_s_robot)
{
    struct config config = fixture_config(NULL, 0);
    struct joint_limits elbow = config_joint_limits(&config, 3);
    struct joint_limits pitch = config_joint_limits(&config, 5);

    ck_assert_int_eq(config_arm_joints(&config), 4);
    ck_assert_int_eq(config_head_joints(&config), 2);
    ck_assert_double_eq_tol(elbow.min, -90 * M_PI / 180, 1e-12);
    ck_assert_double_eq_tol(elbow.max, -5 * M_PI / 180, 1e-12);
    ck_assert_double_eq_tol(pitch.min, -10 * M_PI / 180, 1e-12);
    ck_assert_double_eq(pitch.velocity, config.motion_head_velocity);
    ck_assert_double_eq(elbow.safety_velocity, config.safety_arm_velocity);
}
END_TEST

/* Options that a file of etc sets. */
static int options_named(const char *name)
{
    char path[512], line[256];
    int leaves = 0;
    FILE *file;

    snprintf(path, sizeof path, "%s/etc/%s", getenv("REACH_SOURCE_DIR"), name);
    file = fopen(path, "r");
    ck_assert_ptr_nonnull(file);
    while (fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (line[0] != '#' && colon && colon[1] == ' ' && colon[strspn(colon + 1, " ") + 1] != '#')
            leaves++;
    }
    fclose(file);
    return leaves;
}

/* The robot's file all of them, but for those of what is off without a file of its own, and for
 * what follows from the robot. */
START_TEST(the_shipped_configuration_names_every_option)
{
    int rows = 0, optional = 0, derived = 0;

    for (const struct option_row *row = config_table(); row->name; row++) {
        rows++;
        optional += strncmp(row->name, "practice.", strlen("practice.")) == 0;
        derived += config_default_reason(row->name) != NULL;
    }
    /* Unknown and doubled names are refused, so as many leaves as rows means all of them. */
    ck_assert_int_eq(options_named("practice.yaml"), optional);
    ck_assert_int_eq(options_named("kobian.yaml") + optional + derived, rows);
}
END_TEST

/* As they were found for each robot by itself (docs/learner.md), to the bit. */
START_TEST(what_follows_from_the_robot_is_what_was_found)
{
    struct config kobian = fixture_config(NULL, 0);
    struct config icub = fixture_robot_config("icub.yaml");
    const double middle[] = {-40, 40, 40, 50, 0, 0, 10};

    ck_assert_double_eq(kobian.learner.hyper_sigma, 8);
    ck_assert_double_eq(kobian.learner.prior_sigma, 16);
    ck_assert_double_eq(kobian.learner.p0, 0.001);
    ck_assert_double_eq(kobian.task_damping_max, 0.05);
    ck_assert_int_eq(kobian.learner.degree, 3);
    ck_assert_double_eq(kobian.learner_reference.value[1], -17.5 * (M_PI / 180));
    ck_assert_double_eq(icub.learner.hyper_sigma, 14);
    ck_assert_double_eq(icub.learner.prior_sigma, 128);
    ck_assert_double_eq(icub.learner.p0, 0.1);
    ck_assert_double_eq(icub.task_damping_max, 0.2);
    ck_assert_int_eq(icub.learner.degree, 4);
    ck_assert_int_eq(icub.learner_reference.n, 7);
    for (int i = 0; i < 7; i++)
        ck_assert_double_eq(icub.learner_reference.value[i], middle[i] * (M_PI / 180));
}
END_TEST

START_TEST(what_is_named_holds_before_what_follows)
{
    const char *const overrides[] = {"learner.hyper_sigma=5", "learner.reference=[-60,-10,0,-60]"};
    struct config config = fixture_config(overrides, 2);

    ck_assert_double_eq(config.learner.hyper_sigma, 5);
    ck_assert_double_eq(config.learner_reference.value[1], -10 * (M_PI / 180));
    ck_assert_double_eq(config.learner.prior_sigma, 16);
}
END_TEST

/* The learner was made about the middle that held at the start. */
START_TEST(a_range_of_babbling_that_is_read_again_leaves_the_middle)
{
    struct config first = fixture_config(NULL, 0), again;
    const char *const overrides[] = {"babble.max=[-50,-5,15,-40]"};
    const char *path;
    char name[512], error[512];
    int changes;

    snprintf(name, sizeof name, "%s/etc/kobian.yaml", getenv("REACH_SOURCE_DIR"));
    path = name;
    ck_assert_int_eq(config_load_again(&again, &first, &path, 1, overrides, 1, error, sizeof error),
                     0);
    ck_assert_msg(config_reloadable(&first, &again, &changes, error, sizeof error), "%s", error);
    ck_assert_int_eq(changes, 1);
}
END_TEST

/* A small file for an arm of one's own stays small. */
START_TEST(cameras_that_nobody_turns_need_few_numbers)
{
    char name[512], error[512] = "";
    const char *path = name, *overrides[] = {"learner.experts=body"};
    struct config config;

    snprintf(name, sizeof name, "%s/etc/watched.yaml", getenv("REACH_SOURCE_DIR"));
    ck_assert_int_eq(config_load(&config, &path, 1, overrides, 1, error, sizeof error), -1);
    ck_assert_msg(strstr(error, "learner.experts must be polynomial") != NULL, "%s", error);
    config = fixture_robot_config("watched.yaml");
    ck_assert_int_eq(config.space.kind, SPACE_FIXED);
    ck_assert_int_eq(config_head_joints(&config), 0);
    ck_assert_double_eq(config.space.unit[0], 1);
    ck_assert_double_eq_tol(config.space.scale[0], 400 * M_PI / 18, 1e-9);
    ck_assert_double_eq_tol(config.space.noise[1], 400 * M_PI / 360, 1e-9);
    ck_assert_double_eq(config.space.noise[2], 3);
}
END_TEST

START_TEST(the_file_of_practice_fits)
{
    ck_assert_int_eq(fixture_config(NULL, 0).practice_samples, 0);
    ck_assert_int_eq(fixture_learner_config("practice.yaml").practice_samples, 12);
}
END_TEST

START_TEST(the_file_of_receptive_fields_fits)
{
    struct config config = fixture_learner_config("learner-lwpr.yaml");
    struct learner_config learner = config_learner(&config);

    ck_assert_int_eq(learner.kind, LEARNER_LWPR);
    ck_assert_int_eq(learner.lwpr.max_projections, 4);
    ck_assert_double_eq_tol(learner.lwpr.norm_out[1], 0.0174532925, 1e-9);
    ck_assert_double_eq(learner.lwpr.norm_out[2], 3);
}
END_TEST

START_TEST(the_learners_files_of_the_icub_like_robot_fit)
{
    struct config fields = fixture_overlaid_config("icub.yaml", "icub-lwpr.yaml");
    struct config linear = fixture_overlaid_config("icub.yaml", "icub-linear.yaml");

    ck_assert_int_eq(config_learner(&fields).kind, LEARNER_LWPR);
    ck_assert_int_eq(linear.learner.features, LEARNER_LINEAR);
}
END_TEST

START_TEST(the_linear_learner_s_file_fits)
{
    struct config config = fixture_learner_config("learner-linear.yaml");

    ck_assert_int_eq(config.learner.features, LEARNER_LINEAR);
    ck_assert_double_eq(config.learner_noise_disparity, 6);
    ck_assert_double_eq(config.learner.alpha, 0.999);
}
END_TEST

START_TEST(the_learner_s_memory_is_bounded)
{
    const char *overrides[] = {"learner.experts=polynomial", "learner.most_bytes=3e5",
                               "learner.capacity=1024"};
    struct config config = fixture_config(overrides, 3);
    struct learner_config learner = config_learner(&config);

    ck_assert_uint_gt(learner_memory(&learner), 200000);
    ck_assert_uint_le(learner_memory(&learner), 300000);
}
END_TEST

START_TEST(the_learner_gets_variances)
{
    struct config config = fixture_config(NULL, 0);
    struct learner_config learner = config_learner(&config);

    ck_assert_int_eq(learner.n_inputs, 4);
    ck_assert_int_eq(learner.n_outputs, 3);
    ck_assert_double_eq(learner.psi0[2],
                        config.learner_noise_disparity * config.learner_noise_disparity);
}
END_TEST

START_TEST(what_does_not_fit_together_is_refused)
{
    refuses("arm.max=[-80, -5, 15, -5]", "arm.min is not below arm.max at joint 1");
    refuses("arm.max=[-5, -5, 15]", "as many entries");
    refuses("babble.min=[-75, -30, -15, -90]", "babble range of joint 1");
    refuses("babble.max=[-60, -5, 16, -40]", "babble range of joint 3");
    refuses("head.min=[-40]", "as many entries");
    refuses("motion.arm_velocity=100", "safety.arm_velocity");
    refuses("motion.slow_down=13", "slow_down");
    refuses("motion.head_acceleration=200", "could not be followed");
    refuses("safety.reaction=0.2", "would have to brake before the motion slows down");
    refuses("safety.reaction=0.1", "safety.loop_stall");
    refuses("safety.loop_stall=0.02", "safety.loop_stall is below three periods");
    refuses("safety.loop_stall=0.03", "safety.loop_stall is below three periods");
    refuses("safety.loop_stall=0.0599", "safety.loop_stall is below three periods");
    refuses("safety.state_suspend=0.01", "state_suspend");
    refuses("head.search_velocity=100", "head.search_velocity");
    refuses("learner.reference=[0]", "learner.reference");
    refuses("task.space=fixed", "only the visual task space has a head");
    refuses("learner.reach=nonsense", "not a number");
    refuses("learner.capacity=1025", "one tick can touch");
    refuses("learner.alpha=0.5", "learner.alpha: 0.5 is out of range 0.9 .. 1");
    refuses("learner.prior_sigma=3", "learner: prior_sigma is 3");
    refuses("learner.lwpr.w_prune=2", "learner.lwpr.w_prune: 2 is out of range");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {the_shipped_configuration_is_the_paper_s_robot,
                                  the_shipped_configuration_names_every_option,
                                  what_follows_from_the_robot_is_what_was_found,
                                  what_is_named_holds_before_what_follows,
                                  a_range_of_babbling_that_is_read_again_leaves_the_middle,
                                  cameras_that_nobody_turns_need_few_numbers,
                                  the_file_of_practice_fits,
                                  the_learners_files_of_the_icub_like_robot_fit,
                                  the_file_of_receptive_fields_fits,
                                  the_linear_learner_s_file_fits,
                                  the_learner_s_memory_is_bounded,
                                  the_learner_gets_variances,
                                  what_does_not_fit_together_is_refused};

    return SUITE_RUN("config", tests);
}
