#include "simrobot/setup/inertia.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>

namespace sim
{
namespace
{

/* Of numbers in a file. */
const double rounding = 0.01;

/* No part that moves is smaller: its mass lies this far from its centre at least, m. */
const double smallest = 1e-4;

/* Nothing on a robot is heavier or larger, kg and m; ODE would count with infinity. */
const double heaviest = 1e6, furthest = 1e3;

Eigen::Vector3d moments(const Inertia &inertia)
{
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia.about_centre).eigenvalues();
}

/* What rounding may do: to the largest moment, and to parts so small that they have none. */
double slack(const Inertia &inertia)
{
    return rounding * moments(inertia)[2] + 0.01 * smallest * smallest * std::fabs(inertia.mass);
}

std::string text_of(double number)
{
    char text[40];
    snprintf(text, sizeof text, "%g", number);
    return text;
}

Eigen::Matrix3d steiner(double mass, const Eigen::Vector3d &r)
{
    return mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
}

} // namespace

Inertia inertia_sum(const Inertia &one, const Inertia &other)
{
    Inertia sum;

    sum.mass = one.mass + other.mass;
    if (sum.mass <= 0)
        return one;
    sum.centre = (one.mass * one.centre + other.mass * other.centre) / sum.mass;
    sum.about_centre = one.about_centre + steiner(one.mass, one.centre - sum.centre) +
                       other.about_centre + steiner(other.mass, other.centre - sum.centre);
    return sum;
}

Inertia inertia_moved(const Inertia &inertia, const Eigen::Isometry3d &frame)
{
    return {inertia.mass, frame * inertia.centre,
            frame.linear() * inertia.about_centre * frame.linear().transpose()};
}

std::string inertia_impossible(const Inertia &link)
{
    if (!std::isfinite(link.mass) || !link.centre.allFinite() || !link.about_centre.allFinite() ||
        std::fabs(link.mass) > heaviest || link.centre.norm() > furthest ||
        link.about_centre.norm() > heaviest * furthest * furthest)
        return "mass or inertia is beyond all robots";
    if (link.mass < 0)
        return "its mass is negative (" + text_of(link.mass) + " kg)";
    if (double least = moments(link)[0]; least < -slack(link))
        return "its inertia is negative about one axis (" + text_of(least) + " kg m2)";
    return "";
}

std::string inertia_immovable(const Inertia &body)
{
    if (body.mass <= 0)
        return "a link that moves needs <inertial> with a mass";
    Eigen::Vector3d m = moments(body);
    if (m[0] < body.mass * smallest * smallest)
        return "a link that moves needs an inertia about every axis; its least is " +
               text_of(m[0]) + " kg m2 at " + text_of(body.mass) + " kg";
    if (m[0] + m[1] < m[2] - slack(body))
        return "no body has such an inertia: of its principal moments " + text_of(m[0]) + ", " +
               text_of(m[1]) + ", " + text_of(m[2]) + " kg m2 one is more than the others' sum";
    return "";
}

Inertia inertia_of_ball(double mass, const Eigen::Vector3d &centre)
{
    const double water = 1000; /* kg/m3 */
    double kg = mass > 0 ? mass : 0.01;
    double radius = std::cbrt(3 * kg / (4 * M_PI * water));

    return {kg, centre, 0.4 * kg * radius * radius * Eigen::Matrix3d::Identity()};
}

} // namespace sim
