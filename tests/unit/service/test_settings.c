/* The configuration: the learner's defaults follow the dimensions, and what is wrong is named. */
#include "learner/service/settings.h"
#include "tests/unit/suite.h"

#include <string.h>

static struct settings settings;
static char error[512];

static int load(int n, const char *const *overrides)
{
    error[0] = '\0';
    return settings_load(&settings, NULL, 0, overrides, n, error, sizeof error);
}

START_TEST(defaults_follow_the_dimensions)
{
    const char *overrides[] = {"inputs=5", "outputs=3", "psi0=0.1", "sigma0=[1, 2, 3, 4, 5]",
                               "degree=2"};
    const struct learner_config *config = &settings.learner.config;

    ck_assert_msg(load(5, overrides) == 0, "%s", error);
    ck_assert_int_eq(config->n_inputs, 5);
    ck_assert_int_eq(config->n_outputs, 3);
    ck_assert_double_eq(config->prior_sigma, 32); /* 2^5 */
    ck_assert_double_eq(config->hyper_psi, 6);    /* 2 * 3 */
    ck_assert_double_eq(config->psi0[2], 0.1);
    ck_assert_double_eq(config->sigma0[4], 5);
    ck_assert_int_eq(config->degree, 2);
    ck_assert_str_eq(settings_store(&settings).directory, "");
}
END_TEST

START_TEST(what_is_wrong_is_named)
{
    const struct {
        const char *override, *says;
    } wrong[] = {
        {"inputs=17", "--set:1: inputs: 17 is out of range 1 .. 16"},
        {"outputs=0", "outputs: 0 is out of range 1 .. 8"},
        {"kind=oracle", "kind: "},
        {"nonsense=1", "nonsense: unknown option"},
        {"sigma0=[1, 2, 3]", "sigma0 has 3 entries; wanted: 2, or one number for all"},
        {"prior_sigma=1", "prior_sigma is 1: must be between 2 and inf"},
    };

    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const char *overrides[] = {"inputs=2", "outputs=1", "psi0=1", "sigma0=1",
                                   wrong[i].override};
        ck_assert_int_eq(load(5, overrides), -1);
        ck_assert_msg(strstr(error, wrong[i].says) != NULL, "%s", error);
        ck_assert_ptr_null(strchr(error, '\n'));
    }
    ck_assert_int_eq(load(0, NULL), -1);
    ck_assert_ptr_nonnull(strstr(error, "inputs must be given"));
}
END_TEST

int main(void)
{
    const TTest *tests[] = {defaults_follow_the_dimensions, what_is_wrong_is_named};

    return SUITE_RUN("settings", tests);
}
