/* The kernels for vectors of two numbers, which every x86-64 has. */
#define KERNELS_TABLE kernels_plain
#define KERNELS_WIDTH 2
#include "learner/kernels/kernels_body.h"
