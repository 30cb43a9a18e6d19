#include "vision/ball/mask.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

/* Thinner than this, pixels of the mask, a part of a piece holds no ball. */
static const double thinnest = 1.5;

static void make_mask(mask_work *work, const image_view &image, const colour_table &colours)
{
    const image_region &region = work->region;
    const int step = work->step;
    const int rows = (region.bottom - region.top + step - 1) / step;
    const int columns = (region.right - region.left + step - 1) / step;
    const int red = image_red(image);

    work->mask.create(rows, columns, CV_8U);
    for (int i = 0; i < rows; i++) {
        const uint8_t *pixel = image_pixel(image, region.left, region.top + i * step);
        uint8_t *out = work->mask.ptr<uint8_t>(i);
        for (int j = 0; j < columns; j++, pixel += 3 * step)
            out[j] = colour_member(colours, pixel, red);
    }
}

static mask_piece piece_at(const mask_work &work, int label)
{
    const int *stats = work.stats.ptr<int>(label);
    const double *centroid = work.centroids.ptr<double>(label);
    const int step = work.step;

    return {{work.region.left + centroid[0] * step, work.region.top + centroid[1] * step},
            static_cast<double>(stats[cv::CC_STAT_WIDTH] * step),
            static_cast<double>(stats[cv::CC_STAT_HEIGHT] * step),
            static_cast<double>(stats[cv::CC_STAT_AREA]) * step * step,
            {stats[cv::CC_STAT_LEFT], stats[cv::CC_STAT_TOP], stats[cv::CC_STAT_WIDTH],
             stats[cv::CC_STAT_HEIGHT]}};
}

/* Puts the piece among the largest; returns how many there are now. */
static int insert(mask_piece *pieces, int n, const mask_piece &piece)
{
    int place = n;

    while (place > 0 && pieces[place - 1].area < piece.area) {
        if (place < MASK_PIECES)
            pieces[place] = pieces[place - 1];
        place--;
    }
    if (place < MASK_PIECES)
        pieces[place] = piece;
    return std::min(n + 1, static_cast<int>(MASK_PIECES));
}

int mask_find(mask_work *work, const image_view &image, const colour_table &colours,
              const image_region &region, int step, double area_min, double side_max,
              mask_piece *pieces)
{
    int n = 0;

    work->region = region;
    work->step = step;
    work->left_out = mask_piece();
    make_mask(work, image, colours);
    const int labels = cv::connectedComponentsWithStats(work->mask, work->labels, work->stats,
                                                        work->centroids, 4, CV_16U, cv::CCL_WU);
    for (int label = 1; label < labels; label++) {
        const mask_piece piece = piece_at(*work, label);
        if (piece.area >= area_min && piece.width <= side_max && piece.height <= side_max)
            n = insert(pieces, n, piece);
        else if (piece.area > work->left_out.area)
            work->left_out = piece;
    }
    return n;
}

int mask_starts(mask_work *work, const mask_piece &piece, pixel_point *starts)
{
    double thickness = 0;
    cv::Point at;
    int n = 0;

    /* A frame of one pixel, so that what the picture's border cuts is not taken for thick. */
    cv::copyMakeBorder(work->mask(piece.box), work->closed, 1, 1, 1, 1,
                       cv::BORDER_CONSTANT | cv::BORDER_ISOLATED, cv::Scalar(0));
    cv::morphologyEx(work->closed, work->closed, cv::MORPH_CLOSE, cv::Mat());
    cv::distanceTransform(work->closed, work->depth, cv::DIST_L2, 3, CV_32F);
    while (n < MASK_STARTS) {
        cv::minMaxLoc(work->depth, nullptr, &thickness, nullptr, &at);
        if (thickness < thinnest)
            break;
        starts[n++] = {work->region.left + (piece.box.x + at.x - 1.0) * work->step,
                       work->region.top + (piece.box.y + at.y - 1.0) * work->step};
        cv::circle(work->depth, at, static_cast<int>(thickness), cv::Scalar(0), cv::FILLED);
    }
    return n;
}
