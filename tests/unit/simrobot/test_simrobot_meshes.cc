/* Meshes of robots from elsewhere: found, read, made coarser, drawn, and hiding what is behind. */
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "fixture.h"
#include "simrobot/eyes/mesh.h"
#include "simrobot/setup/meshes.h"
#include "simrobot/world/visibility.h"
#include "tests/unit/suite.h"

namespace fs = std::filesystem;

namespace
{

/* A folder of its own, ROOT/robot_description/{urdf,meshes}. */
class Folder
{
public:
    Folder()
    {
        char name[] = "/tmp/simrobot-test-XXXXXX";
        ck_assert_ptr_nonnull(mkdtemp(name));
        root_ = name;
        fs::create_directories(root_ / "robot_description/urdf");
        fs::create_directories(root_ / "robot_description/meshes");
    }

    ~Folder()
    {
        fs::remove_all(root_);
    }

    std::string write(const char *name, const std::string &text) const
    {
        std::ofstream(root_ / name) << text;
        return root_ / name;
    }

    std::string urdf() const
    {
        return root_ / "robot_description/urdf/arm.urdf";
    }

    std::string root() const
    {
        return root_;
    }

private:
    fs::path root_;
};

/* A block from the origin to (1, 2, 3), in whatever the file's unit is. */
const double corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0},
                              {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}};
const int faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                          {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

std::string text_of(const double *v)
{
    return std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]);
}

std::string block_stl()
{
    std::string text = "solid block\n";
    for (const int *face : faces) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (int k = 0; k < 3; k++)
            text += "vertex " + text_of(corners[face[k]]) + "\n";
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid block\n";
}

std::string block_obj()
{
    std::string text;
    for (const double *corner : corners)
        text += "v " + text_of(corner) + "\n";
    for (const int *face : faces)
        text += "f " + std::to_string(face[0] + 1) + " " + std::to_string(face[1] + 1) + " " +
                std::to_string(face[2] + 1) + "\n";
    return text;
}

/* In centimetres, and said to have z up: assimp by itself would turn it, so that y is up. */
std::string block_dae()
{
    std::string points, indices;
    for (const double *corner : corners)
        points += text_of(corner) + " ";
    for (const int *face : faces)
        for (int k = 0; k < 3; k++)
            indices += std::to_string(face[k]) + " ";
    return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
           "version='1.4.1'><asset><unit meter='0.01'/><up_axis>Z_UP</up_axis></asset>"
           "<library_effects><effect id='e'><profile_COMMON><technique sid='c'><lambert><diffuse>"
           "<color>0.25 0.5 0.75 "
           "1</color></diffuse></lambert></technique></profile_COMMON></effect>"
           "</library_effects><library_materials><material id='m'><instance_effect url='#e'/>"
           "</material></library_materials><library_geometries><geometry id='g'><mesh><source "
           "id='p'>"
           "<float_array id='a' count='24'>" +
           points +
           "</float_array><technique_common><accessor source='#a' count='8' stride='3'><param "
           "name='X' type='float'/><param name='Y' type='float'/><param name='Z' type='float'/>"
           "</accessor></technique_common></source><vertices id='v'><input semantic='POSITION' "
           "source='#p'/></vertices><triangles material='m' count='12'><input semantic='VERTEX' "
           "source='#v' offset='0'/><p>" +
           indices +
           "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
           "<visual_scene id='s'><node><instance_geometry "
           "url='#g'><bind_material><technique_common>"
           "<instance_material symbol='m' target='#m'/></technique_common></bind_material>"
           "</instance_geometry></node></visual_scene></library_visual_scenes><scene>"
           "<instance_visual_scene url='#s'/></scene></COLLADA>";
}

/* A ball of radius 1 of 2 * n * n triangles. */
std::string ball_obj(int n)
{
    std::string text;
    for (int i = 0; i <= n; i++)
        for (int k = 0; k < n; k++) {
            double up = M_PI * i / n, round = 2 * M_PI * k / n;
            double at[] = {std::sin(up) * std::cos(round), std::sin(up) * std::sin(round),
                           std::cos(up)};
            text += "v " + text_of(at) + "\n";
        }
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            int a = i * n + k + 1, b = i * n + (k + 1) % n + 1;
            for (const auto &[second, third] : {std::pair(b + n, b), {a + n, b + n}})
                text += "f " + std::to_string(a) + " " + std::to_string(second) + " " +
                        std::to_string(third) + "\n";
        }
    return text;
}

