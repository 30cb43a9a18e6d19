#include "tools/measure/durations.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "tools/measure/quantiles.h"

int64_t durations_clock(void)
{
    struct timespec now;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void grow(struct durations *durations)
{
    size_t room = durations->room ? 2 * durations->room : 4096;
    double *us = realloc(durations->us, room * sizeof *us);

    if (!us) {
        fprintf(stderr, "out of memory for the times of %zu calls\n", room);
        exit(EXIT_FAILURE);
    }
    durations->us = us;
    durations->room = room;
}

void durations_add(struct durations *durations, int64_t start)
{
    int64_t end = durations_clock();

    if (durations->n == durations->room)
        grow(durations);
    durations->us[durations->n++] = 1e-3 * (double)(end - start);
}

struct durations_summary durations_summarise(struct durations *durations)
{
    struct durations_summary summary = {durations->n, NAN, NAN, NAN, NAN, NAN};
    double sum = 0;

    if (durations->n == 0)
        return summary;
    quantiles_sort(durations->us, durations->n);
    for (size_t i = 0; i < durations->n; i++)
        sum += durations->us[i];
    summary.mean = sum / (double)durations->n;
    summary.p50 = quantile(durations->us, durations->n, 0.5);
    summary.p99 = quantile(durations->us, durations->n, 0.99);
    summary.p999 = quantile(durations->us, durations->n, 0.999);
    summary.max = durations->us[durations->n - 1];
    return summary;
}

void durations_clear(struct durations *durations)
{
    durations->n = 0;
}

void durations_free(struct durations *durations)
{
    free(durations->us);
    *durations = (struct durations){0};
}
