#include "vision/rig/rig_file.h"

#include <cerrno>
#include <cstring>

#include "common/program/log.h"

static const double degree = 3.14159265358979323846 / 180;

static void write_eye(const char *name, const camera &eye, FILE *out)
{
    fprintf(out, "%s:\n  {focal: %.3f, aspect: %.5f, centre_u: %.2f, centre_v: %.2f,\n", name,
            eye.focal, eye.aspect, eye.centre_u, eye.centre_v);
    fprintf(out, "   k1: %.6f, k2: %.6f, k3: %.6f, p1: %.6f, p2: %.6f,\n", eye.k1, eye.k2, eye.k3,
            eye.p1, eye.p2);
    fprintf(out, "   yaw: %.4f, pitch: %.4f, roll: %.4f}\n", eye.yaw / degree, eye.pitch / degree,
            eye.roll / degree);
}

void rig_write(const stereo_rig &rig, const char *comment, FILE *out)
{
    fprintf(out, "# %s\ncamera: {width: %d, height: %d}\n", comment, rig.left.width,
            rig.left.height);
    write_eye("left", rig.left, out);
    write_eye("right", rig.right, out);
    fprintf(out, "eyes: {vergence: %.4f, baseline: %.5f}\n", rig.vergence / degree, rig.baseline);
}

int rig_save(const stereo_rig &rig, const char *comment, const char *path)
{
    FILE *out = fopen(path, "w");

    if (out) {
        rig_write(rig, comment, out);
        if (fclose(out) == 0)
            return 0;
    }
    log_error("%s: %s", path, strerror(errno));
    return -1;
}
