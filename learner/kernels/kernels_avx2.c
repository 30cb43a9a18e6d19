/* The kernels for vectors of four. */
#define KERNELS_TABLE kernels_avx2
#define KERNELS_WIDTH 4
#include "learner/kernels/kernels_body.h"
