/* What the daemon has against this robot, told with what only the simulator knows: the joint's
 * name, and whether its motor is too weak for the weight that it carries. */
#ifndef SIMROBOT_RUN_DAEMON_WATCH_H
#define SIMROBOT_RUN_DAEMON_WATCH_H

#include <reach_robot_state_t.h>
#include <reach_status_t.h>

#include "simrobot/world/rig.h"

namespace sim
{

class DaemonWatch
{
public:
    /* `rig` must outlive this; `ball_mass` in kg. */
    DaemonWatch(const Rig &rig, double ball_mass) : rig_(rig), ball_mass_(ball_mass) {}

    /* `state`: the newest of this robot; `now`: us, of any clock that only goes forward.
     *   returns a line for the log, "" where there is nothing new to say. What goes on is said
     * again every 10 s. */
    std::string look(const reach_status_t &status, const reach_robot_state_t &state, int64_t now);

private:
    std::string refusal(const reach_status_t &status) const;
    std::string fault(const reach_status_t &status, const reach_robot_state_t &state) const;
    const Segment *joint(int number) const; /* from 1; nullptr where there is none */

    const Rig &rig_;
    double ball_mass_;
    int64_t refused_ = 0; /* the newest state that was refused at the last look */
    int8_t fault_ = 0;    /* that of the last look */
    int64_t said_ = 0;
    bool refuses_ = false;
};

} // namespace sim
#endif
