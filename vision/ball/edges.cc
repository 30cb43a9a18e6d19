#include "vision/ball/edges.h"

#include <cmath>

/* A profile runs from -half_width to half_width px across the expected edge; the samples further
 * from it than `gap` tell the colours of the two sides. */
static const int half_width = 5;
static const int gap = 2;
static const int profile_length = 2 * half_width + 1;
static const int side_length = half_width - gap;
static const double profile_radius = 110; /* px: of larger balls the samples are further apart */
static const double contrast_min = 10;    /* levels of 255 between the sides */
static const int outside_run = 3;         /* px of other colours that end the ball */

struct rgb {
    float channel[3];
};

/* Unit vectors at equal angles. Made by turning one step after the other from constants, so that
 * no elementary function of the C library takes part in the result. */
struct ray_table {
    double x[OUTLINE_RAYS];
    double y[OUTLINE_RAYS];
};

static ray_table make_rays()
{
    /* Cosine and sine of 2 pi / 96. */
    const double cosine = 0.99785892323860348;
    const double sine = 0.06540312923014306;
    ray_table rays;

    rays.x[0] = 1;
    rays.y[0] = 0;
    for (int i = 1; i < OUTLINE_RAYS; i++) {
        rays.x[i] = rays.x[i - 1] * cosine - rays.y[i - 1] * sine;
        rays.y[i] = rays.x[i - 1] * sine + rays.y[i - 1] * cosine;
    }
    return rays;
}

static const ray_table rays = make_rays();

pixel_point edges_ray(int i)
{
    return {rays.x[i], rays.y[i]};
}

static bool inside(const image_view &image, double column, double row)
{
    return column >= 0 && row >= 0 && column < image.width - 1 && row < image.height - 1;
}

/* Bilinear. The point must be inside(). */
static rgb sample(const image_view &image, double column, double row)
{
    const int left = static_cast<int>(column);
    const int top = static_cast<int>(row);
    const float right_share = static_cast<float>(column - left);
    const float lower_share = static_cast<float>(row - top);
    const uint8_t *upper = image_pixel(image, left, top);
    const uint8_t *lower = upper + image.stride;
    rgb result;

    for (int c = 0; c < 3; c++) {
        const float above = upper[c] + right_share * (upper[c + 3] - upper[c]);
        const float below = lower[c] + right_share * (lower[c + 3] - lower[c]);
        result.channel[c] = above + lower_share * (below - above);
    }
    return result;
}

static rgb minus(const rgb &a, const rgb &b)
{
    return {
        {a.channel[0] - b.channel[0], a.channel[1] - b.channel[1], a.channel[2] - b.channel[2]}};
}

static float dot(const rgb &a, const rgb &b)
{
    return a.channel[0] * b.channel[0] + a.channel[1] * b.channel[1] + a.channel[2] * b.channel[2];
}

/* Last distance along a ray that has the ball's colour, or -1. Steps in 1/65536 px. */
static int coarse_end(const image_view &image, const colour_table &colours,
                      const pixel_point &start, double x, double y, int reach)
{
    const int red = image_red(image);
    const int step_x = static_cast<int>(x * 65536);
    const int step_y = static_cast<int>(y * 65536);
    int column = static_cast<int>((start.column + 0.5) * 65536);
    int row = static_cast<int>((start.row + 0.5) * 65536);
    int last = -1;

    for (int distance = 0; distance <= reach; distance++, column += step_x, row += step_y) {
        if (column < 0 || row < 0 || column >> 16 >= image.width || row >> 16 >= image.height)
            return -1;
        if (colour_member(colours, image_pixel(image, column >> 16, row >> 16), red))
            last = distance;
        else if (last >= 0 && distance - last >= outside_run)
            return last;
    }
    return -1;
}

void edges_coarse(const image_view &image, const colour_table &colours, const camera &eye,
                  const pixel_point &start, double reach, outline_points *points)
{
    for (int i = 0; i < OUTLINE_RAYS; i++) {
        const int end = coarse_end(image, colours, start, rays.x[i], rays.y[i],
                                   static_cast<int>(reach) + outside_run);
        points->valid[i] = end > 0;
        if (end > 0)
            points->view[i] = camera_direction(
                eye, {start.column + rays.x[i] * (end + 0.5), start.row + rays.y[i] * (end + 0.5)});
    }
}

/* The ends of one ray, px from `start`; returns how many. Steps as in coarse_end. */
static int ends_of_ray(const image_view &image, const colour_table &colours,
                       const pixel_point &start, double x, double y, int reach, int pause,
                       int *ends)
{
    const int red = image_red(image);
    const int step_x = static_cast<int>(x * 65536);
    const int step_y = static_cast<int>(y * 65536);
    int column = static_cast<int>((start.column + 0.5) * 65536);
    int row = static_cast<int>((start.row + 0.5) * 65536);
    int last = 0;
    int n = 0;

    for (int distance = 0; distance <= reach && distance - last <= pause;
         distance++, column += step_x, row += step_y) {
        if (column < 0 || row < 0 || column >> 16 >= image.width || row >> 16 >= image.height)
            break;
        if (colour_member(colours, image_pixel(image, column >> 16, row >> 16), red)) {
            last = distance;
        } else if (distance - last == outside_run && last > 0) {
            n = n < EDGES_ENDS ? n + 1 : n;
            ends[n - 1] = last;
        }
    }
    return n;
}

