#include "tools/measure/durations.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

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

static int compare(const void *a, const void *b)
{
    double left = *(const double *)a;
    double right = *(const double *)b;

    return (left > right) - (left < right);
}

static double quantile(const struct durations *sorted, double share)
{
    double rank = ceil(share * (double)sorted->n);

    return sorted->us[rank < 1 ? 0 : (size_t)rank - 1];
}

struct durations_summary durations_summarise(struct durations *durations)
{
    struct durations_summary summary = {durations->n, NAN, NAN, NAN, NAN, NAN};
    double sum = 0;

    if (durations->n == 0)
        return summary;
    qsort(durations->us, durations->n, sizeof *durations->us, compare);
    for (size_t i = 0; i < durations->n; i++)
        sum += durations->us[i];
    summary.mean = sum / (double)durations->n;
    summary.p50 = quantile(durations, 0.5);
    summary.p99 = quantile(durations, 0.99);
    summary.p999 = quantile(durations, 0.999);
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
