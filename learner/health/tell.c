#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>

#include "learner/health/judge.h"

/* A line that grows; what does not fit is left out. */
struct line {
    char *text;
    size_t size, used;
};

static void put(struct line *line, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(struct line *line, const char *format, ...)
{
    va_list arguments;
    int n;

    if (line->used + 1 >= line->size)
        return;
    va_start(arguments, format);
    n = vsnprintf(line->text + line->used, line->size - line->used, format, arguments);
    va_end(arguments);
    line->used += n > 0 ? (size_t)n : 0;
    if (line->used >= line->size)
        line->used = line->size - 1;
}

static void put_input(struct line *line, const struct health *health, int input)
{
    put(line, "input %d", input + 1);
    if (health->names)
        put(line, " (%s)", health->names[input]);
}

static void put_share(struct line *line, const struct health *health, uint64_t part)
{
    put(line, "%" PRIu64 " of %" PRIu64 " samples (%.2g %%)", part, health->samples,
        100 * (double)part / (double)health->samples);
}

/* Inputs that share a trouble, after the one that was named. */
static void put_others(struct line *line, const struct health *health, int named,
                       bool (*has)(const struct health *health, int input))
{
    int others[LEARNER_MAX_INPUTS];
    int n = 0;

    for (int i = 0; i < health->n_inputs; i++)
        if (i != named && has(health, i))
            others[n++] = i + 1;
    for (int i = 0; i < n; i++)
        put(line, "%s%d", i > 0 ? ", " : n > 1 ? "; so are inputs " : "; so is input ", others[i]);
}

static bool input_is_far(const struct health *health, int input)
{
    return health->input[input].far > 0;
}

static void tell_far(struct line *line, const struct health *health)
{
    const int worst = health_farthest(health);
    const struct health_input *input = &health->input[worst];

    put_input(line, health, worst);
    put(line, " is %.6g in sample %" PRIu64 ", %.0f scales from its reference %g (scale %g)",
        input->farthest, input->farthest_sample, health_scales(health, worst, input->farthest),
        health->reference[worst], health->scale[worst]);
    put_others(line, health, worst, input_is_far);
    put(line, ": another unit, another column?");
}

static void tell_constant(struct line *line, const struct health *health)
{
    int first = 0;

    while (first < health->n_inputs - 1 && !health_is_constant(health, first))
        first++;
    put_input(line, health, first);
    put(line, " is %.6g in all %" PRIu64 " samples", health->input[first].low, health->seen);
    put_others(line, health, first, health_is_constant);
    put(line, ": what it does is not learned");
}

static void tell_experts(struct line *line, const struct health *health,
                         const struct learner_statistics *statistics)
{
    if (health_lacks_samples(health, statistics))
        put(line, "%d experts from %" PRIu64 " samples", statistics->experts, statistics->samples);
    else
        put(line, "%d experts, but %.1f solutions", statistics->experts,
            health_mean_solutions(health));
    put(line, ": more than there are branches; a smaller p0 or a larger psi0 makes fewer");
}

void health_tell(const struct health *health, const struct learner_statistics *statistics,
                 enum health_trouble trouble, char *text, size_t size)
{
    struct line line = {.text = text, .size = size};

    if (size > 0)
        text[0] = '\0';
    switch (trouble) {
    case HEALTH_FULL:
        put_share(&line, health, health->full);
        put(&line, " were dropped: all %d experts are in use (p0, psi0, capacity)",
            statistics->capacity);
        break;
    case HEALTH_OUTLIERS:
        put_share(&line, health, health->outliers);
        put(&line, " were dropped as outliers: psi0 too small, or wrong rows?");
        break;
    case HEALTH_FAR:
        tell_far(&line, health);
        break;
    case HEALTH_CONSTANT:
        tell_constant(&line, health);
        break;
    case HEALTH_FROZEN:
        put(&line, "in ");
        put_share(&line, health, health->frozen);
        put(&line,
            " outputs stood still while inputs moved, first in sample %" PRIu64
            ": a frozen tracker?",
            health->first_frozen);
        break;
    case HEALTH_EXPERTS:
        tell_experts(&line, health, statistics);
        break;
    case HEALTH_TROUBLES:
        break;
    }
}
