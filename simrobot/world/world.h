/* ODE's world: gravity, the fixed step, and the translations between ODE's and Eigen's poses. */
#ifndef SIMROBOT_WORLD_WORLD_H
#define SIMROBOT_WORLD_WORLD_H

#include <ode/ode.h>

#include <Eigen/Geometry>

#include "simrobot/setup/description.h"

namespace sim
{

/* The physics step where the configuration names no other; camera exposures lie on this grid. */
inline constexpr double physics_step = 0.001; /* s */

inline constexpr double gravity = 9.81; /* m/s2, along -z of the base */

class World
{
public:
    explicit World(double step = physics_step);
    ~World();
    World(const World &) = delete;
    World &operator=(const World &) = delete;

    dWorldID id() const
    {
        return id_;
    }

    /* Advances by step_length() seconds. */
    void step();
    double step_length() const
    {
        return step_;
    }

private:
    dWorldID id_;
    double step_;
};

/* A shape in the frame of the body that carries it; nullptr: in the base's frame. */
struct BodyShape {
    dBodyID body;
    Shape shape;
};

/* Pose of a body's frame, whose origin is its centre of mass. */
Eigen::Isometry3d body_pose(dBodyID body);
void body_set_pose(dBodyID body, const Eigen::Isometry3d &pose);

/* A body's frame is at its centre of mass; `inertia` about it, in the body's axes. */
void body_set_mass(dBodyID body, double mass, const Eigen::Matrix3d &inertia);

/* Gives `body` the motion of a point that is rigidly joined to `carrier`. */
void body_move_with(dBodyID body, dBodyID carrier);

} // namespace sim
#endif
