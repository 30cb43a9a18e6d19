/* The meshes of a URDF: what they look like, read when somebody looks at the robot, in few
 * triangles, since they are drawn on the CPU; and the room that they take, where links collide. */
#ifndef SIMROBOT_SETUP_MESHES_H
#define SIMROBOT_SETUP_MESHES_H

#include "simrobot/setup/description.h"

namespace sim
{

/* A finer mesh is made coarser until it has no more than these. */
inline constexpr size_t most_triangles = 800;

/* The file that a URDF means: a path beside the URDF, file://, or package://NAME/..., which is
 * looked for in the folders of `package_path` (separated by ':') and in all folders above the URDF.
 *   returns "" if there is none. */
std::string mesh_file(const std::string &urdf, const std::string &package_path,
                      const std::string &name);

/* Reads the description's meshes and adds them to their segments' shapes. Those whose file is
 * missing or cannot be read are left out, with one line for all in `notes`. */
void meshes_load(const std::string &package_path, Description *description,
                 std::vector<std::string> *notes);

/* Reads the meshes under <collision>: each is taken as the box that holds it, in its own axes, and
 * one line in `findings` says so. Who asks for collisions must not be told of fewer than there are:
 * a file that is missing or cannot be read is a fault. */
void mesh_collisions_load(const std::string &package_path, Description *description,
                          Findings *findings);

} // namespace sim
#endif
