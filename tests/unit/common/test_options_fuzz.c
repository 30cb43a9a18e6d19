/* Damaged YAML never crashes the reader, and every refusal comes with a reason. */
#include "common/options/options.h"
#include "tests/unit/suite.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#define ROUNDS 20000
#define MAX_BYTES 512

static const char sample[] = "# a comment\n"
                             "arm:\n"
                             "  gain: 2.0\n"
                             "  range: [1, -2.5, .inf]\n"
                             "  inner: {deep: {deeper: yes, name: \"a \\\"b\\\"\"}}\n"
                             "head.speed: 1e3\n"
                             "list:\n  - 1\n  - 2\n"
                             "text: |\n  two\n  lines\n";
/* What breaks YAML most often. */
static const char pieces[] = "{}[]:,-&*!|>'\"%@`#?~ \n\t\x01\xff";

static unsigned long long state;

/* A small generator of our own: the same seed gives the same bytes everywhere. */
static unsigned next_random(unsigned below)
{
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (unsigned)(state >> 33) % below;
}

static int ignore_leaf(void *user, const char *name, const char *const *items, int n_items,
                       bool is_list, char *error, size_t error_size)
{
    (void)is_list;
    (void)error;
    (void)error_size;
    ck_assert_int_gt((int)strlen(name), 0);
    ck_assert_int_le(n_items, 64);
    for (int i = 0; i < n_items; i++)
        ck_assert_ptr_nonnull(items[i]);
    ++*(long *)user;
    return 0;
}

static size_t damage(char *text)
{
    size_t length = sizeof sample - 1;

    memcpy(text, sample, length);
    for (unsigned hits = next_random(8); hits > 0; hits--) {
        size_t at = next_random((unsigned)length);
        switch (next_random(3)) {
        case 0: /* another character */
            text[at] = pieces[next_random(sizeof pieces - 1)];
            break;
        case 1: /* cut off */
            length = at + 1;
            break;
        default: /* a piece twice */
            if (length + 40 < MAX_BYTES && at + 40 < length) {
                memmove(text + at + 40, text + at, length - at);
                length += 40;
            }
            break;
        }
    }
    return length;
}

START_TEST(damaged_text_is_read_or_refused)
{
    char text[MAX_BYTES];
    long leaves = 0;
    long refused = 0;

    for (int round = 0; round < ROUNDS; round++) {
        char error[256] = "";
        size_t length = damage(text);
        FILE *stream = fmemopen(text, length, "r");
        ck_assert_ptr_nonnull(stream);
        if (options_read_yaml("fuzz", stream, ignore_leaf, &leaves, error, sizeof error)) {
            ck_assert_msg(strncmp(error, "fuzz:", 5) == 0, "round %d: '%s'", round, error);
            refused++;
        }
        fclose(stream);
    }
    /* Both ways were taken often, so the test looks at something. */
    ck_assert_int_gt(leaves, ROUNDS);
    ck_assert_int_gt(refused, ROUNDS / 10);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        damaged_text_is_read_or_refused,
    };
    const char *seed = getenv("REACH_TEST_SEED");

    state = seed ? strtoull(seed, NULL, 10) : (unsigned long long)time(NULL);
    printf("REACH_TEST_SEED=%llu\n", state);
    fflush(stdout); /* Check forks */
    return SUITE_RUN("options_fuzz", tests);
}
