/* What the loading of a robot has to say: all of it at once, not one line a start. */
#ifndef SIMROBOT_SETUP_FINDINGS_H
#define SIMROBOT_SETUP_FINDINGS_H

#include <string>
#include <vector>

namespace sim
{

struct Findings {
    std::vector<std::string> faults; /* each of them refuses the robot */
    std::vector<std::string> notes;  /* what was mended, guessed or left out; the robot is taken */
};

} // namespace sim
#endif
