#include "tools/reachctl/targets.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const int max_targets = (int)(sizeof((reach_request_t *)NULL)->u / sizeof(double));

void targets_star(reach_request_t *request)
{
    static const double ends[8][2] = {{50, 0},  {50, 50},   {0, 50},  {-50, 50},
                                      {-50, 0}, {-50, -50}, {0, -50}, {50, -50}};

    for (int i = 0; i < 8; i++) {
        request->u[2 * i] = ends[i][0];
        request->v[2 * i] = ends[i][1];
    }
    request->n_targets = 16;
}

/* Returns 1 for a target, 0 for a line without one, -1 for anything else. */
static int parse_line(char *line, double *u, double *v, double *disparity)
{
    char rest[2];
    int found;

    line[strcspn(line, "#\n")] = '\0';
    if (line[strspn(line, " \t\r")] == '\0')
        return 0;
    found = sscanf(line, "%lf %lf %lf %1s", u, v, disparity, rest);
    return found == 3 && isfinite(*u) && isfinite(*v) && isfinite(*disparity) ? 1 : -1;
}

static int read_lines(FILE *file, const char *path, reach_request_t *request, char *error,
                      size_t error_size)
{
    char line[256];

    for (int number = 1; fgets(line, sizeof line, file); number++) {
        double u;
        double v;
        double disparity;
        int found = parse_line(line, &u, &v, &disparity);
        if (found == 0)
            continue;
        if (found < 0 || request->n_targets == max_targets) {
            snprintf(error, error_size, "%s:%d: %s", path, number,
                     found < 0 ? "'u v disparity' in pixels is wanted" : "at most 32 targets");
            return -1;
        }
        request->u[request->n_targets] = u;
        request->v[request->n_targets] = v;
        request->disparity[request->n_targets++] = disparity;
    }
    if (request->n_targets == 0) {
        snprintf(error, error_size, "%s: holds no target", path);
        return -1;
    }
    return 0;
}

int targets_read(const char *path, reach_request_t *request, char *error, size_t error_size)
{
    FILE *file = fopen(path, "r");
    int result;

    if (!file) {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
        return -1;
    }
    request->n_targets = 0;
    result = read_lines(file, path, request, error, error_size);
    fclose(file);
    return result;
}
