/* What the user typed. */
#ifndef SIMROBOT_COMMAND_LINE_H
#define SIMROBOT_COMMAND_LINE_H

#include <cstdint>
#include <string>
#include <vector>

namespace sim
{

enum class Task { run, help, help_options, renderer, version };

struct CommandLine {
    Task task = Task::run;
    std::string config, url, truth_url, snapshot;
    std::vector<const char *> overrides;
    bool lockstep = true;
    bool hold = false, send_truth = true, eyes = true, verbose = false;
    int64_t seed = 1;
    int64_t bench_eyes = 0;
    int64_t tool = 0; /* in the hand at the start */
};

/* Reads the arguments.
 *   returns false when they are wrong, having said why on stderr. */
bool command_line_parse(int argc, char **argv, CommandLine *line);

const char *command_line_help();

} // namespace sim
#endif
