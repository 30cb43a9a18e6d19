/* Draws what the two eyes see. Lives in one thread, the one that made it. */
#ifndef SIMROBOT_EYES_RENDERER_H
#define SIMROBOT_EYES_RENDERER_H

#include <GLES3/gl3.h>

#include "simrobot/eyes/egl_context.h"
#include "simrobot/eyes/mesh.h"
#include "simrobot/setup/config.h"
#include "simrobot/world/simulation.h"

namespace sim
{

/* Both images side by side, the left eye's at the left: 4 bytes a pixel (red, green, blue, unused),
 * rows from top to bottom, 2 * width pixels a row. */
using StereoPixels = std::vector<uint8_t>;

class Renderer
{
public:
    /*   returns nullptr with one line in `error` when there is no OpenGL. */
    static std::unique_ptr<Renderer> create(const Config &config, std::string *error);
    ~Renderer();
    Renderer(const Renderer &) = delete;
    Renderer &operator=(const Renderer &) = delete;

    void draw(const Snapshot &snapshot, StereoPixels *pixels);

    /* What draws. */
    std::string name() const
    {
        return context_->renderer();
    }

private:
    /* Triangles that share a program and a texture. */
    struct Batch {
        GLuint texture;
        GLsizei first, count;
    };

    explicit Renderer(const Config &config);

    bool start(std::string *error);
    bool make_programs(std::string *error);
    bool make_target(std::string *error);
    void make_scene();
    View view_from(const Eigen::Isometry3d &eye) const;
    void fill_vertices(const LightState &light, const View &view);
    void draw_eye(const Eigen::Isometry3d &eye, const Snapshot &snapshot);
    void draw_scene(const Eigen::Matrix4f &view);
    void draw_ball(const Eigen::Isometry3d &eye, const Snapshot &snapshot);

    const int width_, height_;
    const float focal_length_;
    const Eigen::Vector3f ball_colour_;
    std::unique_ptr<EglContext> context_;
    GLuint plain_ = 0, textured_ = 0, ball_ = 0;
    GLuint target_ = 0, colour_buffer_ = 0, depth_buffer_ = 0;
    GLuint vertex_array_ = 0, empty_array_ = 0, vertex_buffer_ = 0;
    Corners table_, walls_, things_;
    Corners moving_; /* the robot and its tool, made anew for each pair */
    std::vector<Batch> batches_;
    std::vector<Vertex> vertices_;
};

} // namespace sim
#endif
