#include "vision/ball/tag.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

static const double cell_share = 0.7; /* of a cell: how far a corner is looked at */
static const int reach_most = 6;      /* px */
static const int refine_rounds = 40;
static const double refine_enough = 0.005; /* px */
static const int margin_cells = 2;

typedef std::vector<cv::Point2f> corners; /* clockwise from the tag's upper left */

static cv::Ptr<cv::aruco::Dictionary> dictionary_of(int index)
{
#if CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR < 7
    return cv::aruco::getPredefinedDictionary(index - 1);
#else
    return cv::makePtr<cv::aruco::Dictionary>(cv::aruco::getPredefinedDictionary(index - 1));
#endif
}

int tag_count(int dictionary)
{
    return dictionary_of(dictionary)->bytesList.rows;
}

tag_finder tag_finder_create(const tag_config &config)
{
    tag_finder finder;

    finder.config = config;
    if (config.dictionary > 0) {
        finder.dictionary = dictionary_of(config.dictionary);
        finder.parameters = cv::makePtr<cv::aruco::DetectorParameters>();
    }
    return finder;
}

static double side_of(const corners &square)
{
    double around = 0;

    for (size_t i = 0; i < 4; i++)
        around += cv::norm(square[(i + 1) % 4] - square[i]);
    return around / 4;
}

/* The corners to a fraction of a pixel. No further than a part of the black frame is looked at, or
 * the tag's own pattern would draw them aside. */
static void refine(const tag_finder &finder, corners *square)
{
    const double cell = side_of(*square) / (finder.dictionary->markerSize + 2);
    const int reach = std::clamp(static_cast<int>(cell_share * cell), 1, reach_most);

    cv::cornerSubPix(
        finder.grey, *square, {reach, reach}, {-1, -1},
        {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, refine_rounds, refine_enough});
}

/* Where the planes through the eye and the diagonals meet. */
static direction centre_of(const direction *views)
{
    const direction meet = direction_normalised(
        direction_cross(direction_cross(views[0], views[2]), direction_cross(views[1], views[3])));

    return meet.z < 0 ? direction{-meet.x, -meet.y, -meet.z} : meet;
}

/* Distance of the tag's centre, where its side is 1; 0 when no square looks so. */
static double distance_of(const direction *views)
{
    static const std::vector<cv::Point3d> square = {
        {-0.5, 0.5, 0}, {0.5, 0.5, 0}, {0.5, -0.5, 0}, {-0.5, -0.5, 0}};
    std::vector<cv::Point2d> seen(4);
    cv::Vec3d turn;
    cv::Vec3d place;

    for (int i = 0; i < 4; i++)
        seen[i] = {views[i].x / views[i].z, views[i].y / views[i].z};
    if (!cv::solvePnP(square, seen, cv::Matx33d::eye(), cv::noArray(), turn, place, false,
                      cv::SOLVEPNP_IPPE_SQUARE))
        return 0;
    return cv::norm(place);
}

/* Returns false when it is no square in space. */
static bool blob_of(const camera &eye, const corners &square, blob *found)
{
    direction views[4];

    for (int i = 0; i < 4; i++)
        views[i] = camera_direction(eye, {square[i].x, square[i].y});
    const double distance = distance_of(views);
    if (!(distance > 0.5))
        return false;
    const double sine = 0.5 / distance;
    *found = blob();
    found->cone.axis = centre_of(views);
    found->cone.cosine = std::sqrt(1 - sine * sine);
    found->cone.tangent = sine / found->cone.cosine;
    found->cone.support = OUTLINE_RAYS;
    found->pixel = camera_project(eye, found->cone.axis);
    found->radius = found->cone.tangent * eye.focal;
    found->coverage = found->fill = 1;
    found->score = found->radius;
    return std::isfinite(found->radius) && found->cone.axis.z > 0;
}

static cv::Mat grey_part(tag_finder *finder, const image_view &image, const image_region &part)
{
    const cv::Mat colours(part.bottom - part.top, part.right - part.left, CV_8UC3,
                          const_cast<uint8_t *>(image_pixel(image, part.left, part.top)),
                          image.stride);

    cv::cvtColor(colours, finder->grey,
                 image.order == PIXEL_RGB ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
    return finder->grey;
}

int tag_find(tag_finder *finder, const image_view &image, const camera &eye,
             const image_region &region, blob *blobs, refused_blob *refused, int *n_refused)
{
    const image_region part = image_clip(image, region);
    std::vector<corners> squares;
    std::vector<int> ids;
    int n = 0;

    *n_refused = 0;
    if (part.right - part.left < reach_most * 3 || part.bottom - part.top < reach_most * 3)
        return 0;
    cv::aruco::detectMarkers(grey_part(finder, image, part), finder->dictionary, squares, ids,
                             finder->parameters);
    for (size_t i = 0; i < ids.size(); i++) {
        blob found;
        refine(*finder, &squares[i]);
        for (cv::Point2f &corner : squares[i])
            corner += cv::Point2f(static_cast<float>(part.left), static_cast<float>(part.top));
        if (!blob_of(eye, squares[i], &found))
            continue;
        if (ids[i] == finder->config.id && n < SEGMENT_CANDIDATES)
            blobs[n++] = found;
        else if (ids[i] != finder->config.id && *n_refused < SEGMENT_REFUSED)
            refused[(*n_refused)++] = {BLOB_OTHER_TAG, found.pixel, found.radius};
    }
    std::stable_sort(blobs, blobs + n,
                     [](const blob &a, const blob &b) { return a.radius > b.radius; });
    return n;
}

cv::Mat tag_picture(const tag_config &config, int side)
{
    const cv::Ptr<cv::aruco::Dictionary> dictionary = dictionary_of(config.dictionary);
    const int margin = margin_cells * side / (dictionary->markerSize + 2);
    cv::Mat tag;
    cv::Mat framed;

#if CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR < 7
    dictionary->drawMarker(config.id, side, tag, 1);
#else
    dictionary->generateImageMarker(config.id, side, tag, 1);
#endif
    cv::copyMakeBorder(tag, framed, margin, margin, margin, margin, cv::BORDER_CONSTANT,
                       cv::Scalar(255));
    return framed;
}
