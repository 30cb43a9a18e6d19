#include "vision/ball/outline.h"

#include <opencv2/core.hpp>

#include <cmath>

static const int least_support = 12; /* of OUTLINE_RAYS: with fewer a fit means nothing */
static const int refine_rounds = 3;
static const int consensus_stride = 3;
static const double agreed_share = 0.95; /* of the points: no better cone is looked for */

/* The cone of m = axis / cos. No cone has |m| <= 1. */
static bool cone_of(const direction &m, outline *cone)
{
    const double squared = direction_dot(m, m);

    if (!(squared > 1 + 1e-8) || !std::isfinite(squared))
        return false;
    cone->axis = direction_normalised(m);
    cone->cosine = 1 / std::sqrt(squared);
    cone->tangent = std::sqrt(squared - 1);
    cone->wide_cosine = cone->wide_sine = 0;
    return true;
}

outline_frame outline_axes(const direction &axis)
{
    const direction right = direction_normalised(direction_cross({0, 1, 0}, axis));

    return {right, direction_cross(axis, right)};
}

double outline_stretch(const outline &cone)
{
    return std::sqrt(cone.wide_cosine * cone.wide_cosine + cone.wide_sine * cone.wide_sine);
}

/* Cosine and sine of twice the angle of a direction about the axis. */
static pixel_point twice_angle(const outline_frame &frame, const direction &view)
{
    const double x = direction_dot(frame.right, view);
    const double y = direction_dot(frame.down, view);
    const double squared = x * x + y * y;

    return {(x * x - y * y) / squared, 2 * x * y / squared};
}

double outline_distance(const outline &cone, const direction &view, double focal)
{
    /* cos(angle) / cos(half) - 1 is, to first order, tan(half) (half - angle). */
    const double distance =
        (1 - direction_dot(cone.axis, view) / cone.cosine) / cone.tangent * focal;

    if (cone.wide_cosine == 0 && cone.wide_sine == 0)
        return distance;
    const pixel_point twice = twice_angle(outline_axes(cone.axis), view);
    return distance -
           focal * cone.tangent * (cone.wide_cosine * twice.column + cone.wide_sine * twice.row);
}

