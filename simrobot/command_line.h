/* What the user typed. */
#ifndef SIMROBOT_COMMAND_LINE_H
#define SIMROBOT_COMMAND_LINE_H

#include <cstdint>

#include "common/options/command_line.h"

namespace sim
{

/* Texts are argv's; nullptr where nothing was given. */
struct CommandLine {
    const char *config = nullptr, *url = nullptr, *truth_url = nullptr, *snapshot = nullptr,
               *package_path = nullptr;
    const char *overrides[OPTION_SOURCES_OVERRIDES] = {};
    int n_overrides = 0;
    bool lockstep = true;
    bool check = false, hold = false, send_truth = true, eyes = true, renderer = false,
         view = false, verbose = false;
    int64_t seed = 1;
    int64_t bench_eyes = 0;
    int64_t probe = 0; /* postures */
    int64_t tool = 0;  /* in the hand at the start */
};

/* Reads the arguments.
 *   returns -1 to go on, or the status to exit with, all having been said. */
int command_line_parse(int argc, char **argv, CommandLine *given);

} // namespace sim
#endif
