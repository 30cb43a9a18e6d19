/* The option table: what is stored, and what each kind of mistake is answered with. */
#include "common/options/options.h"
#include "tests/unit/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct settings {
    bool fast;
    int count;
    double gain;
    double limit;
    struct option_list range;
    char name[OPTION_MAX_TEXT];
    int colour;
};

#define ROW(field, type, unit, initial, low, high, choices)                                        \
    {                                                                                              \
        "arm." #field, type, offsetof(struct settings, field), unit, initial, low, high,           \
            "help of " #field, choices                                                             \
    }

static const struct option_row table[] = {
    ROW(fast, OPTION_BOOL, NULL, "false", 0, 0, NULL),
    ROW(count, OPTION_INT, NULL, "3", 1, 10, NULL),
    ROW(gain, OPTION_NUMBER, "1/s", "2.0", 0, 5, NULL),
    ROW(limit, OPTION_NUMBER, "deg/s", "90", 0, 360, NULL),
    ROW(range, OPTION_LIST, "deg", "[-90, 180]", -360, 360, NULL),
    ROW(name, OPTION_TEXT, NULL, "kobian", 0, 0, NULL),
    ROW(colour, OPTION_CHOICE, NULL, "red", 0, 0, "red|green|blue"),
    OPTION_END,
};

static char error[512];

/* Loads a YAML text through a file, as programs do. */
static int load(const struct option_row *rows, struct settings *settings, const char *yaml,
                const char *override)
{
    char path[] = "/tmp/reach_options_XXXXXX";
    int descriptor = mkstemp(path);
    ssize_t length = (ssize_t)strlen(yaml);
    int result;

    error[0] = '\0';
    ck_assert_int_ge(descriptor, 0);
    ck_assert_int_eq(write(descriptor, yaml, (size_t)length), length);
    close(descriptor);
    result = options_load(rows, settings, (const char *[]){path}, 1, &override, override ? 1 : 0,
                          error, sizeof error);
    unlink(path);
    return result;
}

/* Refused, with every one of the given pieces in the error's single line. */
static void assert_refused(const char *yaml, const char *override, const char *where,
                           const char *what)
{
    struct settings settings;

    ck_assert_int_eq(load(table, &settings, yaml, override), -1);
    ck_assert_msg(strstr(error, where) != NULL, "'%s' lacks '%s'", error, where);
    ck_assert_msg(strstr(error, what) != NULL, "'%s' lacks '%s'", error, what);
    ck_assert_ptr_null(strchr(error, '\n'));
}

START_TEST(defaults_are_stored)
{
    struct settings settings;

    ck_assert_int_eq(options_load(table, &settings, NULL, 0, NULL, 0, error, sizeof error), 0);
    ck_assert(!settings.fast);
    ck_assert_int_eq(settings.count, 3);
    ck_assert_double_eq(settings.gain, 2.0);
    ck_assert_str_eq(settings.name, "kobian");
    ck_assert_int_eq(settings.colour, 0);
}
END_TEST

START_TEST(degrees_become_radians)
{
    struct settings settings;

    ck_assert_int_eq(load(table, &settings, "arm: {limit: 180, range: [45, -30, 0]}\n", NULL), 0);
    ck_assert_double_eq_tol(settings.limit, M_PI, 1e-15);
    ck_assert_int_eq(settings.range.n, 3);
    ck_assert_double_eq_tol(settings.range.value[0], M_PI / 4, 1e-15);
    ck_assert_double_eq_tol(settings.range.value[1], -M_PI / 6, 1e-15);
    ck_assert_double_eq(settings.range.value[2], 0);
}
END_TEST

START_TEST(file_replaces_defaults_and_overrides_replace_the_file)
{
    struct settings settings;
    const char *yaml = "arm:\n  gain: 4\n  colour: blue\n  fast: true\n  name: my robot\n";

    ck_assert_int_eq(load(table, &settings, yaml, "arm.gain=1.5"), 0);
    ck_assert_double_eq(settings.gain, 1.5);
    ck_assert_int_eq(settings.colour, 2);
    ck_assert(settings.fast);
    ck_assert_str_eq(settings.name, "my robot");
}
END_TEST

