/* A configuration as text gives the same configuration, whatever its numbers are. */
#include "daemon/config/load.h"
#include "daemon/config/text.h"
#include "tests/unit/control/fixture.h"
#include "tests/unit/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void must_come_back(const struct config *config)
{
    struct config again;
    char text[CONFIG_TEXT_SIZE], error[512] = "";

    ck_assert_int_gt(config_text(config, text), 0);
    ck_assert_msg(config_from_text(&again, text, error, sizeof error) == 0, "%s", error);
    ck_assert_mem_eq(config, &again, sizeof again);
}

START_TEST(every_robot_comes_back)
{
    static const char *const robots[] = {"kobian.yaml", "icub.yaml", "sixaxis.yaml",
                                         "watched.yaml"};

    for (size_t i = 0; i < sizeof robots / sizeof robots[0]; i++) {
        struct config config = fixture_robot_config(robots[i]);
        must_come_back(&config);
    }
}
END_TEST

START_TEST(odd_numbers_and_words_come_back_to_the_last_bit)
{
    struct random_state random = fixture_random("config_text");

    for (int i = 0; i < 200; i++) {
        char limits[64], gain[64];
        const char *overrides[] = {limits, gain, "model.directory='it''s: here #1'",
                                   "babble.min=[]", "babble.max=[]"};
        struct config config;
        snprintf(limits, sizeof limits, "motion.margin=%.17g", random_uniform(&random, 0.1, 1));
        snprintf(gain, sizeof gain, "task.gain=%.17g", random_uniform(&random, 1, 3));
        config = fixture_config(overrides, sizeof overrides / sizeof overrides[0]);
        ck_assert_str_eq(config.model_directory, "it's: here #1");
        must_come_back(&config);
    }
}
END_TEST

/* What --check-config prints can be a configuration itself. */
START_TEST(what_is_printed_can_be_read)
{
    const char *overrides[] = {"model.directory='it''s: here #1'", "learner.p0=0.2"};
    struct config config = fixture_config(overrides, 2), again;
    char path[] = "/tmp/reach_config_XXXXXX", error[512] = "";
    const char *paths[] = {path};
    FILE *file = fdopen(mkstemp(path), "w");

    ck_assert_ptr_nonnull(file);
    config_print(&config, file);
    fclose(file);
    ck_assert_msg(config_load(&again, paths, 1, NULL, 0, error, sizeof error) == 0, "%s", error);
    unlink(path);
    ck_assert_mem_eq(&config, &again, sizeof again);
}
END_TEST

START_TEST(another_configuration_has_another_checksum)
{
    const char *overrides[] = {"task.gain=2.0000000001"};
    struct config config = fixture_config(NULL, 0);
    struct config other = fixture_config(overrides, 1);

    ck_assert_uint_ne(config.checksum, other.checksum);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        every_robot_comes_back, odd_numbers_and_words_come_back_to_the_last_bit,
        what_is_printed_can_be_read, another_configuration_has_another_checksum};

    return SUITE_RUN("config_text", tests);
}
