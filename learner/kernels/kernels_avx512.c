/* The kernels for vectors of eight. */
#define KERNELS_TABLE kernels_avx512
#define KERNELS_WIDTH 8
#include "learner/kernels/kernels_body.h"
