/* A harness as an ordinary test: every file of the corpus, and then so many damaged copies of them.
 *   usage: HARNESS COUNT FILE...
 * The damage comes from a seed, which is printed and taken from $REACH_TEST_SEED. */
#include "harness.h"

#include <inttypes.h>
#include <string.h>
#include <time.h>

enum { MOST_BYTES = 1 << 20 };

static uint64_t state;

static uint64_t next_random(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return state >> 33;
}

static size_t read_file(const char *path, uint8_t *bytes)
{
    FILE *file = fopen(path, "rb");
    size_t size;

    HARNESS_REQUIRE(file != NULL);
    size = fread(bytes, 1, MOST_BYTES, file);
    fclose(file);
    return size;
}

/* A few bytes changed, moved or cut off. */
static size_t damage(uint8_t *bytes, size_t size)
{
    static const uint8_t borders[] = {0, 1, 0x7f, 0x80, 0xff};

    for (uint64_t n = 1 + next_random() % 8; n > 0 && size > 0; n--) {
        size_t at = next_random() % size, from = next_random() % size;
        size_t length = 1 + next_random() % 16;
        switch (next_random() % 5) {
        case 0:
            bytes[at] = (uint8_t)next_random();
            break;
        case 1:
            bytes[at] ^= (uint8_t)(1u << next_random() % 8);
            break;
        case 2:
            bytes[at] = borders[next_random() % sizeof borders];
            break;
        case 3:
            length = length > size - at ? size - at : length;
            length = length > size - from ? size - from : length;
            memmove(bytes + at, bytes + from, length);
            break;
        default:
            if (next_random() % 8 == 0)
                size = at;
            break;
        }
    }
    return size;
}

int main(int argc, char **argv)
{
    static uint8_t bytes[MOST_BYTES];
    const char *seed = getenv("REACH_TEST_SEED");
    long count;

    if (argc < 3) {
        fprintf(stderr, "usage: %s COUNT FILE...\n", argv[0]);
        return 2;
    }
    count = strtol(argv[1], NULL, 10);
    state = seed ? strtoull(seed, NULL, 10) : (uint64_t)time(NULL);
    printf("REACH_TEST_SEED=%" PRIu64 "\n", state);
    fflush(stdout);
    for (int i = 2; i < argc; i++)
        LLVMFuzzerTestOneInput(bytes, read_file(argv[i], bytes));
    for (long i = 0; i < count; i++) {
        size_t size = read_file(argv[2 + next_random() % (uint64_t)(argc - 2)], bytes);
        LLVMFuzzerTestOneInput(bytes, damage(bytes, size));
    }
    printf("%d files and %ld damaged copies\n", argc - 2, count);
    return 0;
}
