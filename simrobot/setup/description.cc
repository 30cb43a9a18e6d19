#include "simrobot/setup/description.h"

#include <cmath>

#include "simrobot/setup/drives.h"
#include "simrobot/setup/inertia.h"

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

Inertia inertia_of(const urdf::Inertial &inertial)
{
    Inertia result;

    result.mass = inertial.mass;
    result.about_centre << inertial.ixx, inertial.ixy, inertial.ixz, inertial.ixy, inertial.iyy,
        inertial.iyz, inertial.ixz, inertial.iyz, inertial.izz;
    return result;
}

/* Turns URDF's tree into segments, depth first, children in the order of their names, so that the
 * order does not depend on the parser. */
class Builder
{
public:
    Builder(const urdf::ModelInterface &model, const std::set<std::string> &driven,
            bool repair_inertia, UrdfSource *source, Description *description)
        : drives_(model, driven, source), repair_inertia_(repair_inertia), source_(source),
          description_(description)
    {
    }

    void build(const urdf::Link &root)
    {
        Segment base = {};
        base.parent = base.leader = -1;
        base.origin.setIdentity();
        base.axis = Eigen::Vector3d::UnitZ();
        base.centre_of_mass.setZero();
        base.inertia.setZero();
        add_segment(base, "");
        add_link(root, 0, Eigen::Isometry3d::Identity());
        find_leaders();
    }

private:
    Segment &segment(int index)
    {
        return description_->segments[static_cast<size_t>(index)];
    }

    int add_segment(const Segment &segment, const std::string &leader)
    {
        description_->segments.push_back(segment);
        leaders_.push_back(leader);
        return static_cast<int>(leaders_.size()) - 1;
    }

    /* Leaders may come after those that follow them. */
    void find_leaders()
    {
        for (size_t i = 1; i < leaders_.size(); i++)
            for (size_t k = 1; k < leaders_.size(); k++)
                if (i != k && description_->segments[k].name == leaders_[i])
                    description_->segments[i].leader = static_cast<int>(k);
    }

    void add_link(const urdf::Link &link, int index, const Eigen::Isometry3d &pose)
    {
        description_->links[link.name] = LinkFrame{index, pose};
        if (link.inertial)
            add_mass(link, index, pose);
        for (const auto &visual : link.visual_array)
            add_visual(link, *visual, index, pose);
        for (const auto &collision : link.collision_array)
            add_collision(link, *collision, index, pose);
        std::map<std::string, urdf::LinkConstSharedPtr> children;
        for (const auto &child : link.child_links)
            children[child->name] = child;
        for (const auto &[name, child] : children)
            add_joint(*child, index, pose);
    }

    void add_joint(const urdf::Link &child, int parent, const Eigen::Isometry3d &pose)
    {
        const urdf::Joint &joint = *child.parent_joint;
        Eigen::Isometry3d origin = pose * pose_of(joint.parent_to_joint_origin_transform);
        Drive drive = drives_.of(joint);

        if (drive.leader.empty()) {
            if (drive.offset != 0)
                origin = origin * Drives::moved(joint, drive.offset);
            return add_link(child, parent, origin);
        }
        int index = add_segment(drives_.segment(joint, drive, parent, origin), drive.leader);
        add_link(child, index, Eigen::Isometry3d::Identity());
        check_mass(child, index);
    }

    Inertia inertia(int index)
    {
        return {segment(index).mass, segment(index).centre_of_mass, segment(index).inertia};
    }

    void set_inertia(int index, const Inertia &inertia)
    {
        segment(index).mass = inertia.mass;
        segment(index).centre_of_mass = inertia.centre;
        segment(index).inertia = inertia.about_centre;
    }

    /* What stands still may weigh what it likes. */
    void add_mass(const urdf::Link &link, int index, const Eigen::Isometry3d &pose)
    {
        Inertia own = inertia_of(*link.inertial);
        std::string wrong = inertia_impossible(own);

        if (index == 0)
            return;
        if (!wrong.empty() && complain_of_mass(link, wrong))
            own = inertia_of_ball(own.mass, {0, 0, 0});
        set_inertia(index, inertia_sum(inertia(index),
                                       inertia_moved(own, pose * pose_of(link.inertial->origin))));
    }

