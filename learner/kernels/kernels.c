#include "learner/kernels/kernels.h"

extern const struct kernels kernels_plain;

#ifdef REACH_KERNELS_X86
extern const struct kernels kernels_avx2;
extern const struct kernels kernels_avx512;

static const struct kernels *avx2(void)
{
    return __builtin_cpu_supports("avx2") ? &kernels_avx2 : NULL;
}

static const struct kernels *avx512(void)
{
    return __builtin_cpu_supports("avx512f") ? &kernels_avx512 : NULL;
}
#else
static const struct kernels *avx2(void)
{
    return NULL;
}

static const struct kernels *avx512(void)
{
    return NULL;
}
#endif

const struct kernels *kernels_of(enum learner_kernels width)
{
    switch (width) {
    case LEARNER_KERNELS_PLAIN:
        return &kernels_plain;
    case LEARNER_KERNELS_AVX2:
        return avx2();
    case LEARNER_KERNELS_AVX512:
        return avx512();
    case LEARNER_KERNELS_AUTO:
        break;
    }
    const struct kernels *widest = avx512() ? avx512() : avx2();
    return widest ? widest : &kernels_plain;
}
