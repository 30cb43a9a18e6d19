#include "scene.h"

#include <algorithm>
#include <cmath>

static const int supersampling = 6; /* rays along each side of a pixel at the rim of a sphere */

image_view picture::view() const
{
    return {rgb.data(), width, height, static_cast<size_t>(width) * 3, PIXEL_RGB};
}

scene_eyes scene_default_eyes()
{
    const camera eye = {640, 480, 1200, 0, 0, 0, 0};

    return {eye, eye, 0.18, 0.09};
}

/* Where an eye stands in the common frame, and how it is turned about the vertical axis. */
struct pose {
    double x;
    double cosine;
    double sine;
};

static pose pose_of(const scene_eyes &eyes, bool left)
{
    const double turn = left ? eyes.vergence / 2 : -eyes.vergence / 2;

    return {left ? -eyes.baseline / 2 : eyes.baseline / 2, std::cos(turn), std::sin(turn)};
}

static direction to_eye(const pose &at, const direction &p)
{
    const double x = p.x - at.x;

    return {at.cosine * x - at.sine * p.z, p.y, at.sine * x + at.cosine * p.z};
}

/* The inverse of camera_upright, whose rotations are undone one after the other. */
static direction tilted(const camera &eye, const direction &upright)
{
    const double cy = std::cos(eye.yaw), sy = std::sin(eye.yaw);
    const double cp = std::cos(eye.pitch), sp = std::sin(eye.pitch);
    const double cr = std::cos(eye.roll), sr = std::sin(eye.roll);
    const direction a = {cy * upright.x - sy * upright.z, upright.y,
                         sy * upright.x + cy * upright.z};
    const direction b = {a.x, cp * a.y - sp * a.z, sp * a.y + cp * a.z};

    return {cr * b.x + sr * b.y, cr * b.y - sr * b.x, b.z};
}

void scene_project(const scene_eyes &eyes, bool left, const direction &point, double *u, double *v)
{
    const camera &eye = left ? eyes.left : eyes.right;
    const direction seen = to_eye(pose_of(eyes, left), point);

    *u = eye.focal * seen.x / seen.z;
    *v = eye.focal * seen.y / seen.z;
}

/* Smooth pattern of the background: a few plane waves, different in each colour. A wave over a sum
 * of column and row is made from its sines and cosines over each, which are few. */
struct backdrop {
    static constexpr int waves = 4;
    std::vector<double> column_sine[3][waves], column_cosine[3][waves];
    std::vector<double> row_sine[3][waves], row_cosine[3][waves];
    double contrast;
};

static backdrop make_backdrop(int width, int height, double contrast)
{
    static const double wave[backdrop::waves][3] = {
        {0.031, 0.017, 0.3}, {-0.011, 0.043, 1.1}, {0.127, 0.089, 2.3}, {0.21, -0.17, 0.7}};
    backdrop made;

    made.contrast = contrast;
    for (int c = 0; c < 3; c++)
        for (int w = 0; w < backdrop::waves; w++) {
            for (int i = 0; i < width; i++) {
                const double phase = wave[w][0] * i + wave[w][2] * (1 + 0.2 * c);
                made.column_sine[c][w].push_back(std::sin(phase));
                made.column_cosine[c][w].push_back(std::cos(phase));
            }
            for (int i = 0; i < height; i++) {
                made.row_sine[c][w].push_back(std::sin(wave[w][1] * i));
                made.row_cosine[c][w].push_back(std::cos(wave[w][1] * i));
            }
        }
    return made;
}

static void background(const backdrop &behind, int column, int row, double *colour)
{
    static const double base[3] = {0.52, 0.46, 0.42};

    for (int c = 0; c < 3; c++) {
        double pattern = 0;
        for (int w = 0; w < backdrop::waves; w++)
            pattern += behind.column_sine[c][w][column] * behind.row_cosine[c][w][row] +
                       behind.column_cosine[c][w][column] * behind.row_sine[c][w][row];
        colour[c] = base[c] * (1 + behind.contrast * pattern / 2);
    }
}

/* Light that comes back from a sphere's surface. */
static void shade(const scene &what, const scene_sphere &ball, const direction &light,
                  const direction &normal, const direction &view, double *colour)
{
    const double diffuse = std::max(0.0, direction_dot(normal, light));
    const direction half =
        direction_normalised({light.x - view.x, light.y - view.y, light.z - view.z});
    const double glint = std::pow(std::max(0.0, direction_dot(normal, half)), 40) * what.gloss;

    for (int c = 0; c < 3; c++)
        colour[c] = ball.colour[c] * (what.ambient + (1 - what.ambient) * diffuse) + glint;
}

struct hit {
    const scene_sphere *ball;
    direction centre; /* eye's frame */
    double distance;
};

static hit nearest(const scene &what, const std::vector<direction> &centres, const direction &view)
{
    hit best = {nullptr, {}, 0};

    for (size_t i = 0; i < centres.size(); i++) {
        const double along = direction_dot(centres[i], view);
        const double squared = what.spheres[i].radius * what.spheres[i].radius -
                               direction_dot(centres[i], centres[i]) + along * along;
        if (squared < 0)
            continue;
        const double distance = along - std::sqrt(squared);
        if (!best.ball || distance < best.distance)
            best = {&what.spheres[i], centres[i], distance};
    }
    return best;
}

