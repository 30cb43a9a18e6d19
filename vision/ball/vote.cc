#include "vision/ball/vote.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

static const int trials = 700;
static const int ray_distance = 6;      /* between the rays of a trial, at least */
static const double enough_share = 0.9; /* of all rays: no better cone is looked for */
static const double same_cone = 0.15;   /* of the radius: two cones no further apart are one */

/* The ends side by side in single precision, what the compiler can compare four at a time. */
struct packed_ends {
    float x[OUTLINE_RAYS * EDGES_ENDS];
    float y[OUTLINE_RAYS * EDGES_ENDS];
    float z[OUTLINE_RAYS * EDGES_ENDS];
    int n;
};

static void pack(const outline_ends &ends, packed_ends *packed)
{
    packed->n = ends.first[OUTLINE_RAYS];
    for (int i = 0; i < packed->n; i++) {
        packed->x[i] = static_cast<float>(ends.view[i].x);
        packed->y[i] = static_cast<float>(ends.view[i].y);
        packed->z[i] = static_cast<float>(ends.view[i].z);
    }
}

/* Ends of one ray lie 3 px apart or more, so that hardly two of them agree with one cone. */
static int count_near(const packed_ends &ends, const vote_limits &limits, const outline &cone)
{
    const float x = static_cast<float>(cone.axis.x);
    const float y = static_cast<float>(cone.axis.y);
    const float z = static_cast<float>(cone.axis.z);
    const float cosine = static_cast<float>(cone.cosine);
    const double tolerance =
        std::max(limits.tolerance / limits.focal, limits.tolerance_share * cone.tangent);
    const float limit = static_cast<float>(tolerance * cone.tangent * cone.cosine);
    int near = 0;

    for (int i = 0; i < ends.n; i++) {
        const float off = x * ends.x[i] + y * ends.y[i] + z * ends.z[i] - cosine;
        near += off <= limit && off >= -limit;
    }
    return near;
}

static uint32_t next_random(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

static int below(uint32_t *state, int n)
{
    return static_cast<int>(
        (static_cast<uint64_t>(next_random(state)) * static_cast<uint64_t>(n)) >> 32);
}

/* An end of the ray: every second time the last, which is the outline unless something of the
 * ball's colour stands behind it. Returns nullptr when the ray has none. */
static const direction *end_of(const outline_ends &ends, int ray, uint32_t *state)
{
    const int first = ends.first[ray];
    const int n = ends.first[ray + 1] - first;

    if (n == 0)
        return nullptr;
    const int pick = below(state, 2 * n);
    return &ends.view[first + (pick < n ? pick : n - 1)];
}

static bool draw_cone(const outline_ends &ends, const vote_limits &limits, uint32_t *state,
                      outline *cone)
{
    const int spread = OUTLINE_RAYS - 3 * ray_distance;
    const int i = below(state, OUTLINE_RAYS);
    const int j = ray_distance + below(state, spread);
    const int k = j + ray_distance + below(state, OUTLINE_RAYS - 2 * ray_distance - j + 1);
    const direction *const a = end_of(ends, i, state);
    const direction *const b = end_of(ends, (i + j) % OUTLINE_RAYS, state);
    const direction *const c = end_of(ends, (i + k) % OUTLINE_RAYS, state);

    if (!a || !b || !c || !outline_through(*a, *b, *c, cone))
        return false;
    const double radius = cone->tangent * limits.focal;
    return radius >= limits.radius_min && radius <= limits.radius_max && cone->axis.z > 0.1;
}

static bool same(const outline &a, const outline &b)
{
    const double limit = same_cone * std::max(a.tangent, b.tangent);
    const direction apart = {a.axis.x - b.axis.x, a.axis.y - b.axis.y, a.axis.z - b.axis.z};

    return std::fabs(a.tangent - b.tangent) < limit && direction_dot(apart, apart) < limit * limit;
}

/* Puts the cone among the best that differ; returns how many there are now. */
static int insert(outline *cones, int n, const outline &cone)
{
    int place = 0;

    while (place < n && !same(cones[place], cone))
        place++;
    if (place < n && cones[place].support >= cone.support)
        return n;
    if (place == n && n == VOTE_CONES && cones[--place].support >= cone.support)
        return n;
    const int now = std::max(n, place + 1);
    for (; place > 0 && cones[place - 1].support < cone.support; place--)
        cones[place] = cones[place - 1];
    cones[place] = cone;
    return now;
}

int vote_cones(const outline_ends &ends, const vote_limits &limits, outline *cones)
{
    uint32_t state = 2463534242U;
    packed_ends packed;
    int n = 0;

    pack(ends, &packed);
    for (int i = 0; i < trials; i++) {
        outline cone;
        if (!draw_cone(ends, limits, &state, &cone))
            continue;
        cone.support = count_near(packed, limits, cone);
        cone.rms = 0;
        n = insert(cones, n, cone);
        if (cones[0].support >= enough_share * OUTLINE_RAYS)
            break;
    }
    return n;
}

void vote_nearest(const outline_ends &ends, const outline &cone, double focal,
                  outline_points *points)
{
    for (int i = 0; i < OUTLINE_RAYS; i++) {
        double best = INFINITY;
        points->valid[i] = ends.first[i + 1] > ends.first[i];
        for (int k = ends.first[i]; k < ends.first[i + 1]; k++) {
            const double distance = std::fabs(outline_distance(cone, ends.view[k], focal));
            if (distance < best) {
                best = distance;
                points->view[i] = ends.view[k];
            }
        }
    }
}
