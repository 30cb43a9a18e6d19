/* What a user without a multicast route is told. Runs in a network namespace without one. */
#include "common/bus/open.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(void)
{
    char error[512] = "";
    lcm_t *lcm = bus_open(NULL, error, sizeof error);

    if (lcm) {
        fprintf(stderr, "the bus opened without a route\n");
        lcm_destroy(lcm);
        return EXIT_FAILURE;
    }
    if (!strstr(error, "ip route add 224.0.0.0/4 dev lo") || strchr(error, '\n')) {
        fprintf(stderr, "no remedy in one line: '%s'\n", error);
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
