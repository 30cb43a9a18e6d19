#include "vision/colour/learner.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

#include "common/program/log.h"
#include "vision/colour/seeds.h"
#include "vision/pictures/image_file.h"

static const int64_t enough_time = 5000000; /* us of pairs */
static const int64_t between = 120000;      /* us: of all pictures so many are enough */
static const size_t most_pictures = 64;
static const int kept_side = 1280;       /* px: larger pictures are made smaller */
static const int most_side = 4096;       /* px */
static const double much_clutter = 0.01; /* of the picture beside the ball */
static const double degree = 3.14159265358979323846 / 180;

void colour_learner::refuse(const char *reason)
{
    if (refused_++ == 0)
        log_warning("picture dropped: %s", reason);
}

bool colour_learner::done() const
{
    return since_ > 0 && utime_ - since_ >= enough_time;
}

const cv::Mat &colour_learner::newest() const
{
    static const cv::Mat none;

    return pictures_.empty() ? none : pictures_.back();
}

void colour_learner::point(const pixel_point &at)
{
    point_ = at;
    has_point_ = true;
    pointed_ = pictures_.empty() ? 0 : pictures_.size() - 1;
    since_ = utime_;
}

/* Whatever size the picture has: only its colours count. */
void colour_learner::keep(decoder *eye, const encoded_image &image, std::vector<cv::Mat> *pictures)
{
    camera any = {image.width, image.height, 1, 0, 0, 0, 0};
    image_view view;

    if (image.width > most_side || image.height > most_side)
        return refuse("more than 4096 pixels along a side");
    const char *wrong = eye->decode(image, any, &view);
    if (wrong)
        return refuse(wrong);
    const cv::Mat seen(view.height, view.width, CV_8UC3, const_cast<uint8_t *>(view.data),
                       view.stride);
    const double scale =
        std::min(1.0, static_cast<double>(kept_side) / std::max(view.width, view.height));
    cv::Mat copy;
    cv::resize(seen, copy, {}, scale, scale, cv::INTER_AREA);
    if (view.order == PIXEL_RGB)
        cv::cvtColor(copy, copy, cv::COLOR_RGB2BGR);
    if (pictures_.empty())
        point_ = {point_.column * scale, point_.row * scale};
    if (pictures->empty() || copy.size() == pictures->front().size())
        pictures->push_back(copy);
}

void colour_learner::take(const incoming_pair &pair)
{
    utime_ = pair.images.utime;
    since_ = since_ > 0 && since_ <= utime_ ? since_ : utime_;
    if (pictures_.size() >= most_pictures || (!pictures_.empty() && utime_ - kept_ < between))
        return;
    kept_ = utime_;
    keep(&right_, pair.images.right, &pictures_);
    if (pair.images.left.data != pair.images.right.data)
        keep(&left_, pair.images.left, &left_ones_);
}

/* With the point's colour, the ball that holds the point. */
bool colour_learner::follow_point(std::vector<colour_sighting> *sightings) const
{
    colour_range range;
    colour_hsv colour;

    if (!seed_at(pictures_[pointed_], point_, &range, &colour)) {
        log_error(
            "column %.0f, row %.0f is white, grey or black (saturation %.2f, value %.2f): such "
            "a ball has no hue and cannot be found; take one of a bright colour",
            point_.column, point_.row, colour.saturation, colour.value);
        return false;
    }
    std::vector<colour_sighting> there = evidence_follow({pictures_[pointed_]}, range);
    if (!evidence_holds(there, 0, point_)) {
        log_error(
            "nothing round of the colour at column %.0f, row %.0f (hue %.0f deg): is the ball "
            "there, whole and sharp?",
            point_.column, point_.row, colour.hue / degree);
        return false;
    }
    *sightings = evidence_follow(pictures_, range);
    if (evidence_holds(*sightings, pointed_, point_))
        return true;
    there[0].picture = pointed_; /* it rests, or another thing moves: what was pointed at counts */
    *sightings = there;
    return true;
}

bool colour_learner::follow(std::vector<colour_sighting> *sightings) const
{
    double best = 0;

    if (has_point_)
        return follow_point(sightings);
    for (const colour_range &seed : seeds_that_move(pictures_)) {
        const std::vector<colour_sighting> found = evidence_follow(pictures_, seed);
        const double weight = evidence_weight(found);
        if (weight > best) {
            best = weight;
            *sightings = found;
        }
    }
    if (best > 0)
        return true;
    log_error(
        "no %sround thing with a colour in %zu pictures: move the ball, or point at it (--at, "
        "--show); a white, grey or black ball has no hue and cannot be found",
        pictures_.size() > 1 ? "moving " : "", pictures_.size());
    return false;
}

/* From both eyes, whose cameras may see colours differently. */
bool colour_learner::learn(const std::vector<colour_sighting> &sightings, colour_range *range) const
{
    std::vector<colour_hsv> pixels;

    evidence_pixels(pictures_, sightings, &pixels);
    if (!evidence_range(pixels, range))
        return false;
    evidence_pixels(left_ones_, evidence_follow(left_ones_, *range), &pixels);
    return evidence_range(pixels, range);
}

static bool draw(const cv::Mat &picture, const blob &ball, const colour_range &range,
                 const char *path)
{
    const colour_table colours = colour_table_create(range);
    cv::Mat drawn = picture.clone();

    for (int row = 0; row < drawn.rows; row++)
        for (int column = 0; column < drawn.cols; column++)
            if (!colour_member(colours, picture.ptr(row, column), 2))
                drawn.at<cv::Vec3b>(row, column) /= 3;
    cv::circle(drawn, {static_cast<int>(ball.pixel.column), static_cast<int>(ball.pixel.row)},
               static_cast<int>(ball.radius), cv::Scalar(255, 255, 255), 1, cv::LINE_AA);
    return image_file_write(path, drawn);
}

int colour_learner::finish(FILE *out, const char *drawing)
{
    std::vector<colour_sighting> sightings;
    colour_range range;

    if (pictures_.empty()) {
        log_error("no picture came");
        return -1;
    }
    if (!follow(&sightings))
        return -1;
    if (!learn(sightings, &range)) {
        log_error(
            "the ball shows too few pixels with a colour: hold it nearer, and not into the sun");
        return -1;
    }
    const double clutter = evidence_clutter(pictures_, sightings, range);
    if (clutter > much_clutter)
        log_warning(
            "%.1f %% of the pictures beside the ball have its colour, too: take away what has "
            "it, or take a ball of another colour",
            100 * clutter);
    fprintf(out, "# from %zu of %zu pictures; %.2f %% of what is beside the ball has its colour\n",
            sightings.size(), pictures_.size(), 100 * clutter);
    fprintf(out, "ball: {hue: %.1f, hue_tolerance: %.1f, saturation_min: %.2f, value_min: %.2f}\n",
            range.hue / degree, range.hue_tolerance / degree, range.saturation_min,
            range.value_min);
    if (!drawing ||
        draw(pictures_[sightings.back().picture], sightings.back().ball, range, drawing))
        return 0;
    log_error("%s cannot be written", drawing);
    return -1;
}
