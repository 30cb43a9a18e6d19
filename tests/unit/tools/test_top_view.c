/* What `reachctl top` counts, and the frames that it draws. */
#include "tests/unit/suite.h"
#include "tools/reachctl/view/top_view.h"

#include <stdlib.h>
#include <string.h>

static const int64_t start = 5000000;
static struct top top;

static void hear_status(const reach_status_t *status, int64_t now)
{
    unsigned char data[1024];
    int size = reach_status_t_encode(data, 0, sizeof data, status);

    ck_assert_int_gt(size, 0);
    top_hear(&top, "REACH_STATUS", data, (size_t)size, now);
}

/* The frame as text, to be freed. */
static char *frame(int64_t now, int width, int height, bool terminal)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);

    top_draw(&top, now, width, height, terminal, out);
    fclose(out);
    return text;
}

static void assert_shows(int64_t now, const char *piece)
{
    char *text = frame(now, 100, 50, false);

    ck_assert_msg(strstr(text, piece) != NULL, "'%s' is not in\n%s", piece, text);
    free(text);
}

START_TEST(rates_are_those_of_a_closed_window)
{
    static const char text[1000] = "";
    static struct rates rates;

    for (int i = 0; i < 100; i++)
        rates_count(&rates, "B", text, 30, start + i * 20000);
    rates_count(&rates, "A", text, 1000, start);
    ck_assert_double_eq(rates_settle(&rates, start + 900000), 0);
    ck_assert_double_eq(rates.rate[0].per_second, 0);
    ck_assert_double_eq(rates_settle(&rates, start + 2000000), 2);
    ck_assert_str_eq(rates.rate[0].channel, "A");
    ck_assert_str_eq(rates.rate[1].channel, "B");
    ck_assert_double_eq(rates.rate[0].bytes_per_second, 500);
    ck_assert_double_eq(rates.rate[1].per_second, 50);
    ck_assert_double_eq(rates.rate[1].bytes_per_second, 1500);
    rates_settle(&rates, start + 4000000);
    ck_assert_double_eq(rates.rate[1].per_second, 0);
}
END_TEST

START_TEST(more_channels_than_rows_are_counted_apart)
{
    static struct rates rates;
    char name[16];

    for (int i = 0; i < RATES_MOST + 3; i++) {
        snprintf(name, sizeof name, "C%04d", i);
        rates_count(&rates, name, "", 0, start);
    }
    ck_assert_int_eq(rates.n, RATES_MOST);
    ck_assert_int_eq(rates.uncounted, 3);
}
END_TEST

START_TEST(unevenness_is_told)
{
    static struct rates rates;
    int64_t now = start;

    for (int i = 0; i < 50; i++) { /* 19 ms and 21 ms in turn, and once a quarter of a second */
        rates_count(&rates, "EVEN", "", 0, start + i * 20000);
        rates_count(&rates, "UNEVEN", "", 0, now);
        now += i % 2 ? 19000 : 21000;
    }
    rates_settle(&rates, start + 1000000);
    ck_assert_double_eq_tol(rates.rate[0].jitter, 0, 1e-6);
    ck_assert_double_eq_tol(rates.rate[1].jitter, 1000, 1);
    rates_count(&rates, "EVEN", "", 0, start + 980000 + 250000);
    for (int i = 0; i < 3; i++)
        rates_settle(&rates, start + (2 + i) * 1000000);
    ck_assert_int_eq(rates.rate[0].longest, 250000); /* it is not forgotten */
    ck_assert_double_eq(rates.rate[0].jitter, 0);
}
END_TEST

START_TEST(types_are_told)
{
    reach_robot_state_t robot = {.n_joints = 9};
    unsigned char data[1024];
    int size = reach_robot_state_t_encode(data, 0, sizeof data, &robot);

    top_hear(&top, "ROBOT_STATE", data, (size_t)size, start);
    top_hear(&top, "MINE", "12345678", 8, start);
    top_hear(&top, "MARKER", data, (size_t)size, start);
    top_hear(&top, "REACH_TRACE", "12345678", 8, start);
    assert_shows(start, "reach.robot_state_t");
    assert_shows(start, "not ours");
    assert_shows(start, "wrong type");
    assert_shows(start, "another version");
}
END_TEST