sim::Description with_mesh(const Folder &folder, const std::string &file, double scale,
                           std::vector<std::string> *notes, const std::string &packages = "")
{
    sim::Description description;
    description.path = folder.urdf();
    description.segments.resize(1);
    description.meshes.push_back({0, "link", file, Eigen::Vector3d::Constant(scale),
                                  Eigen::Isometry3d(Eigen::Translation3d(10, 0, 0)), false,
                                  Eigen::Vector3f::Zero()});
    sim::meshes_load(packages, &description, notes);
    return description;
}

/* The one shape, a mesh. */
sim::Shape mesh(const Folder &folder, const std::string &file, double scale)
{
    std::vector<std::string> notes;
    sim::Description description = with_mesh(folder, file, scale, &notes);
    for (const std::string &note : notes)
        ck_abort_msg("%s", note.c_str());
    ck_assert_uint_eq(description.segments[0].shapes.size(), 1);
    ck_assert(description.segments[0].shapes[0].kind == sim::ShapeKind::mesh);
    return description.segments[0].shapes[0];
}

double volume_of(const sim::Triangles &triangles)
{
    double volume = 0;
    for (size_t i = 0; i + 2 < triangles.size(); i += 3)
        volume +=
            static_cast<double>(triangles[i].dot(triangles[i + 1].cross(triangles[i + 2])) / 6);
    return volume;
}

void assert_same(const std::string &found, const std::string &expected)
{
    ck_assert_str_eq(found.c_str(), expected.c_str());
}

} // namespace

START_TEST(test_files_are_found_as_they_are_named)
{
    Folder folder;
    std::string there = folder.write("robot_description/meshes/a.stl", block_stl());
    auto found = [&](const char *name, const std::string &packages = "") {
        std::string file = sim::mesh_file(folder.urdf(), packages, name);
        return file.empty() ? file : fs::weakly_canonical(file).string();
    };

    assert_same(found("../meshes/a.stl"), there);
    assert_same(found("package://robot_description/meshes/a.stl"), there);
    assert_same(found(("file://" + there).c_str()), there);
    assert_same(found("package:///robot_description/meshes/a.stl"), there);
    assert_same(found("package://other/a.stl"), "");
    assert_same(found("a.stl"), "");

    Folder elsewhere;
    fs::create_directories(elsewhere.root() + "/other");
    std::string other = elsewhere.write("other/a.stl", block_stl());
    assert_same(found("package://other/a.stl", "/nowhere:" + elsewhere.root()), other);
    assert_same(found("package://other/a.stl", elsewhere.root() + "/other"), other);
}
END_TEST

START_TEST(test_stl_obj_and_dae_are_read_with_their_scale)
{
    Folder folder;
    folder.write("robot_description/meshes/a.stl", block_stl());
    folder.write("robot_description/meshes/a.obj", block_obj());
    folder.write("robot_description/meshes/a.dae", block_dae());

    for (const auto &[file, scale] :
         {std::pair("../meshes/a.stl", 0.1), {"../meshes/a.obj", 0.1}, {"../meshes/a.dae", 10.0}}) {
        sim::Shape shape = mesh(folder, file, scale);
        Eigen::AlignedBox3f box;
        for (const Eigen::Vector3f &corner : *shape.triangles)
            box.extend(corner);
        ck_assert_uint_eq(shape.triangles->size(), 36);
        ck_assert_double_lt((box.min() - Eigen::Vector3f(0, 0, 0)).norm(), 1e-6);
        ck_assert_double_lt((box.max() - Eigen::Vector3f(0.1f, 0.2f, 0.3f)).norm(), 1e-6);
        ck_assert_double_eq_tol(volume_of(*shape.triangles), 0.006, 1e-8);
        ck_assert_double_eq_tol(shape.size.x(), std::sqrt(0.14), 1e-6);
    }
    sim::Shape painted = mesh(folder, "../meshes/a.dae", 10);
    ck_assert_double_lt((painted.colour - Eigen::Vector3f(0.25f, 0.5f, 0.75f)).norm(), 1e-3);
}
END_TEST

