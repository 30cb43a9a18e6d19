#include "simrobot/world/world.h"

namespace sim
{
namespace
{

/* ODE is set up once for the process, whatever the number of worlds. */
void start_ode()
{
    static const bool started = (dInitODE2(0), dRandSetSeed(1), true);
    (void)started;
}

} // namespace

World::World(double step) : step_(step)
{
    start_ode();
    id_ = dWorldCreate();
    dWorldSetGravity(id_, 0, 0, -gravity);
    /* Joints are kept together at this share of their error a step; constraints are hard. */
    dWorldSetERP(id_, 0.2);
    dWorldSetCFM(id_, 1e-10);
}

World::~World()
{
    dWorldDestroy(id_);
}

void World::step()
{
    dWorldStep(id_, step_);
}

Eigen::Isometry3d body_pose(dBodyID body)
{
    const dReal *p = dBodyGetPosition(body);
    const dReal *q = dBodyGetQuaternion(body);
    return Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

void body_set_pose(dBodyID body, const Eigen::Isometry3d &pose)
{
    Eigen::Quaterniond q(pose.rotation());
    dQuaternion quaternion = {q.w(), q.x(), q.y(), q.z()};

    dBodySetPosition(body, pose.translation().x(), pose.translation().y(), pose.translation().z());
    dBodySetQuaternion(body, quaternion);
}

void body_set_mass(dBodyID body, double mass, const Eigen::Matrix3d &inertia)
{
    dMass m;
    dMassSetParameters(&m, mass, 0, 0, 0, inertia(0, 0), inertia(1, 1), inertia(2, 2),
                       inertia(0, 1), inertia(0, 2), inertia(1, 2));
    dBodySetMass(body, &m);
}

void body_move_with(dBodyID body, dBodyID carrier)
{
    const dReal *p = dBodyGetPosition(body);
    const dReal *turning = dBodyGetAngularVel(carrier);
    dVector3 velocity;

    dBodyGetPointVel(carrier, p[0], p[1], p[2], velocity);
    dBodySetLinearVel(body, velocity[0], velocity[1], velocity[2]);
    dBodySetAngularVel(body, turning[0], turning[1], turning[2]);
}

} // namespace sim
