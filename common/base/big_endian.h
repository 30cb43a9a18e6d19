/* Numbers as LCM writes them. */
#ifndef REACH_COMMON_BASE_BIG_ENDIAN_H
#define REACH_COMMON_BASE_BIG_ENDIAN_H

#include <stdint.h>

/* The number in `n` bytes, at most 8. */
static inline uint64_t big_endian(const unsigned char *bytes, int n)
{
    uint64_t number = 0;

    for (int i = 0; i < n; i++)
        number = number << 8 | bytes[i];
    return number;
}

#endif
