#include "vision/ball/judge.h"

#include <algorithm>
#include <cmath>

#include "vision/ball/edges.h"

static const double radius_least = 7;   /* px: less holds too few pixels for an outline */
static const int fill_grid = 9;         /* the disc is sampled on a grid of this many rows */
static const double fill_radius = 0.85; /* of the disc: its rim is mixed with the background */
static const int blown = 250; /* levels: with this in a channel a pixel has lost its colour */
static const double least_painted = 0.3; /* of the disc: so much must not be blown */
static const double rough_share = 0.008; /* of the radius: rougher than ball.roughness may be */
static const double border_share = 0.6;  /* of coverage_min, of an outline that the border cuts */
static const double leak_max = 0.4;
static const double leak_reach = 0.08;       /* of the radius, beyond the outline */
static const double leak_least = 4;          /* px */
static const double stretch_max = 0.08;      /* of the radius */
static const double stretch_coverage = 0.75; /* least, with a stretch */
static const double stretch_from = 0.5;      /* least coverage as round for which it is tried */
static const double stretch_rough = 0.4;     /* least roughness, of what may be */
static const double clear_share = 0.8;       /* of outline and disc */
static const double clear_leak = 0.1;

radius_range judge_radii(const segment_limits &limits, const camera &eye)
{
    return {std::max(radius_least, eye.focal * std::tan(limits.radius_min)),
            eye.focal * std::tan(limits.radius_max)};
}

/* Pixels of the disc. */
struct disc {
    int n = 0;
    int members = 0;
    int blown = 0;             /* and no members */
    double sum[3] = {0, 0, 0}; /* of the members; red, green, blue */
};

static void count_pixel(const segmenter &work, const image_view &image, const pixel_point &at,
                        disc *seen)
{
    const int column = static_cast<int>(at.column);
    const int row = static_cast<int>(at.row);
    const int red = image_red(image);

    if (column < 0 || row < 0 || column >= image.width || row >= image.height)
        return;
    seen->n++;
    const uint8_t *pixel = image_pixel(image, column, row);
    if (!colour_member(work.colours, pixel, red)) {
        seen->blown += std::max({pixel[0], pixel[1], pixel[2]}) >= blown;
        return;
    }
    seen->members++;
    seen->sum[0] += pixel[red];
    seen->sum[1] += pixel[1];
    seen->sum[2] += pixel[2 - red];
}

/* Share of the disc with the ball's colour, and the mean of those pixels. What is blown out says
 * nothing about the colour. */
static double measure_disc(const segmenter &work, const image_view &image, const blob &found,
                           colour_hsv *colour)
{
    disc seen;

    for (int i = 0; i < fill_grid * fill_grid; i++) {
        const int across = i % fill_grid;
        const int down = i / fill_grid;
        const double x = 2.0 * across / (fill_grid - 1) - 1;
        const double y = 2.0 * down / (fill_grid - 1) - 1;
        if (x * x + y * y <= 1)
            count_pixel(work, image,
                        {found.pixel.column + x * found.radius * fill_radius,
                         found.pixel.row + y * found.radius * fill_radius},
                        &seen);
    }
    *colour = colour_to_hsv(seen.sum[0], seen.sum[1], seen.sum[2]);
    if (seen.n == 0)
        return 0;
    return seen.members / std::max<double>(seen.n - seen.blown, least_painted * seen.n);
}

static bool has_colour(const segmenter &work, const image_view &image, double column, double row)
{
    return column >= 0 && row >= 0 && column < image.width && row < image.height &&
           colour_member(work.colours,
                         image_pixel(image, static_cast<int>(column), static_cast<int>(row)),
                         image_red(image));
}

/* Counts the outline's parts: seen, cut off by the picture's border, or with the ball's colour on
 * both sides and no edge. */
static void measure_outline(const segmenter &work, const image_view &image, const camera &eye,
                            const outline_points &points, blob *found)
{
    const double beyond = found->radius + std::max(leak_least, leak_reach * found->radius);
    int inside = 0;
    int leaks = 0;

    for (int i = 0; i < OUTLINE_RAYS; i++) {
        const double x = edges_ray(i).column;
        const double y = edges_ray(i).row;
        const bool seen =
            points.valid[i] &&
            std::fabs(outline_distance(found->cone, points.view[i], eye.focal)) <= leak_least / 2;
        inside += !points.outside[i];
        leaks += !seen && !points.outside[i] &&
                 has_colour(work, image, found->pixel.column + x * beyond,
                            found->pixel.row + y * beyond);
    }
    found->coverage = inside ? std::min(1.0, static_cast<double>(found->cone.support) / inside) : 0;
    found->leak = inside ? static_cast<double>(leaks) / inside : 0;
}

/* Edges that have nothing to do with each other agree with some cone to about the tolerance, but
 * hardly over much of its outline: the less of it is seen, the more exact it must be. */
static double roughness_max(const segment_limits &limits, const blob &found)
{
    const double sure = std::max(0.0, found.coverage - found.leak);

    return std::max(limits.roughness, rough_share * found.radius) * sure * std::sqrt(sure);
}

static blob_fault fault_of(const segment_limits &limits, const camera &eye, const blob &found)
{
    const radius_range radii = judge_radii(limits, eye);
    const double whole = static_cast<double>(found.cone.support) / OUTLINE_RAYS;

    if (found.radius < radii.least)
        return BLOB_TOO_SMALL;
    if (found.radius > radii.most)
        return BLOB_TOO_LARGE;
    if (found.coverage < limits.coverage_min || whole < border_share * limits.coverage_min)
        return BLOB_COVERAGE;
    const double stretch = outline_stretch(found.cone);
    if (stretch > stretch_max || (stretch > 0 && found.coverage < stretch_coverage))
        return BLOB_ROUGH;
    if (found.fill < limits.fill_min)
        return BLOB_FILL;
    if (found.cone.rms > roughness_max(limits, found))
        return BLOB_ROUGH;
    return found.leak > leak_max ? BLOB_LEAKS : BLOB_GOOD;
}

blob_fault judge_blob(const segmenter &work, const image_view &image, const camera &eye,
                      const outline_points &points, blob *found)
{
    colour_hsv colour;

    found->pixel = camera_project(eye, found->cone.axis);
    found->radius = found->cone.tangent * eye.focal;
    measure_outline(work, image, eye, points, found);
    found->fill = measure_disc(work, image, *found, &colour);
    const double off = colour_hue_distance(colour.hue, work.range.hue) / work.range.hue_tolerance;
    const double rough = found->cone.rms / std::max(1e-3, roughness_max(work.limits, *found));
    found->score = found->coverage * found->coverage * found->fill * (1 - found->leak) *
                   (1 - off * off / 2) * std::max(0.1, 1 - rough / 2) * found->radius *
                   (1 - 2 * std::min(0.4, outline_stretch(found->cone)));
    return fault_of(work.limits, eye, *found);
}

bool judge_stretched(const segmenter &work, const blob &found)
{
    return found.coverage >= stretch_from &&
           (found.coverage < clear_share ||
            found.cone.rms > stretch_rough * roughness_max(work.limits, found));
}

bool judge_clear(const blob &found)
{
    return found.coverage >= clear_share && found.fill >= clear_share && found.leak <= clear_leak;
}