START_TEST(dotted_and_nested_names_are_the_same)
{
    struct settings settings;

    ck_assert_int_eq(load(table, &settings, "arm.count: 7\n", NULL), 0);
    ck_assert_int_eq(settings.count, 7);
    ck_assert_int_eq(load(table, &settings, "", NULL), 0);
    ck_assert_int_eq(settings.count, 3);
}
END_TEST

START_TEST(mistakes_in_keys_are_named_with_their_line)
{
    assert_refused("arm:\n  gain: 1\n  gian: 2\n", NULL, ":3: arm.gian:", "unknown option");
    assert_refused("arm:\n  gain: 1\n  count: 2\n  gain: 2\n", NULL, ":4: arm.gain:", "twice");
    assert_refused("leg: 1\n", NULL, ":1: leg:", "unknown option");
    assert_refused("", "arm.gian=2", "arm.gian", "unknown option");
    assert_refused("", "arm.gain", "arm.gain", "name=value");
}
END_TEST

START_TEST(mistakes_in_values_are_named_with_their_line)
{
    assert_refused("arm:\n  gain: 5.1\n", NULL, ":2: arm.gain:", "range 0 .. 5");
    assert_refused("arm:\n\n  count: 2.5\n", NULL, ":3: arm.count:", "whole number");
    assert_refused("arm: {gain: fast}\n", NULL, ":1: arm.gain:", "not a number");
    assert_refused("arm: {gain: \"a\\nb\"}\n", NULL, ":1: arm.gain:", "'a?b'");
    assert_refused("arm: {gain: .nan}\n", NULL, ":1: arm.gain:", "not a number");
    assert_refused("arm: {fast: 1}\n", NULL, ":1: arm.fast:", "neither true nor false");
    assert_refused("arm: {colour: pink}\n", NULL, ":1: arm.colour:", "red|green|blue");
    assert_refused("arm: {gain: [1, 2]}\n", NULL, ":1: arm.gain:", "not a list");
    assert_refused("arm: {range: 4}\n", NULL, ":1: arm.range:", "list");
    assert_refused("arm: {range: [4, 400]}\n", NULL, ":1: arm.range:", "range -360 .. 360 deg");
    assert_refused("arm: {range: [1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]}\n", NULL,
                   ":1: arm.range:", "longer than 16");
}
END_TEST

START_TEST(a_list_longer_than_the_reader_holds_is_refused)
{
    char yaml[1024] = "arm: {range: [";

    for (int i = 0; i < 200; i++)
        strcat(yaml, "1, ");
    strcat(yaml, "1]}\n");
    assert_refused(yaml, NULL, ":1: arm.range:", "at most 64");
}
END_TEST

START_TEST(what_is_no_map_is_refused)
{
    assert_refused("[1, 2]\n", NULL, ":1:", "map of options");
    assert_refused("hello\n", NULL, ":1:", "map of options");
    assert_refused("arm: {gain: 1\n", NULL, ":", "");
    assert_refused("a: &x {b: 1}\narm: *x\n", NULL, ":", "");
}
END_TEST

START_TEST(a_missing_file_and_a_missing_value_are_told)
{
    static const struct option_row needed[] = {{"arm.gain", OPTION_NUMBER,
                                                offsetof(struct settings, gain), NULL, NULL, 0, 0,
                                                "a gain", NULL},
                                               OPTION_END};
    struct settings settings;

    ck_assert_int_eq(options_load(table, &settings, (const char *[]){"/no/such.yaml"}, 1, NULL, 0,
                                  error, sizeof error),
                     -1);
    ck_assert_ptr_nonnull(strstr(error, "/no/such.yaml: No such file"));
    ck_assert_int_eq(load(needed, &settings, "", NULL), -1);
    ck_assert_ptr_nonnull(strstr(error, "arm.gain must be given"));
}
END_TEST