void edges_all(const image_view &image, const colour_table &colours, const camera &eye,
               const pixel_point &start, double reach, double pause, outline_ends *ends)
{
    int n = 0;

    for (int i = 0; i < OUTLINE_RAYS; i++) {
        int found[EDGES_ENDS];
        const int n_found = ends_of_ray(image, colours, start, rays.x[i], rays.y[i],
                                        static_cast<int>(reach), static_cast<int>(pause), found);
        ends->first[i] = n;
        for (int k = 0; k < n_found; k++)
            ends->view[n++] = camera_direction(eye, {start.column + rays.x[i] * (found[k] + 0.5),
                                                     start.row + rays.y[i] * (found[k] + 0.5)});
    }
    ends->first[OUTLINE_RAYS] = n;
}

static rgb mean(const rgb *samples, int n)
{
    rgb sum = {};

    for (int i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            sum.channel[c] += samples[i].channel[c];
    for (float &channel : sum.channel)
        channel /= static_cast<float>(n);
    return sum;
}

static bool has_colour(const colour_table &colours, const rgb &colour, int red)
{
    const uint8_t pixel[3] = {static_cast<uint8_t>(colour.channel[0]),
                              static_cast<uint8_t>(colour.channel[1]),
                              static_cast<uint8_t>(colour.channel[2])};

    return colour_member(colours, pixel, red) != 0;
}

/* Place of the edge on a profile, px from its middle: the middle of the squared steps from the
 * inner colour to the outer. Shading inside and texture outside are slow beside the edge, and
 * squaring keeps them out; the share of each colour in the mixed pixels would carry them in
 * (measured: 0.05 px of error against 0.015). */
static bool edge_position(const rgb *profile, const colour_table &colours, int red, double *place)
{
    const rgb inner = mean(profile, side_length);
    const rgb outer = mean(profile + profile_length - side_length, side_length);
    const rgb contrast = minus(inner, outer);
    double weight = 0;
    double moment = 0;

    if (!has_colour(colours, inner, red) || dot(contrast, contrast) < contrast_min * contrast_min)
        return false;
    for (int i = side_length - 1; i < profile_length - side_length; i++) {
        const double step = dot(minus(profile[i], profile[i + 1]), contrast);
        if (step > 0) {
            weight += step * step;
            moment += step * step * (i + 0.5 - half_width);
        }
    }
    if (!(weight > 0))
        return false;
    *place = moment / weight;
    return true;
}

/* `x` and `y`: from one sample to the next; px. */
static bool take_profile(const image_view &image, const pixel_point &edge, double x, double y,
                         rgb *profile)
{
    if (!inside(image, edge.column - x * half_width, edge.row - y * half_width) ||
        !inside(image, edge.column + x * half_width, edge.row + y * half_width))
        return false;
    for (int i = 0; i < profile_length; i++)
        profile[i] =
            sample(image, edge.column + x * (i - half_width), edge.row + y * (i - half_width));
    return true;
}

/* The ray's direction on the guessed cone. */
static direction cone_direction(const outline &guess, const outline_frame &frame, int i)
{
    const double stretch = guess.wide_cosine * (rays.x[i] * rays.x[i] - rays.y[i] * rays.y[i]) +
                           guess.wide_sine * 2 * rays.x[i] * rays.y[i];
    const double sine = guess.tangent * guess.cosine * (1 + stretch);
    const double x = rays.x[i] * sine;
    const double y = rays.y[i] * sine;

    return {guess.axis.x * guess.cosine + frame.right.x * x + frame.down.x * y,
            guess.axis.y * guess.cosine + frame.right.y * x + frame.down.y * y,
            guess.axis.z * guess.cosine + frame.right.z * x + frame.down.z * y};
}

void edges_fine(const image_view &image, const colour_table &colours, const camera &eye,
                const outline &guess, outline_points *points)
{
    const outline_frame frame = outline_axes(guess.axis);
    const pixel_point centre = camera_project(eye, guess.axis);
    /* The outline of a large ball is less sharp, and known less well, in pixels. */
    const double stride = std::fmax(1, guess.tangent * eye.focal / profile_radius);

    for (int i = 0; i < OUTLINE_RAYS; i++) {
        const pixel_point edge = camera_project(eye, cone_direction(guess, frame, i));
        const double x = edge.column - centre.column;
        const double y = edge.row - centre.row;
        const double scale = stride / std::sqrt(x * x + y * y);
        rgb profile[profile_length];
        double place;

        points->outside[i] = !inside(image, edge.column, edge.row);
        points->valid[i] = take_profile(image, edge, x * scale, y * scale, profile) &&
                           edge_position(profile, colours, image_red(image), &place);
        if (points->valid[i])
            points->view[i] = camera_direction(
                eye, {edge.column + x * scale * place, edge.row + y * scale * place});
    }
}
