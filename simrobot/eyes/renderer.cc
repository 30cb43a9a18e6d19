#include "simrobot/eyes/renderer.h"

#include <cmath>
#include <cstddef>
#include <iterator>

#include "simrobot/eyes/gl_program.h"
#include "simrobot/eyes/scene.h"
#include "simrobot/eyes/shaders.h"

namespace sim
{
namespace
{

/* What is nearer or farther than this is not drawn, m. */
const float near_plane = 0.05f, far_plane = 8.0f;

const int texture_size = 256;

/* From the eye's frame (x ahead, y left, z up) to clip space. Rows are drawn upside down, so that
 * reading back gives the top row first. */
Eigen::Matrix4f projection(float focal_length, int width, int height)
{
    const float range = far_plane - near_plane;
    Eigen::Matrix4f m = Eigen::Matrix4f::Zero();

    m(0, 1) = -2 * focal_length / static_cast<float>(width);
    m(1, 2) = -2 * focal_length / static_cast<float>(height);
    m(2, 0) = (far_plane + near_plane) / range;
    m(2, 3) = -2 * far_plane * near_plane / range;
    m(3, 0) = 1;
    return m;
}

void set_vector(GLuint program, const char *name, const Eigen::Vector3f &v)
{
    glUniform3f(glGetUniformLocation(program, name), v.x(), v.y(), v.z());
}

struct Span {
    float low, high;
};

/* Where the lines from the eye that touch a sphere meet the plane x = 1, in one of its directions,
 * with `rim` to spare: `ahead` and `aside` are the sphere's centre. */
Span sphere_span(float ahead, float aside, float radius, float rim)
{
    float scale = 1 / (ahead * ahead - radius * radius);
    float half = radius * std::sqrt(ahead * ahead + aside * aside - radius * radius) * scale;
    float middle = ahead * aside * scale;

    return {middle - half - rim, middle + half + rim};
}

const void *at_offset(size_t bytes)
{
    return reinterpret_cast<const void *>(bytes);
}

} // namespace

Renderer::Renderer(const Config &config)
    : width_(config.width), height_(config.height),
      focal_length_(static_cast<float>(config.focal_length)),
      ball_colour_(Eigen::Vector3d(config.ball_colour.value).cast<float>())
{
}

std::unique_ptr<Renderer> Renderer::create(const Config &config, std::string *error)
{
    std::unique_ptr<Renderer> renderer(new Renderer(config));
    return renderer->start(error) ? std::move(renderer) : nullptr;
}

bool Renderer::start(std::string *error)
{
    context_ = EglContext::create(error);
    if (!context_ || !make_programs(error) || !make_target(error))
        return false;
    make_scene();
    return true;
}

Renderer::~Renderer()
{
    /* Everything of OpenGL goes with its context. */
}

bool Renderer::make_programs(std::string *error)
{
    plain_ = gl_program(scene_vertex_shader, plain_fragment_shader, error);
    textured_ = gl_program(scene_vertex_shader, textured_fragment_shader, error);
    ball_ = gl_program(ball_vertex_shader, ball_fragment_shader, error);
    return plain_ && textured_ && ball_;
}

bool Renderer::make_target(std::string *error)
{
    glGenFramebuffers(1, &target_);
    glBindFramebuffer(GL_FRAMEBUFFER, target_);
    glGenRenderbuffers(1, &colour_buffer_);
    glBindRenderbuffer(GL_RENDERBUFFER, colour_buffer_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 2 * width_, height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              colour_buffer_);
    glGenRenderbuffers(1, &depth_buffer_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_buffer_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, 2 * width_, height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_buffer_);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE)
        return true;
    *error = "eyes: the graphics driver cannot draw " + std::to_string(2 * width_) + " x " +
             std::to_string(height_) + " pixels";
    return false;
}

void Renderer::make_scene()
{
    table_ = scene_table();
    walls_ = scene_walls();
    things_ = scene_things();
    batches_ = {{gl_texture(scene_wallpaper(texture_size), texture_size), 0, 0},
                {gl_texture(scene_wood(texture_size), texture_size), 0, 0},
                {0, 0, 0}};

    glGenVertexArrays(1, &empty_array_);
    glGenVertexArrays(1, &vertex_array_);
    glBindVertexArray(vertex_array_);
    glGenBuffers(1, &vertex_buffer_);
    glBindBuffer(GL_ARRAY_BUFFER, vertex_buffer_);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                          at_offset(offsetof(Vertex, position)));
    glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Vertex),
                          at_offset(offsetof(Vertex, colour)));
    glVertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                          at_offset(offsetof(Vertex, texture)));
    for (GLuint i = 0; i < 3; i++)
        glEnableVertexAttribArray(i);
}