/* A list takes names with blanks, a text splits at them; both hold more than one text would. */
START_TEST(names_are_a_list_or_words)
{
    static const struct option_row rows[] = {
        {"joints", OPTION_NAMES, 0, NULL, "", 0, 0, "help", NULL}, OPTION_END};
    static char names[OPTION_MAX_NAMES], yaml[2 * OPTION_MAX_NAMES], text[OPTION_TEXT_SIZE];
    const char *override;

    ck_assert_int_eq(options_load(rows, names, NULL, 0, NULL, 0, error, sizeof error), 0);
    ck_assert_str_eq(names, "");
    override = "joints=  one two\tthree ";
    ck_assert_int_eq(options_load(rows, names, NULL, 0, &override, 1, error, sizeof error), 0);
    ck_assert_str_eq(names, "one\ntwo\nthree");
    override = "joints=[upper arm, \"neck: yaw\"]";
    ck_assert_int_eq(options_load(rows, names, NULL, 0, &override, 1, error, sizeof error), 0);
    ck_assert_str_eq(names, "upper arm\nneck: yaw");
    option_text(&rows[0], names, text);
    ck_assert_str_eq(text, "[upper arm, neck: yaw]");
    override = "joints=[one, '']";
    ck_assert_int_eq(options_load(rows, names, NULL, 0, &override, 1, error, sizeof error), -1);
    ck_assert_ptr_nonnull(strstr(error, "empty"));

    strcpy(yaml, "joints=");
    for (int i = 0; i < 16; i++)
        snprintf(yaml + strlen(yaml), 100, "a_joint_with_a_rather_long_name_%02d ", i);
    override = yaml;
    ck_assert_int_eq(options_load(rows, names, NULL, 0, &override, 1, error, sizeof error), 0);
    ck_assert_uint_eq(strlen(names), 16 * 35 - 1);
    memset(yaml + strlen("joints="), 'x', OPTION_MAX_NAMES);
    yaml[strlen("joints=") + OPTION_MAX_NAMES] = '\0';
    ck_assert_int_eq(options_load(rows, names, NULL, 0, &override, 1, error, sizeof error), -1);
    ck_assert_ptr_nonnull(strstr(error, "longer"));
}
END_TEST

START_TEST(values_become_the_text_that_gives_them)
{
    static const char *const texts[] = {"true", "7", "0.25", "180", "[-30, 45.5]", "nao", "blue"};
    struct settings settings;
    char infinite[OPTION_TEXT_SIZE];

    for (int i = 0; table[i].name; i++) {
        char override[OPTION_TEXT_SIZE], text[OPTION_TEXT_SIZE];
        const char *overrides[] = {override};
        snprintf(override, sizeof override, "%s=%s", table[i].name, texts[i]);
        ck_assert_int_eq(options_load(table, &settings, NULL, 0, overrides, 1, error, sizeof error),
                         0);
        option_text(&table[i], &settings, text);
        ck_assert_str_eq(text, texts[i]);
    }
    settings.limit = INFINITY;
    option_text(option_find(table, "arm.limit"), &settings, infinite);
    ck_assert_str_eq(infinite, ".inf");
}
END_TEST

START_TEST(what_the_program_puts_in_is_the_default)
{
    const struct option_row rows[] = {ROW(count, OPTION_INT, NULL, option_preset, 1, 10, NULL),
                                      ROW(gain, OPTION_NUMBER, NULL, option_preset, 0, 5, NULL),
                                      OPTION_END};
    const char *overrides[] = {"arm.gain=4"};
    struct settings settings = {.count = 8, .gain = 3};
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);

    options_print(rows, &settings, stream);
    fclose(stream);
    ck_assert_ptr_nonnull(strstr(text, "whole number, default 8, range 1 .. 10"));
    free(text);
    ck_assert_int_eq(options_load(rows, &settings, NULL, 0, overrides, 1, error, sizeof error), 0);
    ck_assert_int_eq(settings.count, 8);
    ck_assert_double_eq(settings.gain, 4);
}
END_TEST

START_TEST(the_reference_names_every_row)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);

    options_print(table, NULL, stream);
    fclose(stream);
    for (const struct option_row *row = table; row->name; row++)
        ck_assert_ptr_nonnull(strstr(text, row->name));
    ck_assert_ptr_nonnull(strstr(text, "number, default 90, unit deg/s, range 0 .. 360"));
    free(text);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        names_are_a_list_or_words,
        defaults_are_stored,
        degrees_become_radians,
        file_replaces_defaults_and_overrides_replace_the_file,
        dotted_and_nested_names_are_the_same,
        mistakes_in_keys_are_named_with_their_line,
        mistakes_in_values_are_named_with_their_line,
        a_list_longer_than_the_reader_holds_is_refused,
        what_is_no_map_is_refused,
        a_missing_file_and_a_missing_value_are_told,
        values_become_the_text_that_gives_them,
        what_the_program_puts_in_is_the_default,
        the_reference_names_every_row,
    };

    return SUITE_RUN("options", tests);
}
