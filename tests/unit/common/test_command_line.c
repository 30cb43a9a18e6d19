/* The table of a command line: where values go, what is refused, what is printed. */
#include "common/options/command_line.h"

#include "tests/unit/suite.h"

#include <stdbool.h>
#include <string.h>
#include <unistd.h>

enum { MOST = 32, MOST_FILES = 2 };

struct settings {
    bool quiet, eyes;
    const char *json, *cameras[2], *files[MOST_FILES], *words[MOST];
    int n_files, n_words, inputs;
    int64_t seed;
    double timeout;
};

static int take_word(void *user, const char *text, char *error, size_t error_size)
{
    struct settings *settings = user;

    if (strcmp(text, "bad") == 0) {
        snprintf(error, error_size, "a bad word");
        return -1;
    }
    settings->words[settings->n_words++] = text;
    return 0;
}

static const struct argument_row rows[] = {
    ARGUMENT_ON("quiet", 'q', struct settings, quiet, "say less"),
    ARGUMENT_OFF("no-eyes", struct settings, eyes, "no cameras"),
    ARGUMENT_TEXT("json", 'j', "FILE", struct settings, json, "the report"),
    ARGUMENT_PAIR("cameras", "LEFT RIGHT", struct settings, cameras, "two devices"),
    ARGUMENT_LIST(
        "train", 0, "FILE ...", struct settings, files, n_files, MOST_FILES,
        "a help so long that it goes on behind the ninety-sixth column of the terminal, on "
        "a second line"),
    ARGUMENT_INT("inputs", "d", struct settings, inputs, 1, 16, "dimension"),
    ARGUMENT_INT64("seed", "S", struct settings, seed, INT64_MIN, INT64_MAX, "of all chance"),
    ARGUMENT_SECONDS("timeout", "S", struct settings, timeout, "patience"),
    ARGUMENT_CALL("word", "WORD", take_word, "a word more"),
    ARGUMENT_END,
};

static const struct command_line line = {
    .program = "prog",
    .usage = "prog [options]",
    .about = "Is tested.",
    .rows = rows,
    .exit_status = "0 done, 1 failed",
    .take_word = take_word,
};

static struct settings settings;
static char said[4096];

/* Parses words separated by spaces; what goes to `stream` is left in `said`. */
static int parse_catching(const char *text, FILE *stream)
{
    static char words[256];
    char *argv[MOST] = {"prog"};
    FILE *caught = tmpfile();
    const int kept = dup(fileno(stream));
    int argc = 1;
    int status;

    settings = (struct settings){.eyes = true};
    snprintf(words, sizeof words, "%s", text);
    for (char *word = strtok(words, " "); word; word = strtok(NULL, " "))
        argv[argc++] = word;
    fflush(stream);
    dup2(fileno(caught), fileno(stream));
    status = command_line_parse(&line, argc, argv, &settings);
    fflush(stream);
    dup2(kept, fileno(stream));
    close(kept);
    rewind(caught);
    said[fread(said, 1, sizeof said - 1, caught)] = '\0';
    fclose(caught);
    return status;
}

static void assert_refused(const char *text, const char *reason)
{
    ck_assert_msg(parse_catching(text, stderr) == 2, "'%s' is taken", text);
    ck_assert_msg(strstr(said, reason), "'%s' got: %s", text, said);
    ck_assert_ptr_nonnull(strstr(said, "; prog --help tells more\n"));
    ck_assert_ptr_eq(strchr(said, '\n'), said + strlen(said) - 1);
}

START_TEST(test_values_go_where_the_rows_say)
{
    ck_assert_int_eq(parse_catching("-qj a --no-eyes --cameras l r --inputs 7 --seed -3 first "
                                    "--timeout=0.5 -50 --train x y --word last -- --quiet",
                                    stderr),
                     -1);
    ck_assert(settings.quiet && !settings.eyes);
    ck_assert_str_eq(settings.json, "a");
    ck_assert_str_eq(settings.cameras[0], "l");
    ck_assert_str_eq(settings.cameras[1], "r");
    ck_assert_int_eq(settings.inputs, 7);
    ck_assert_int_eq(settings.seed, -3);
    ck_assert_double_eq(settings.timeout, 0.5);
    ck_assert_int_eq(settings.n_files, 2);
    ck_assert_str_eq(settings.files[1], "y");
    ck_assert_int_eq(settings.n_words, 4);
    ck_assert_str_eq(settings.words[0], "first");
    ck_assert_str_eq(settings.words[1], "-50");
    ck_assert_str_eq(settings.words[2], "last");
    ck_assert_str_eq(settings.words[3], "--quiet");
}
END_TEST

START_TEST(test_wrong_usage_is_told_in_one_line)
{
    assert_refused("--fly", "prog: unrecognized option '--fly'");
    assert_refused("-x", "unrecognized option '-x'");
    assert_refused("--json", "--json: FILE is missing");
    assert_refused("-j", "--json: FILE is missing");
    assert_refused("--quiet=yes", "--quiet: takes no value");
    assert_refused("--cameras l", "--cameras: two words are wanted");
    assert_refused("--cameras l -q", "--cameras: two words are wanted");
    assert_refused("--train a b c", "--train: more than 2");
    for (const char *const *bad = (const char *const[]){"0", "17", "two", "7x", NULL}; *bad;
         bad++) {
        char text[32];
        snprintf(text, sizeof text, "--inputs %s", *bad);
        assert_refused(text, "--inputs: a whole number from 1 to 16 is wanted, not");
    }
    assert_refused("--seed 99999999999999999999", "--seed: a whole number");
    assert_refused("--timeout 0", "--timeout: a positive number of seconds");
    assert_refused("--timeout nan", "--timeout: a positive number of seconds");
    assert_refused("--word bad", "--word: a bad word");
    assert_refused("bad", "prog: a bad word");
}
END_TEST

START_TEST(test_help_and_version)
{
    ck_assert_int_eq(parse_catching("--help --fly", stdout), 0);
    ck_assert_ptr_eq(strstr(said, "usage: prog [options]\n\nIs tested.\n\n"), said);
    ck_assert_ptr_nonnull(strstr(said, "\n  -q, --quiet               say less\n"));
    ck_assert_ptr_nonnull(strstr(said, "\n      --cameras LEFT RIGHT  two devices\n"));
    ck_assert_ptr_nonnull(
        strstr(said, " of the\n                            terminal, on a second line\n"));
    ck_assert_ptr_nonnull(strstr(said, "\nExit status: 0 done, 1 failed, 2 wrong usage.\n"));
    ck_assert_ptr_null(strstr(said, "--help-options"));
    ck_assert_int_eq(parse_catching("-V", stdout), 0);
    ck_assert_ptr_eq(strstr(said, "prog "), said);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {test_values_go_where_the_rows_say, test_wrong_usage_is_told_in_one_line,
                            test_help_and_version};

    return SUITE_RUN("command_line", tests);
}
