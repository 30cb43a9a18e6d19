/* The simulated world as a whole: robot, what it holds, encoders, light. Knows steps and seconds
 * since its start, no clock and no bus. The same seed and the same calls give the same bits. */
#ifndef SIMROBOT_WORLD_SIMULATION_H
#define SIMROBOT_WORLD_SIMULATION_H

#include <memory>

#include "simrobot/disturbances/light.h"
#include "simrobot/disturbances/mounts.h"
#include "simrobot/setup/random.h"
#include "simrobot/world/contacts.h"
#include "simrobot/world/robot.h"
#include "simrobot/world/tool.h"

namespace sim
{

/* What the encoders say: true values with reading errors. */
struct Reading {
    std::vector<double> position; /* rad, order of the messages */
    std::vector<double> velocity; /* rad/s */
};

/* Everything that an image pair needs, so that physics may go on while it is drawn. Poses and
 * points in the base's frame. */
struct Snapshot {
    int64_t number; /* of the exposure, counts from 1 */
    std::vector<Shape> shapes;
    Eigen::Vector3d ball;
    double ball_radius;
    Eigen::Isometry3d left_eye, right_eye; /* as the mounts have turned them */
    LightState light;
};

/* Ground truth about this instant. The eyes are where the robot believes them (mounts.h). */
struct Truth {
    std::vector<double> position, velocity; /* rad, rad/s */
    Eigen::Vector3d ball;                   /* m */
    double ball_speed;                      /* m/s */
    Projection projection;
    bool in_view;   /* the centre lies inside both images */
    double visible; /* share of the ball that the right eye sees */
    Fixation fixation;
    int touching;   /* pairs of shapes, links' and tool's, that touch; 0 without collisions */
    double deepest; /* how far they overlap at most, m */
};

/* The control period. */
inline constexpr int period_ms = 20;

class Simulation
{
public:
    Simulation(const Config &config, const Rig &rig, uint64_t seed);

    /* Back to the start pose, at rest; the tool stays in the hand. Time goes on. */
    void reset();

    /* Tool 0 is the bare hand, n the n-th of the configuration.
     *   returns false, changing nothing, when there is no such tool. */
    bool set_tool(int tool);
    int tool() const
    {
        return tool_index_;
    }

    void set_brightness(double brightness)
    {
        brightness_ = brightness;
    }

    /* Velocity references for the motors, rad/s. */
    void command(const std::vector<double> &velocities);

    /* One physics step. */
    void step();
    int64_t steps() const
    {
        return steps_;
    }

    /* Those at which something touched. */
    int64_t touching_steps() const
    {
        return touching_steps_;
    }

    /* Of all steps so far, us; exact. */
    int64_t elapsed() const
    {
        return steps_ * config_.physics_step * int64_t{1000};
    }

    int steps_in_period() const
    {
        return period_ms / config_.physics_step;
    }
    int64_t step_us() const
    {
        return config_.physics_step * int64_t{1000};
    }

    /* Each call reads anew, with new errors: call it once a period. */
    Reading read_encoders();

    /* Where the end-effector is measured to be, in the base's frame, m; likewise. */
    Eigen::Vector3d measure_effector();

    Snapshot snapshot(int64_t number) const;
    Truth truth() const;

    const Rig &rig() const
    {
        return rig_;
    }

private:
    std::vector<Shape> shapes(const std::vector<Eigen::Isometry3d> &poses) const;
    double reading_error();
    void make_tool();

    const Config &config_;
    const Rig &rig_;
    World world_;
    Robot robot_;
    std::unique_ptr<Tool> tool_;
    std::unique_ptr<Contacts> contacts_; /* nullptr: all pass through all */
    int tool_index_ = 0;
    Light light_;
    Mounts mounts_;
    double brightness_ = 1;
    Random encoder_random_, effector_random_;
    int64_t steps_ = 0;
    int64_t touching_steps_ = 0;
};

} // namespace sim
#endif