    void check_mass(const urdf::Link &link, int index)
    {
        std::string wrong = inertia_immovable(inertia(index));

        if (!wrong.empty() && complain_of_mass(link, wrong))
            set_inertia(index, inertia_of_ball(segment(index).mass, segment(index).centre_of_mass));
    }

    /* Returns whether it is to be repaired. */
    bool complain_of_mass(const urdf::Link &link, const std::string &wrong)
    {
        if (repair_inertia_)
            source_->note("link", link.name, wrong + "; it takes that of a ball");
        else
            source_->fault("link", link.name,
                           wrong + "; robot.repair_inertia: true gives it that of a ball");
        return repair_inertia_;
    }

    /* What URDF gives a shape: false for none that can be drawn or bumped into. */
    bool set_shape(const urdf::Link &link, const char *kind,
                   const urdf::GeometrySharedPtr &geometry, Shape *shape)
    {
        if (!geometry || !set_geometry(*geometry, shape))
            return false;
        size_t n = shape->kind == ShapeKind::box ? 3 : shape->kind == ShapeKind::sphere ? 1 : 2;
        for (size_t i = 0; i < n; i++)
            if (!(shape->size[static_cast<int>(i)] > 0)) {
                source_->note("link", link.name,
                              std::string("a <") + kind + "> without size is left out");
                return false;
            }
        return true;
    }

    void add_visual(const urdf::Link &link, const urdf::Visual &visual, int index,
                    const Eigen::Isometry3d &pose)
    {
        Shape shape = {};

        shape.pose = pose * pose_of(visual.origin);
        shape.colour = visual.material
                           ? Eigen::Vector3f(visual.material->color.r, visual.material->color.g,
                                             visual.material->color.b)
                           : Eigen::Vector3f(0.7f, 0.7f, 0.7f);
        if (visual.geometry && visual.geometry->type == urdf::Geometry::MESH) {
            const auto &mesh = static_cast<const urdf::Mesh &>(*visual.geometry);
            description_->meshes.push_back({index, link.name, mesh.filename, vector_of(mesh.scale),
                                            shape.pose, visual.material != nullptr, shape.colour});
        } else if (set_shape(link, "visual", visual.geometry, &shape)) {
            segment(index).shapes.push_back(shape);
        }
    }

    void add_collision(const urdf::Link &link, const urdf::Collision &collision, int index,
                       const Eigen::Isometry3d &pose)
    {
        Shape shape = {};

        shape.pose = pose * pose_of(collision.origin);
        if (collision.geometry && collision.geometry->type == urdf::Geometry::MESH) {
            const auto &mesh = static_cast<const urdf::Mesh &>(*collision.geometry);
            description_->mesh_collisions.push_back({index, link.name, mesh.filename,
                                                     vector_of(mesh.scale), shape.pose, false,
                                                     Eigen::Vector3f::Zero()});
        } else if (set_shape(link, "collision", collision.geometry, &shape)) {
            segment(index).collisions.push_back(shape);
        }
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

    Drives drives_;
    bool repair_inertia_;
    UrdfSource *source_;
    Description *description_;
    std::vector<std::string> leaders_; /* for each segment, the joint that drives it */
};

} // namespace

bool description_load(const std::string &path, const Wanted &wanted, Description *description,
                      Findings *findings)
{
    UrdfSource source(path, findings);
    std::set<std::string> driven(wanted.joints.begin(), wanted.joints.end());

    *description = Description{};
    description->path = path;
    urdf::ModelInterfaceSharedPtr model = source.load(driven);
    if (!model)
        return false;
    Builder(*model, driven, wanted.repair_inertia, &source, description).build(*model->getRoot());
    return true;
}

int description_joint(const Description &description, const std::string &name, std::string *error)
{
    for (size_t i = 1; i < description.segments.size(); i++)
        if (description.segments[i].name == name && description.segments[i].leader < 0)
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
