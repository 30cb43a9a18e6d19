#include "simrobot/world/probe.h"

#include <algorithm>
#include <cmath>

#include "simrobot/setup/random.h"
#include "simrobot/world/robot.h"
#include "simrobot/world/strength.h"

namespace sim
{
namespace
{

const uint64_t posture_stream = 0x70726f6265;

void put_list(const char *name, const double *values, size_t n, const char *end, FILE *out)
{
    fprintf(out, "\"%s\": [", name);
    for (size_t i = 0; i < n; i++)
        fprintf(out, "%s%.17g", i ? ", " : "", values[i]);
    fprintf(out, "]%s", end);
}

const double command_seconds = 0.5; /* of random speeds, until the next ones */

const Segment &joint_of(const Rig &rig, size_t i)
{
    return rig.description.segments[static_cast<size_t>(rig.joints[i])];
}

struct Energy {
    double kinetic = 0, potential = 0; /* J */
};

Energy energy_of(const Robot &robot, const Rig &rig)
{
    const std::vector<Segment> &segments = rig.description.segments;
    Energy energy;

    for (size_t i = 1; i < segments.size(); i++) {
        dBodyID body = robot.body(static_cast<int>(i));
        Eigen::Isometry3d pose = body_pose(body);
        const dReal *v = dBodyGetLinearVel(body), *w = dBodyGetAngularVel(body);
        Eigen::Vector3d turn = pose.linear().transpose() * Eigen::Vector3d(w[0], w[1], w[2]);
        energy.kinetic += 0.5 * segments[i].mass * Eigen::Vector3d(v[0], v[1], v[2]).squaredNorm();
        energy.kinetic += 0.5 * turn.dot(segments[i].inertia * turn);
        energy.potential += segments[i].mass * gravity * pose.translation().z();
    }
    return energy;
}

} // namespace

void probe_postures(const Config &config, const Rig &rig, uint64_t seed, int64_t count, FILE *out)
{
    Random random(seed, posture_stream);

    for (int64_t i = 0; i < count; i++) {
        std::vector<double> angles = rig_any_posture(rig, &random);
        Eigen::Vector3d place = rig_link(rig.hand, rig_forward(rig, angles)).translation();
        std::vector<double> torques = gravity_torques(rig, config.ball_mass, angles);
        fputc('{', out);
        put_list("position", angles.data(), angles.size(), ", ", out);
        put_list("place", place.data(), 3, ", ", out);
        put_list("gravity", torques.data(), torques.size(), "}\n", out);
    }
}

void probe_swing(const Config &config, const Rig &rig, uint64_t seed, double seconds, FILE *out)
{
    Random random(seed, posture_stream);
    Config free = config;
    Rig loose = rig;
    World world(config.physics_step * 1e-3);

    free.hard_stops = false;
    for (int joint : loose.joints)
        loose.description.segments[static_cast<size_t>(joint)].effort = 0;
    Robot robot(world, loose, free);
    robot.reset(rig_any_posture(loose, &random));
    double start = energy_of(robot, loose).potential, most = 0, drift = 0;
    for (double time = 0; time < seconds; time += world.step_length()) {
        robot.drive_motors();
        world.step();
        Energy energy = energy_of(robot, loose);
        most = std::fmax(most, energy.kinetic);
        drift = std::fmax(drift, std::fabs(energy.kinetic + energy.potential - start));
    }
    fprintf(out, "{\"seconds\": %g, \"kinetic\": %.6g, \"drift\": %.6g}\n", seconds, most, drift);
}

void probe_speeds(const Config &config, const Rig &rig, uint64_t seed, double seconds, FILE *out)
{
    Random random(seed, posture_stream);
    World world(config.physics_step * 1e-3);
    Robot robot(world, rig, config);
    std::vector<double> commands(rig.joints.size());
    int64_t steps = std::llround(seconds / world.step_length());
    int64_t steps_of_command = std::llround(command_seconds / world.step_length());
    double fastest = 0;
    size_t joint = 0;

    robot.reset(rig_any_posture(rig, &random));
    for (int64_t step = 0; step < steps; step++) {
        for (size_t i = 0; i < commands.size() && step % steps_of_command == 0; i++)
            commands[i] = joint_of(rig, i).velocity * random.uniform(-1, 1);
        robot.command(commands);
        robot.drive_motors();
        world.step();
        std::vector<double> speeds = robot.velocities();
        for (size_t i = 0; i < speeds.size(); i++) {
            double share = std::fabs(speeds[i]) / joint_of(rig, i).velocity;
            if (share <= fastest)
                continue;
            fastest = share;
            joint = i;
        }
    }
    std::string name = joint_of(rig, joint).name;
    name.erase(std::remove_if(name.begin(), name.end(),
                              [](char c) { return c == '"' || c == '\\' || c < ' '; }),
               name.end());
    fprintf(out, "{\"seconds\": %g, \"fastest\": %.6g, \"joint\": \"%s\"}\n", seconds, fastest,
            name.c_str());
}

} // namespace sim