void Renderer::fill_vertices(const LightState &light, const View &view)
{
    const Corners *contents[] = {&walls_, &table_, &things_, &moving_};
    const size_t batch_of[] = {0, 1, 2, 2};

    vertices_.clear();
    for (Batch &batch : batches_)
        batch.first = batch.count = 0;
    for (size_t i = 0; i < std::size(contents); i++) {
        Batch &batch = batches_[batch_of[i]];
        auto before = static_cast<GLsizei>(vertices_.size());
        mesh_show(*contents[i], light, view, &vertices_);
        if (batch.count == 0)
            batch.first = before;
        batch.count += static_cast<GLsizei>(vertices_.size()) - before;
    }
    glBindBuffer(GL_ARRAY_BUFFER, vertex_buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(Vertex)),
                 vertices_.data(), GL_STREAM_DRAW);
}

void Renderer::draw(const Snapshot &snapshot, StereoPixels *pixels)
{
    moving_.clear();
    for (const Shape &shape : snapshot.shapes)
        mesh_append(shape, &moving_);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glViewport(0, 0, width_, height_);
    draw_eye(snapshot.left_eye, snapshot);
    glViewport(width_, 0, width_, height_);
    draw_eye(snapshot.right_eye, snapshot);
    pixels->resize(static_cast<size_t>(2 * width_) * static_cast<size_t>(height_) * 4);
    glReadPixels(0, 0, 2 * width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels->data());
}

View Renderer::view_from(const Eigen::Isometry3d &eye) const
{
    auto width = static_cast<float>(width_), height = static_cast<float>(height_);
    Eigen::Matrix3f turn = eye.linear().cast<float>();

    return {eye.translation().cast<float>(),
            {turn * Eigen::Vector3f(width / 2, focal_length_, 0),
             turn * Eigen::Vector3f(width / 2, -focal_length_, 0),
             turn * Eigen::Vector3f(height / 2, 0, focal_length_),
             turn * Eigen::Vector3f(height / 2, 0, -focal_length_)}};
}

void Renderer::draw_eye(const Eigen::Isometry3d &eye, const Snapshot &snapshot)
{
    fill_vertices(snapshot.light, view_from(eye));
    draw_scene(projection(focal_length_, width_, height_) * eye.inverse().cast<float>().matrix());
    draw_ball(eye, snapshot);
}

void Renderer::draw_scene(const Eigen::Matrix4f &view)
{
    glBindVertexArray(vertex_array_);
    /* Nearest first: what is hidden then costs a depth test and no colour. */
    for (auto batch = batches_.rbegin(); batch != batches_.rend(); ++batch) {
        GLuint program = batch->texture ? textured_ : plain_;
        glUseProgram(program);
        glUniformMatrix4fv(glGetUniformLocation(program, "view"), 1, GL_FALSE, view.data());
        glBindTexture(GL_TEXTURE_2D, batch->texture);
        glDrawArrays(GL_TRIANGLES, batch->first, batch->count);
    }
}

void Renderer::draw_ball(const Eigen::Isometry3d &eye, const Snapshot &snapshot)
{
    Eigen::Vector3f centre = (eye.inverse() * snapshot.ball).cast<float>();
    Eigen::Matrix3f to_eye = eye.linear().transpose().cast<float>();
    auto radius = static_cast<float>(snapshot.ball_radius);
    const float range = far_plane - near_plane;

    if (centre.x() < near_plane + 2 * radius)
        return;
    Span across = sphere_span(centre.x(), -centre.y(), radius, 1 / focal_length_);
    Span down = sphere_span(centre.x(), -centre.z(), radius, 1 / focal_length_);
    glUseProgram(ball_);
    glUniform4f(glGetUniformLocation(ball_, "square"), across.low, down.low, across.high,
                down.high);
    glUniform2f(glGetUniformLocation(ball_, "scale"),
                2 * focal_length_ / static_cast<float>(width_),
                2 * focal_length_ / static_cast<float>(height_));
    set_vector(ball_, "centre", centre);
    set_vector(ball_, "paint", ball_colour_);
    set_vector(ball_, "lamp_direction", to_eye * snapshot.light.direction);
    set_vector(ball_, "lamp", snapshot.light.colour);
    set_vector(ball_, "ambient", snapshot.light.ambient);
    set_vector(ball_, "up", to_eye * Eigen::Vector3f::UnitZ());
    glUniform1f(glGetUniformLocation(ball_, "radius"), radius);
    glUniform1f(glGetUniformLocation(ball_, "pixel_angle"), 1 / focal_length_);
    glUniform2f(glGetUniformLocation(ball_, "depth"), far_plane / range,
                -far_plane * near_plane / range);
    glBindVertexArray(empty_array_);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glDisable(GL_BLEND);
}

} // namespace sim