/* A block from the origin to (1, 2, 3), in a tenth of its size: a box about its middle. */
START_TEST(test_what_collides_is_the_box_that_holds_the_mesh)
{
    Folder folder;
    sim::Description description;
    sim::Findings findings;
    folder.write("robot_description/meshes/a.stl", block_stl());
    Eigen::Isometry3d pose(Eigen::Translation3d(0, 0, 1));

    description.path = folder.urdf();
    description.segments.emplace_back();
    for (const char *file : {"package://robot_description/meshes/a.stl", "../meshes/none.stl"})
        description.mesh_collisions.push_back({0, "link", file, Eigen::Vector3d::Constant(0.1),
                                               pose, false, Eigen::Vector3f::Zero()});
    sim::mesh_collisions_load("", &description, &findings);
    ck_assert_uint_eq(description.segments[0].collisions.size(), 1);
    const sim::Shape &box = description.segments[0].collisions[0];
    ck_assert(box.kind == sim::ShapeKind::box);
    ck_assert_double_lt((box.size - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-6);
    ck_assert_double_lt((box.pose.translation() - Eigen::Vector3d(0.05, 0.1, 1.15)).norm(), 1e-6);
    ck_assert_uint_eq(findings.notes.size(), 1);
    ck_assert_ptr_nonnull(strstr(findings.notes[0].c_str(), "boxes that hold them"));
    ck_assert_uint_eq(findings.faults.size(), 1);
    ck_assert_ptr_nonnull(strstr(findings.faults[0].c_str(), "link link: ../meshes/none.stl"));
}
END_TEST

START_TEST(test_a_fine_mesh_is_made_coarser_and_keeps_its_form)
{
    Folder folder;
    folder.write("robot_description/meshes/ball.obj", ball_obj(100));
    sim::Shape shape = mesh(folder, "../meshes/ball.obj", 0.1);

    ck_assert_uint_le(shape.triangles->size(), 3 * sim::most_triangles);
    ck_assert_uint_gt(shape.triangles->size(), sim::most_triangles);
    for (const Eigen::Vector3f &corner : *shape.triangles)
        ck_assert_double_eq_tol(corner.norm(), 0.1, 0.01);
    ck_assert_double_eq_tol(volume_of(*shape.triangles), 4.0 / 3 * M_PI * 0.001, 0.0005);
}
END_TEST

START_TEST(test_what_is_missing_is_left_out_with_one_line)
{
    Folder folder;
    folder.write("robot_description/meshes/broken.stl", "nothing of the kind");

    for (const char *file : {"package://nowhere/a.stl", "../meshes/broken.stl"}) {
        std::vector<std::string> notes;
        sim::Description description = with_mesh(folder, file, 1, &notes);
        ck_assert_uint_eq(description.segments[0].shapes.size(), 0);
        ck_assert_uint_eq(notes.size(), 1);
        for (const char *word : {"1 of 1", "link link", file, "--package-path"})
            if (!strstr(notes[0].c_str(), word))
                ck_abort_msg("'%s' does not say '%s'", notes[0].c_str(), word);
    }
}
END_TEST

/* As the box of the same size does. */
START_TEST(test_a_mesh_is_drawn_and_hides_as_the_box_it_is)
{
    Folder folder;
    folder.write("robot_description/meshes/a.stl", block_stl());
    sim::Shape shape = mesh(folder, "../meshes/a.stl", 0.1), box = {};
    box.kind = sim::ShapeKind::box;
    box.size = {0.1, 0.2, 0.3};
    box.pose = shape.pose * Eigen::Translation3d(0.05, 0.1, 0.15);
    box.colour = shape.colour;

    sim::Corners drawn, expected;
    sim::mesh_append(shape, &drawn);
    sim::mesh_append(box, &expected);
    ck_assert_uint_eq(drawn.size(), expected.size());
    for (const sim::Corner &corner : drawn)
        ck_assert(std::any_of(expected.begin(), expected.end(), [&](const sim::Corner &other) {
            return (corner.position - other.position).norm() < 1e-5 &&
                   (corner.normal - other.normal).norm() < 1e-5;
        }));

    sim::Random random(fixture::test_seed(), 3);
    int blocked = 0;
    for (int i = 0; i < 2000; i++) {
        Eigen::Vector3d from(10 + random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -1);
        Eigen::Vector3d to(10 + random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 1);
        bool blocks = sim::visibility_blocks(box, from, to);
        blocked += blocks;
        ck_assert_int_eq(sim::visibility_blocks(shape, from, to), blocks);
    }
    ck_assert_int_gt(blocked, 50);
    ck_assert_int_lt(blocked, 1950);
}
END_TEST

int main()
{
    const TTest *tests[] = {test_files_are_found_as_they_are_named,
                            test_stl_obj_and_dae_are_read_with_their_scale,
                            test_what_collides_is_the_box_that_holds_the_mesh,
                            test_a_fine_mesh_is_made_coarser_and_keeps_its_form,
                            test_what_is_missing_is_left_out_with_one_line,
                            test_a_mesh_is_drawn_and_hides_as_the_box_it_is};
    return SUITE_RUN("simrobot meshes", tests);
}
