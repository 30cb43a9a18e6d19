#include <stdlib.h>
static inline double lab(const char *n, double v) { const char *s = getenv(n); return s ? atof(s) : v; }