START_TEST(who_cannot_keep_up_says_so)
{
    top_note_lateness(&top, 400000, start);
    ck_assert_int_eq(top.late_at, 0);
    top_note_lateness(&top, 2500000, start);
    assert_shows(start + 1000000, "cannot keep up: what it shows is up to 2.5 s old");
    top.dropped = 7;
    assert_shows(start + 9000000, "7 packets found a full socket");
    top.late_at = 0;
    top.dropped = 0;
}
END_TEST

START_TEST(names_cannot_command_the_terminal)
{
    char *text;

    top_hear(&top,
             "\033[2J\x9b"
             "A\n",
             "", 0, start);
    text = frame(start, 100, 50, false);
    ck_assert_ptr_null(strchr(text, '\033'));
    ck_assert_ptr_null(strchr(text, '\x9b'));
    ck_assert_ptr_nonnull(strstr(text, "\\x1b[2J\\x9bA\\x0a "));
    free(text);
}
END_TEST

START_TEST(a_frame_says_what_was_heard)
{
    reach_status_t status = {.state = REACH_STATUS_T_ACTIVE, .behaviour = REACH_STATUS_T_REACH};
    reach_robot_state_t robot = {.n_joints = 9, .position = {[8] = -0.5}};
    unsigned char data[1024];
    int size = reach_robot_state_t_encode(data, 0, sizeof data, &robot);

    status.error = 12.25;
    status.experts = 7;
    top_hear(&top, "ROBOT_STATE", data, (size_t)size, start);
    hear_status(&status, start);
    assert_shows(start, "reachd active, reach");
    assert_shows(start, "7 experts");
    assert_shows(start, "12.2 px");
    assert_shows(start, "-28.6\n"); /* the ninth joint, in degrees */
    assert_shows(start, "ROBOT_STATE");
    assert_shows(start + 3000000, "silent for 3 s");
}
END_TEST

START_TEST(robot_time_is_compared_to_the_walls)
{
    reach_status_t status = {.utime = 1000000, .error = 4};

    hear_status(&status, start);
    top_settle(&top, start + 1000000);
    status.utime += 3000000;
    status.error = 8;
    hear_status(&status, start + 1500000);
    top_settle(&top, start + 2000000);
    assert_shows(start + 2000000, "3.0 times real time");
    assert_shows(start + 2000000, "at most 8.0 px: |+@|");
}
END_TEST

START_TEST(a_message_of_another_layout_is_only_counted)
{
    top_hear(&top, "REACH_STATUS", "abc", 3, start);
    ck_assert_int_eq(top.status_at, 0);
    assert_shows(start, "reachd has not been heard");
    assert_shows(start, "REACH_STATUS");
}
END_TEST

/* Lines, and the longest of them without escape sequences. */
static void measure(const char *text, int *lines, int *longest)
{
    int length = 0;
    bool escape = false;

    *lines = 1;
    *longest = 0;
    for (; *text; text++) {
        if (*text == '\n') {
            ++*lines;
            length = 0;
        } else if (*text == '\033')
            escape = true;
        else if (escape)
            escape = !((*text >= 'A' && *text <= 'Z') || (*text >= 'a' && *text <= 'z'));
        else if (*text != '\r' && ++length > *longest)
            *longest = length;
    }
}

START_TEST(frames_fit_every_terminal)
{
    reach_status_t status = {.utime = 1};
    char name[16];
    int lines;
    int longest;

    hear_status(&status, start);
    for (int i = 0; i < 30; i++) {
        snprintf(name, sizeof name, "CHANNEL_%d", i);
        top_hear(&top, name, "", 0, start);
    }
    for (int height = 1; height < 50; height++)
        for (int width = 1; width < 120; width += 7) {
            char *text = frame(start, width, height, true);
            measure(text, &lines, &longest);
            ck_assert_int_le(lines, height);
            ck_assert_int_le(longest, width);
            free(text);
        }
    assert_shows(start, "CHANNEL_29");
}
END_TEST

int main(void)
{
    const TTest *tests[] = {rates_are_those_of_a_closed_window,
                            more_channels_than_rows_are_counted_apart,
                            unevenness_is_told,
                            types_are_told,
                            who_cannot_keep_up_says_so,
                            names_cannot_command_the_terminal,
                            a_frame_says_what_was_heard,
                            robot_time_is_compared_to_the_walls,
                            a_message_of_another_layout_is_only_counted,
                            frames_fit_every_terminal};

    return SUITE_RUN("top", tests);
}
