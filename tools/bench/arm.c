#include "tools/bench/arm.h"

#include <math.h>
#include <string.h>

static const double radians_per_degree = 3.14159265358979323846 / 180.0;
static const double noise = 0.0005;     /* m */
static const double longest_tool = 0.6; /* m */

/* Joint ranges in degrees. */
static const double lowest[ARM_JOINTS] = {-30, -30, -10, -80, 0, 0, 20};
static const double highest[ARM_JOINTS] = {30, 30, 30, 0, 80, 80, 80};

/* Rotations about an axis: y maps (x, z) to (cos x + sin z, -sin x + cos z), the others are
 * right-handed. */
static void turn_x(double angle, double v[3])
{
    double y = cos(angle) * v[1] - sin(angle) * v[2];

    v[2] = sin(angle) * v[1] + cos(angle) * v[2];
    v[1] = y;
}

static void turn_y(double angle, double v[3])
{
    double x = cos(angle) * v[0] + sin(angle) * v[2];

    v[2] = -sin(angle) * v[0] + cos(angle) * v[2];
    v[0] = x;
}

static void turn_z(double angle, double v[3])
{
    double x = cos(angle) * v[0] - sin(angle) * v[1];

    v[1] = sin(angle) * v[0] + cos(angle) * v[1];
    v[0] = x;
}

void arm_tip(const double q[ARM_JOINTS], const double tool[3], double x[ARM_OUTPUTS])
{
    memcpy(x, tool, ARM_OUTPUTS * sizeof *x);
    x[2] -= 0.197;
    turn_y(-q[6], x);
    turn_z(-q[5], x);
    x[2] -= 0.152;
    turn_x(-q[4], x);
    turn_y(q[3], x);
    x[1] -= 0.11;
    x[2] += 0.18;
    turn_y(q[2], x);
    turn_x(q[1], x);
    turn_z(q[0], x);
}

struct body arm_body(void)
{
    static const double axes[ARM_JOINTS][3] = {{0, 0, 1},  {1, 0, 0},  {0, 1, 0}, {0, 1, 0},
                                               {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
    static const double known = 1e-4; /* m: how well each number is */
    struct body body = {.chain = {.n = ARM_JOINTS}, .length = 0.3, .gravity = {0, 0, -1}};

    memcpy(body.chain.axis, axes, sizeof axes);
    body.chain.offset[3][1] = -0.11;
    body.chain.offset[3][2] = 0.18;
    body.chain.offset[5][2] = -0.152;
    for (int i = 0; i < ARM_JOINTS; i++)
        body.range[i] = (highest[i] - lowest[i]) / 2.0 * radians_per_degree;
    for (int i = 0; i < BODY_OUTPUTS; i++)
        body.noise[i] = noise;
    for (int i = 0; i < body_unknowns(&body); i++)
        body.root[i * (i + 1) / 2 + i] = known;
    return body;
}

/* splitmix64, uniform in [0, 1) */
static double uniform(struct arm_stream *stream)
{
    stream->state += 0x9E3779B97F4A7C15ULL;
    uint64_t mixed = (stream->state ^ (stream->state >> 30)) * 0xBF58476D1CE4E5B9ULL;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBULL;
    return (double)((mixed ^ (mixed >> 31)) >> 11) * 0x1p-53;
}

static double normal(struct arm_stream *stream)
{
    double radius = sqrt(-2.0 * log(1.0 - uniform(stream)));

    return radius * cos(360 * radians_per_degree * uniform(stream));
}

static void draw(struct arm_stream *stream, double q[ARM_JOINTS])
{
    int first = ARM_JOINTS - stream->n_inputs; /* joints before it stay at zero */

    memset(q, 0, ARM_JOINTS * sizeof *q);
    for (int i = first; i < ARM_JOINTS; i++)
        q[i] = radians_per_degree * (lowest[i] + (highest[i] - lowest[i]) * uniform(stream));
}

struct arm_stream arm_stream_start(uint64_t seed, int n_inputs, double speed)
{
    struct arm_stream stream = {.state = seed, .n_inputs = n_inputs, .speed = speed};

    draw(&stream, stream.q);
    return stream;
}

void arm_stream_take_tool(struct arm_stream *stream, int number)
{
    struct arm_stream source = {.state = (uint64_t)number};

    for (int i = 0; i < 3; i++)
        stream->tool[i] = number == 0 ? 0.0 : longest_tool / sqrt(3.0) * (2 * uniform(&source) - 1);
}

void arm_stream_query(struct arm_stream *stream, double *z)
{
    double q[ARM_JOINTS];

    draw(stream, q);
    memcpy(z, q + ARM_JOINTS - stream->n_inputs, (size_t)stream->n_inputs * sizeof *z);
}

/* The way to another turning point. */
static void turn(struct arm_stream *stream)
{
    double goal[ARM_JOINTS];
    double farthest = 0.0;

    draw(stream, goal);
    for (int i = 0; i < ARM_JOINTS; i++)
        farthest = fmax(farthest, fabs(goal[i] - stream->q[i]));
    stream->steps = 1 + (int)(farthest / stream->speed);
    for (int i = 0; i < ARM_JOINTS; i++)
        stream->step[i] = (goal[i] - stream->q[i]) / stream->steps;
}

void arm_stream_next(struct arm_stream *stream, double *z, double x[ARM_OUTPUTS])
{
    if (stream->steps == 0)
        turn(stream);
    stream->steps--;
    for (int i = 0; i < ARM_JOINTS; i++)
        stream->q[i] += stream->step[i];
    memcpy(z, stream->q + ARM_JOINTS - stream->n_inputs, (size_t)stream->n_inputs * sizeof *z);
    arm_tip(stream->q, stream->tool, x);
    for (int i = 0; i < ARM_OUTPUTS; i++)
        x[i] += noise * normal(stream);
}
