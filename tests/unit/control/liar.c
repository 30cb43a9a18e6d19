#include "liar.h"

#include <math.h>
#include <string.h>

const char *const lie_names[TRUTHS] = {
    [LIE_NONE] = "nothing is wrong",
    [LIE_JUMPS] = "each frame jumps by up to 30 px, 5 cm",
    [LIE_OUTLIERS] = "one frame of five is anywhere",
    [LIE_ROWS] = "every other frame 30 px, 3 cm too low",
    [LIE_REPEATS] = "the last answer again and again",
    [LIE_NUMB] = "the same, with fresh noise",
    [LIE_LATE] = "0.3 s late under new stamps",
    [LIE_VERY_LATE] = "0.6 s late under new stamps",
    [LIE_WANDERS] = "wanders by 40 px, 8 cm, once in 2 s",
    [LIE_EYE_FROZEN] = "the left eye is frozen",
    [LIE_EYE_LATE] = "the left eye is 0.3 s late",
    [LIE_PAST] = "stamps 10 s too old",
    [LIE_FUTURE] = "stamps 10 s too new",
    [TRUTH_KNOCKED] = "knocked by 25 px, 3 cm, once",
    [TRUTH_TOOL] = "a new tool",
};

void liar_init(struct liar *liar, const struct config *config, int64_t seed)
{
    memset(liar, 0, sizeof *liar);
    liar->config = config;
    liar->random = random_seed(seed);
}

void liar_begin(struct liar *liar, enum lie lie)
{
    liar->lie = lie;
    liar->ticks = 0;
}

static bool sees(const struct config *config)
{
    return config->space.kind == SPACE_VISUAL;
}

bool liar_can(bool tracker, enum lie lie)
{
    return !tracker || (lie != LIE_EYE_FROZEN && lie != LIE_EYE_LATE);
}

static const struct observation *ago(const struct liar *liar, double seconds)
{
    int frames = (int)lround(seconds / liar->config->period);

    return &liar->told[(liar->newest - frames + LIAR_REMEMBERS) % LIAR_REMEMBERS];
}

/* Adds up to so much to each axis. */
static void stir(struct liar *liar, double *value, double most)
{
    for (int axis = 0; axis < SPACE_DIMENSIONS; axis++)
        value[axis] += random_uniform(&liar->random, -most, most);
}

static void shift(double *value, double by)
{
    value[0] += by;
    value[1] += by;
}

/* What the left eye saw then, beside what the right one sees. */
static void mix_eyes(struct observation *observation, const struct observation *left)
{
    observation->value[2] = left->value[2] + left->value[0] - observation->value[0];
}

static void take(struct observation *observation, const struct observation *other)
{
    memcpy(observation->value, other->value, sizeof observation->value);
    observation->seen = other->seen;
}

static void lie_of_where(struct liar *liar, struct observation *o)
{
    bool px = sees(liar->config);
    double swing = sin(3.14159265358979 * liar->ticks * liar->config->period);

    switch (liar->lie) {
    case LIE_JUMPS:
        stir(liar, o->value, px ? 30 : 0.05);
        break;
    case LIE_OUTLIERS:
        if (random_uniform(&liar->random, 0, 1) < 0.2)
            stir(liar, o->value, px ? 150 : 0.3);
        break;
    case LIE_ROWS:
        o->value[px ? 1 : 2] += liar->ticks % 2 ? px ? 30 : 0.03 : 0;
        break;
    case LIE_WANDERS:
        shift(o->value, swing * (px ? 40 : 0.08));
        break;
    case TRUTH_KNOCKED:
        shift(o->value, px ? 25 : 0.03);
        break;
    default:
        break;
    }
}

static void lie_of_when(struct liar *liar, struct observation *o)
{
    switch (liar->lie) {
    case LIE_REPEATS:
        take(o, &liar->first);
        break;
    case LIE_NUMB:
        take(o, &liar->first);
        stir(liar, o->value, sees(liar->config) ? 0.5 : 0.001);
        break;
    case LIE_LATE:
        take(o, ago(liar, 0.3));
        break;
    case LIE_VERY_LATE:
        take(o, ago(liar, 0.6));
        break;
    case LIE_EYE_FROZEN:
        mix_eyes(o, &liar->first);
        break;
    case LIE_EYE_LATE:
        mix_eyes(o, ago(liar, 0.3));
        break;
    case LIE_PAST:
        o->utime -= 10000000;
        break;
    case LIE_FUTURE:
        o->utime += 10000000;
        break;
    default:
        break;
    }
}

void liar_tell(struct liar *liar, struct observation *observation)
{
    liar->newest = (liar->newest + 1) % LIAR_REMEMBERS;
    liar->told[liar->newest] = *observation;
    if (liar->ticks++ == 0)
        liar->first = *observation;
    if (observation->seen)
        lie_of_where(liar, observation);
    lie_of_when(liar, observation);
}
