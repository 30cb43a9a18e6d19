#!/usr/bin/env bash
# GCC 14.2.0 (Debian 13: g++-14 14.2.0-19) with Eigen 3.4.0: -fno-math-errno makes correct code answer wrongly.
#
# The option is known as the harmless part of -ffast-math: it only gives up errno after sqrt() and its like, and
# many projects that compute turn it on. With this compiler, from -O1 on, a vector that is made by an Eigen
# expression and handed on by reference (`meets(a - tip, b, r)`) is read before its elements are written. Below, a way that
# ends 30 cm before a ball is said to meet it. The compiler is silent; without the option, or
# with -fno-ipa-modref beside it, the answer is right. GCC 12.2.0 answers rightly with each of these.
#
# Needs root, debootstrap and the network: a Debian 13 with this compiler is made in a temporary folder.
# Ends with 0 while that is so, with 1 when it is not.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
debootstrap --variant=minbase --include=g++,libeigen3-dev trixie "$folder/debian" >"$folder/log" 2>&1 ||
    { tail "$folder/log" >&2; exit 1; }
chroot "$folder/debian" dpkg-query --show g++-14 libeigen3-dev

cat >"$folder/debian/root/ball.cc" <<'CC'
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
using Eigen::Vector3d;

namespace
{
struct Part { // of a way, as numbers from 0 to 1
    double enter = 0, leave = 1;

    void cut(double low, double high)
    {
        enter = std::max(enter, low);
        leave = std::min(leave, high);
    }
};

template <typename Vector>
void cut_by_ball(Part *part, const Vector &a, const Vector &b, double radius)
{
    double bb = b.squaredNorm(), ab = a.dot(b), c = a.squaredNorm() - radius * radius;
    double root = ab * ab - bb * c;

    if (bb == 0 || root < 0) {
        if (c > 0 || bb > 0)
            part->cut(1, 0);
        return;
    }
    root = std::sqrt(root);
    part->cut((-ab - root) / bb, (-ab + root) / bb);
}

bool meets(const Vector3d &a, const Vector3d &b, double radius)
{
    Part part;
    cut_by_ball(&part, a, b, radius);
    return part.enter <= part.leave;
}

bool meets_disc(const Vector3d &a, const Vector3d &b, double radius)
{
    Part part;
    cut_by_ball(&part, Eigen::Vector2d(a.head<2>()), Eigen::Vector2d(b.head<2>()), radius);
    return part.enter <= part.leave;
}
} // namespace

__attribute__((noinline)) bool met(int kind, const double *size, const Vector3d &a, const Vector3d &to)
{
    Vector3d b = to - a, tip(0, 0, size[1] / 2);

    if (kind == 0)
        return meets(a, b, size[0]);
    if (kind == 1)
        return meets_disc(a, b, size[0]);
    return meets(a - tip, b, size[0]) || meets(a + tip, b, size[0]);
}

int main(int argc, char **)
{
    double size[2] = {0.2, 0.2};
    std::puts(met(argc + 1, size, Vector3d(-1, 0, 0), Vector3d(-0.5, 0, 0)) ? "met" : "missed");
}
CC

answers=$(for options in "-O1" "-O1 -fno-math-errno" "-O2 -fno-math-errno" "-O1 -fno-math-errno -fno-ipa-modref"; do
    # shellcheck disable=SC2086 # words
    chroot "$folder/debian" g++ -Wall -Wextra $options -I/usr/include/eigen3 -o /root/ball /root/ball.cc
    echo "$options: $(chroot "$folder/debian" /root/ball)"
done)
printf '%s\n' "$answers"
expected='-O1: missed
-O1 -fno-math-errno: met
-O2 -fno-math-errno: met
-O1 -fno-math-errno -fno-ipa-modref: missed'
[ "$answers" = "$expected" ] || {
    echo "this has changed; it was:" >&2
    printf '%s\n' "$expected" >&2
    exit 1
}
