#include "vision/rig/solve.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

static const size_t least_sightings = 30;
static const double degree = 3.14159265358979323846 / 180;
static const double aspect_low = 0.8, aspect_high = 1.25;
static const int aspect_steps = 24;
static const double edge_share = 0.08; /* of the radius: what aspect can move an edge by */
static const double edge_least = 2;    /* px */
static const int turn_rounds = 12;
static const double outlier = 4;         /* times the median */
static const double outlier_least = 0.3; /* px */

/* The unknown turns; the eyes share the pitch, since to turn both alike tells nothing. */
enum { TURN_PITCH, TURN_LEFT_ROLL, TURN_RIGHT_ROLL, TURN_YAW, TURNS };
/* How far they may lie from what was configured, and what one sighting is exact to. */
static const double turn_prior[TURNS] = {6 * degree, 6 * degree, 6 * degree, 1 * degree};
static const double height_deviation = 0.1; /* px */

/* Fits the cone anew; returns the squares of what it leaves, px^2. */
static double fit_cone(const camera &eye, seen_edge *edge)
{
    const double tolerance = std::max(edge_least, edge_share * edge->cone.tangent * eye.focal);
    outline_points points = {};

    for (size_t i = 0; i < edge->points.size() && i < OUTLINE_RAYS; i++) {
        points.view[i] = camera_direction(eye, edge->points[i]);
        points.valid[i] = true;
    }
    outline cone = edge->cone;
    if (!outline_refine(points, eye.focal, tolerance, tolerance, &cone))
        return static_cast<double>(edge->points.size()) * tolerance * tolerance;
    edge->cone = cone;
    return cone.support * cone.rms * cone.rms +
           (static_cast<double>(edge->points.size()) - cone.support) * tolerance * tolerance;
}

static double roundness(stereo_rig rig, double aspect, std::vector<sighting> *sightings)
{
    double squares = 0;

    rig.left.aspect = rig.right.aspect = aspect;
    for (sighting &one : *sightings)
        squares += fit_cone(rig.left, &one.left) + fit_cone(rig.right, &one.right);
    return squares;
}

/* Golden section. */
double rig_find_aspect(const stereo_rig &rig, std::vector<sighting> *sightings)
{
    const double share = 0.6180339887498949;
    double low = aspect_low, high = aspect_high;
    double a = high - share * (high - low), b = low + share * (high - low);
    double at_a = roundness(rig, a, sightings), at_b = roundness(rig, b, sightings);

    for (int i = 0; i < aspect_steps; i++) {
        if (at_a < at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - share * (high - low);
            at_a = roundness(rig, a, sightings);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + share * (high - low);
            at_b = roundness(rig, b, sightings);
        }
    }
    return (low + high) / 2;
}

static stereo_rig turned(stereo_rig rig, const cv::Vec<double, TURNS> &turn)
{
    rig.left.pitch += turn[TURN_PITCH] / 2;
    rig.right.pitch -= turn[TURN_PITCH] / 2;
    rig.left.roll += turn[TURN_LEFT_ROLL];
    rig.right.roll += turn[TURN_RIGHT_ROLL];
    rig.left.yaw += turn[TURN_YAW];
    rig.right.yaw += turn[TURN_YAW];
    return rig;
}

static double median_height(const std::vector<sighting> &sightings)
{
    std::vector<double> all;

    all.reserve(sightings.size());
    for (const sighting &one : sightings)
        all.push_back(std::fabs(one.height));
    const auto middle = all.begin() + static_cast<long>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}

static void measure(const stereo_rig &rig, std::vector<sighting> *sightings)
{
    for (sighting &one : *sightings)
        one.height = stereo_height(rig, one.left.cone.axis, one.right.cone.axis);
    const double limit = std::max(outlier_least, outlier * median_height(*sightings));
    for (sighting &one : *sightings)
        one.used = std::fabs(one.height) <= limit;
}

static double rms(const std::vector<sighting> &sightings)
{
    double squares = 0;
    int n = 0;

    for (const sighting &one : sightings)
        if (one.used) {
            squares += one.height * one.height;
            n++;
        }
    return n ? std::sqrt(squares / n) : 0;
}

/* One step of Gauss and Newton over the used sightings, with the prior. */
static void improve(const stereo_rig &start, const std::vector<sighting> &sightings,
                    cv::Vec<double, TURNS> *turn)
{
    const double step = 1e-5;
    cv::Matx<double, TURNS, TURNS> normal = cv::Matx<double, TURNS, TURNS>::zeros();
    cv::Vec<double, TURNS> right = cv::Vec<double, TURNS>::all(0);
    stereo_rig aside[TURNS];

    for (int k = 0; k < TURNS; k++) {
        cv::Vec<double, TURNS> moved = *turn;
        moved[k] += step;
        aside[k] = turned(start, moved);
        normal(k, k) = std::pow(height_deviation / turn_prior[k], 2);
        right[k] = -normal(k, k) * (*turn)[k];
    }
    for (const sighting &one : sightings) {
        cv::Vec<double, TURNS> slope;
        if (!one.used)
            continue;
        for (int k = 0; k < TURNS; k++)
            slope[k] =
                (stereo_height(aside[k], one.left.cone.axis, one.right.cone.axis) - one.height) /
                step;
        normal += slope * slope.t();
        right -= slope * one.height;
    }
    *turn += normal.solve(right, cv::DECOMP_CHOLESKY);
}

bool rig_solve(const stereo_rig &rig, std::vector<sighting> *sightings, solution *found)
{
    cv::Vec<double, TURNS> turn = cv::Vec<double, TURNS>::all(0);

    if (sightings->size() < least_sightings)
        return false;
    found->rig = rig;
    roundness(rig, rig.left.aspect, sightings);
    measure(rig, sightings);
    found->before = rms(*sightings);
    found->rig.left.aspect = found->rig.right.aspect = rig_find_aspect(rig, sightings);
    roundness(found->rig, found->rig.left.aspect, sightings);
    const stereo_rig start = found->rig;
    for (int i = 0; i < turn_rounds; i++) {
        measure(turned(start, turn), sightings);
        improve(start, *sightings, &turn);
    }
    found->rig = turned(start, turn);
    measure(found->rig, sightings);
    found->after = rms(*sightings);
    found->used = static_cast<int>(std::count_if(sightings->begin(), sightings->end(),
                                                 [](const sighting &one) { return one.used; }));
    return static_cast<size_t>(found->used) >= least_sightings;
}
