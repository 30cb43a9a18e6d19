#include "simrobot/setup/description.h"

#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace sim
{
namespace
{

Eigen::Vector3d vector_of(const urdf::Vector3 &v)
{
    return {v.x, v.y, v.z};
}

Eigen::Isometry3d pose_of(const urdf::Pose &pose)
{
    Eigen::Quaterniond rotation(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
    return Eigen::Translation3d(vector_of(pose.position)) * rotation.normalized();
}

/* Turns URDF's tree into segments, depth first, children in the order of their names, so that the
 * order does not depend on the parser. */
class Builder
{
public:
    Builder(const std::string &path, Description *description, std::string *error)
        : path_(path), description_(description), error_(error)
    {
    }

    bool add_base(const urdf::Link &root)
    {
        Segment base = {};
        base.parent = -1;
        base.origin.setIdentity();
        base.axis = Eigen::Vector3d::UnitZ();
        base.centre_of_mass.setZero();
        base.inertia.setZero();
        description_->segments.push_back(base);
        return add_link(root, 0, Eigen::Isometry3d::Identity());
    }

private:
    bool fail(const std::string &what)
    {
        *error_ = path_ + ": " + what;
        return false;
    }

    bool add_link(const urdf::Link &link, int segment, const Eigen::Isometry3d &pose)
    {
        description_->links[link.name] = LinkFrame{segment, pose};
        if (link.inertial)
            add_mass(*link.inertial, segment, pose);
        for (const auto &visual : link.visual_array)
            if (!add_visual(link, *visual, segment, pose))
                return false;
        for (const auto &collision : link.collision_array)
            add_collision(link, *collision, segment, pose);
        std::map<std::string, urdf::LinkConstSharedPtr> children;
        for (const auto &child : link.child_links)
            children[child->name] = child;
        for (const auto &[name, child] : children)
            if (!add_joint(*child, segment, pose))
                return false;
        return true;
    }

    bool add_joint(const urdf::Link &child, int parent, const Eigen::Isometry3d &pose)
    {
        const urdf::Joint &joint = *child.parent_joint;
        Eigen::Isometry3d origin = pose * pose_of(joint.parent_to_joint_origin_transform);

        if (joint.type == urdf::Joint::FIXED)
            return add_link(child, parent, origin);
        if (joint.type != urdf::Joint::REVOLUTE && joint.type != urdf::Joint::CONTINUOUS)
            return fail("joint " + joint.name +
                        ": only revolute, continuous and fixed are simulated");
        if (!joint.limits)
            return fail("joint " + joint.name + ": <limit effort=... velocity=...> is missing");
        if (joint.limits->effort <= 0 || joint.limits->velocity <= 0)
            return fail("joint " + joint.name + ": effort and velocity limits must be positive");
        description_->segments.push_back(segment_of(joint, parent, origin));
        int index = static_cast<int>(description_->segments.size()) - 1;
        if (!add_link(child, index, Eigen::Isometry3d::Identity()))
            return false;
        if (description_->segments[static_cast<size_t>(index)].mass <= 0)
            return fail("link " + child.name + ": a link that moves needs <inertial> with a mass");
        return true;
    }

    static Segment segment_of(const urdf::Joint &joint, int parent, const Eigen::Isometry3d &origin)
    {
        bool revolute = joint.type == urdf::Joint::REVOLUTE;
        double infinity = std::numeric_limits<double>::infinity();
        Segment segment = {};

        segment.name = joint.name;
        segment.parent = parent;
        segment.origin = origin;
        segment.axis = vector_of(joint.axis).normalized();
        segment.lower = revolute ? joint.limits->lower : -infinity;
        segment.upper = revolute ? joint.limits->upper : infinity;
        segment.effort = joint.limits->effort;
        segment.velocity = joint.limits->velocity;
        segment.centre_of_mass.setZero();
        segment.inertia.setZero();
        return segment;
    }

    /* Adds a link's mass to its segment's (Steiner's theorem). */
    void add_mass(const urdf::Inertial &inertial, int index, const Eigen::Isometry3d &pose)
    {
        Segment &segment = description_->segments[static_cast<size_t>(index)];
        Eigen::Isometry3d frame = pose * pose_of(inertial.origin);
        Eigen::Matrix3d own;
        own << inertial.ixx, inertial.ixy, inertial.ixz, inertial.ixy, inertial.iyy, inertial.iyz,
            inertial.ixz, inertial.iyz, inertial.izz;
        own = frame.linear() * own * frame.linear().transpose();

        double total = segment.mass + inertial.mass;
        if (total <= 0)
            return;
        Eigen::Vector3d centre =
            (segment.mass * segment.centre_of_mass + inertial.mass * frame.translation()) / total;
        segment.inertia = segment.inertia + shift(segment.mass, segment.centre_of_mass - centre) +
                          own + shift(inertial.mass, frame.translation() - centre);
        segment.centre_of_mass = centre;
        segment.mass = total;
    }

    static Eigen::Matrix3d shift(double mass, const Eigen::Vector3d &r)
    {
        return mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    }

    bool add_visual(const urdf::Link &link, const urdf::Visual &visual, int index,
                    const Eigen::Isometry3d &pose)
    {
        Shape shape = {};
        if (!visual.geometry || !set_geometry(*visual.geometry, &shape))
            return fail("link " + link.name + ": only box, cylinder and sphere visuals are drawn");
        shape.pose = pose * pose_of(visual.origin);
        shape.colour = visual.material
                           ? Eigen::Vector3f(visual.material->color.r, visual.material->color.g,
                                             visual.material->color.b)
                           : Eigen::Vector3f(0.7f, 0.7f, 0.7f);
        description_->segments[static_cast<size_t>(index)].shapes.push_back(shape);
        return true;
    }

    /* What cannot be simulated matters only to who asks for collisions (rig_load). */
    void add_collision(const urdf::Link &link, const urdf::Collision &collision, int index,
                       const Eigen::Isometry3d &pose)
    {
        Shape shape = {};
        if (!collision.geometry || !set_geometry(*collision.geometry, &shape)) {
            description_->mesh_link = link.name;
            return;
        }
        shape.pose = pose * pose_of(collision.origin);
        description_->segments[static_cast<size_t>(index)].collisions.push_back(shape);
    }

    static bool set_geometry(const urdf::Geometry &geometry, Shape *shape)
    {
        if (geometry.type == urdf::Geometry::BOX) {
            shape->kind = ShapeKind::box;
            shape->size = vector_of(static_cast<const urdf::Box &>(geometry).dim);
        } else if (geometry.type == urdf::Geometry::SPHERE) {
            shape->kind = ShapeKind::sphere;
            shape->size = {static_cast<const urdf::Sphere &>(geometry).radius, 0, 0};
        } else if (geometry.type == urdf::Geometry::CYLINDER) {
            const auto &cylinder = static_cast<const urdf::Cylinder &>(geometry);
            shape->kind = ShapeKind::cylinder;
            shape->size = {cylinder.radius, cylinder.length, 0};
        } else {
            return false;
        }
        return true;
    }

    std::string path_;
    Description *description_;
    std::string *error_;
};

bool read_file(const std::string &path, std::string *text)
{
    std::ifstream file(path);
    std::stringstream buffer;
    if (!file || !(buffer << file.rdbuf()))
        return false;
    *text = buffer.str();
    return true;
}

} // namespace

bool description_load(const std::string &path, Description *description, std::string *error)
{
    std::string text;

    *description = Description{};
    description->path = path;
    if (!read_file(path, &text)) {
        *error = path + ": cannot be read";
        return false;
    }
    urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
    if (!model || !model->getRoot()) {
        *error = path + ": not a URDF robot (see the lines above)";
        return false;
    }
    return Builder(path, description, error).add_base(*model->getRoot());
}

int description_joint(const Description &description, const std::string &name, std::string *error)
{
    for (size_t i = 1; i < description.segments.size(); i++)
        if (description.segments[i].name == name)
            return static_cast<int>(i);
    *error = description.path + ": joint " + name +
             " is missing or does not turn, but the configuration names it";
    return -1;
}

const LinkFrame *description_link(const Description &description, const std::string &name,
                                  std::string *error)
{
    auto found = description.links.find(name);
    if (found != description.links.end())
        return &found->second;
    *error = description.path + ": link " + name + " is missing, but the configuration names it";
    return nullptr;
}

} // namespace sim
