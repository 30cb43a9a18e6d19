/* Triangles of the scene in the base's frame, lit corner by corner on the CPU: so few corners that
 * one draw call for all is much cheaper than one a shape. */
#ifndef SIMROBOT_EYES_MESH_H
#define SIMROBOT_EYES_MESH_H

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "simrobot/disturbances/light.h"
#include "simrobot/setup/description.h"

namespace sim
{

/* A corner as the shaders read it. */
struct Vertex {
    float position[3];
    uint8_t colour[4];
    float texture[2]; /* where in the texture; plain shapes leave it 0 */
};

/* A corner before the light falls on it. */
struct Corner {
    Eigen::Vector3f position, normal, colour;
    Eigen::Vector2f texture;
};

using Corners = std::vector<Corner>; /* three make a triangle */

/* Appends a shape's triangles. */
void mesh_append(const Shape &shape, Corners *corners);

/* Appends a flat rectangle: `corner` and the edges from it; the normal is edge_u x edge_v. The
 * texture repeats `repeat` times over it. */
void mesh_append_rectangle(const Eigen::Vector3f &corner, const Eigen::Vector3f &edge_u,
                           const Eigen::Vector3f &edge_v, const Eigen::Vector3f &colour,
                           float repeat, Corners *corners);

/* What an eye can see: its place, and the planes through it that bound the image, normals inwards.
 */
struct View {
    Eigen::Vector3f eye;
    Eigen::Vector3f inwards[4];
};

/* Appends, under this light, the triangles that face the eye and may be in its image. The others
 * would cost the renderer much more than they cost here. */
void mesh_show(const Corners &corners, const LightState &light, const View &view,
               std::vector<Vertex> *vertices);

} // namespace sim
#endif