static direction minus(const direction &a, const direction &b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

bool outline_through(const direction &a, const direction &b, const direction &c, outline *cone)
{
    const direction normal = direction_cross(minus(b, a), minus(c, a));
    const double height = direction_dot(normal, a);

    if (std::fabs(height) < 1e-12)
        return false;
    return cone_of({normal.x / height, normal.y / height, normal.z / height}, cone);
}

static void count_support(const outline_points &points, double focal, double tolerance,
                          outline *cone)
{
    double sum = 0;

    cone->support = 0;
    for (int i = 0; i < OUTLINE_RAYS; i++) {
        if (!points.valid[i])
            continue;
        const double distance = outline_distance(*cone, points.view[i], focal);
        if (std::fabs(distance) <= tolerance) {
            cone->support++;
            sum += distance * distance;
        }
    }
    cone->rms = cone->support ? std::sqrt(sum / cone->support) : 0;
}

/* The valid directions side by side, in single precision: enough to count with, and what the
 * compiler can count four at a time. */
struct packed_views {
    float x[OUTLINE_RAYS];
    float y[OUTLINE_RAYS];
    float z[OUTLINE_RAYS];
    int n;
};

static packed_views pack(const outline_points &points)
{
    packed_views packed;

    packed.n = 0;
    for (int i = 0; i < OUTLINE_RAYS; i++) {
        if (!points.valid[i])
            continue;
        packed.x[packed.n] = static_cast<float>(points.view[i].x);
        packed.y[packed.n] = static_cast<float>(points.view[i].y);
        packed.z[packed.n] = static_cast<float>(points.view[i].z);
        packed.n++;
    }
    return packed;
}

static int count_near(const packed_views &views, double focal, double tolerance,
                      const outline &cone)
{
    const float x = static_cast<float>(cone.axis.x);
    const float y = static_cast<float>(cone.axis.y);
    const float z = static_cast<float>(cone.axis.z);
    const float cosine = static_cast<float>(cone.cosine);
    const float limit = static_cast<float>(tolerance / focal * cone.tangent * cone.cosine);
    int near = 0;

    for (int i = 0; i < views.n; i++) {
        const float off = x * views.x[i] + y * views.y[i] + z * views.z[i] - cosine;
        near += off <= limit && off >= -limit;
    }
    return near;
}

bool outline_consensus(const outline_points &points, double focal, double tolerance, outline *cone)
{
    static const int spans[] = {OUTLINE_RAYS / 3, OUTLINE_RAYS / 4, OUTLINE_RAYS / 6};
    const packed_views views = pack(points);
    const int enough = static_cast<int>(agreed_share * views.n);
    int best = 0;

    for (int span : spans)
        for (int i = 0; i < OUTLINE_RAYS && best <= enough; i += consensus_stride) {
            const int j = (i + span) % OUTLINE_RAYS;
            const int k = (j + span) % OUTLINE_RAYS;
            outline trial;
            if (!points.valid[i] || !points.valid[j] || !points.valid[k] ||
                !outline_through(points.view[i], points.view[j], points.view[k], &trial))
                continue;
            const int near = count_near(views, focal, tolerance, trial);
            if (near > best) {
                *cone = trial;
                best = near;
            }
        }
    if (best > 0)
        count_support(points, focal, tolerance, cone);
    return best > 0;
}

static bool agrees(const outline_points &points, int i, const outline &cone, double focal,
                   double tolerance)
{
    return points.valid[i] && std::fabs(outline_distance(cone, points.view[i], focal)) <= tolerance;
}

/* Sums of the normal equations of m . d = 1. */
struct normal_equations {
    direction row_x, row_y, row_z; /* sum of d d' */
    direction right;               /* sum of d */
};

static void accumulate(normal_equations *sums, const direction &d)
{
    sums->row_x.x += d.x * d.x;
    sums->row_x.y += d.x * d.y;
    sums->row_x.z += d.x * d.z;
    sums->row_y.y += d.y * d.y;
    sums->row_y.z += d.y * d.z;
    sums->row_z.z += d.z * d.z;
    sums->right.x += d.x;
    sums->right.y += d.y;
    sums->right.z += d.z;
}

/* Cramer's rule; good enough since the frame below keeps the columns apart. */
static bool solve(normal_equations sums, direction *m)
{
    sums.row_y.x = sums.row_x.y;
    sums.row_z.x = sums.row_x.z;
    sums.row_z.y = sums.row_y.z;
    const direction yz = direction_cross(sums.row_y, sums.row_z);
    const direction zx = direction_cross(sums.row_z, sums.row_x);
    const direction xy = direction_cross(sums.row_x, sums.row_y);
    const double determinant = direction_dot(sums.row_x, yz);

    if (!(std::fabs(determinant) > 1e-15))
        return false;
    *m = {(yz.x * sums.right.x + zx.x * sums.right.y + xy.x * sums.right.z) / determinant,
          (yz.y * sums.right.x + zx.y * sums.right.y + xy.y * sums.right.z) / determinant,
          (yz.z * sums.right.x + zx.z * sums.right.y + xy.z * sums.right.z) / determinant};
    return true;
}

/* Least squares in a frame whose z is the present axis, where the small angles do not cancel. */
static bool fit(const outline_points &points, double focal, double tolerance, outline *cone)
{
    const direction z = cone->axis;
    const direction across = std::fabs(z.x) < 0.7 ? direction{1, 0, 0} : direction{0, 1, 0};
    const direction x = direction_normalised(direction_cross(across, z));
    const direction y = direction_cross(z, x);
    normal_equations sums = {};
    direction m;
    int n = 0;

    for (int i = 0; i < OUTLINE_RAYS; i++) {
        const direction &d = points.view[i];
        if (!agrees(points, i, *cone, focal, tolerance))
            continue;
        accumulate(&sums, {direction_dot(d, x), direction_dot(d, y), direction_dot(d, z)});
        n++;
    }
    if (n < least_support || !solve(sums, &m))
        return false;
    return cone_of({x.x * m.x + y.x * m.y + z.x * m.z, x.y * m.x + y.y * m.y + z.y * m.z,
                    x.z * m.x + y.z * m.y + z.z * m.z},
                   cone);
}

/* As fit, with the stretch: 1 = m . d + tangent^2 (wide_cosine cos 2a + wide_sine sin 2a). */
static bool fit_stretched(const outline_points &points, double focal, double tolerance,
                          outline *cone)
{
    const outline_frame frame = outline_axes(cone->axis);
    const double scale = 1 / cone->tangent; /* keeps the columns alike */
    cv::Matx<double, 5, 5> normal = cv::Matx<double, 5, 5>::zeros();
    cv::Vec<double, 5> right = cv::Vec<double, 5>::all(0);
    int n = 0;

    for (int i = 0; i < OUTLINE_RAYS; i++) {
        const direction &d = points.view[i];
        if (!agrees(points, i, *cone, focal, tolerance))
            continue;
        const pixel_point twice = twice_angle(frame, d);
        const cv::Vec<double, 5> row(direction_dot(d, frame.right) * scale,
                                     direction_dot(d, frame.down) * scale,
                                     direction_dot(d, cone->axis), twice.column, twice.row);
        normal += row * row.t();
        right += row;
        n++;
    }
    if (n < 2 * least_support)
        return false;
    const cv::Vec<double, 5> p = normal.solve(right, cv::DECOMP_CHOLESKY);
    const direction &z = cone->axis, &x = frame.right, &y = frame.down;
    const double mx = p[0] * scale, my = p[1] * scale;
    if (!cone_of({x.x * mx + y.x * my + z.x * p[2], x.y * mx + y.y * my + z.y * p[2],
                  x.z * mx + y.z * my + z.z * p[2]},
                 cone))
        return false;
    cone->wide_cosine = p[3] / (cone->tangent * cone->tangent);
    cone->wide_sine = p[4] / (cone->tangent * cone->tangent);
    return outline_stretch(*cone) < 0.5;
}

typedef bool (*fit_function)(const outline_points &, double, double, outline *);

static bool refine(fit_function step, const outline_points &points, double focal, double tolerance,
                   double tolerance_min, outline *cone)
{
    outline trial = *cone;

    for (int round = 0; round < refine_rounds; round++) {
        if (!step(points, focal, tolerance, &trial))
            return false;
        count_support(points, focal, tolerance, &trial);
        if (trial.support < least_support)
            return false;
        tolerance = std::fmin(tolerance, std::fmax(3 * trial.rms, tolerance_min));
    }
    count_support(points, focal, tolerance, &trial);
    *cone = trial;
    return true;
}

bool outline_refine(const outline_points &points, double focal, double tolerance,
                    double tolerance_min, outline *cone)
{
    return refine(fit, points, focal, tolerance, tolerance_min, cone);
}

bool outline_refine_stretched(const outline_points &points, double focal, double tolerance,
                              double tolerance_min, outline *cone)
{
    return refine(fit_stretched, points, focal, tolerance, tolerance_min, cone);
}