/* About where a sphere is seen; px. */
struct place {
    pixel_point middle;
    double radius;
};

struct drawing {
    const scene &what;
    camera eye;
    std::vector<direction> centres; /* eye's frame */
    std::vector<place> places;
    direction light;
    backdrop behind;
};

/* The picture cast along one line of sight; `column` and `row` name the pixel it belongs to. */
static void look(const drawing &draw, const pixel_point &at, int column, int row, double *colour)
{
    const direction view = camera_upright(draw.eye, camera_direction(draw.eye, at));
    const hit found = nearest(draw.what, draw.centres, view);

    if (draw.what.bar && at.column >= draw.what.bar_left && at.column < draw.what.bar_right) {
        colour[0] = colour[1] = colour[2] = 0.7;
    } else if (found.ball) {
        const double r = found.ball->radius;
        const direction normal = {(view.x * found.distance - found.centre.x) / r,
                                  (view.y * found.distance - found.centre.y) / r,
                                  (view.z * found.distance - found.centre.z) / r};
        shade(draw.what, *found.ball, draw.light, normal, view, colour);
    } else {
        background(draw.behind, column, row, colour);
    }
}

/* Whether the pixel needs rays at all (0), one (1), or many, since a rim may cross it (2). */
static int care(const drawing &draw, int column, int row)
{
    int needed = 0;

    if (draw.what.bar && column > draw.what.bar_left - 2 && column < draw.what.bar_right + 2)
        needed = column < draw.what.bar_left + 2 || column > draw.what.bar_right - 2 ? 2 : 1;
    for (size_t i = 0; i < draw.places.size() && needed < 2; i++) {
        const double radius = draw.places[i].radius;
        const double x = column - draw.places[i].middle.column;
        const double y = row - draw.places[i].middle.row;
        const double away = x * x + y * y;
        if (away > 1.3 * 1.3 * radius * radius + 9)
            continue;
        needed = away > 0.8 * 0.8 * radius * radius - 9 ? 2 : 1;
    }
    return needed;
}

static void pixel_colour(const drawing &draw, int column, int row, double *colour)
{
    const int needed = care(draw, column, row);
    const int n = needed == 2 ? supersampling : 1;

    if (needed == 0) {
        background(draw.behind, column, row, colour);
        return;
    }
    colour[0] = colour[1] = colour[2] = 0;
    for (int i = 0; i < n * n; i++) {
        const int across = i % n;
        const int down = i / n;
        const pixel_point at = {column + (across + 0.5) / n - 0.5, row + (down + 0.5) / n - 0.5};
        double one[3];
        look(draw, at, column, row, one);
        for (int c = 0; c < 3; c++)
            colour[c] += one[c] / (n * n);
    }
}

/* Noise is drawn from a long list of numbers, since drawing a million anew takes longer than the
 * picture. */
static std::vector<double> make_noise(double deviation, std::mt19937_64 &random)
{
    std::normal_distribution<double> normal(0, 1);
    std::vector<double> list(65521);

    for (double &one : list)
        one = deviation * normal(random);
    return list;
}

picture scene_draw(const scene &what, const scene_eyes &eyes, bool left, std::mt19937_64 &random)
{
    const pose at = pose_of(eyes, left);
    const camera &eye = left ? eyes.left : eyes.right;
    drawing draw = {what, eye, {}, {}, {}, make_backdrop(eye.width, eye.height, what.texture)};
    const std::vector<double> noise = make_noise(what.noise, random);
    picture result;

    for (const scene_sphere &ball : what.spheres) {
        const direction centre = to_eye(at, ball.centre);
        draw.centres.push_back(centre);
        draw.places.push_back(
            {camera_project(eye, tilted(eye, centre)), eye.focal * ball.radius / centre.z});
    }
    draw.light = to_eye({0, at.cosine, at.sine}, what.light);
    result.width = eye.width;
    result.height = eye.height;
    result.rgb.resize(static_cast<size_t>(eye.width) * eye.height * 3);
    for (size_t i = 0; i < result.rgb.size() / 3; i++) {
        double colour[3];
        pixel_colour(draw, static_cast<int>(i) % eye.width, static_cast<int>(i) / eye.width,
                     colour);
        for (size_t c = 0; c < 3; c++) {
            const double level = 255 * colour[c] * what.brightness * what.tint[c] +
                                 noise[(3 * i + c) % noise.size()];
            result.rgb[3 * i + c] = static_cast<uint8_t>(std::clamp(level + 0.5, 0.0, 255.0));
        }
    }
    return result;
}

scene scene_random(std::mt19937_64 &random)
{
    auto between = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    scene what;
    const double z = between(0.42, 0.8);

    what.spheres.push_back(
        {{z * between(-0.14, 0.14), z * between(-0.13, 0.13), z}, 0.025, {0.16, 0.72, 0.22}});
    what.light = direction_normalised({between(-1, 1), between(-1, 0.3), between(-1, 0.2)});
    what.ambient = between(0.3, 0.6);
    what.gloss = between(0, 0.4);
    what.brightness = between(0.75, 1.15);
    what.tint[0] = between(0.9, 1.1);
    what.tint[2] = between(0.9, 1.1);
    what.noise = between(1, 4);
    what.texture = between(0, 0.4);
    return what;
}
