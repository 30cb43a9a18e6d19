/* reach-prime: a model of many experts on disk, for measurements of a daemon that starts from it.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program/version.h"
#include "tools/bench/tick.h"

static const char usage[] =
    "usage: reach-prime DIRECTORY EXPERTS\n"
    "Teaches etc/kobian.yaml with etc/learner-linear.yaml, learner.capacity=1024,\n"
    "learner.noise_angle=0.05 and learner.noise_disparity=0.3 until the model has that many "
    "experts,\n"
    "and leaves it in DIRECTORY, empty before, for a reachd with these options.\n";

int main(int argc, char **argv)
{
    char error[512];
    int experts;

    if (argc == 2 && strcmp(argv[1], "--help") == 0)
        return fputs(usage, stdout) < 0;
    if (argc == 2 && strcmp(argv[1], "--version") == 0)
        return printf("reach-prime %s\n", reach_version) < 0;
    experts = argc == 3 ? atoi(argv[2]) : 0;
    if (experts < 1 || experts > 1024) {
        fputs("reach-prime: wants a directory and 1 to 1024 experts; --help tells more\n", stderr);
        return 2;
    }
    if (tick_prime(argv[1], experts, error, sizeof error) == 0)
        return 0;
    fprintf(stderr, "reach-prime: %s\n", error);
    return 1;
}
