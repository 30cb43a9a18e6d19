#include "tools/pictures/ball.h"

#include <algorithm>
#include <cmath>

static const double pi = 3.14159265358979323846;
static const int supersampling = 4; /* rays along each side of a pixel */

double random_between(random_source *random, double low, double high)
{
    return low + (high - low) * static_cast<double>((*random)() >> 11) * 0x1p-53;
}

int random_whole(random_source *random, int n)
{
    return static_cast<int>(random_between(random, 0, n));
}

/* A direction of the half of the ball that is seen, no further than `most` (rad) from its middle.
 */
static direction seen_side(random_source *random, double most)
{
    const double away = random_between(random, 0, most);
    const double round = random_between(random, 0, 2 * pi);

    return {std::sin(away) * std::cos(round), std::sin(away) * std::sin(round), -std::cos(away)};
}

static direction any_direction(random_source *random)
{
    return seen_side(random, pi);
}

drawn_ball ball_plain(random_source *random, const cv::Vec3f &colour)
{
    drawn_ball ball = {};

    ball.colour = colour * random_between(random, 0.8, 1);
    ball.light =
        direction_normalised({random_between(random, -0.9, 0.9), random_between(random, -1, 0.1),
                              random_between(random, -1, -0.3)});
    ball.ambient = random_between(random, 0.35, 0.6);
    ball.exposure = random_between(random, 0.75, 1);
    return ball;
}

static cv::Vec3f ink(random_source *random)
{
    static const cv::Vec3f inks[] = {
        {0.07F, 0.06F, 0.06F}, {0.9F, 0.9F, 0.92F}, {0.35F, 0.1F, 0.1F}};

    return inks[random_whole(random, 3)];
}

void ball_add_prints(random_source *random, drawn_ball *ball)
{
    const cv::Vec3f colour = ink(random);
    const int kind = random_whole(random, 3);
    const int n = kind == 0 ? 1 + random_whole(random, 2) : kind == 1 ? 6 : 4;

    for (int i = 0; i < n; i++) {
        print one = {any_direction(random), 0, 0, {0, 0, 1}, -2, colour};
        if (kind == 0) { /* a line round the ball */
            const double at = random_between(random, -0.5, 0.5);
            const double half = random_between(random, 0.02, 0.08);
            one.low = at - half;
            one.high = at + half;
        } else if (kind == 1) { /* strokes of letters */
            one.low = -0.05;
            one.high = 0.05;
            one.side = seen_side(random, 1);
            one.side_min = std::cos(random_between(random, 0.25, 0.5));
        } else { /* round panels */
            one.towards = seen_side(random, 1.5);
            one.low = std::cos(random_between(random, 0.2, 0.4));
            one.high = 2;
        }
        ball->prints.push_back(one);
    }
}

void ball_add_glints(random_source *random, drawn_ball *ball)
{
    const int n = 3 + random_whole(random, 12);

    for (int i = 0; i < n; i++)
        ball->glints.push_back({seen_side(random, 1), std::pow(10, random_between(random, 1.8, 3)),
                                random_between(random, 0.7, 1.5)});
}

static cv::Vec3f surface(const drawn_ball &ball, const direction &normal)
{
    const double diffuse = std::max(0.0, direction_dot(normal, ball.light));
    cv::Vec3f colour = ball.colour;

    for (const print &one : ball.prints) {
        const double along = direction_dot(normal, one.towards);
        if (along > one.low && along < one.high && direction_dot(normal, one.side) > one.side_min)
            colour = one.colour;
    }
    colour *= ball.exposure * (ball.ambient + (1 - ball.ambient) * diffuse);
    for (const glint &one : ball.glints) {
        const double along = std::max(0.0, direction_dot(normal, one.towards));
        colour += cv::Vec3f::all(static_cast<float>(one.strength * std::pow(along, one.power)));
    }
    return colour;
}

/* A sphere at distance 1 along `axis`. Turned so that its nearest point has the normal (0, 0, -1).
 */
struct placed_ball {
    direction axis;
    direction right;
    direction down;
    double radius;
};

static placed_ball place(const drawn_ball &ball, const camera &eye)
{
    placed_ball at;

    at.axis = camera_direction(eye, ball.centre);
    at.right = direction_normalised(direction_cross({0, 1, 0}, at.axis));
    at.down = direction_cross(at.axis, at.right);
    at.radius = std::sin(std::atan(ball.radius / eye.focal));
    return at;
}

/* Returns false where the line of sight misses the ball. */
static bool hit(const placed_ball &at, const direction &view, direction *normal)
{
    const double along = direction_dot(at.axis, view);
    const double squared = at.radius * at.radius - 1 + along * along;

    if (squared < 0 || along < 0)
        return false;
    const double distance = along - std::sqrt(squared);
    const direction p = {(view.x * distance - at.axis.x) / at.radius,
                         (view.y * distance - at.axis.y) / at.radius,
                         (view.z * distance - at.axis.z) / at.radius};
    *normal = {direction_dot(p, at.right), direction_dot(p, at.down), direction_dot(p, at.axis)};
    return true;
}

static void draw_pixel(const drawn_ball &ball, const placed_ball &at, const camera &eye, int column,
                       int row, cv::Vec3f *pixel)
{
    cv::Vec3f sum = {0, 0, 0};
    int hits = 0;

    for (int i = 0; i < supersampling * supersampling; i++) {
        const double x = (i % supersampling + 0.5) / supersampling - 0.5;
        const int line = i / supersampling;
        const double y = (line + 0.5) / supersampling - 0.5;
        direction normal;
        if (!hit(at, camera_direction(eye, {column + x, row + y}), &normal))
            continue;
        sum += surface(ball, normal);
        hits++;
    }
    const float share = static_cast<float>(hits) / (supersampling * supersampling);
    if (hits > 0)
        *pixel = *pixel * (1 - share) + sum * (share / static_cast<float>(hits));
}

void ball_draw(const drawn_ball &ball, const camera &eye, cv::Mat *picture)
{
    const placed_ball at = place(ball, eye);
    const int reach = static_cast<int>(1.5 * ball.radius) + 4; /* distortion and perspective */
    const int column = static_cast<int>(ball.centre.column);
    const int row = static_cast<int>(ball.centre.row);

    for (int y = std::max(0, row - reach); y < std::min(eye.height, row + reach); y++)
        for (int x = std::max(0, column - reach); x < std::min(eye.width, column + reach); x++)
            draw_pixel(ball, at, eye, x, y, &picture->at<cv::Vec3f>(y, x));
}
