#include "tools/reachctl/body/show.h"

#include "learner/body/chain/vec3.h"
#include "tools/reachctl/body/dh.h"

#include <math.h>

static const double degree = 3.14159265358979323846 / 180;
/* An axis that is less sure than this is not yet known: nothing that the samples hold turns about
 * it. */
static const double unknown = 10; /* degrees */

/* Standard deviation of the unknown k. */
static double doubt_of(const struct body *body, int k)
{
    const double *row = body->root + (ptrdiff_t)k * (k + 1) / 2;
    double sum = 0;

    for (int i = 0; i <= k; i++)
        sum += row[i] * row[i];
    return sqrt(sum);
}

/* The same of three in a row, all directions together. */
static double doubt_of_three(const struct body *body, int k)
{
    double x = doubt_of(body, k), y = doubt_of(body, k + 1), z = doubt_of(body, k + 2);

    return sqrt(x * x + y * y + z * z);
}

static const char *unit_of(const struct body *body)
{
    return body->sees ? "eye units" : "m";
}

void body_show(const struct body *body, FILE *stream)
{
    const struct chain *chain = &body->chain;

    fprintf(stream,
            "%d joints, found from %d samples; error %.2f of the noise on samples kept apart\n",
            chain->n, body->samples, body->error);
    fprintf(stream,
            "joint  kind    axis at the middle          sure to   to the next   range seen\n");
    for (int i = 0; i < chain->n; i++) {
        double sure = doubt_of_three(body, 3 * i) / degree;
        double length = i + 1 < chain->n ? vec3_length(chain->offset[i + 1]) : 0;
        fprintf(stream, "%5d  %-6s  %+.4f %+.4f %+.4f   ", i + 1,
                chain->slides[i] ? "slides" : "turns", chain->axis[i][0], chain->axis[i][1],
                chain->axis[i][2]);
        if (sure < unknown)
            fprintf(stream, "%6.2f deg", sure);
        else
            fprintf(stream, "not yet   ");
        fprintf(stream, "   %8.4f      +-%.0f deg\n", length, body->range[i] / degree);
    }
    fprintf(stream, "lengths are in %s; the hand and every tool are tips behind the last joint\n",
            unit_of(body));
}

static void write_joint(const struct body *body, int i, FILE *stream)
{
    const struct chain *chain = &body->chain;
    const double zero[CHAIN_MAX_JOINTS] = {0};
    struct chain_pose pose;
    double step[3];

    /* Where all joints are zero the frames of a URDF without turns lie along the base's. */
    chain_at(chain, zero, &pose);
    for (int k = 0; k < 3; k++)
        step[k] = pose.place[i][k] - (i > 0 ? pose.place[i - 1][k] : 0);
    fprintf(stream, "  <link name=\"link%d\"/>\n", i + 1);
    fprintf(stream, "  <joint name=\"joint%d\" type=\"%s\">\n", i + 1,
            chain->slides[i] ? "prismatic" : "revolute");
    fprintf(stream, "    <parent link=\"link%d\"/>\n    <child link=\"link%d\"/>\n", i, i + 1);
    fprintf(stream, "    <origin xyz=\"%.9g %.9g %.9g\"/>\n", step[0], step[1], step[2]);
    fprintf(stream, "    <axis xyz=\"%.9g %.9g %.9g\"/>\n", pose.axis[i][0], pose.axis[i][1],
            pose.axis[i][2]);
    fprintf(stream, "    <limit lower=\"%.6g\" upper=\"%.6g\" velocity=\"1\" effort=\"1\"/>\n",
            chain->middle[i] - body->range[i], chain->middle[i] + body->range[i]);
    fprintf(stream, "  </joint>\n");
}

void body_write_urdf(const struct body *body, FILE *stream)
{
    fprintf(stream, "<?xml version=\"1.0\"?>\n");
    fprintf(
        stream,
        "<!-- Found from %d samples; lengths in %s. Velocities and efforts are not known. -->\n",
        body->samples, unit_of(body));
    fprintf(stream, "<robot name=\"found\">\n  <link name=\"link0\"/>\n");
    for (int i = 0; i < body->chain.n; i++)
        write_joint(body, i, stream);
    fprintf(stream, "</robot>\n");
}

void body_write_dh(const struct body *body, FILE *stream)
{
    struct dh dh = {0};

    dh_of_chain(&body->chain, &dh);
    fprintf(stream, "# T = Rot(z, theta + q) Trans(z, d) Trans(x, a) Rot(x, alpha); deg, %s\n",
            unit_of(body));
    fprintf(stream, "# frame 0 at %.6g %.6g %.6g, x %.6g %.6g %.6g, z %.6g %.6g %.6g\n", dh.base[9],
            dh.base[10], dh.base[11], dh.base[0], dh.base[1], dh.base[2], dh.base[6], dh.base[7],
            dh.base[8]);
    fprintf(stream, "joint,kind,theta,d,a,alpha\n");
    for (int i = 0; i < dh.n; i++)
        fprintf(stream, "%d,%s,%.6f,%.6f,%.6f,%.6f\n", i + 1,
                body->chain.slides[i] ? "slides" : "turns", dh.row[i].theta / degree, dh.row[i].d,
                dh.row[i].a, dh.row[i].alpha / degree);
}
