#include "vision/rig/calibrate.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

#include "common/program/log.h"
#include "vision/ball/edges.h"
#include "vision/pictures/image_file.h"
#include "vision/rig/rig_file.h"

static const int64_t enough_time = 30000000; /* us of pairs */
static const int64_t tell_period = 5000000;  /* us of pairs */
static const double moved_least = 4;         /* px: a ball at rest tells nothing more */
static const double size_most = 1.4;         /* times, between the eyes */
static const size_t settle_after = 12;       /* sightings */
static const double settled_within = 0.002;  /* of the aspect */
static const double spread_least = 0.12; /* of the picture's width and height: rms about the mean */
static const double degree = 3.14159265358979323846 / 180;

rig_calibrator::rig_calibrator(const eyes_config &config) : config_(config)
{
    work_.range = config.colour;
    work_.colours = colour_table_create(config.colour);
    work_.limits = config.limits;
}

void rig_calibrator::refuse(const char *reason)
{
    if (refused_++ == 0)
        log_warning("image message dropped: %s", reason);
}

bool rig_calibrator::done() const
{
    return first_utime_ > 0 && utime_ - first_utime_ >= enough_time;
}

bool rig_calibrator::find(const image_view &image, const camera &eye, blob *found)
{
    blob blobs[SEGMENT_CANDIDATES];

    if (segment_find(&work_, image, eye, image_whole(image), config_.whole_step, blobs) == 0)
        return false;
    *found = blobs[0];
    return true;
}

/* The edge once more, as pixels: what they mean as directions is still to be found. */
static seen_edge edge_of(const segmenter &work, const image_view &image, const camera &eye,
                         const blob &found)
{
    seen_edge edge = {found.cone, {}};
    outline_points points;

    edges_fine(image, work.colours, eye, found.cone, &points);
    for (int i = 0; i < OUTLINE_RAYS; i++)
        if (points.valid[i])
            edge.points.push_back(camera_project(eye, points.view[i]));
    return edge;
}

/* Edges are sought near a round outline, and found a little nearer to it than they are. So the
 * first sightings only tell with which aspect to look. */
void rig_calibrator::settle_aspect()
{
    stereo_rig &rig = config_.rig;

    if (settled_ || sightings_.size() < settle_after)
        return;
    const double aspect = rig_find_aspect(rig, &sightings_);
    settled_ = std::fabs(aspect - rig.left.aspect) <= settled_within * aspect;
    rig.left.aspect = rig.right.aspect = aspect;
    if (!settled_)
        sightings_.clear();
}

void rig_calibrator::take(const incoming_pair &pair)
{
    const stereo_rig &rig = config_.rig;
    image_view left;
    image_view right;
    blob in_left;
    blob in_right;

    pairs_++;
    utime_ = pair.images.utime;
    first_utime_ = first_utime_ > 0 && first_utime_ <= utime_ ? first_utime_ : utime_;
    const char *wrong = right_.decode(pair.images.right, rig.right, &right);
    wrong = wrong ? wrong : left_.decode(pair.images.left, rig.left, &left);
    if (wrong)
        return refuse(wrong);
    if (!find(right, rig.right, &in_right) || !find(left, rig.left, &in_left) ||
        std::max(in_left.radius, in_right.radius) >
            size_most * std::min(in_left.radius, in_right.radius) ||
        std::hypot(in_right.pixel.column - newest_.column, in_right.pixel.row - newest_.row) <
            moved_least)
        return;
    newest_ = in_right.pixel;
    sightings_.push_back({edge_of(work_, left, rig.left, in_left),
                          edge_of(work_, right, rig.right, in_right), 0, true});
    settle_aspect();
    if (utime_ - told_ >= tell_period) {
        told_ = utime_;
        log_info("%zu sightings; go on moving the ball to every part of the pictures, near and far",
                 sightings_.size());
    }
}

/* Whether the ball was in enough of the picture, right eye. */
static bool spread(const camera &eye, const std::vector<sighting> &sightings)
{
    std::vector<double> columns;
    std::vector<double> rows;
    cv::Scalar mean;
    cv::Scalar column_spread;
    cv::Scalar row_spread;

    for (const sighting &one : sightings) {
        const pixel_point at = camera_project(eye, one.right.cone.axis);
        columns.push_back(at.column / eye.width);
        rows.push_back(at.row / eye.height);
    }
    cv::meanStdDev(columns, mean, column_spread);
    cv::meanStdDev(rows, mean, row_spread);
    return std::min(column_spread[0], row_spread[0]) >= spread_least;
}

static void draw_eye(const camera &eye, const outline &cone, const sighting &one, int aside,
                     cv::Mat *picture)
{
    const pixel_point at = camera_project(eye, cone.axis);
    const cv::Point centre(static_cast<int>(at.column) + aside, static_cast<int>(at.row));
    const cv::Scalar colour = one.used ? cv::Scalar(0, 200, 0) : cv::Scalar(0, 0, 255);

    cv::circle(*picture, centre, static_cast<int>(cone.tangent * eye.focal), colour, 1,
               cv::LINE_AA);
    cv::line(*picture, centre, centre + cv::Point(0, static_cast<int>(20 * one.height)), colour, 2);
}

/* Lines show twenty times the difference of heights that is left. */
static bool draw(const stereo_rig &rig, const std::vector<sighting> &sightings, const char *path)
{
    cv::Mat picture(rig.left.height, 2 * rig.left.width, CV_8UC3, cv::Scalar::all(255));

    for (const sighting &one : sightings) {
        draw_eye(rig.left, one.left.cone, one, 0, &picture);
        draw_eye(rig.right, one.right.cone, one, rig.left.width, &picture);
    }
    return image_file_write(path, picture);
}

static void tell(const solution &found, size_t sightings)
{
    const camera &left = found.rig.left;
    const camera &right = found.rig.right;

    log_info("%d of %zu sightings agree; the eyes' heights differed by %.2f px rms, now by %.2f",
             found.used, sightings, found.before, found.after);
    log_info("aspect %.4f; left pitch %.2f roll %.2f deg, right pitch %.2f roll %.2f deg",
             left.aspect, left.pitch / degree, left.roll / degree, right.pitch / degree,
             right.roll / degree);
}

int rig_calibrator::finish(const char *path, const char *drawing)
{
    solution found;
    char comment[128];

    if (!rig_solve(config_.rig, &sightings_, &found)) {
        log_error("only %zu of %d pairs show the ball in both eyes, or too few of them agree: see "
                  "with --show whether it is found, and move it for 30 s",
                  sightings_.size(), pairs_);
        return -1;
    }
    if (!spread(found.rig.right, sightings_))
        log_warning(
            "the ball was in a small part of the pictures: the result may not hold elsewhere");
    tell(found, sightings_.size());
    if (drawing && !draw(found.rig, sightings_, drawing)) {
        log_error("%s cannot be written", drawing);
        return -1;
    }
    snprintf(comment, sizeof comment, "from %d sightings of the ball; heights agree to %.2f px rms",
             found.used, found.after);
    return rig_save(found.rig, comment, path);
}
