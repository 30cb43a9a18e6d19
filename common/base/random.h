/* Random numbers that are the same on every machine for the same seed (splitmix64). */
#ifndef REACH_COMMON_BASE_RANDOM_H
#define REACH_COMMON_BASE_RANDOM_H

#include <stdint.h>

struct random_state {
    uint64_t state;
};

static inline struct random_state random_seed(int64_t seed)
{
    return (struct random_state){(uint64_t)seed};
}

/* 64 random bits: a counter in steps of the golden ratio, scrambled (Steele, Lea, Flood 2014). */
static inline uint64_t random_bits(struct random_state *random)
{
    uint64_t z = random->state += UINT64_C(0x9e3779b97f4a7c15);

    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Uniform in [low, high). */
static inline double random_uniform(struct random_state *random, double low, double high)
{
    return low + (high - low) * (double)(random_bits(random) >> 11) * 0x1p-53;
}

#endif
