/* What is in the hand, with the one green ball at its end: nothing (the ball sits at the hand), a
 * rigid stick, straight or with a foot like an L's, or a flexible tube. All are a chain of
 * capsules; they differ in the joints. */
#ifndef SIMROBOT_WORLD_TOOL_H
#define SIMROBOT_WORLD_TOOL_H

#include <memory>

#include "simrobot/setup/config.h"
#include "simrobot/setup/description.h"
#include "simrobot/world/world.h"

namespace sim
{

/* A tube is this many capsules; robots.md's calibration is for 7. */
inline constexpr int tube_pieces = 7;

class Tool
{
public:
    /* Makes the bodies straight along the tool's direction, moving with the hand.
     * `hand`: the body that carries it; `frame`: pose of the hand link in the base's frame now.
     * `tool` nullptr: the bare hand. */
    Tool(World &world, dBodyID hand, const Eigen::Isometry3d &frame, const Config &config,
         const ToolConfig *tool);
    ~Tool();
    Tool(const Tool &) = delete;
    Tool &operator=(const Tool &) = delete;

    /* Centre of the ball in the base's frame (m), and its velocity (m/s). */
    Eigen::Vector3d ball() const;
    Eigen::Vector3d ball_velocity() const;

    /* Its capsules, without the ball. */
    std::vector<BodyShape> pieces() const;

    /* Appends what is to be drawn of the tool, without the ball: the same in the base's frame. */
    void append_shapes(std::vector<Shape> *shapes) const;

private:
    struct Piece {
        dBodyID body;
        dJointID joint;
        double length;
        Eigen::Vector3d centre; /* of the capsule, in the body's frame */
    };

    void add_bare_ball(World &world, dBodyID hand, const Eigen::Isometry3d &frame);
    void add_stick(World &world, dBodyID hand, const Eigen::Isometry3d &frame);
    void add_tube(World &world, dBodyID hand, const Eigen::Isometry3d &root);
    void add_piece(World &world, const Eigen::Isometry3d &root, double length, double mass,
                   bool last);
    void fix(World &world, dBodyID carrier);
    void bend(World &world, dBodyID carrier, const Eigen::Isometry3d &root, double stiffness);

    double ball_radius_, ball_mass_;
    ToolConfig tool_;
    std::vector<Piece> pieces_;
    Eigen::Vector3d ball_offset_; /* in the last body's frame */
};

} // namespace sim
#endif
