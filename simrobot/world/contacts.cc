#include "simrobot/world/contacts.h"

#include <algorithm>

namespace sim
{
namespace
{

const int most_points = 4; /* of a pair */

/* The iCub simulator's (Tikhanoff et al. 2008): a share of the overlap is taken back at each step,
 * by a joint that gives way a little. No friction: what touches slides along. */
const double contact_erp = 0.2, contact_cfm = 1e-5;

/* A tool that is put into the hand may reach through the body: it is pushed out at this speed, not
 * thrown. m/s */
const double most_push = 0.2;

/* A cylinder that is longer than thick becomes the capsule within it: it has no edges, and ODE
 * knows exactly how a capsule touches what else there is. */
dGeomID create(const Shape &shape)
{
    double radius = shape.size[0], length = shape.size[1];

    switch (shape.kind) {
    case ShapeKind::box:
        return dCreateBox(nullptr, shape.size[0], shape.size[1], shape.size[2]);
    case ShapeKind::sphere:
        return dCreateSphere(nullptr, radius);
    case ShapeKind::capsule:
        return dCreateCapsule(nullptr, radius, length);
    case ShapeKind::mesh: /* is in no <collision> that got here */
    case ShapeKind::cylinder:
        break;
    }
    return length > 2 * radius ? dCreateCapsule(nullptr, radius, length - 2 * radius)
                               : dCreateCylinder(nullptr, radius, length);
}

void place(dGeomID geom, const BodyShape &shape)
{
    Eigen::Vector3d at = shape.shape.pose.translation();
    Eigen::Quaterniond q(shape.shape.pose.rotation());
    dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};

    if (!shape.body) {
        dGeomSetPosition(geom, at.x(), at.y(), at.z());
        dGeomSetQuaternion(geom, turn);
        return;
    }
    dGeomSetBody(geom, shape.body);
    dGeomSetOffsetPosition(geom, at.x(), at.y(), at.z());
    dGeomSetOffsetQuaternion(geom, turn);
}

} // namespace

Contacts::Contacts(World &world, const Rig &rig, const Robot &robot)
    : world_(world), rig_(rig), joints_(dJointGroupCreate(0))
{
    dWorldSetContactMaxCorrectingVel(world.id(), most_push);
    for (size_t i = 0; i < rig.description.segments.size(); i++)
        for (const BodyShape &shape : robot.collisions(static_cast<int>(i)))
            add(shape, static_cast<int>(i), &links_);
    for (size_t i = 0; i < links_.size(); i++)
        for (size_t j = i + 1; j < links_.size(); j++) {
            dContactGeom point;
            if (!related(links_[i].segment, links_[j].segment) &&
                !dCollide(links_[i].geom, links_[j].geom, 1, &point, sizeof point))
                of_links_.emplace_back(links_[i].geom, links_[j].geom);
        }
}

Contacts::~Contacts()
{
    for (const std::vector<Body> &bodies : {links_, tool_})
        for (const Body &body : bodies)
            dGeomDestroy(body.geom);
    dJointGroupDestroy(joints_);
}

/* Whether two segments are one, or joined by a joint. */
bool Contacts::related(int one, int other) const
{
    const std::vector<Segment> &segments = rig_.description.segments;

    return one == other || segments[static_cast<size_t>(one)].parent == other ||
           segments[static_cast<size_t>(other)].parent == one;
}

void Contacts::add(const BodyShape &shape, int segment, std::vector<Body> *bodies)
{
    bodies->push_back({create(shape.shape), segment});
    place(bodies->back().geom, shape);
}

void Contacts::take_tool(const Tool &tool)
{
    int hand = rig_.hand.segment;

    for (const Body &body : tool_)
        dGeomDestroy(body.geom);
    tool_.clear();
    with_tool_.clear();
    for (const BodyShape &shape : tool.pieces())
        add(shape, hand, &tool_);
    for (const Body &link : links_)
        for (const Body &piece : tool_)
            if (link.segment != hand)
                with_tool_.emplace_back(link.geom, piece.geom);
}

void Contacts::press(dGeomID one, dGeomID other)
{
    dContact points[most_points] = {};
    int n = dCollide(one, other, most_points, &points[0].geom, sizeof points[0]);

    touching_ += n > 0;
    for (int i = 0; i < n; i++) {
        points[i].surface.mode = dContactSoftERP | dContactSoftCFM;
        points[i].surface.soft_erp = contact_erp;
        points[i].surface.soft_cfm = contact_cfm;
        depth_ = std::max(depth_, points[i].geom.depth);
        dJointID joint = dJointCreateContact(world_.id(), joints_, &points[i]);
        dJointAttach(joint, dGeomGetBody(points[i].geom.g1), dGeomGetBody(points[i].geom.g2));
    }
}

void Contacts::find()
{
    dJointGroupEmpty(joints_);
    touching_ = 0;
    depth_ = 0;
    for (const auto *pairs : {&of_links_, &with_tool_})
        for (const auto &[one, other] : *pairs)
            press(one, other);
}

} // namespace sim
