/* The daemon's configuration. What is taken is whole: a second reading gives the same. */
#include "daemon/config/load.h"
#include "daemon/config/sizes.h"
#include "daemon/config/table.h"
#include "harness.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct config config, again;
    const char *paths[] = {harness_file(data, size)};
    char error[512] = "";

    if (config_load(&config, paths, 1, NULL, 0, error, sizeof error)) {
        HARNESS_REQUIRE(error[0] && !strchr(error, '\n'));
        return 0;
    }
    HARNESS_REQUIRE(config_joints(&config) <= MAX_JOINTS && config_arm_joints(&config) > 0);
    HARNESS_REQUIRE(config_load(&again, paths, 1, NULL, 0, error, sizeof error) == 0);
    for (const struct option_row *row = config_table(); row->name; row++) {
        char first[OPTION_TEXT_SIZE], second[OPTION_TEXT_SIZE];
        option_text(row, &config, first);
        option_text(row, &again, second);
        HARNESS_REQUIRE(strcmp(first, second) == 0);
    }
    return 0;
}
