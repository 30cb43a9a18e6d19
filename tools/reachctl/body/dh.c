#include "tools/reachctl/body/dh.h"

#include "learner/body/chain/vec3.h"

#include <math.h>
#include <string.h>

/* Axes that differ less than this in direction count as parallel. */
static const double parallel = 1e-9;

/* A joint's axis where all joints are zero. */
struct line {
    double point[3], direction[3];
};

static void lines_of(const struct chain *chain, struct line *lines)
{
    const double zero[CHAIN_MAX_JOINTS] = {0};
    struct chain_pose pose;

    chain_at(chain, zero, &pose);
    for (int i = 0; i < chain->n; i++) {
        memcpy(lines[i].point, pose.place[i], sizeof lines[i].point);
        memcpy(lines[i].direction, pose.axis[i], sizeof lines[i].direction);
    }
}

static void difference(const double *a, const double *b, double *y)
{
    for (int k = 0; k < 3; k++)
        y[k] = a[k] - b[k];
}

/* What of v is across the unit vector w. */
static void take_across(const double *w, double *v)
{
    double along = vec3_dot(v, w);

    vec3_add(-along, w, v);
}

static void make_unit(double *v)
{
    double length = vec3_length(v);

    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

/* Any unit vector across w, near `like` where that is across enough. */
static void any_across(const double *w, const double *like, double *x)
{
    static const double tries[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

    memcpy(x, like, 3 * sizeof *x);
    take_across(w, x);
    for (int k = 0; k < 3 && vec3_length(x) < 0.5; k++) {
        memcpy(x, tries[k], 3 * sizeof *x);
        take_across(w, x);
    }
    make_unit(x);
}

/* The common normal from line a to line b: its foot on each, and its direction x, which is near
 * x_before where it is free. `from` is the frame's origin on a. */
static void common_normal(const struct line *a, const struct line *b, const double *from,
                          const double *x_before, double *on_a, double *on_b, double *x)
{
    double between[3], cross[3];

    vec3_cross(a->direction, b->direction, cross);
    memcpy(on_a, from, 3 * sizeof *on_a);
    memcpy(on_b, b->point, 3 * sizeof *on_b);
    if (vec3_length(cross) < parallel) {
        difference(from, b->point, between);
        vec3_add(vec3_dot(between, b->direction), b->direction, on_b);
    } else {
        /* Along each line to where the other is nearest. */
        double n = vec3_dot(cross, cross);
        double turned[3];
        difference(b->point, from, between);
        vec3_cross(between, b->direction, turned);
        vec3_add(vec3_dot(turned, cross) / n, a->direction, on_a);
        vec3_cross(between, a->direction, turned);
        vec3_add(vec3_dot(turned, cross) / n, b->direction, on_b);
    }
    difference(on_b, on_a, x);
    if (vec3_length(x) > 1e-12)
        make_unit(x);
    else if (vec3_length(cross) >= parallel) {
        memcpy(x, cross, 3 * sizeof *x);
        make_unit(x);
    } else {
        any_across(a->direction, x_before, x);
    }
}

/* The angle from u to v about w; all are unit vectors, u and v across w. */
static double angle_about(const double *w, const double *u, const double *v)
{
    double cross[3];

    vec3_cross(u, v, cross);
    return atan2(vec3_dot(cross, w), vec3_dot(u, v));
}

void dh_of_chain(const struct chain *chain, struct dh *dh)
{
    static const double forward[3] = {1, 0, 0};
    struct line lines[CHAIN_MAX_JOINTS];
    double *x = dh->base, *z = dh->base + 6, *origin = dh->base + 9;
    double here[3], x_before[3];

    memset(dh, 0, sizeof *dh);
    dh->n = chain->n;
    lines_of(chain, lines);
    memcpy(z, lines[0].direction, 3 * sizeof *z);
    memcpy(origin, lines[0].point, 3 * sizeof *origin);
    any_across(z, forward, x);
    vec3_cross(z, x, dh->base + 3);
    memcpy(here, origin, sizeof here);
    memcpy(x_before, x, sizeof x_before);
    for (int i = 0; i < chain->n; i++) {
        struct dh_row *row = &dh->row[i];
        double on_this[3], on_next[3], normal[3], step[3];
        if (i + 1 == chain->n) {
            break; /* frame n is frame n - 1, turned by the last joint */
        }
        common_normal(&lines[i], &lines[i + 1], here, x_before, on_this, on_next, normal);
        difference(on_this, here, step);
        row->d = vec3_dot(step, lines[i].direction);
        row->theta = angle_about(lines[i].direction, x_before, normal);
        difference(on_next, on_this, step);
        row->a = vec3_dot(step, normal);
        row->alpha = angle_about(normal, lines[i].direction, lines[i + 1].direction);
        memcpy(here, on_next, sizeof here);
        memcpy(x_before, normal, sizeof x_before);
    }
}
