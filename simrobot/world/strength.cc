#include "simrobot/world/strength.h"

#include <cmath>

#include "simrobot/setup/random.h"
#include "simrobot/world/world.h"

namespace sim
{
namespace
{

const int postures = 2000;

struct Load {
    double mass = 0;                                  /* kg */
    Eigen::Vector3d moment = Eigen::Vector3d::Zero(); /* mass times place, kg m */

    void add(double more, const Eigen::Vector3d &at)
    {
        mass += more;
        moment += more * at;
    }
};

} // namespace

std::vector<double> gravity_torques(const Rig &rig, double ball_mass,
                                    const std::vector<double> &angles)
{
    const std::vector<Segment> &segments = rig.description.segments;
    std::vector<Eigen::Isometry3d> poses = rig_forward(rig, angles);
    std::vector<Load> carried(segments.size());
    std::vector<double> torques;
    const Eigen::Vector3d down(0, 0, -gravity);

    carried[static_cast<size_t>(rig.hand.segment)].add(ball_mass,
                                                       rig_link(rig.hand, poses).translation());
    for (size_t i = segments.size() - 1; i > 0; i--) { /* children come after their parents */
        carried[i].add(segments[i].mass, poses[i] * segments[i].centre_of_mass);
        Load &parent = carried[static_cast<size_t>(segments[i].parent)];
        parent.mass += carried[i].mass;
        parent.moment += carried[i].moment;
    }
    for (int joint : rig.joints) {
        auto i = static_cast<size_t>(joint);
        Eigen::Vector3d axis = poses[i].linear() * segments[i].axis;
        Eigen::Vector3d lever = carried[i].moment - carried[i].mass * poses[i].translation();
        torques.push_back(segments[i].slides ? carried[i].mass * down.dot(axis)
                                             : lever.cross(down).dot(axis));
    }
    return torques;
}

std::vector<std::string> strength_notes(const Rig &rig, double ball_mass)
{
    std::vector<double> most(rig.joints.size(), 0.0);
    std::vector<int> too_much(rig.joints.size(), 0);
    std::vector<std::string> notes;
    Random random(1, 0);

    for (int n = 0; n < postures; n++) {
        std::vector<double> torques =
            gravity_torques(rig, ball_mass, rig_any_posture(rig, &random));
        for (size_t i = 0; i < torques.size(); i++) {
            double effort = rig.description.segments[static_cast<size_t>(rig.joints[i])].effort;
            most[i] = std::max(most[i], std::fabs(torques[i]));
            too_much[i] += std::fabs(torques[i]) > effort;
        }
    }
    for (size_t i = 0; i < most.size(); i++) {
        const Segment &segment = rig.description.segments[static_cast<size_t>(rig.joints[i])];
        char text[160];
        snprintf(
            text, sizeof text,
            " is too weak for the robot's weight: in %.1f %% of its range that takes more than "
            "the motor's %.4g %s, up to %.4g",
            100.0 * too_much[i] / postures, segment.effort, segment.slides ? "N" : "N m", most[i]);
        if (too_much[i])
            notes.push_back(rig.description.path + ": joint " + segment.name + text);
    }
    return notes;
}

} // namespace sim
