#include "simrobot/world/tool.h"

#include <algorithm>

namespace sim
{
namespace
{

/* The hand's frame turned so that z points along `direction`: the least turn, half way about x for
 * what points back. By hand, since Eigen's way holds an SVD. */
Eigen::Isometry3d root_frame(const Eigen::Isometry3d &hand, const struct option_list &direction)
{
    Eigen::Vector3d z = Eigen::Vector3d(direction.value).normalized();
    Eigen::Quaterniond turn(1 + z.z(), -z.y(), z.x(), 0);

    return hand * (turn.norm() > 1e-9 ? turn.normalized() : Eigen::Quaterniond(0, 1, 0, 0));
}

} // namespace

Tool::Tool(World &world, dBodyID hand, const Eigen::Isometry3d &frame, const Config &config,
           const ToolConfig *tool)
    : ball_radius_(config.ball_radius), ball_mass_(config.ball_mass),
      tool_(tool ? *tool : ToolConfig{}), ball_offset_(Eigen::Vector3d::Zero())
{
    if (!tool)
        add_bare_ball(world, hand, frame);
    else if (tool->kind == static_cast<int>(ToolKind::stick))
        add_stick(world, hand, frame);
    else
        add_tube(world, hand, root_frame(frame, tool->direction));
    for (const Piece &piece : pieces_)
        body_move_with(piece.body, hand);
}

Tool::~Tool()
{
    for (const Piece &piece : pieces_) {
        dJointDestroy(piece.joint);
        dBodyDestroy(piece.body);
    }
}

void Tool::add_bare_ball(World &world, dBodyID hand, const Eigen::Isometry3d &frame)
{
    Piece piece = {dBodyCreate(world.id()), nullptr, 0, Eigen::Vector3d::Zero()};
    dMass mass;

    dMassSetSphereTotal(&mass, ball_mass_, ball_radius_);
    dBodySetMass(piece.body, &mass);
    body_set_pose(piece.body, frame);
    pieces_.push_back(piece);
    fix(world, hand);
}

/* One piece, or two where it has a foot, of a mass in proportion to their lengths. */
void Tool::add_stick(World &world, dBodyID hand, const Eigen::Isometry3d &frame)
{
    Eigen::Isometry3d root = root_frame(frame, tool_.direction);
    double share = tool_.length / (tool_.length + tool_.foot);

    add_piece(world, root, tool_.length, tool_.mass * share, tool_.foot <= 0);
    fix(world, hand);
    if (tool_.foot <= 0)
        return;
    dBodyID carrier = pieces_.back().body;
    Eigen::Isometry3d foot = root_frame(frame, tool_.foot_direction);
    foot.translation() = root * Eigen::Vector3d(0, 0, tool_.length);
    add_piece(world, foot, tool_.foot, tool_.mass * (1 - share), true);
    fix(world, carrier);
}

/* Lumped bending: each joint stands for one piece's length of tube, E I / l; the first for half a
 * piece, hence twice as stiff. */
void Tool::add_tube(World &world, dBodyID hand, const Eigen::Isometry3d &root)
{
    double length = tool_.length / tube_pieces;
    double stiffness = tool_.rigidity / length;
    dBodyID carrier = hand;

    for (int i = 0; i < tube_pieces; i++) {
        Eigen::Isometry3d start = root * Eigen::Translation3d(0, 0, i * length);
        add_piece(world, start, length, tool_.mass / tube_pieces, i == tube_pieces - 1);
        bend(world, carrier, start, i == 0 ? 2 * stiffness : stiffness);
        carrier = pieces_.back().body;
    }
}

/* One capsule from `root` along z, with the ball's mass at its far end if it is the last. ODE
 * wants the body's frame at the centre of mass. */
void Tool::add_piece(World &world, const Eigen::Isometry3d &root, double length, double mass,
                     bool last)
{
    Piece piece = {dBodyCreate(world.id()), nullptr, length, Eigen::Vector3d::Zero()};
    double straight = std::max(length - 2 * tool_.radius, 0.1 * length);
    dMass total, ball;

    dMassSetCapsuleTotal(&total, mass, 3, tool_.radius, straight);
    if (last) {
        dMassSetSphereTotal(&ball, ball_mass_, ball_radius_);
        dMassTranslate(&ball, 0, 0, length / 2);
        dMassAdd(&total, &ball);
    }
    double shift = total.c[2];
    dMassTranslate(&total, -total.c[0], -total.c[1], -total.c[2]);
    dBodySetMass(piece.body, &total);
    body_set_pose(piece.body, root * Eigen::Translation3d(0, 0, length / 2 + shift));
    piece.centre.z() = -shift;
    ball_offset_ = Eigen::Vector3d(0, 0, length / 2 - shift);
    pieces_.push_back(piece);
}

void Tool::fix(World &world, dBodyID carrier)
{
    Piece &piece = pieces_.back();
    piece.joint = dJointCreateFixed(world.id(), nullptr);
    dJointAttach(piece.joint, piece.body, carrier);
    dJointSetFixed(piece.joint);
}

/* Stops at 0 .. 0 with this softness are an implicit spring-damper (ODE manual, "how to use ERP and
 * CFM"): ERP = h k / (h k + c), CFM = 1 / (h k + c). */
void Tool::bend(World &world, dBodyID carrier, const Eigen::Isometry3d &root, double stiffness)
{
    const double h = world.step_length();
    const double c = tool_.damping * stiffness;
    const double erp = h * stiffness / (h * stiffness + c);
    const double cfm = 1 / (h * stiffness + c);
    Piece &piece = pieces_.back();
    Eigen::Vector3d x = root.linear().col(0), y = root.linear().col(1), at = root.translation();

    piece.joint = dJointCreateUniversal(world.id(), nullptr);
    dJointAttach(piece.joint, piece.body, carrier);
    dJointSetUniversalAnchor(piece.joint, at.x(), at.y(), at.z());
    dJointSetUniversalAxis2(piece.joint, y.x(), y.y(), y.z());
    dJointSetUniversalAxis1(piece.joint, x.x(), x.y(), x.z());
    for (int group : {dParamGroup1, dParamGroup2}) {
        dJointSetUniversalParam(piece.joint, group | dParamLoStop, 0);
        dJointSetUniversalParam(piece.joint, group | dParamHiStop, 0);
        dJointSetUniversalParam(piece.joint, group | dParamStopERP, erp);
        dJointSetUniversalParam(piece.joint, group | dParamStopCFM, cfm);
    }
}

Eigen::Vector3d Tool::ball() const
{
    return body_pose(pieces_.back().body) * ball_offset_;
}

Eigen::Vector3d Tool::ball_velocity() const
{
    dVector3 velocity;
    dBodyGetRelPointVel(pieces_.back().body, ball_offset_.x(), ball_offset_.y(), ball_offset_.z(),
                        velocity);
    return {velocity[0], velocity[1], velocity[2]};
}

std::vector<BodyShape> Tool::pieces() const
{
    const double *colour = tool_.colour.value;
    std::vector<BodyShape> result;

    for (const Piece &piece : pieces_) {
        if (piece.length <= 0)
            continue;
        Shape shape = {};
        shape.kind = ShapeKind::capsule;
        shape.size = {tool_.radius, piece.length, 0};
        shape.pose = Eigen::Translation3d(piece.centre);
        shape.colour = Eigen::Vector3d(colour[0], colour[1], colour[2]).cast<float>();
        result.push_back({piece.body, shape});
    }
    return result;
}

void Tool::append_shapes(std::vector<Shape> *shapes) const
{
    for (BodyShape piece : pieces()) {
        piece.shape.pose = body_pose(piece.body) * piece.shape.pose;
        shapes->push_back(piece.shape);
    }
}

} // namespace sim
