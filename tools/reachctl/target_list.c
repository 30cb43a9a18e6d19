#include "tools/reachctl/target_list.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const int max_targets =
    (int)(sizeof((reach_request_t *)NULL)->target / sizeof((reach_request_t *)NULL)->target[0]);

void targets_star(reach_request_t *request)
{
    static const double ends[8][2] = {{50, 0},  {50, 50},   {0, 50},  {-50, 50},
                                      {-50, 0}, {-50, -50}, {0, -50}, {50, -50}};

    for (int i = 0; i < 8; i++)
        memcpy(request->target[2 * i], ends[i], sizeof ends[i]);
    request->n_targets = 16;
}

/* Returns 1 for a target, 0 for a line without one, -1 for anything else. */
static int parse_line(char *line, double target[3])
{
    char rest[2];
    int found;

    line[strcspn(line, "#\n")] = '\0';
    if (line[strspn(line, " \t\r")] == '\0')
        return 0;
    found = sscanf(line, "%lf %lf %lf %1s", &target[0], &target[1], &target[2], rest);
    return found == 3 && isfinite(target[0]) && isfinite(target[1]) && isfinite(target[2]) ? 1 : -1;
}

static int read_lines(FILE *file, const char *path, reach_request_t *request, char *error,
                      size_t error_size)
{
    char line[256];

    for (int number = 1; fgets(line, sizeof line, file); number++) {
        double target[3];
        int found = parse_line(line, target);
        if (found == 0)
            continue;
        if (found < 0 || request->n_targets == max_targets) {
            snprintf(error, error_size, "%s:%d: %s", path, number,
                     found < 0 ? "three numbers, px or m, are wanted" : "at most 32 targets");
            return -1;
        }
        memcpy(request->target[request->n_targets++], target, sizeof target);
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
