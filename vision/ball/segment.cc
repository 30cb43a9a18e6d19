#include "vision/ball/segment.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/ball/edges.h"

static const int fine_rounds = 2;
static const double coarse_tolerance = 2;  /* px: edges to the pixel, and ragged ones */
static const double coarse_share = 0.5;    /* of coverage_min: less is not worth a close look */
static const double fine_tolerance = 1.5;  /* px */
static const double trim_tolerance = 0.35; /* px: closer than this no edge point is left out */
static const int fill_grid = 9;            /* the disc is sampled on a grid of this many rows */
static const double fill_radius = 0.85;    /* of the disc: its rim is mixed with the background */

/* A connected piece of the mask, in full-resolution pixels. */
struct component {
    pixel_point centre;
    double width;
    double height;
    double area;
};

static void make_mask(segmenter *work, const image_view &image, const image_region &region,
                      int step)
{
    const int rows = (region.bottom - region.top + step - 1) / step;
    const int columns = (region.right - region.left + step - 1) / step;
    const int red = image_red(image);

    work->mask.create(rows, columns, CV_8U);
    for (int i = 0; i < rows; i++) {
        const uint8_t *pixel = image_pixel(image, region.left, region.top + i * step);
        uint8_t *out = work->mask.ptr<uint8_t>(i);
        for (int j = 0; j < columns; j++, pixel += 3 * step)
            out[j] = colour_member(work->colours, pixel, red);
    }
}

static component component_at(const segmenter &work, int label, const image_region &region,
                              int step)
{
    const int *stats = work.stats.ptr<int>(label);
    const double *centroid = work.centroids.ptr<double>(label);

    return {{region.left + centroid[0] * step, region.top + centroid[1] * step},
            static_cast<double>(stats[cv::CC_STAT_WIDTH] * step),
            static_cast<double>(stats[cv::CC_STAT_HEIGHT] * step),
            static_cast<double>(stats[cv::CC_STAT_AREA]) * step * step};
}

/* A part of a ball can be as small as what coverage_min leaves of the smallest, and grass between
 * the ball's colour and the background can make it look larger than it is. */
static bool plausible(const segment_limits &limits, const component &piece)
{
    const double most = 3 * limits.radius_max;

    return piece.area >= 0.5 * limits.radius_min * limits.radius_min && piece.width <= most &&
           piece.height <= most;
}

/* The largest pieces, largest first; returns how many. */
static int list_components(segmenter *work, const image_region &region, int step, component *pieces)
{
    const int labels = cv::connectedComponentsWithStats(work->mask, work->labels, work->stats,
                                                        work->centroids, 4, CV_16U, cv::CCL_WU);
    int n = 0;

    for (int label = 1; label < labels; label++) {
        const component piece = component_at(*work, label, region, step);
        int place = n < SEGMENT_CANDIDATES ? n : SEGMENT_CANDIDATES;
        if (!plausible(work->limits, piece))
            continue;
        while (place > 0 && pieces[place - 1].area < piece.area) {
            if (place < SEGMENT_CANDIDATES)
                pieces[place] = pieces[place - 1];
            place--;
        }
        if (place < SEGMENT_CANDIDATES)
            pieces[place] = piece;
        n = std::min(n + 1, static_cast<int>(SEGMENT_CANDIDATES));
    }
    return n;
}

static bool fit_outline(const segmenter &work, const image_view &image, const camera &eye,
                        const component &piece, outline *cone)
{
    outline_points points;

    edges_coarse(image, work.colours, eye, piece.centre, std::max(piece.width, piece.height),
                 &points);
    if (!outline_consensus(points, eye.focal, coarse_tolerance, cone) ||
        cone->support < coarse_share * work.limits.coverage_min * OUTLINE_RAYS ||
        !outline_refine(points, eye.focal, coarse_tolerance, coarse_tolerance, cone))
        return false;
    for (int round = 0; round < fine_rounds; round++) {
        if (!(cone->axis.z > 0.1) || cone->tangent * eye.focal > 2 * work.limits.radius_max)
            return false;
        edges_fine(image, work.colours, eye, *cone, &points);
        if (!outline_refine(points, eye.focal, fine_tolerance, trim_tolerance, cone))
            return false;
    }
    return true;
}

/* Share of the disc with the ball's colour, and the mean of those pixels. */
static double measure_disc(const segmenter &work, const image_view &image, const blob &found,
                           colour_hsv *colour)
{
    const int red = image_red(image);
    double sum[3] = {0, 0, 0};
    int n = 0;
    int members = 0;

    for (int i = 0; i < fill_grid * fill_grid; i++) {
        const int across = i % fill_grid;
        const int down = i / fill_grid;
        const double x = 2.0 * across / (fill_grid - 1) - 1;
        const double y = 2.0 * down / (fill_grid - 1) - 1;
        const int column = static_cast<int>(found.pixel.column + x * found.radius * fill_radius);
        const int row = static_cast<int>(found.pixel.row + y * found.radius * fill_radius);
        if (x * x + y * y > 1 || column < 0 || row < 0 || column >= image.width ||
            row >= image.height)
            continue;
        n++;
        const uint8_t *pixel = image_pixel(image, column, row);
        if (!colour_member(work.colours, pixel, red))
            continue;
        members++;
        sum[0] += pixel[red];
        sum[1] += pixel[1];
        sum[2] += pixel[2 - red];
    }
    *colour = colour_to_hsv(sum[0], sum[1], sum[2]);
    return n ? static_cast<double>(members) / n : 0;
}

static bool describe(const segmenter &work, const image_view &image, const camera &eye, blob *found)
{
    const segment_limits &limits = work.limits;
    colour_hsv colour;

    found->pixel = camera_project(eye, found->cone.axis);
    found->radius = found->cone.tangent * eye.focal;
    found->coverage = static_cast<double>(found->cone.support) / OUTLINE_RAYS;
    found->fill = measure_disc(work, image, *found, &colour);
    const double off = colour_hue_distance(colour.hue, work.range.hue) / work.range.hue_tolerance;
    found->score = found->coverage * found->fill * std::max(0.0, 1 - off * off);
    return found->radius >= limits.radius_min && found->radius <= limits.radius_max &&
           found->coverage >= limits.coverage_min && found->fill >= limits.fill_min &&
           found->cone.rms <= limits.roughness;
}

int segment_find(segmenter *work, const image_view &image, const camera &eye,
                 const image_region &region, int step, blob *blobs)
{
    const image_region part = image_clip(image, region);
    component pieces[SEGMENT_CANDIDATES];
    int n = 0;

    if (part.right - part.left < 2 * step || part.bottom - part.top < 2 * step)
        return 0;
    make_mask(work, image, part, step);
    const int n_pieces = list_components(work, part, step, pieces);
    for (int i = 0; i < n_pieces; i++)
        if (fit_outline(*work, image, eye, pieces[i], &blobs[n].cone) &&
            describe(*work, image, eye, &blobs[n]))
            n++;
    std::stable_sort(blobs, blobs + n,
                     [](const blob &a, const blob &b) { return a.score > b.score; });
    return n;
}
