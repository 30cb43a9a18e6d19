#include "vision/ball/stereo.h"

#include <algorithm>
#include <cmath>

static const double height_share = 0.02; /* of the ball's radius */

const char *stereo_reason_text(stereo_reason reason)
{
    static const char *const texts[STEREO_REASONS] = {
        "seen",
        "not in the right image",
        "not in the left image",
        "heights differ (check.height)",
        "sizes differ (check.size, ball.radius)",
        "disparity out of range (check.disparity_min, check.disparity_max)",
        "images unusable"};

    return texts[reason];
}

/* A line of sight in the frame between the eyes: slopes to the right and down. */
struct slopes {
    double across;
    double down;
    double stretch; /* length of (across, down, 1) */
};

/* `turn` is how far the eye looks to the right of that frame's z; rad. */
static slopes turned(const direction &view, double turn)
{
    const double cosine = std::cos(turn);
    const double sine = std::sin(turn);
    const double z = cosine * view.z - sine * view.x;
    const double across = (cosine * view.x + sine * view.z) / z;
    const double down = view.y / z;

    return {across, down, std::sqrt(1 + across * across + down * down)};
}

static double pinhole_u(const camera &eye, const direction &view)
{
    return eye.focal * view.x / view.z;
}

static double pinhole_v(const camera &eye, const direction &view)
{
    return eye.focal * view.y / view.z;
}

static bool differ(double a, double b, double tolerance)
{
    return !(std::fabs(a - b) <= tolerance * std::min(a, b));
}

/* The ball's radius for a depth of 1: both eyes must find the same, however near each is. */
static double relative_size(const blob &found, const slopes &sight)
{
    return found.cone.tangent * found.cone.cosine * sight.stretch;
}

/* Both lines of sight to one thing, in the axes of the ideal eyes. */
struct sights {
    direction left;
    direction right;
};

static sights sights_of(const stereo_rig &rig, const blob &left, const blob &right)
{
    return {camera_upright(rig.left, left.cone.axis), camera_upright(rig.right, right.cone.axis)};
}

/* Two findings in the frame between the eyes. */
struct views {
    sights seen;
    slopes from_left;
    slopes from_right;
    double closing; /* baseline / depth */
    double left_size;
    double right_size;
};

static views views_of(const stereo_rig &rig, const blob &left, const blob &right)
{
    const sights seen = sights_of(rig, left, right);
    const slopes from_left = turned(seen.left, rig.vergence / 2);
    const slopes from_right = turned(seen.right, -rig.vergence / 2);

    return {seen,
            from_left,
            from_right,
            from_left.across - from_right.across,
            relative_size(left, from_left),
            relative_size(right, from_right)};
}

/* The ball's true radius, where the lines of sight meet ahead; m. */
static double true_radius(const stereo_rig &rig, const views &both)
{
    return (both.left_size + both.right_size) / 2 * rig.baseline / both.closing;
}

double stereo_height(const stereo_rig &rig, const direction &left, const direction &right)
{
    const slopes from_left = turned(camera_upright(rig.left, left), rig.vergence / 2);
    const slopes from_right = turned(camera_upright(rig.right, right), -rig.vergence / 2);

    return (from_right.down - from_left.down) * rig.right.focal;
}

/* A large ball is located less well, in pixels: it is seen less sharp, and less round. */
static double height_limit(const stereo_rig &rig, const blob &left, const blob &right)
{
    return std::max(rig.height_tolerance, height_share * rig.right.focal *
                                              std::max(left.cone.tangent, right.cone.tangent));
}

stereo_reason stereo_check(const stereo_rig &rig, const blob &left, const blob &right)
{
    const views both = views_of(rig, left, right);
    const double height = both.from_left.down - both.from_right.down;
    const double disparity =
        pinhole_u(rig.left, both.seen.left) - pinhole_u(rig.right, both.seen.right);

    if (!(std::fabs(height) * rig.right.focal <= height_limit(rig, left, right)))
        return STEREO_HEIGHTS_DIFFER;
    if (differ(both.left_size, both.right_size, rig.size_tolerance))
        return STEREO_SIZES_DIFFER;
    if (!(disparity >= rig.disparity_min && disparity <= rig.disparity_max))
        return STEREO_DISPARITY_RANGE;
    if (rig.ball_radius > 0) {
        if (!(both.closing > 0))
            return STEREO_DISPARITY_RANGE;
        if (differ(true_radius(rig, both), rig.ball_radius, rig.size_tolerance))
            return STEREO_SIZES_DIFFER;
    }
    return STEREO_SEEN;
}

/* What two findings would mean if they were one ball. */
static void interpret(const stereo_rig &rig, const blob &left, const blob &right,
                      stereo_marker *marker)
{
    const views both = views_of(rig, left, right);

    marker->meets_behind = both.closing < 0;
    if (both.closing > 0)
        marker->true_radius = true_radius(rig, both);
}

static stereo_marker marker_of(const stereo_rig &rig, const blob &left, const blob &right)
{
    const sights seen = sights_of(rig, left, right);
    stereo_marker marker;

    marker.reason = STEREO_SEEN;
    marker.u_right = pinhole_u(rig.right, seen.right);
    marker.v_right = pinhole_v(rig.right, seen.right);
    marker.disparity = pinhole_u(rig.left, seen.left) - marker.u_right;
    marker.radius = right.radius;
    return marker;
}

stereo_marker stereo_match(const stereo_rig &rig, const blob *left, int n_left, const blob *right,
                           int n_right, int *left_index, int *right_index)
{
    stereo_marker marker;
    double best = -1;
    bool seen = false;

    marker.reason = n_right == 0 ? STEREO_NOT_IN_RIGHT : STEREO_NOT_IN_LEFT;
    for (int i = 0; i < n_left; i++)
        for (int j = 0; j < n_right; j++) {
            const stereo_reason reason = stereo_check(rig, left[i], right[j]);
            const double score = left[i].score * right[j].score;
            if ((reason == STEREO_SEEN) < seen ||
                ((reason == STEREO_SEEN) == seen && score <= best))
                continue;
            seen = reason == STEREO_SEEN;
            best = score;
            marker = seen ? marker_of(rig, left[i], right[j]) : stereo_marker();
            marker.reason = reason;
            interpret(rig, left[i], right[j], &marker);
            if (!seen)
                continue;
            *left_index = i;
            *right_index = j;
        }
    return marker;
}
