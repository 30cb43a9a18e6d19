#include "simrobot/setup/meshes.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace sim
{
namespace
{

namespace fs = std::filesystem;

/* A file as large as this is a scan of a whole machine, not what a link looks like. */
const uintmax_t most_bytes = 100u << 20;

bool is_there(const fs::path &path)
{
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/* Without the word before "://", if it is that. */
bool take_scheme(const std::string &scheme, std::string *name)
{
    if (name->compare(0, scheme.size(), scheme) != 0)
        return false;
    name->erase(0, scheme.size());
    return true;
}

/* "NAME/some/file" in a folder that holds packages, or that is the package NAME. */
std::string in_folder(const fs::path &folder, const fs::path &file)
{
    fs::path package = *file.begin(), inside = file.lexically_relative(package);

    for (const fs::path &path : {folder / file, folder / "share" / file})
        if (is_there(path))
            return path;
    return folder.filename() == package && is_there(folder / inside) ? folder / inside : "";
}

/* The corners of all triangles, three each, and the colour of most of them. */
struct Surface {
    Triangles corners;
    Eigen::Vector3f colour = {0.7f, 0.7f, 0.7f};
};

void add_part(const aiMesh &part, const Eigen::Vector3d &scale, Triangles *corners)
{
    for (unsigned int i = 0; i < part.mNumFaces; i++) {
        const aiFace &face = part.mFaces[i];
        if (face.mNumIndices != 3)
            continue;
        for (unsigned int k = 0; k < 3; k++) {
            const aiVector3D &at = part.mVertices[face.mIndices[k]];
            corners->push_back(Eigen::Vector3d(at.x, at.y, at.z).cwiseProduct(scale).cast<float>());
        }
    }
}

bool read_surface(const std::string &file, const Eigen::Vector3d &scale, Surface *surface)
{
    Assimp::Importer importer;
    std::error_code error;
    unsigned int largest = 0;

    if (fs::file_size(file, error) > most_bytes || error)
        return false;
    /* As all programs that read a URDF do: the mesh keeps its axes, whatever its file calls up. */
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    const aiScene *scene = importer.ReadFile(
        file, aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType);
    if (!scene)
        return false;
    for (unsigned int i = 0; i < scene->mNumMeshes; i++) {
        const aiMesh &part = *scene->mMeshes[i];
        aiColor3D colour(0.7f, 0.7f, 0.7f);
        add_part(part, scale, &surface->corners);
        if (part.mNumFaces <= largest)
            continue;
        largest = part.mNumFaces;
        scene->mMaterials[part.mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, colour);
        surface->colour = {colour.r, colour.g, colour.b};
    }
    for (const Eigen::Vector3f &corner : surface->corners)
        if (!corner.allFinite())
            return false;
    return !surface->corners.empty();
}

/* Corners that fall into one cell of a grid become one point, their mean; triangles that are left
 * with two corners or fewer go. */
Triangles coarser(const Triangles &corners, float cell)
{
    using Cell = std::array<int, 3>;
    std::map<Cell, std::pair<Eigen::Vector3f, int>> points;
    std::vector<Cell> cells;
    Triangles result;

    for (const Eigen::Vector3f &corner : corners) {
        Cell at;
        for (int i = 0; i < 3; i++)
            at[static_cast<size_t>(i)] = static_cast<int>(std::floor(corner[i] / cell));
        auto &point = points.try_emplace(at, Eigen::Vector3f::Zero(), 0).first->second;
        point.first += corner;
        point.second++;
        cells.push_back(at);
    }
    for (size_t i = 0; i + 2 < cells.size(); i += 3) {
        if (cells[i] == cells[i + 1] || cells[i + 1] == cells[i + 2] || cells[i] == cells[i + 2])
            continue;
        for (size_t k = i; k < i + 3; k++)
            result.push_back(points[cells[k]].first / static_cast<float>(points[cells[k]].second));
    }
    return result;
}

Eigen::AlignedBox3f box_around(const Triangles &corners)
{
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f &corner : corners)
        box.extend(corner);
    return box;
}

/* The shape, which has its pose, becomes this box of its frame. */
void take_box(const Eigen::AlignedBox3f &box, Shape *shape)
{
    shape->kind = ShapeKind::box;
    shape->size = box.sizes().cast<double>();
    shape->pose = shape->pose * Eigen::Translation3d(box.center().cast<double>());
}

/* A mesh, or its box where no grid makes it coarse enough. */
Shape shape_of(const MeshPart &visual, const Surface &surface)
{
    Eigen::AlignedBox3f box = box_around(surface.corners);
    Triangles corners = surface.corners;
    Shape shape = {};

    for (float cells = 40; corners.size() > 3 * most_triangles && cells > 4; cells /= 1.3f)
        corners = coarser(surface.corners, box.sizes().maxCoeff() / cells);
    shape.pose = visual.pose;
    shape.colour = visual.has_colour ? visual.colour : surface.colour;
    if (corners.empty() || corners.size() > 3 * most_triangles) {
        take_box(box, &shape);
        return shape;
    }
    shape.kind = ShapeKind::mesh;
    for (const Eigen::Vector3f &corner : corners)
        shape.size.x() = std::max<double>(shape.size.x(), corner.norm());
    shape.triangles = std::make_shared<const Triangles>(std::move(corners));
    return shape;
}

} // namespace

std::string mesh_file(const std::string &urdf, const std::string &package_path,
                      const std::string &name)
{
    fs::path beside = fs::absolute(urdf).parent_path();
    std::istringstream folders(package_path);
    std::string file = name, found;

    if (take_scheme("file://", &file))
        return is_there(file) ? file : "";
    if (!take_scheme("package://", &file) && !take_scheme("model://", &file))
        return is_there(beside / file) ? (beside / file).string() : "";
    file.erase(0, file.find_first_not_of('/')); /* some have package:///NAME */
    for (std::string folder; found.empty() && std::getline(folders, folder, ':');)
        found = in_folder(folder, file);
    for (; found.empty() && beside.has_relative_path(); beside = beside.parent_path())
        found = in_folder(beside, file);
    return found;
}

void meshes_load(const std::string &package_path, Description *description,
                 std::vector<std::string> *notes)
{
    size_t missing = 0;
    std::string first;

    for (const MeshPart &visual : description->meshes) {
        Surface surface;
        std::string file = mesh_file(description->path, package_path, visual.file);
        if (!file.empty() && read_surface(file, visual.scale, &surface))
            description->segments[static_cast<size_t>(visual.segment)].shapes.push_back(
                shape_of(visual, surface));
        else if (missing++ == 0)
            first = "link " + visual.link + ": " + visual.file +
                    (file.empty() ? " is not there" : " cannot be read");
    }
    if (missing)
        notes->push_back(description->path + ": " + std::to_string(missing) + " of " +
                         std::to_string(description->meshes.size()) +
                         " meshes are left out, the first: " + first +
                         "; --package-path says where packages are");
    description->meshes.clear();
}

void mesh_collisions_load(const std::string &package_path, Description *description,
                          Findings *findings)
{
    const double thinnest = 1e-3; /* m: ODE wants room in each direction */

    for (const MeshPart &part : description->mesh_collisions) {
        Surface surface;
        Shape shape = {};
        std::string file = mesh_file(description->path, package_path, part.file);
        if (file.empty() || !read_surface(file, part.scale, &surface)) {
            findings->faults.push_back(
                description->path + ": robot.collisions: <collision> of link " + part.link + ": " +
                part.file + (file.empty() ? " is not there" : " cannot be read") +
                "; --package-path says where packages are");
            continue;
        }
        shape.pose = part.pose;
        shape.colour = part.colour;
        take_box(box_around(surface.corners), &shape);
        shape.size = shape.size.cwiseMax(thinnest);
        description->segments[static_cast<size_t>(part.segment)].collisions.push_back(shape);
    }
    if (!description->mesh_collisions.empty())
        findings->notes.push_back(description->path + ": robot.collisions: " +
                                  std::to_string(description->mesh_collisions.size()) +
                                  " meshes are taken as the boxes that hold them");
    description->mesh_collisions.clear();
}

} // namespace sim
