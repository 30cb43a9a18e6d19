/* Contexts: one expert after another without a jump is one, a jump begins another. */
#include "daemon/control/senses/context.h"
#include "tests/unit/suite.h"

#include <string.h>

static const double scale[] = {0.1, 0.1, 40};

static struct context context;
static struct estimate estimate;

static void begin(void)
{
    context_init(&context);
    estimate_init(&estimate, 2, 3, scale);
}

/* Follows an expert whose solution has this value (rad) for some ticks. */
static void follow(int expert, double value, int ticks)
{
    estimate.prediction.n_solutions = 1;
    estimate.solution = 0;
    estimate.prediction.solution[0].principal = expert;
    estimate.prediction.solution[0].value[0] = value;
    for (int n = 0; n < ticks; n++)
        context_follow(&context, &estimate);
}

static void expect(int current, int count)
{
    ck_assert_int_eq(context.current, current);
    ck_assert_int_eq(context.count, count);
}

START_TEST(nothing_followed_is_no_context)
{
    begin();
    for (int n = 0; n < 100; n++)
        context_follow(&context, &estimate);
    expect(0, 0);
}
END_TEST

START_TEST(a_context_is_believed_after_some_time)
{
    begin();
    follow(0, 0.5, CONTEXT_SETTLE - 1);
    expect(0, 0);
    follow(0, 0.5, 1);
    expect(1, 1);
}
END_TEST

START_TEST(a_jump_begins_another_and_the_way_back_does_not)
{
    begin();
    follow(0, 0.5, 100);
    follow(3, 1.5, 100);
    expect(2, 2);
    follow(0, 0.5, CONTEXT_SETTLE - 1);
    expect(2, 2);
    follow(0, 0.5, 1);
    expect(1, 2);
    follow(3, 1.5, 100);
    expect(2, 2);
}
END_TEST

START_TEST(neighbours_on_a_branch_are_one_context)
{
    begin();
    follow(0, 0.5, 100);
    follow(1, 0.51, 100);
    follow(2, 0.52, 100);
    expect(1, 1);
    follow(0, 0.51, 100);
    expect(1, 1);
    follow(4, 1.5, 100);
    follow(5, 1.51, 100);
    expect(2, 2);
    follow(2, 0.52, 100);
    expect(1, 2);
}
END_TEST

START_TEST(a_short_error_is_none)
{
    begin();
    follow(0, 0.5, 100);
    for (int n = 0; n < 50; n++) {
        follow(1, 1.5, 2);
        follow(0, 0.5, 2);
    }
    expect(1, 1);
}
END_TEST

START_TEST(experts_beyond_the_table_are_left_out)
{
    begin();
    follow(CONTEXT_EXPERTS, 0.5, 100);
    expect(0, 0);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        nothing_followed_is_no_context,
        a_context_is_believed_after_some_time,
        a_jump_begins_another_and_the_way_back_does_not,
        neighbours_on_a_branch_are_one_context,
        a_short_error_is_none,
        experts_beyond_the_table_are_left_out,
    };

    return SUITE_RUN("context", tests);
}
