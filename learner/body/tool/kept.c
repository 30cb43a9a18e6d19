#include "learner/body/tool/kept.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "common/base/random.h"

/* Two postures that differ less than this in every joint say the same. */
static const double first_spacing = 0.01; /* rad */
static const double growth = 1.005;
static const double most_spacing = 0.2; /* rad */
/* A kept sample gives way to a new one near it after so many. */
static const double old = 1000.0;

size_t kept_numbers(int capacity, int n_inputs, int n_outputs)
{
    return (size_t)capacity * (size_t)(n_inputs + n_outputs + 1);
}

void kept_place(struct kept *kept, int capacity, int n_inputs, int n_outputs, double *numbers)
{
    *kept = (struct kept){
        .capacity = capacity,
        .n_inputs = n_inputs,
        .n_outputs = n_outputs,
        .spacing = first_spacing,
        .z = numbers,
        .x = numbers + (size_t)capacity * (size_t)n_inputs,
        .at = numbers + (size_t)capacity * (size_t)(n_inputs + n_outputs),
    };
}

void kept_clear(struct kept *kept)
{
    kept->n = 0;
    kept->spacing = first_spacing;
    kept->offered = 0.0;
}

static double *input(const struct kept *kept, int i)
{
    return kept->z + (size_t)i * (size_t)kept->n_inputs;
}

static double *output(const struct kept *kept, int i)
{
    return kept->x + (size_t)i * (size_t)kept->n_outputs;
}

/* The largest difference of a joint, or any that is not under `enough`. */
static double apart(const struct kept *kept, int i, const double *z, double enough)
{
    const double *other = input(kept, i);
    double most = 0.0;

    for (int k = 0; k < kept->n_inputs && most < enough; k++) {
        double one = fabs(other[k] - z[k]);
        most = one > most ? one : most;
    }
    return most;
}

int kept_nearest(const struct kept *kept, const double *z)
{
    double least = INFINITY;
    int nearest = -1;

    for (int i = 0; i < kept->n; i++) {
        double distance = apart(kept, i, z, least);
        if (distance < least) {
            least = distance;
            nearest = i;
        }
    }
    return nearest;
}

int kept_nearest_output(const struct kept *kept, const double *x, const double *unit)
{
    double least = INFINITY;
    int nearest = -1;

    for (int i = 0; i < kept->n; i++) {
        const double *other = output(kept, i);
        double distance = 0.0;
        for (int k = 0; k < kept->n_outputs; k++)
            distance += (other[k] - x[k]) / unit[k] * ((other[k] - x[k]) / unit[k]);
        if (distance < least) {
            least = distance;
            nearest = i;
        }
    }
    return nearest;
}

static void put(struct kept *kept, int i, const double *z, const double *x)
{
    memmove(input(kept, i), z, (size_t)kept->n_inputs * sizeof *z);
    memmove(output(kept, i), x, (size_t)kept->n_outputs * sizeof *x);
    kept->at[i] = kept->offered;
}

static void take_out(struct kept *kept, int i)
{
    size_t behind = (size_t)(kept->n - i - 1);

    memmove(input(kept, i), input(kept, i + 1), behind * (size_t)kept->n_inputs * sizeof(double));
    memmove(output(kept, i), output(kept, i + 1),
            behind * (size_t)kept->n_outputs * sizeof(double));
    memmove(kept->at + i, kept->at + i + 1, behind * sizeof(double));
    kept->n--;
}

/* Which one makes room: any, the same for the same stream. */
static int any_of(const struct kept *kept)
{
    struct random_state random = random_seed((int64_t)kept->offered);

    return (int)(random_bits(&random) % (uint64_t)kept->n);
}

/* Whether z may be kept: all that are near it are old. They go, but for one whose place it takes;
 * *place is -1 when there is none. */
static bool replaces(struct kept *kept, const double *z, int *place)
{
    *place = -1;
    for (int i = 0; i < kept->n; i++)
        if (apart(kept, i, z, kept->spacing) < kept->spacing) {
            if (kept->offered - kept->at[i] < old)
                return false;
            *place = i;
        }
    for (int i = *place - 1; i >= 0; i--)
        if (apart(kept, i, z, kept->spacing) < kept->spacing) {
            take_out(kept, i);
            --*place;
        }
    return true;
}

void kept_add(struct kept *kept, const double *z, const double *x)
{
    int place = -1;

    kept->offered += 1.0;
    if (!replaces(kept, z, &place))
        return;
    if (place < 0 && kept->n == kept->capacity) {
        place = any_of(kept);
        kept->spacing = fmin(kept->spacing * growth, most_spacing);
    }
    put(kept, place >= 0 ? place : kept->n++, z, x);
}
